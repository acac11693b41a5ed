"""Makes robots, perception and maps out of a composed configuration."""

import zlib
from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from cli.make import asked_by, made_of, make, make_offered, without
from imitation.approach import Approach
from imitation.arrays import Array
from imitation.controllers.controller import Controller
from imitation.dynamics import Dynamics
from imitation.gaze import VisualSpace
from imitation.guard import Guard
from imitation.hand_watch import HandWatch
from imitation.perception import Perception
from imitation.robot import SECOND, Arm, Body, Camera, Robot
from imitation.robots.bodies import body_of, guard_of
from imitation.robots.bullet.world_can import Can
from imitation.robots.demonstrators import HandOverTable
from imitation.robots.dry_run import DryRun
from imitation.robots.recorded import RecordedRobot
from imitation.robots.scenery import can_on_table, hand_over_table, held_at
from imitation.sample import RecordedStep, Sample
from imitation.selection import Selection
from imitation.sequence import TimeCells, TimedSequence
from imitation.visual_field import VisualField
from imitation.visuo_motor_map import Learning, VisuoMotorMap

Config = Mapping[str, Any]
DEMONSTRATOR = ("name", "hand", "hands", "height", "raise")  # what no gesture asks for


def generator(seed: int, purpose: str) -> np.random.Generator:
    """Randomness for one purpose: another purpose does not shift it."""
    return np.random.default_rng([seed, zlib.crc32(purpose.encode())])


