"""The encoders of every Katana, against the vendor's numbers."""

import numpy as np
import pytest

from imitation.robots.bullet.world import find_urdf
from imitation.robots.katana.models import MODELS
from imitation.robots.kinematic_chain import read_joints

# Smallest and largest encoder of motors 1 to 6, and joint limits [rad], as the vendor's library
# computes them from its configuration files.
ENCODERS = {
    "300": [(-18308, 31000), (-31000, 6726), (-31000, 25533), (-2137, 31000), (-17924, 31000)],
    "400": [(-18208, 31000), (-31000, 5935), (-31000, 1977), (-1711, 31000), (-17640, 31000)],
    "450": [(-17213, 31000), (-31000, 3824), (-31000, 1318), (-857, 31000), (-16786, 31000)],
}
GRIPPER = {"300": (-16928, 31000), "400": (-16928, 31000), "450": (-15791, 31000)}
JOINTS_OF_400 = [
    (-3.025528, 3.013202),
    (-0.274882, 2.168572),
    (-2.221804, 2.141416),
    (-2.033309, 1.980935),
    (-2.99324, 2.975786),
]


@pytest.mark.parametrize("name", MODELS)
def test_encoder_ranges_are_the_vendors(name):
    lower, upper = MODELS[name].limits
    assert list(zip(lower, upper, strict=True)) == [*ENCODERS[name], GRIPPER[name]]


def test_joint_limits_are_the_vendors():
    lower, upper = MODELS["400"].joint_limits
    assert np.column_stack((lower, upper)) == pytest.approx(np.array(JOINTS_OF_400), abs=1e-6)


def test_the_400_has_the_joint_limits_of_the_urdf():
    joints = list(read_joints(find_urdf("katana_6m180.urdf")).values())
    moving = [one for one in joints if one.name.split("_")[-2] in ("pan", "lift", "roll")]
    lower, upper = MODELS["400"].joint_limits
    assert lower == pytest.approx([one.lower for one in moving], abs=1e-6)
    assert upper == pytest.approx([one.upper for one in moving], abs=1e-6)


@pytest.mark.parametrize("name", MODELS)
def test_angles_and_encoders_are_there_and_back(name):
    model = MODELS[name]
    lower, upper = model.joint_limits
    for share in (0.0, 0.3, 1.0):
        angles = lower + share * (upper - lower)
        assert model.angles(model.encoders(angles)) == pytest.approx(angles)


def test_the_gripper_opens_from_its_closed_to_its_open_encoder():
    model = MODELS["400"]
    assert [model.gripper_encoder(opening) for opening in (0.0, 1.0)] == [12240, 30770]
    assert model.opening(30770) == 1.0
    assert model.opening(12240) == 0.0
