"""Why the arm moved as it did at one step: what its recording says, put in order."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from imitation.arrays import Array, Index
from imitation.dynamics import Dynamics
from imitation.recording import messages
from imitation.recording.recorded_steps import StepTold, events
from imitation.recording.step_messages import Topic
from imitation.robot import SECOND, Observation

NOTICED = 0.005  # a share or a velocity smaller than this is not worth a word


@dataclass(frozen=True)
class Moment:
    """One step of a recording with what was in force then."""

    number: int  # of the step, from 0
    told: StepTold
    episode: str  # how the episode began, in a sentence; empty when it does not tell
    episode_ns: int  # when it began
    reasons: tuple[str, ...]  # why the guard limited the velocity


def moment(steps: Iterable[StepTold], time_ns: int) -> Moment:
    """The step that was under way at a time since the start of the run.

    Raises:
        ValueError: There was none.
    """
    found: Moment | None = None
    episode, episode_ns, reasons = "", 0, tuple[str, ...]()
    last_ns = 0
    for number, told in enumerate(steps):
        last_ns = told.time_ns
        if told.time_ns > time_ns:
            break
        for event in events(told.messages):
            sentence, facts = messages.split_log(event)
            if event.name == "episode":
                episode, episode_ns = sentence, told.time_ns
            elif event.name == "limited":
                reasons = tuple(facts["reasons"])
        found = Moment(number, told, episode, episode_ns, reasons)
    else:
        if found is not None and time_ns > last_ns + SECOND:
            raise ValueError(_no_step(time_ns, "ends", last_ns))
    if found is None:
        raise ValueError(_no_step(time_ns, "begins", last_ns))
    return found


def _no_step(asked_ns: int, doing: str, nearest_ns: int) -> str:
    # Rounded up: the first step is not yet under way before it.
    nearest = f"{np.ceil(nearest_ns / SECOND * 100) / 100:.2f}"
    return (
        f"no step at {asked_ns / SECOND:g} s: the run {doing} at {nearest} s; type --at {nearest}"
    )


@dataclass(frozen=True)
class Reason:
    """What a step decided on, in the arrays of eqs. 1 and 2."""

    seen: Observation
    hand: Array | None  # (2,) [px of visual space]; None: not seen
    hand_ns: int  # when the frame that showed it was captured
    target: Array | None  # (2,) [px of visual space]
    visual_input: Array  # I, (rows, columns)
    selection: Array  # V, (rows, columns)
    index: Index  # row, column, neuron of each attractor, (n, 3)
    activation: Array  # N V, (n,)
    pulls: Array  # shares of f(x), (n, n_joints) [-1..1]
    gain: float  # A
    noise_level: float  # epsilon
    distance: float  # [px]; nan: none
    noise: Array  # drawn, (n_joints,) [-1..1]
    requested: Array  # (n_joints,) [rad/s]
    limited: Array
    sent: Array
    events: tuple[str, ...]  # what happened, in sentences

    @property
    def shares(self) -> Array:
        """Share of each attractor in the whole pull, along it, (n,); they sum to 1."""
        whole = self.pulls.sum(axis=0)
        squared = float(whole @ whole)
        return self.pulls @ whole / squared if squared else np.zeros(len(self.pulls))

    def pulled(self, dynamics: Dynamics) -> Array:
        """What the pull alone makes of the velocity, A f(x) / tau, (n_joints,) [rad/s]."""
        return self._unscaled(self.gain * self.pulls.sum(axis=0), dynamics)

    def shaken(self, dynamics: Dynamics) -> Array:
        """What the noise alone makes of it, (n_joints,) [rad/s]."""
        return self._unscaled(self.noise, dynamics)

    def _unscaled(self, scaled: Array, dynamics: Dynamics) -> Array:
        return np.asarray(scaled / dynamics.tau * (dynamics.upper - dynamics.lower) / 2)


def reason(told: StepTold, topics: dict[str, Topic]) -> Reason:
    """Decode what a step says.

    Raises:
        ValueError: A message is damaged or missing.
    """
    said: dict[str, Any] = {
        message.topic: messages.decoded(message.data, topics[message.topic].type)
        for message in told.messages
        if message.topic not in ("/camera/image", "/events")
    }
    try:
        return _reason(told, said)
    except KeyError as missing:
        at = told.time_ns / SECOND
        raise ValueError(f"the step at {at:.3f} s lacks {missing.args[0]}") from missing


def _reason(told: StepTold, said: dict[str, Any]) -> Reason:
    hand, target = said.get("/hand"), said.get("/target")
    gain, noise_level, distance = said["/dynamics"].data.tolist()
    happened = [event for event in events(told.messages) if event.name != "limited"]
    return Reason(
        seen=told.step.seen,
        hand=None if hand is None else _place(hand),
        hand_ns=told.step.seen.frame_time_ns,
        target=None if target is None else _place(target),
        visual_input=messages.array(said["/visual_input"]),
        selection=messages.array(said["/selection"]),
        index=messages.array(said["/attractors/index"]),
        activation=messages.array(said["/attractors/activation"]),
        pulls=messages.array(said["/attractors/pull"]),
        gain=gain,
        noise_level=noise_level,
        distance=distance,
        noise=said["/dynamics/noise"].data,
        requested=said["/joint_command/requested"].velocity,
        limited=said["/joint_command/limited"].velocity,
        sent=said["/joint_command/sent"].velocity,
        events=tuple(messages.split_log(event)[0] for event in happened),
    )


def active_areas(values: Array) -> list[tuple[str, float]]:
    """The areas that have something, as [row, column], the most active first."""
    areas: Sequence[tuple[int, int]] = [
        (int(row), int(column)) for row, column in np.argwhere(values > NOTICED)
    ]
    ordered = sorted(areas, key=lambda area: -values[area])
    return [(f"[{row}, {column}]", float(values[row, column])) for row, column in ordered]


def _place(told: Any) -> Array:
    return np.array((told.point.x, told.point.y))
