"""ROS 2 messages as CDR: serialised by rosbags once for each layout, then filled anew."""

import json
import math
import struct
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rosbags.serde import SerdeError
from rosbags.typesys import Stores, get_typestore

from imitation.clock import SECOND
from imitation.recording.json_file import plain

STORE: Any = get_typestore(Stores.ROS2_JAZZY)

IMAGE = "sensor_msgs/msg/Image"
COMPRESSED_IMAGE = "sensor_msgs/msg/CompressedImage"
HEADER = "std_msgs/msg/Header"
JOINT_STATE = "sensor_msgs/msg/JointState"
FLOATS = "std_msgs/msg/Float64MultiArray"
INTEGERS = "std_msgs/msg/Int32MultiArray"
POINT = "geometry_msgs/msg/PointStamped"
POSE = "geometry_msgs/msg/PoseStamped"
LOG = "rcl_interfaces/msg/Log"
LOG_INFO = 20
# What decoding bytes that are no message may end in.
UNREADABLE = (AssertionError, LookupError, MemoryError, SerdeError, ValueError, struct.error)

# Stand for what changes from message to message; no constant part of a message holds them.
STAMP_MARK = (0x5EC05EC0, 0x0A9051AB)
MARKS = np.random.default_rng(0).random(4096)


class Form:
    """A message whose layout is fixed and whose values change.

    Args:
        message: A rosbags message that holds each of `values` once, in this order.
        values: Bytes of the parts that change.
    """

    def __init__(self, message: Any, *values: bytes) -> None:
        rest = serialised(message)
        parts: list[bytes] = []
        for value in values:
            at = rest.index(value)
            parts += (rest[:at], b"")
            rest = rest[at + len(value) :]
        self._parts = [*parts, rest]

    def fill(self, *values: bytes | NDArray[Any]) -> bytes:
        """The message with `values` in place of those it was made with, as CDR."""
        parts: list[Any] = self._parts.copy()
        parts[1::2] = values
        return b"".join(parts)


def serialised(message: Any) -> bytes:
    """A rosbags message as CDR."""
    return bytes(STORE.serialize_cdr(message, message.__msgtype__))


def decoded(data: bytes, type_name: str) -> Any:
    """The rosbags message that `data` (CDR) holds.

    Raises:
        ValueError: It holds none of this type.
    """
    try:
        return STORE.deserialize_cdr(data, type_name)
    except UNREADABLE as error:
        raise ValueError(f"a message is damaged: it is no {type_name}") from error


def definition(type_name: str) -> str:
    """Text of a message type with all the types it uses, as MCAP's `ros2msg` wants it."""
    text, _ = STORE.generate_msgdef(type_name, ros_version=2)
    return str(text)


def array(message: Any) -> NDArray[Any]:
    """Numbers of a `Float64MultiArray` or `Int32MultiArray` in the shape of its layout."""
    return np.asarray(message.data).reshape([dim.size for dim in message.layout.dim])


def stamp(time_ns: int) -> bytes:
    """`builtin_interfaces/msg/Time` of a time [ns] as CDR, (8,)."""
    second, nanosecond = divmod(time_ns, SECOND)
    return second.to_bytes(4, "little", signed=True) + nanosecond.to_bytes(4, "little")


def time_of(header: Any) -> int:
    """Time in a header's stamp [ns]."""
    return int(header.stamp.sec) * SECOND + int(header.stamp.nanosec)


def make(type_name: str, *fields: Any) -> Any:
    """A rosbags message of a type, from its fields in order."""
    return STORE.types[type_name](*fields)


def header(frame: str, sec: int = STAMP_MARK[0], nanosec: int = STAMP_MARK[1]) -> Any:
    """A header in a coordinate frame, its stamp to be filled in."""
    return make(HEADER, make("builtin_interfaces/msg/Time", sec, nanosec), frame)


MARK = stamp(STAMP_MARK[0] * SECOND + STAMP_MARK[1])


@cache
def header_form(frame: str) -> Form:
    """Fill with: stamp."""
    return Form(header(frame), MARK)


