"""One control step as it goes into the recording: senses, decision, what was applied."""

from dataclasses import dataclass, field

import numpy as np

from imitation.arrays import Array, Index
from imitation.perception import Percept
from imitation.robot import Applied, Command, Observation


@dataclass(frozen=True)
class Decision:
    """Where the arm is drawn and how strongly: all that eqs. 1 and 2 were given."""

    selection: Array  # V, (rows, columns)
    index: Index  # row, column, neuron of each attractor, (n, 3); -1: not in the map
    postures: Array  # of the attractors, (n, n_joints) [rad]
    activation: Array  # normalised weight N V of each, (n,)
    shares: Array  # each one's share of f(x), (n, n_joints) [-1..1]
    gain: float  # A
    noise_level: float  # epsilon
    noise: Array  # the noise drawn, (n_joints,) [-1..1]
    velocity: Array  # requested, eq. 1, (n_joints,) [rad/s]
    target: Array | None = None  # (2,) [px of visual space]
    distance: float = float("nan")  # from the seen hand to the target [px]


@dataclass(frozen=True)
class Event:
    """Something that happened once."""

    kind: str  # one word
    sentence: str
    facts: dict[str, object] = field(default_factory=dict)


@dataclass(frozen=True)
class Sample:
    """One control step."""

    seen: Observation
    percept: Percept
    decision: Decision
    command: Command
    applied: Applied
    events: tuple[Event, ...] = ()


@dataclass(frozen=True)
class RecordedStep:
    """What a recording tells of the senses at one step, to decide on anew."""

    seen: Observation
    sent: Array  # velocity that the arm made of the command, (n_joints,) [rad/s]
    sent_ns: int  # when it was sent
    begins: bool  # an episode: the robot was reset before
    trouble: str | None = None  # with the frame, why the arm was not to move


def attractors_not_in_map(n: int) -> Index:
    """Index of `n` attractors that no cluster holds, (n, 3)."""
    return np.full((n, 3), -1, dtype=np.int32)
