"""The robot in its world as a visitor sees it: lit, with its table and the camera on its neck."""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
import pybullet

from imitation.arrays import Array, Image
from imitation.gaze import VisualSpace
from imitation.robots.bullet.photograph import projection_matrix, view_matrix
from imitation.robots.bullet.world import World
from imitation.robots.bullet.world_picture import SOFTWARE, rendered
from imitation.robots.bullet.world_table import add_seen

DARK, LIGHT = (0.16, 0.17, 0.20, 1.0), (0.62, 0.64, 0.68, 1.0)  # of camera and stand, RGBA
SKIN = (0.88, 0.67, 0.55, 1.0)  # RGBA
LIGHTING = {
    "shadow": 1,
    "lightDirection": (0.6, -1.0, 2.2),
    "lightAmbientCoeff": 0.62,
    "lightDiffuseCoeff": 0.42,
    "lightSpecularCoeff": 0.05,
    **SOFTWARE,
}


@dataclass(frozen=True)
class Portrait:
    """Where the visitor stands.

    Args:
        eye: Where from (3,) [m].
        towards: What is in the middle of the picture (3,) [m].
        size: Width and height of the picture [px].
        focal_px: Focal length [px].
        finer: Drawn this much finer, then shrunk, so that edges are smooth.
    """

    eye: Sequence[float]
    towards: Sequence[float]
    size: Sequence[int]
    focal_px: float
    finer: int

    @property
    def space(self) -> VisualSpace:
        """The picture's plane."""
        x, y, z = np.subtract(self.towards, self.eye)
        gaze = (float(np.arctan2(y, x)), float(np.arctan2(z, np.hypot(x, y))))
        width, height = self.size
        return VisualSpace((width, height), self.focal_px, (width / 2, height / 2), gaze)

    def place_of(self, position: Array) -> Array:
        """Where a point of the world (3,) [m] is in the picture, (2,) [px]."""
        return self.space.project(np.asarray(position), np.asarray(self.eye))

    def picture(self, world: World, posture: Array, eye: Array, gaze: Array) -> Image:
        """The picture, RGB, (height, width, 3).

        Args:
            world: The robot's.
            posture: Of the arm [rad].
            eye: Optical centre of the robot's camera (3,) [m].
            gaze: Of that camera, pan and tilt [rad].
        """
        lit = lit_up(world, posture)
        lit.add_camera(eye, gaze)
        drawn = self.drawn(lit)
        lit.close()
        return drawn

    def drawn(self, lit: "LitWorld") -> Image:
        """The picture of a lit world as it is now, RGB, (height, width, 3)."""
        space, finer = self.space, self.finer
        large = VisualSpace(
            (space.size[0] * finer, space.size[1] * finer),
            space.focal * finer,
            (space.centre[0] * finer, space.centre[1] * finer),
            space.reference,
        )
        view = view_matrix(np.asarray(self.eye), np.asarray(space.reference))
        return shrunk(lit.picture(view, projection_matrix(large), large.size), finer)


@dataclass(frozen=True)
class Moment:
    """How everything stood at one time."""

    time: float  # [s]
    posture: Array  # of the arm, (n_joints,) [rad]
    opening: float  # of its gripper, 0 closed .. 1 open
    thing: Array | None  # pose of the object, (7,) [m]; None: there is none
    other: Array | None  # mark on the demonstrator's hand, (3,) [m]; None: not in sight


def lit_up(world: World, posture: Array) -> "LitWorld":
    """A lit world like `world`, with the arm at `posture` [rad]."""
    lit = LitWorld(**{one.name: getattr(world, one.name) for one in fields(world) if one.init})
    lit.rebuild(posture, opening=1.0)
    return lit