@cache
def point_form(frame: str) -> Form:
    """Fill with: stamp, x y z as three doubles."""
    point = make("geometry_msgs/msg/Point", *MARKS[:3])
    return Form(make(POINT, header(frame), point), MARK, MARKS[:3].tobytes())


@cache
def pose_form(frame: str) -> Form:
    """Fill with: stamp, x y z and quaternion x y z w as seven doubles."""
    point = make("geometry_msgs/msg/Point", *MARKS[:3])
    turn = make("geometry_msgs/msg/Quaternion", *MARKS[3:7])
    pose = make("geometry_msgs/msg/Pose", point, turn)
    return Form(make(POSE, header(frame), pose), MARK, MARKS[:7].tobytes())


@cache
def joint_form(names: tuple[str, ...]) -> Form:
    """Fill with: stamp, positions [rad], velocities [rad/s], each as doubles."""
    n = len(names)
    position, velocity = MARKS[:n], MARKS[n : 2 * n]
    message = make(JOINT_STATE, header(""), list(names), position, velocity, np.zeros(0))
    return Form(message, MARK, position.tobytes(), velocity.tobytes())


@cache
def velocity_form(names: tuple[str, ...]) -> Form:
    """Fill with: stamp, velocities [rad/s] as doubles."""
    velocity = MARKS[: len(names)]
    message = make(JOINT_STATE, header(""), list(names), np.zeros(0), velocity, np.zeros(0))
    return Form(message, MARK, velocity.tobytes())


@cache
def image_form(shape: tuple[int, int, int]) -> Form:
    """Fill with: stamp, pixels. `shape` is (height, width, 3), RGB."""
    height, width, channels = shape
    pixels = np.frombuffer(np.random.default_rng(0).bytes(height * width * channels), np.uint8)
    message = make(IMAGE, header("camera"), height, width, "rgb8", 0, width * channels, pixels)
    return Form(message, MARK, pixels.tobytes())


@cache
def floats_form(shape: tuple[int, ...], labels: tuple[str, ...]) -> Form:
    """Fill with: doubles of an array of `shape`, whose dimensions are called `labels`."""
    values = MARKS[: math.prod(shape)]
    return Form(make(FLOATS, _layout(shape, labels), values), values.tobytes())


@cache
def integers_form(shape: tuple[int, ...], labels: tuple[str, ...]) -> Form:
    """Fill with: 32-bit integers of an array of `shape`, whose dimensions are called `labels`."""
    values = MARKS.view(np.int32)[: math.prod(shape)]
    return Form(make(INTEGERS, _layout(shape, labels), values), values.tobytes())


def compressed_image(time_ns: int, jpeg: bytes) -> bytes:
    """A JPEG picture captured at `time_ns`, as CDR."""
    head = header("camera", *divmod(time_ns, SECOND))
    return serialised(make(COMPRESSED_IMAGE, head, "jpeg", np.frombuffer(jpeg, dtype=np.uint8)))


def log(time_ns: int, kind: str, sentence: str, facts: dict[str, object]) -> bytes:
    """An event as `rcl_interfaces/msg/Log`, as CDR: the message is a sentence and JSON."""
    text = json.dumps(plain(facts), separators=(",", ":"), ensure_ascii=False)
    when = make("builtin_interfaces/msg/Time", *divmod(time_ns, SECOND))
    return serialised(make(LOG, when, LOG_INFO, kind, f"{sentence} {text}", "", "", 0))


def split_log(message: Any) -> tuple[str, dict[str, Any]]:
    """Sentence and facts of an event's message."""
    sentence, brace, facts = message.msg.partition(" {")
    return sentence, json.loads(brace[1:] + facts) if brace else {}


def _layout(shape: tuple[int, ...], labels: tuple[str, ...]) -> Any:
    strides = [math.prod(shape[axis:]) for axis in range(len(shape))]
    dims = [
        make("std_msgs/msg/MultiArrayDimension", label, size, stride)
        for label, size, stride in zip(labels, shape, strides, strict=True)
    ]
    return make("std_msgs/msg/MultiArrayLayout", dims, 0)
