"""The arm with its fingers, and the object it handles, in three dimensions."""

import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa  # type: ignore[import-untyped]
import rerun as rr
from rerun.urdf import UrdfJoint, UrdfTree

from imitation.arrays import Array
from imitation.recording.overview import Overview
from imitation.recording.picture_columns import Batch
from imitation.recording.rerun_view.columns import send
from imitation.recording.yaml_reading import read_yaml

OBJECT = "arm/object"
FRAME = "object"


class BodyDrawing:
    """Draws the arm of a run as its URDF, which must be attached, and the object if there is one.

    Args:
        shown: What there is to show.
    """

    def __init__(self, shown: Overview) -> None:
        assert shown.urdf is not None
        self._tree = _tree(shown.urdf)
        self._joints = list(shown.topics["/joint_states"].names)
        told = read_yaml(shown.attachments.get("config.yaml", b"")) or {}
        try:
            self._take(told)
        except (AttributeError, KeyError, TypeError, ValueError) as error:
            raise ValueError(f"the configuration attached describes no body: {error}") from error

    def _take(self, told: dict[str, Any]) -> None:
        """Keep what a configuration says of the body and the object."""
        arm = told.get("robot", {}).get("arm", {})
        self._base = np.array([float(part) for part in arm.get("base", (0.0, 0.0, 0.0))])
        fingers = (arm.get("gripper") or {}).get("joints", [])
        self._fingers = {name: _range(self._tree.get_joint_by_name(name)) for name in fingers}
        thing = told.get("object")
        self._object: dict[str, Any] | None = thing and {
            "lengths": [float(thing["height"])],
            "radii": [float(thing["radius"])],
            "colors": [[round(255 * part) for part in thing["colour"]]],
        }

    def draw_constants(self, stream: rr.RecordingStream) -> None:
        """Draw what does not change."""
        self._tree.log_urdf_to_recording(stream)
        if self._object:
            look = rr.Cylinders3D(**self._object, fill_mode="solid")
            stream.log(OBJECT, look, rr.CoordinateFrame(FRAME), static=True)

    def draw(self, stream: rr.RecordingStream, batch: Batch) -> None:
        """Draw some steps."""
        angles = np.hstack((batch.vectors("/joint_states", "position"), self._opened(batch)))
        names = [[*self._joints, *self._fingers]] * len(angles)
        told = self._tree.compute_joint_transform_batches(
            pa.array(names), pa.array(angles.tolist())
        )
        parts = told.flatten()
        transforms = rr.Transform3D.columns(
            translation=np.array(parts.field("translation").to_pylist()),
            quaternion=np.array(parts.field("quaternion").to_pylist()),
            parent_frame=parts.field("parent_frame").to_pylist(),
            child_frame=parts.field("child_frame").to_pylist(),
        )
        times = batch.times("/joint_states").repeat(angles.shape[1])
        send(stream, "arm/joints", times, transforms)
        if "/truth/object" in batch:
            poses = [message.pose for message in batch.messages("/truth/object")]
            at = [(pose.position.x, pose.position.y, pose.position.z) for pose in poses]
            turns = [pose.orientation for pose in poses]
            where = rr.Transform3D.columns(
                translation=np.array(at) - self._base,
                quaternion=[(turn.x, turn.y, turn.z, turn.w) for turn in turns],
                parent_frame=[self._tree.root_link().name] * len(at),
                child_frame=[FRAME] * len(at),
            )
            send(stream, "arm/joints/object", batch.times("/truth/object"), where)

    def _opened(self, batch: Batch) -> Array:
        """Angle of each finger, (n, fingers) [rad]."""
        opening = batch.vectors("/gripper")[:, :1]
        closed, opened = np.array(list(self._fingers.values())).reshape(-1, 2).T
        return np.asarray(closed + opening * (opened - closed))


def _tree(urdf: bytes) -> UrdfTree:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "arm.urdf"
        path.write_bytes(urdf)
        return UrdfTree.from_file_path(path, "arm")


def _range(joint: UrdfJoint | None) -> tuple[float, float]:
    """Lower and upper limit of a joint [rad]."""
    assert joint is not None
    return joint.limit_lower, joint.limit_upper
