"""What each key may hold: types, ranges and lengths. The values themselves stand in conf/ alone."""

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict
from pydantic import Field as Within

Whole = Annotated[int, Within(ge=0)]
Count = Annotated[int, Within(ge=1)]
Positive = Annotated[float, Within(gt=0)]
NotNegative = Annotated[float, Within(ge=0)]
Share = Annotated[float, Within(ge=0, le=1)]
Pair = Annotated[list[float], Within(min_length=2, max_length=2)]
HueRange = Annotated[list[Annotated[int, Within(ge=0, le=179)]], Within(min_length=2, max_length=2)]
ByteRange = Annotated[
    list[Annotated[int, Within(ge=0, le=255)]], Within(min_length=2, max_length=2)
]
Size = Annotated[list[Count], Within(min_length=2, max_length=2)]
Place = str | int  # a file or folder; one may be named 1
Posture = Annotated[list[float], Within(min_length=1)]


Triple = Annotated[list[float], Within(min_length=3, max_length=3)]
Colour = Annotated[list[Share], Within(min_length=4, max_length=4)]
Names = Annotated[list[str], Within(min_length=1)]


class Section(BaseModel):
    """Keys that belong together; no other key is taken."""

    model_config = ConfigDict(extra="forbid", strict=True)


class Target(BaseModel):
    """A node whose `_target_` names what is built of it: other keys are its parameters."""

    model_config = ConfigDict(extra="allow", strict=True)


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


class Recording(Section):
    """`recording`."""

    max_loss: Positive
    reproducible: bool
    live: bool


class Field(Section):
    """`field`."""

    name: str
    rows: Count
    columns: Count
    left: NotNegative


class GuardPoint(Section):
    """One of `robot.guard.points`."""

    link: str
    at: Triple
    radius: NotNegative


class Guard(Section):
    """`robot.guard`."""

    margin: NotNegative
    least_clearance: NotNegative
    points: Annotated[list[GuardPoint], Within(min_length=1)]
    table_height: float
    base_radius: NotNegative
    base_height: NotNegative


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
    period: Positive
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


class Clusters(Section):
    """`map` of learn-map."""

    neurons: Count
    alpha: Annotated[float, Within(gt=0, le=1)]
    min_activity: Share
    radius: NotNegative
    excitation: Positive
    inhibition: Positive


class Learning(Section):
    """`learning`."""

    limit: Positive
    patience: Positive
    arrival: Positive
    blocked: Positive
    pairing: Positive


class Curiosity(Section):
    """`curiosity`."""

    central: Positive
    spacing: NotNegative
    bandwidth: Positive
    ridge: Positive
    jitter: NotNegative
    random: Share


class LearnMap(Common):
    """`imitate learn-map`."""

    field: Field
    guide: bool
    map: Clusters
    learning: Learning
    curiosity: Curiosity


class Reaching(Section):
    """`reach`."""

    tolerance: Positive
    settled: Positive
    hold_frames: Count
    limit: Positive
    after: Literal["stop", "hold"]
    required: Share | None
    inset: NotNegative
    border: NotNegative
    force: bool


class Reach(Common):
    """`imitate reach`."""

    field: Field | None = None  # the map's, so that none is given
    map: Place
    target: Literal["random"] | Pair
    area: Annotated[list[Whole], Within(min_length=2, max_length=2)] | None
    trials: Count
    controller: Named
    reach: Reaching


class TimeCells(Section):
    """`sequence.cells`."""

    shortest: Positive
    longest: Positive
    count: Annotated[int, Within(ge=2, le=1000)]
    width: Annotated[float, Within(ge=0.01, le=1)]


class Sequence(Section):
    """`sequence`."""

    cells: TimeCells
    context: Whole
    match: Annotated[float, Within(gt=0, lt=1)]
    noise: Annotated[float, Within(ge=0, le=0.1)]  # with more, predictions fail to come


class Watching(Section):
    """`demo`."""

    duration: Positive
    gone: Positive


class VisualStates(Section):
    """`states`."""

    dwell: Positive
    still: Positive
    hysteresis: Annotated[float, Within(ge=0, lt=1)]
    lost: NotNegative


class DemoRecord(Common):
    """`imitate demo-record`."""

    field: Field
    sequence: Sequence
    demo: Watching
    states: VisualStates


class Mimicry(Section):
    """`mimic`."""

    endless: Positive
    catching_up: NotNegative
    largest_lag: NotNegative
    shortest: NotNegative
    grace: NotNegative
    near: Positive
    jitter_hz: Pair
    frechet_points: Annotated[int, Within(ge=2)]
    required: Share


class MirrorExperiment(Section):
    """`mirror`."""

    deviations: Annotated[list[NotNegative], Within(min_length=1)]
    window: Positive
    after: Positive
    settled: Positive


class Controls(Section):
    """`controls`."""

    look: str
    still: Positive
    permutations: Count
    quantile: Share
    batch: Count
    workers: Count


class Mimic(Common):
    """`imitate mimic`."""

    field: Field | None = None  # the map's, so that none is given
    map: Place
    duration: Positive | None
    shift: Pair
    selection: Named
    controller: Named | None = None  # of the arm that draws before a mirror
    mimic: Mimicry
    mirror: MirrorExperiment | None
    controls: Controls | None


class Replaying(Section):
    """`replay`."""

    precision: Literal["area", "seen"]
    patience: Positive
    after: NotNegative
    limit: Positive


class Arrivals(Section):
    """`arrivals`."""

    appearing: Annotated[float, Within(gt=0, le=1)]
    leaving: Annotated[float, Within(gt=0, le=1)]
    absence: NotNegative
    one_hand: Positive


class Arriving(Section):
    """`arriving`."""

    passing: Positive
    looking: Positive
    near: Positive
    settled: NotNegative
    still: Positive
    pairing: Positive


class DeferredControls(Section):
    """`controls` of replay."""

    seeds: Count
    noise_level: NotNegative
    noise_steps: Count
    resamples: Count
    workers: Count


class Replay(Common):
    """`imitate replay`."""

    field: Field | None = None  # the map's, so that none is given
    map: Place
    action: Place
    aim: Named
    sequence: Sequence
    states: VisualStates
    replay: Replaying
    arrivals: Arrivals
    arriving: Arriving
    controls: DeferredControls | None


class Figure(Section):
    """`imitate figure`."""

    figure: dict[str, Any]
    name: str
    out: Place
    first_seed: Whole
    seeds: Count
    demo: bool
    demo_seeds: Count


class Checking(Section):
    """`check`."""

    postures: Count
    slowness: Annotated[float, Within(ge=1)]
    arrival: Positive
    frames: Count
    blocked: Positive
    tolerance: Positive


class CheckMap(Common):
    """`imitate check-map`."""

    field: Field | None = None  # the map's, so that none is given
    map: Place
    check: Checking


COMMANDS: dict[str, type[Section]] = {
    "learn-map": LearnMap,
    "reach": Reach,
    "mimic": Mimic,
    "demo-record": DemoRecord,
    "replay": Replay,
    "check-map": CheckMap,
    "figure": Figure,
}
