import numpy as np
import pytest
from made_up import BODY, run

from imitation.recording import messages
from imitation.recording.messages import make, serialised, stamp
from imitation.recording.step_messages import StepMessages

TIME_NS = 3_040_000_007


def header(frame):
    return make(messages.HEADER, make("builtin_interfaces/msg/Time", 3, 40_000_007), frame)


def floats(values, *labels):
    shape = np.shape(values)
    strides = [int(np.prod(shape[axis:])) for axis in range(len(shape))]
    dims = [
        make("std_msgs/msg/MultiArrayDimension", *dim)
        for dim in zip(labels, shape, strides, strict=True)
    ]
    layout = make("std_msgs/msg/MultiArrayLayout", dims, 0)
    return make(messages.FLOATS, layout, np.ravel(values).astype(float))


@pytest.mark.parametrize("shape", [(0,), (1,), (4, 5), (0, 5), (16, 5)])
def test_filled_array_is_what_rosbags_serialises(shape):
    values = np.random.default_rng(1).normal(size=shape)
    labels = ("rows", "columns")[: len(shape)]
    filled = messages.floats_form(shape, labels).fill(values)
    assert filled == serialised(floats(values, *labels))


def test_filled_joint_state_is_what_rosbags_serialises():
    names, position, velocity = ("a", "bcd", "ef"), np.arange(3.0), np.arange(3.0) / 7
    filled = messages.joint_form(names).fill(stamp(TIME_NS), position, velocity)
    whole = make(messages.JOINT_STATE, header(""), list(names), position, velocity, np.zeros(0))
    assert filled == serialised(whole)


def test_filled_image_is_what_rosbags_serialises():
    frame = np.random.default_rng(2).integers(0, 255, (12, 16, 3), dtype=np.uint8)
    filled = messages.image_form(frame.shape).fill(stamp(TIME_NS), frame)
    head = header("camera")
    assert filled == serialised(make(messages.IMAGE, head, 12, 16, "rgb8", 0, 48, frame.ravel()))


def test_filled_point_and_pose_are_what_rosbags_serialises():
    numbers = np.arange(7.0) + 0.25
    point = make("geometry_msgs/msg/Point", *numbers[:3])
    turn = make("geometry_msgs/msg/Quaternion", *numbers[3:])
    filled = messages.point_form("world").fill(stamp(TIME_NS), numbers[:3])
    assert filled == serialised(make(messages.POINT, header("world"), point))
    pose = make("geometry_msgs/msg/Pose", point, turn)
    filled = messages.pose_form("world").fill(stamp(TIME_NS), numbers)
    assert filled == serialised(make(messages.POSE, header("world"), pose))


def test_event_holds_its_sentence_and_facts_without_nan():
    facts = {"area": (2, np.int64(3)), "distance": float("nan"), "place": np.array((1.5, 2.0))}
    message = messages.decoded(messages.log(TIME_NS, "learned", "An area.", facts), messages.LOG)
    assert (message.name, messages.time_of(message)) == ("learned", TIME_NS)
    assert messages.split_log(message) == (
        "An area.",
        {"area": [2, 3], "distance": None, "place": [1.5, 2.0]},
    )


def test_limitation_is_told_when_its_reasons_change():
    steps = StepMessages(BODY)
    told = [
        messages.split_log(messages.decoded(message.data, messages.LOG))[1]["reasons"]
        for sample, truths in run(200)
        for message in steps.of(sample, truths)
        if message.topic == "/events" and b"guard" in message.data
    ]
    assert told[:3] == [["speed"], [], ["speed"]]


def test_frame_delivered_twice_is_told_once():
    (sample, truths), *_ = run(1)
    steps = StepMessages(BODY)
    first, second = list(steps.of(sample, truths)), list(steps.of(sample, truths))
    assert first[0].topic == "/camera/image"
    assert "/camera/image" not in {message.topic for message in second}
