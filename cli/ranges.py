"""What the parameters of a `_target_` may hold, by section and parameter."""

from typing import Annotated, Any, Literal, get_type_hints

from pydantic import Field as Within

from cli.kinds import (
    ByteRange,
    Colour,
    Count,
    HueRange,
    Names,
    NotNegative,
    Pair,
    Place,
    Positive,
    Section,
    Share,
    Triple,
    Whole,
)

Pulse = Annotated[int, Within(ge=500, le=2500)]  # [us]
ServoId = Annotated[int, Within(ge=0, le=252)]
Byte = Annotated[int, Within(ge=0, le=255)]


class Mark(Section):
    """`robot.arm.mark`."""

    link: str
    offset: Triple
    radius: Annotated[float, Within(gt=0, le=1)]
    colour: Colour


class Table(Section):
    """`robot.arm.table`."""

    size: Annotated[list[Positive], Within(min_length=3, max_length=3)]
    centre: Triple
    colour: Colour
    friction: NotNegative


class Driving(Section):
    """`robot.arm.driving`."""

    calibrate: bool
    unblock: bool
    patience: Positive
    following: Positive
    overdue: Positive
    finger_speed: Positive
    yielding: Positive
    unsure: Whole


class Sensing(Section):
    """`robot.arm.sensing`."""

    empty: Byte
    close: Byte
    reach: Positive
    pressed: Byte


class Jaw(Section):
    """`robot.arm.jaw`."""

    id: ServoId
    opened: float
    closed: float
    speed: Positive
    torque: Annotated[float, Within(gt=0, le=1)]
    pressing: Annotated[float, Within(gt=0, le=1)]
    expected: Positive


class Servo(Section):
    """`neck.pan` and `neck.tilt`."""

    channel: Annotated[int, Within(ge=0, le=31)]
    centre: Pulse
    per_radian: float
    lower: Pulse
    upper: Pulse


class Watching(Section):
    """`fault.watch`, and the same of a real camera."""

    stale: Positive
    frozen: Positive | None
    dark: Annotated[float, Within(ge=0, le=255)]
    lost: Positive


class Gripper(Section):
    """`robot.arm.gripper`."""

    joints: Annotated[list[str], Within(min_length=2, max_length=2)]
    force: NotNegative
    speed: Positive
    friction: NotNegative
    spinning: NotNegative
    rolling: NotNegative
    palm: str
    rays: Annotated[list[Triple], Within(min_length=1)]
    reach: Positive
    beams: Annotated[list[Positive], Within(min_length=1)]
    pad: Pair


RANGES: dict[str, dict[str, Any]] = {
    "camera": {
        "eye": Triple,
        "noise_px": NotNegative,
        "delay_frames": Whole,
        "path": Place,
        "device": Place,
        "latency": Share,
        "start": NotNegative,
        "end": Positive | None,
        **get_type_hints(Watching, include_extras=True),
        "aspect": Literal["crop", "fit"],
        "mirror": bool,
        "quality": Annotated[int, Within(ge=1, le=100)],
    },
    "vision": {
        "hue": HueRange,
        "saturation": ByteRange,
        "value": ByteRange,
        "min_pixels": Count,
        "least_patch": Share,
        "most": Share,
        "length": Positive | None,
        "threshold": Annotated[int, Within(ge=0, le=255)],
        "apart": NotNegative,
        "blur": Positive,
        "keep": NotNegative,
        "margin": NotNegative,
    },
    "robot": {
        "base": Triple,
        "model": Literal[300, 400, 450],
        "timeout": Positive,
        "tries": Count,
        "baud": Count,
        "ids": Annotated[list[ServoId], Within(min_length=1)],
        "servos": Literal["sts3215", "xl330", "xl430", "xm430"],
        "jaw": Jaw | None,
        "senses": list[Literal[1, -1]],
        "torque": Annotated[float, Within(gt=0, le=1)],
        "following": Positive,
        "overdue": Positive,
        "driving": Driving,
        "sensing": Sensing,
        "mark": Mark,
        "table": Table,
        "joints": Names,
        "gripper": Gripper | None,
        "speed": list[Positive] | None,
        "acceleration": list[Positive],
        "force": list[Positive],
        "rate": Annotated[int, Within(ge=1, le=10_000)],
        "iterations": Annotated[int, Within(ge=1, le=10_000)],
        "stiffness": Annotated[float, Within(ge=0, le=1_000)],
        "behind": Positive,
    },
    "demonstrator": {
        "centre": Pair,
        "size": Annotated[list[NotNegative], Within(min_length=2, max_length=2)],
        "period": Positive,
        "laps": Count | None,
        "start": NotNegative,
        "waypoints": Annotated[list[Triple], Within(min_length=2)],
        "places": Annotated[list[Pair], Within(min_length=4, max_length=4)],
        "rests": Annotated[list[Positive], Within(min_length=4, max_length=4)],
        "travel": Positive,
        "leaves_to": Pair,
        "place": Pair,
        "at": NotNegative,
        "stay": Positive | None,
        "ends": Annotated[list[Pair], Within(min_length=2, max_length=2)],
        "begins": NotNegative,
        "lasts": Positive,
        "switch": NotNegative,
        "deviation": float,
        "onset": Positive,
    },
    "fault": {
        "at": NotNegative,
        "lasts": Positive | None,
        "joint": Count,
        "following": Positive,
        "overdue": Positive,
        "watch": Watching,
    },
    "neck": {
        "baud": Literal[2400, 9600, 38400, 115200],
        "pan": Servo,
        "tilt": Servo,
        "speed": Positive,
        "timeout": Positive,
        "watch": Positive,
    },
    "selection": {
        "bandwidth": Positive,
        "ridge": NotNegative,
    },
    "controller": {
        "bandwidth": Positive,
        "ridge": NotNegative,
        "settling": Positive,
        "noise": Positive,
        "noise_steps": Count,
        "largest": Positive,
        "gain_per_px": NotNegative,
        "noise_per_px": NotNegative,
        "radius": Positive,
        "distance_cap": Positive,
    },
}
RANGES["aim"] = RANGES["controller"]
