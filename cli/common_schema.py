"""What the keys that commands share may hold: robot, camera, demonstrator and the like."""

from typing import Annotated, Literal

from pydantic import Field as Within

from cli.kinds import (
    Colour,
    NotNegative,
    Pair,
    Place,
    Positive,
    Posture,
    Section,
    Share,
    Size,
    Target,
    Triple,
    Whole,
)


class Camera(Target):
    """`camera`: what the visual space takes of it, and what the camera itself asks for."""

    size: Size
    focal_px: Positive
    gaze: Pair


class HandLook(Section):
    """One of `demonstrator.hands`."""

    radius: Annotated[float, Within(gt=0, le=1)]
    colour: Colour


class Demonstrator(Target):
    """`demonstrator`: what all share, and what the gesture itself asks for."""

    name: str
    hand: str
    hands: dict[str, HandLook]
    height: float
    raised: float = Within(alias="raise")


class Object(Section):
    """`object`."""

    name: str
    radius: Positive
    height: Positive
    mass: Positive
    friction: NotNegative
    spinning: NotNegative
    rolling: NotNegative
    colour: Colour
    seen_px: Pair
    off_m: Pair
    scatter: NotNegative


class Named(Target):
    """`controller`, `selection`."""

    name: str


class HandEvents(Section):
    """`recording.hand`."""

    after: NotNegative
    gap: NotNegative
    least: Share


class Recording(Section):
    """`recording`."""

    max_loss: Positive
    reproducible: bool
    hand: HandEvents
    live: bool


class Field(Section):
    """`field`."""

    name: str
    rows: Annotated[int, Within(ge=1, le=100)]
    columns: Annotated[int, Within(ge=1, le=100)]
    left: NotNegative


class GuardPoint(Section):
    """One of `robot.guard.points` or `.trunk`."""

    link: str
    at: Triple
    radius: NotNegative


class Guard(Section):
    """`robot.guard`."""

    margin: NotNegative
    least_clearance: NotNegative
    late: Annotated[float, Within(ge=0, le=1)]
    points: Annotated[list[GuardPoint], Within(min_length=1)]
    trunk: list[GuardPoint]
    table_height: float
    base_radius: NotNegative
    base_height: NotNegative
    head_radius: NotNegative


class Head(Section):
    """`robot.head`."""

    size: Size
    focal_px: Positive
    eye: Triple
    gaze: Pair
    aside: Pair


class Holding(Section):
    """`robot.holding`."""

    height: float
    outwards: float


class Approach(Section):
    """`robot.approach`."""

    share: Annotated[float, Within(gt=0, le=1)]
    tolerance: Positive
    patience: Positive
    park: bool


class Grasp(Section):
    """`robot.grasp`."""

    drawn_back: Posture
    lifted: Posture
    lowered: Posture
    leaving: Posture
    close_within: Positive
    firm: Positive
    closing: Positive
    opening: Positive


class Robot(Section):
    """`robot`."""

    name: str
    arm: Target
    head: Head
    guided: Annotated[list[Posture], Within(min_length=2)]
    rest: Posture
    guard: Guard
    approach: Approach | None = None  # of a real arm
    holding: Holding
    grasp: Grasp | None


class Dynamics(Section):
    """`dynamics`."""

    tau: Positive
    beta: Positive
    kernel_power: Literal[2, 4]


class Common(Section):
    """What every command that moves a robot takes."""

    seed: Whole
    out: Place | None
    period: Annotated[float, Within(ge=0.001, le=10)]
    dry_run: bool
    confirmed: bool
    recording: Recording
    camera: Camera
    neck: Target | None = None  # of a real camera
    robot: Robot
    vision: Target
    dynamics: Dynamics
    demonstrator: Demonstrator
    fault: Target
    object: Object | None = None  # what a command without it does not take
