"""Forward kinematics of an arm read from its URDF.

Only the guard and the simulated bodies use it: nothing that learns knows the arm's geometry.
"""

import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from imitation.arrays import Array


def rotation_about(axis: Array, angle: float) -> Array:
    """Rotation by `angle` [rad] about a unit `axis` (3,), (3, 3)."""
    x, y, z = axis
    cross = np.array(((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)))
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)


def transform(turn: Array, offset: Array) -> Array:
    """Homogeneous matrix of a rotation (3, 3) and an offset (3,) [m], (4, 4)."""
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = turn, offset
    return matrix


def rotation_of_rpy(roll: float, pitch: float, yaw: float) -> Array:
    """Rotation of URDF's fixed-axis roll, pitch, yaw [rad], (3, 3)."""
    x, y, z = np.eye(3)
    return rotation_about(z, yaw) @ rotation_about(y, pitch) @ rotation_about(x, roll)


@dataclass(frozen=True)
class Joint:
    """One joint of a URDF."""

    name: str
    parent: str
    child: str
    turn: Array  # fixed rotation from the parent link, (3, 3)
    offset: Array  # fixed offset from the parent link, (3,) [m]
    cross: Array  # cross-product matrix of the axis, (3, 3); 0 for a fixed joint
    lower: float  # [rad]
    upper: float  # [rad]
    speed: float  # [rad/s]


def _numbers(text: str | None, default: str) -> Array:
    return np.array([float(word) for word in (text or default).split()])


def read_joints(urdf: Path) -> dict[str, Joint]:
    """Joints of a URDF file by the name of their child link."""
    joints = {}
    try:
        model = ElementTree.parse(urdf).getroot()
    except ElementTree.ParseError as error:
        raise ValueError(f"{urdf.name} is no URDF: {error}") from error
    for node in model.iterfind("joint"):
        origin, axis, limit = node.find("origin"), node.find("axis"), node.find("limit")
        at = {} if origin is None else origin.attrib
        bounds = {} if limit is None else limit.attrib
        x, y, z = _numbers(None if axis is None else axis.get("xyz"), "1 0 0")
        cross = np.array(((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)))
        parent, child = node.find("parent"), node.find("child")
        if parent is None or child is None:
            raise ValueError(f"{urdf.name}: joint {node.get('name')} lacks parent or child")
        joints[child.attrib["link"]] = Joint(
            name=node.attrib["name"],
            parent=parent.attrib["link"],
            child=child.attrib["link"],
            turn=rotation_of_rpy(*_numbers(at.get("rpy"), "0 0 0")),
            offset=_numbers(at.get("xyz"), "0 0 0"),
            cross=cross if node.get("type") in ("revolute", "continuous") else np.zeros((3, 3)),
            lower=float(bounds.get("lower", 0.0)),
            upper=float(bounds.get("upper", 0.0)),
            speed=float(bounds.get("velocity", 0.0)),
        )
    return joints


class KinematicChain:
    """Where points of an arm's links are, for a posture of its moving joints.

    Args:
        urdf: The arm's URDF file.
        joint_names: The moving joints, in the order of the posture; all others stay at 0.
        points: (link name, point in that link (3,) [m]) of each point to follow.
        base: Where the URDF's root stands in the world, (3,) [m].
    """

    def __init__(
        self,
        urdf: Path,
        joint_names: tuple[str, ...],
        points: list[tuple[str, Array]],
        base: Array,
    ) -> None:
        by_child = read_joints(urdf)
        by_name = {joint.name: joint for joint in by_child.values()}
        unknown = [name for name in joint_names if name not in by_name]
        if unknown:
            raise ValueError(f"{urdf.name} has no joint {unknown[0]}; it has {sorted(by_name)}")
        links = {joint.parent for joint in by_child.values()} | set(by_child)
        for link, _ in points:
            if link not in links:
                raise ValueError(f"{urdf.name} has no link {link}; it has {sorted(links)}")
        self.limits = [by_name[name] for name in joint_names]
        self._base = transform(np.eye(3), base)
        self._order: list[Joint] = []  # parents before children
        reached: set[str] = set()
        for link, _ in points:
            path = []
            while link in by_child and link not in reached:
                path.append(by_child[link])
                reached.add(link)
                link = by_child[link].parent
            self._order += reversed(path)
        number = {joint.child: place for place, joint in enumerate(self._order, start=1)}
        self._parents = [number.get(joint.parent, 0) for joint in self._order]  # 0: the root
        self._carriers = [number.get(link, 0) for link, _ in points]
        self._points = np.array([(*point, 1.0) for _, point in points]).reshape(-1, 1, 4, 1)
        self._split(joint_names)

    def _split(self, joint_names: tuple[str, ...]) -> None:
        """Each joint's matrix as a fixed part and those that its angle's sine and versine scale."""
        slot = {name: place for place, name in enumerate(joint_names)}
        self._slots = [slot.get(joint.name, 0) for joint in self._order]
        parts = np.zeros((3, len(self._order), 1, 4, 4))
        for number, joint in enumerate(self._order):
            parts[0, number] = transform(joint.turn, joint.offset)
            if joint.name in slot:
                parts[1, number, 0, :3, :3] = joint.turn @ joint.cross
                parts[2, number, 0, :3, :3] = joint.turn @ joint.cross @ joint.cross
        self._fixed, self._by_sine, self._by_versine = parts

    def positions(self, posture: Array) -> Array:
        """The points at `posture` (..., n_joints) [rad], (..., n_points, 3) [m]."""
        angles = posture.reshape(-1, posture.shape[-1]).T[self._slots, :, None, None]
        turned = self._by_sine * np.sin(angles) + self._by_versine * (1 - np.cos(angles))
        links = np.empty((len(self._order) + 1, angles.shape[1], 4, 4))
        links[0] = self._base
        for number, (parent, step) in enumerate(
            zip(self._parents, self._fixed + turned, strict=True), start=1
        ):
            np.matmul(links[parent], step, out=links[number])
        places = (links[self._carriers] @ self._points)[..., :3, 0].swapaxes(0, 1)
        return np.asarray(places.reshape((*posture.shape[:-1], len(self._points), 3)))
