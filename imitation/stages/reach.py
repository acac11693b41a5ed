"""Reaching a seen target with the learned map (section II, figs. 4 and 5)."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from imitation.arrays import Array
from imitation.controllers.controller import Controller
from imitation.deciding import braking
from imitation.dynamics import Dynamics
from imitation.perception import Perception
from imitation.robot import Command, Robot
from imitation.sample import Event, Sample
from imitation.visuo_motor_map import VisuoMotorMap


@dataclass(frozen=True)
class Trial:
    """One reach from one start."""

    target: Array  # (2,) [px of visual space]
    start: Array  # posture, (n_joints,) [rad]


@dataclass(frozen=True)
class Reaching:
    """When a trial succeeds and when it ends."""

    tolerance: float  # the target is reached when the hand is seen nearer than this [px]
    hold_frames: int  # held when that is so for this many frames in a row
    noise_px: float  # standard deviation of the places seen [px]
    sure: float  # nearer than tolerance by so many times the noise, the hand truly is there
    limit: float  # a trial ends here [s]
    after: Literal["stop", "hold"]  # stop at the target for good, or hold while under tolerance

    def begins_hold(self, distance: float, near_before: bool) -> bool:
        """Whether a frame within tolerance begins a hold: one alone may be there by noise."""
        return near_before or distance < self.tolerance - self.sure * self.noise_px


def reach(
    robot: Robot,
    perception: Perception,
    learned: VisuoMotorMap,
    dynamics: Dynamics,
    controller: Controller,
    trials: Sequence[Trial],
    reaching: Reaching,
) -> Iterator[Sample]:
    """Reach one target after another; every trial begins at its own start."""
    for number, trial in enumerate(trials):
        seen = robot.reset(trial.start)
        controller.begin(learned, trial.target)
        begun, frame_ns = seen.time, -1
        stopped, reached, near_before = False, False, False
        held, left = 0, reaching.hold_frames + 1  # the first frame may be doubted
        events = [_begun(number, trial)]
        while seen.time - begun <= reaching.limit and held < reaching.hold_frames and left:
            percept = perception.perceive(seen)
            decision = controller.decide(seen, percept, trial.target, dynamics)
            near = decision.distance < reaching.tolerance
            if near and not reached:
                events.append(_told("reached", number, decision.distance))
            if percept.time_ns != frame_ns or not near:
                goes_on = held > 0 or reaching.begins_hold(decision.distance, near_before)
                held, near_before = held + 1 if near and goes_on else 0, near
                if held == 1:
                    events.append(_told("settled", number, decision.distance))
                if held == reaching.hold_frames:
                    events.append(_told("held", number, decision.distance))
            frame_ns, reached = percept.time_ns, reached or near
            stopped = near or (stopped and reaching.after == "stop")
            if stopped and not controller.keeps_correcting:
                decision = braking(decision, np.zeros_like(decision.velocity))
                left -= reaching.after == "stop"
            command = Command(decision.velocity)
            sensed, applied = robot.step(command)
            yield Sample(seen, percept, decision, command, applied, tuple(events))
            seen, events = sensed, []


def _begun(number: int, trial: Trial) -> Event:
    x, y = (round(float(value), 3) for value in trial.target)
    return Event(
        "episode",
        f"trial {number + 1} begins: reach ({x:.1f}, {y:.1f}) px",
        {"trial": number, "target_px": [x, y], "start_posture": trial.start.tolist()},
    )


def _told(kind: str, number: int, distance: float) -> Event:
    return Event(
        kind,
        f"trial {number + 1}: {kind}, the hand is seen {distance:.2f} px from the target",
        {"trial": number, "distance_px": round(distance, 3)},
    )
