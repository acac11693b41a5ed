"""`map.npz`: what is saved comes back, and what is no map is refused."""

import io
import json

import numpy as np
import pytest

from imitation.gaze import VisualSpace
from imitation.recording.map_file import (
    MAX_BYTES,
    LearnedMap,
    differences,
    fingerprint,
    load_map,
    save_map,
)
from imitation.robot import Body
from imitation.visual_field import VisualField
from imitation.visuo_motor_map import Learning, VisuoMotorMap

FIELD = VisualField("right_3x3", (160, 120), rows=3, columns=3, left=40.0)
SPACE = VisualSpace((160, 120), focal=690.0, centre=(80.0, 60.0), reference=(-0.14, -1.09))
OUTLINE = np.array([[50.0, 10.0], [150.0, 10.0], [150.0, 110.0], [50.0, 110.0]])
LEARNING = Learning(alpha=0.5, min_activity=0.5, radius=0.4, excitation=0.8, inhibition=1.6)


def body(name="made_up_arm", joints=("pan", "lift"), upper=1.0) -> Body:
    count = len(joints)
    return Body(name, joints, np.full(count, -1.0), np.full(count, upper), *[np.ones(count)] * 2)


def stored(neurons: int = 2) -> LearnedMap:
    """A map that holds two postures in one area and one in another."""
    arm = body()
    learned = VisuoMotorMap(FIELD, arm.lower, arm.upper, neurons, LEARNING)
    activity = np.zeros(FIELD.shape)
    activity[1, 2] = 1.0
    learned.learn(activity, np.array([0.7, -0.7]), FIELD.centres[1, 2] + 4)
    learned.learn(activity, np.array([-0.7, 0.7]), FIELD.centres[1, 2] + 3)
    learned.postures[0, 1, 0], learned.places[0, 1, 0] = (0.1, 0.2), (55.0, 21.0)
    return LearnedMap(learned, OUTLINE, fingerprint(arm, FIELD, SPACE))


@pytest.fixture
def file(tmp_path):
    """A saved map."""
    path = tmp_path / "map.npz"
    save_map(path, stored())
    return path


def test_what_is_saved_comes_back(file):
    before, after = stored(), load_map(file)
    for name in ("postures", "places", "visits", "lower", "upper"):
        assert np.array_equal(
            getattr(after.map, name), getattr(before.map, name), equal_nan=name != "visits"
        )
    assert after.map.learning == LEARNING
    assert after.map.field == FIELD
    assert after.map.neurons == 2
    assert after.fingerprint == before.fingerprint
    assert after.outline.tolist() == OUTLINE.tolist()


def test_a_map_that_comes_back_goes_on_learning(file):
    learned, activity = load_map(file).map, np.zeros(FIELD.shape)
    activity[2, 3] = 1.0
    assert learned.learn(activity, np.array([0.5, 0.5]), FIELD.centres[2, 3]) == (2, 3)
    read = learned.attractors(activity, np.zeros(2))
    assert read.postures.tolist() == [[0.5, 0.5]]


def test_a_map_is_found_in_its_folder(file):
    assert load_map(file.parent).fingerprint == load_map(file).fingerprint


def test_the_same_map_is_saved_as_the_same_bytes(file, tmp_path):
    save_map(tmp_path / "again.npz", stored())
    assert (tmp_path / "again.npz").read_bytes() == file.read_bytes()


def test_a_map_that_is_not_there_is_refused_with_what_to_type(tmp_path):
    for path in (tmp_path, tmp_path / "nowhere.npz"):
        with pytest.raises(ValueError, match=r"no map at .*imitate learn-map"):
            load_map(path)


def refusal(path) -> str:
    """What is said of a file that is no map."""
    with pytest.raises(ValueError, match="is no map of this program") as caught:
        load_map(path)
    assert "\n" not in str(caught.value)
    assert str(path) in str(caught.value)
    return str(caught.value)


def test_a_map_cut_off_anywhere_is_refused(file):
    whole = file.read_bytes()
    for length in range(0, len(whole), 97):
        file.write_bytes(whole[:length])
        refusal(file)