@dataclass
class Bench:
    """The parts of an experiment, made when first asked for."""

    cfg: Config  # composed, resolved, plain dicts and lists

    @cached_property
    def space(self) -> VisualSpace:
        """The visual space of this run: that of learning, its reference gaze turned by `shift`."""
        pan, tilt = np.add(self.learning_space.reference, self.cfg.get("shift", (0.0, 0.0)))
        return replace(self.learning_space, reference=(float(pan), float(tilt)))

    @cached_property
    def learning_space(self) -> VisualSpace:
        """The visual space of the body's camera, looking along its own gaze, as in learning."""
        camera = self.cfg["camera"]
        width, height = camera["size"]
        pan, tilt = camera["gaze"]
        return VisualSpace(
            size=(width, height),
            focal=camera["focal_px"],
            centre=(width / 2, height / 2),
            reference=(pan, tilt),
        )

    @cached_property
    def robot(self) -> Robot:
        """The arm, its camera and the guard."""
        arm, camera = self.arm, self.camera
        approach = Approach(**self.cfg["robot"]["approach"]) if arm.live else None
        home, guard = self.guided.mean(axis=0), self.guard(arm.body)
        return Robot(arm, camera, guard, home, self.period_ns, approach)

    @cached_property
    def arm(self) -> Arm:
        """The arm; a real one is asked who it is, nothing moves."""
        beside = {"period": self.period_ns / SECOND, "thing": self.thing}
        arm: Arm = make_offered(self.cfg["robot"]["arm"], beside)
        arm = self._spoilt("arm", arm, simulated=not arm.live)
        return DryRun(arm) if self.cfg["dry_run"] else arm

    @cached_property
    def camera(self) -> Camera:
        """The camera, on its neck."""
        offered: dict[str, Any] = {
            "space": self.learning_space,
            "reference": self.space.reference,
            "gaze": self.cfg["camera"]["gaze"],
            "rng": generator(self.cfg["seed"], "camera"),
            "demonstrator": self.demonstrator,
        }
        node = without(self.cfg["camera"], "size", "focal_px", "gaze")
        if "arm" in asked_by(node):  # a real camera stands for itself
            offered["arm"] = self.arm
        camera: Camera = make_offered(node, offered)
        with ExitStack() as opened:  # a camera that is left open ends the program its own way
            opened.callback(lambda: camera.close())
            if (neck := self.cfg.get("neck")) and not self.cfg["dry_run"]:
                camera = make(neck, camera=camera, gaze=self.cfg["camera"]["gaze"])
            simulated = "demonstrator" in asked_by(node)
            spoilt: Camera = self._spoilt("camera", camera, simulated)
            opened.pop_all()
        return spoilt

    def _spoilt(self, name: str, part: Any, simulated: bool) -> Any:
        """`part` with the fault that is asked for, if it is one of this part."""
        fault = self.cfg["fault"]
        if name not in asked_by(fault):
            return part
        if not simulated:
            raise ValueError(
                f"fault={fault['name']}: only a simulated {name} can be spoilt; an emulated device "
                "and the twin take --fault NAME"
            )
        return make(fault, **{name: part})

    @property
    def real(self) -> bool:
        """Whether there is a device, or was to be one: it may not have been found."""
        return "robot" not in self.__dict__ or self.robot.live

    def close(self) -> None:
        """Stop the arm and release the devices that were made; harmless when repeated."""
        for made in ("robot", "arm", "camera"):
            if made in self.__dict__:
                self.__dict__[made].close()

    @cached_property
    def demonstrator(self) -> HandOverTable | None:
        """Who moves another hand before the simulated camera; None: nobody."""
        node, camera = self.cfg.get("demonstrator"), self.cfg["camera"]
        simulated = "demonstrator" in asked_by(camera)
        if node is None or not simulated:  # a real camera sees who is there
            return None
        gesture = make(without(node, *DEMONSTRATOR))
        if gesture is None:
            return None
        return hand_over_table(node, gesture, self.space, camera["eye"])

    def relive(self, steps: Iterator[RecordedStep]) -> None:
        """Have a robot from now on that senses what a recording tells, step by step."""
        body, home = self.body, self.guided.mean(axis=0)
        self.robot = RecordedRobot(body, self.guard(body), home, self.period_ns, steps)

    @property
    def body(self) -> Body:
        """Joints and limits of the arm as configured, without the arm."""
        return made_of(body_of, self.cfg["robot"]["arm"])

    def guard(self, body: Body) -> Guard:
        """What no command may make a body do."""
        node = self.cfg["robot"]
        shared = {"urdf": node["arm"]["urdf"], "base": node["arm"]["base"]}
        return guard_of(body, **shared, head=node["head"]["eye"], **node["guard"])

    @cached_property
    def thing(self) -> Can | None:
        """What stands on the table, where a hand that holds it would be seen; None: nothing.

        An arm without an engine has none: things are there for it, or they are not.
        """
        node, robot = self.cfg.get("object"), self.cfg["robot"]
        if node is None or "thing" not in asked_by(robot["arm"]):
            return None
        rng = generator(self.cfg["seed"], "object")
        return can_on_table(node, robot, self.learning_space, self.cfg["camera"]["eye"], rng)

    @property
    def period_ns(self) -> int:
        """The control period [ns]."""
        period: float = self.cfg["period"]
        return round(period * SECOND)

    @cached_property
    def guided(self) -> Array:
        """Postures the experimenter guided the arm to, (n, n_joints) [rad]."""
        return np.array(self.cfg["robot"]["guided"], dtype=float)

    @property
    def rest(self) -> Array:
        """The posture in which the arm is out of the camera's view, (n_joints,) [rad]."""
        return np.array(self.cfg["robot"]["rest"], dtype=float)

    @cached_property
    def dynamics(self) -> Dynamics:
        """Eqs. 1 and 2 for this arm."""
        body = self.robot.body
        return Dynamics(lower=body.lower, upper=body.upper, **self.cfg["dynamics"])

    @cached_property
    def field(self) -> VisualField:
        """The visual field that `field=` names."""
        return VisualField(size=self.space.size, **self.cfg["field"])

    def watched(self, samples: Iterator[Sample]) -> Iterator[Sample]:
        """The steps, with what becomes of the hand in view among their events."""
        return map(HandWatch(**self.cfg["recording"]["hand"]).noticed, samples)

    def perception(self, field: VisualField) -> Perception:
        """Sees the hand in `field`."""
        node = dict(self.cfg["vision"])
        for key in ("hue", "saturation", "value"):
            if key in node:
                node[key] = tuple(node[key])
        return Perception(make(node), self.space, field)

    @cached_property
    def controller(self) -> Controller:
        """What sets V, A and epsilon in reaching, given what it asks for."""
        node, body = self.cfg["controller"], self.robot.body
        offered = {
            "rng": generator(self.cfg["seed"], "noise"),
            "acceleration": body.acceleration,
            "period": self.robot.period,
        }
        controller: Controller = make_offered(without(node, "name"), offered)
        return controller

    @cached_property
    def selection(self) -> Selection:
        """What sets V in mimicry."""
        selection: Selection = make(without(self.cfg["selection"], "name"))
        return selection

    def empty_map(self) -> VisuoMotorMap:
        """A map that has learned nothing yet."""
        node = self.cfg["map"]
        learning = Learning(**without(node, "neurons"))
        body = self.robot.body
        return VisuoMotorMap(self.field, body.lower, body.upper, node["neurons"], learning)

    def object_goal(self, seen: Array) -> Array | None:
        """Where the demonstrator put the object: the mark was last `seen` (2,) [px]; (3,) [m]."""
        if self.thing is None:
            return None
        robot, hand = self.cfg["robot"], self.cfg["demonstrator"]
        eye, height = self.cfg["camera"]["eye"], hand["height"] + hand["raise"]
        place = held_at(seen, robot, self.learning_space, eye, height)
        return np.append(place, self.thing.centre[2])

    def empty_sequence(self) -> TimedSequence:
        """A timed sequence that has learned nothing yet."""
        node = self.cfg["sequence"]
        return TimedSequence(TimeCells(**node["cells"]), node["context"], node["match"])