class LitWorld(World):
    """A world with everything in it that a person would see."""

    _arm_of_other: list[tuple[int, Array]] | None = None

    def picture(self, view: Array, projection: Array, size: tuple[int, int]) -> Image:
        """A lit picture, RGB, (height, width, 3)."""
        return rendered(self._client, view, projection, size, LIGHTING)[..., :3]

    def arrange(self, moment: Moment) -> None:
        """Put everything where it stood at `moment`."""
        call = {"physicsClientId": self._client}
        for joint, angle in zip(self._joints, moment.posture, strict=True):
            pybullet.resetJointState(self._arm, joint, angle, **call)
        if self._gripper:
            self._gripper.place(moment.opening)
        self.carry_mark()
        if self._can and moment.thing is not None:
            at, turned = moment.thing[:3].tolist(), moment.thing[3:].tolist()
            pybullet.resetBasePositionAndOrientation(self._can.body, at, turned, **call)
        if self._arm_of_other is None:
            self._arm_of_other = self._forearm()
        aside = np.array((0.0, 0.0, -10.0)) if moment.other is None else moment.other
        for body, off in self._arm_of_other:
            _, turned = pybullet.getBasePositionAndOrientation(body, **call)
            pybullet.resetBasePositionAndOrientation(body, (aside + off).tolist(), turned, **call)

    def _forearm(self) -> list[tuple[int, Array]]:
        """A demonstrator's forearm and the tag on its hand: each body, and where from the tag."""
        call = {"physicsClientId": self._client}
        along = np.array((0.62, 0.25, 0.50))
        along /= np.linalg.norm(along)
        turned = pybullet.getQuaternionFromEuler(
            (0.0, float(np.arccos(along[2])), float(np.arctan2(along[1], along[0])))
        )
        tag = pybullet.createVisualShape(
            pybullet.GEOM_SPHERE, radius=0.010, rgbaColor=self.mark.colour, **call
        )
        limb = pybullet.createVisualShape(
            pybullet.GEOM_CAPSULE, radius=0.026, length=0.56, rgbaColor=SKIN, **call
        )
        fist = pybullet.createVisualShape(
            pybullet.GEOM_SPHERE, radius=0.034, rgbaColor=SKIN, **call
        )
        below = np.array((0.0, 0.0, -0.040))
        return [
            (pybullet.createMultiBody(0.0, -1, tag, **call), np.zeros(3)),
            (pybullet.createMultiBody(0.0, -1, fist, **call), below),
            (
                pybullet.createMultiBody(0.0, -1, limb, baseOrientation=turned, **call),
                below + 0.30 * along,
            ),
        ]

    def add_camera(self, eye: Array, gaze: Array) -> None:
        """Put a camera at `eye` [m] on a two-axis neck, on a stand that begins on the table."""
        turned = pybullet.getQuaternionFromEuler((0.0, -float(gaze[1]), float(gaze[0])))
        back = np.array(pybullet.getMatrixFromQuaternion(turned)).reshape(3, 3)[:, 0]
        body = np.asarray(eye) - 0.03 * back
        self._box((0.035, 0.045, 0.028), body, turned, DARK)
        x, y, z = np.asarray(eye) - 0.10 * np.array((back[0], back[1], 0.0))
        self._box((0.025, 0.025, 0.05), (x, y, z), None, LIGHT)
        height = z - 0.05 - self.table.height
        self._box((0.010, 0.010, height / 2), (x, y, self.table.height + height / 2), None, LIGHT)

    def _add_table(self) -> None:
        super()._add_table()
        add_seen(self.table, self._client)

    def _box(
        self, half: Sequence[float], centre: Any, turned: Any, colour: Sequence[float]
    ) -> None:
        call = {"physicsClientId": self._client}
        shape = pybullet.createVisualShape(
            pybullet.GEOM_BOX, halfExtents=list(half), rgbaColor=list(colour), **call
        )
        pybullet.createMultiBody(
            0.0, -1, shape, list(map(float, centre)), turned or (0, 0, 0, 1), **call
        )


def shrunk(picture: Image, times: int) -> Image:
    """`picture` made smaller by a whole factor, each pixel the mean of those it stands for."""
    height, width, _ = picture.shape
    blocks = picture.reshape(height // times, times, width // times, times, 3)
    return np.asarray(blocks.mean(axis=(1, 3)).round(), dtype=np.uint8)