def test_a_changed_byte_is_refused_or_changes_nothing(file):
    whole, rng = file.read_bytes(), np.random.default_rng(0)
    for at in rng.integers(len(whole), size=400):
        broken = bytearray(whole)
        broken[at] ^= int(rng.integers(1, 256))
        file.write_bytes(broken)
        try:
            found = load_map(file)
        except ValueError as error:
            assert "is no map" in str(error)
        else:
            assert np.array_equal(found.map.postures, stored().map.postures, equal_nan=True)


@pytest.mark.parametrize(
    "content", [b"", b"\x00" * 1000, b"PK\x03\x04 but no more", b"postures: [1, 2]\n", b"\x93NUMPY"]
)
def test_a_foreign_file_is_refused(tmp_path, content):
    path = tmp_path / "map.npz"
    path.write_bytes(content)
    refusal(path)


def test_arrays_of_another_program_are_refused(tmp_path):
    path = tmp_path / "map.npz"
    np.savez(path, weights=np.ones(3))
    assert "facts" in refusal(path)
    array = io.BytesIO()
    np.save(array, np.ones(3))
    path.write_bytes(array.getvalue())
    refusal(path)


class Dangerous:
    """Runs code when it is unpickled."""

    ran = False

    @classmethod
    def run(cls) -> None:
        cls.ran = True

    def __reduce__(self):
        return Dangerous.run, ()


def test_a_pickle_is_refused_and_not_run(file):
    arrays = dict(np.load(file))
    arrays["outline"] = np.array([Dangerous()], dtype=object)
    np.savez(file, **arrays)
    refusal(file)
    assert not Dangerous.ran


def test_a_file_too_large_for_a_map_is_refused_unread(tmp_path):
    path = tmp_path / "map.npz"
    with path.open("wb") as opened:
        opened.truncate(MAX_BYTES + 1)
    assert "too large" in refusal(path)


def changed(path, **facts) -> None:
    """Save the map again with other facts."""
    arrays = dict(np.load(path))
    told = json.loads(str(arrays["facts"]))
    arrays["facts"] = np.array(json.dumps({**told, **facts}))
    np.savez(path, **arrays)


@pytest.mark.parametrize(
    "facts",
    [
        {"version": 2},
        {"neurons": 3},
        {"neurons": 10**9},  # not even tried
        {"neurons": "many"},
        {"learning": {"alpha": 1.0}},
        {"learning": None},
        {"fingerprint": {}},
        {"fingerprint": "made_up_arm"},
    ],
)
def test_facts_that_do_not_fit_are_refused(file, facts):
    changed(file, **facts)
    refusal(file)


@pytest.mark.parametrize(
    ("name", "array"),
    [
        ("postures", np.zeros((3, 4, 2, 5))),
        ("postures", np.full((3, 4, 2, 2), "x")),
        ("places", np.zeros(7)),
        ("visits", np.zeros((4, 4), dtype=int)),
        ("outline", np.zeros(4)),
        ("outline", np.zeros((4, 3))),
    ],
)
def test_arrays_of_the_wrong_shape_are_refused_by_name(file, name, array):
    np.savez(file, **{**dict(np.load(file)), name: array})
    assert name in refusal(file)


def present(arm=None, space=SPACE) -> dict:
    return fingerprint(arm or body(), FIELD, space)


def test_the_same_body_differs_in_nothing():
    assert differences(present(), present()) == []


def test_where_the_camera_looks_is_no_difference():
    turned = VisualSpace(SPACE.size, SPACE.focal, SPACE.centre, (0.3, -0.9))
    assert differences(present(), present(space=turned)) == []


def test_another_arm_is_named():
    (only,) = differences(present(), present(body(name="other_arm")))
    assert "made_up_arm" in only
    assert "other_arm" in only


def test_other_joints_are_named():
    (only,) = differences(present(), present(body(joints=("lift", "pan"))))
    assert "['pan', 'lift']" in only
    (only,) = differences(present(), present(body(joints=("pan", "lift", "roll"))))
    assert "roll" in only


def test_other_joint_limits_are_told():
    (only,) = differences(present(), present(body(upper=1.1)))
    assert "joint limits (upper_rad)" in only


def test_another_visual_space_is_told_beside_another_arm():
    wider = VisualSpace((320, 240), 690.0, (160.0, 120.0), SPACE.reference)
    arm, space = differences(present(), present(body(name="other_arm"), wider))
    assert "other_arm" in arm
    assert "[320, 240]" in space
