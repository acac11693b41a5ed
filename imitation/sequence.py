"""Discrete transition learning with timing: a sequence seen once is recalled in its own time (IV).

Each event starts a battery of time cells. The next event learns, in one shot, the state that the
battery is in by then; in replay it is predicted when the battery is in that state again.
"""

from collections.abc import Hashable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from imitation.arrays import Array

State = Hashable  # whatever tells states apart, such as their areas
Key = tuple[State, ...]  # a state, after those before it that are kept as its context


@dataclass(frozen=True)
class TimeCells:
    """Cells that are most active at different times since an event, the later ones for longer.

    Equal steps and widths in log time are what makes errors proportional to the interval (Weber).
    """

    shortest: float  # interval that can be told [s]
    longest: float  # the same [s]
    count: int
    width: float  # of each cell, as a share of its time

    @cached_property
    def centres(self) -> Array:
        """When each cell is most active, (count,) [s]."""
        # Only where earlier cells have fallen silent already is the battery like no other time's.
        return np.geomspace(self.shortest / 2, self.longest, self.count)

    def activity(self, elapsed: float) -> Array:
        """State of the battery `elapsed` [s] after the event, (count,) [0..1]."""
        off = (elapsed - self.centres) / (self.width * self.centres)
        return np.asarray(np.exp(-(off**2) / 2))


@dataclass(frozen=True)
class Transition:
    """What is learned of a state: which one comes next, and when."""

    next: State
    battery: Array  # state of the time cells when `next` came, (count,)


class TimedSequence:
    """States in order, with the time between them.

    Args:
        cells: What is started by each event.
        context: How many states before the present one are kept with it; with 0, A-B-A-C cannot
            be told: what comes after A?
        match: Likeness below which the battery counts as far from what was learned [0..1].
    """

    def __init__(self, cells: TimeCells, context: int, match: float) -> None:
        self.cells, self.context, self.match = cells, context, match
        self.keys: list[Key] = []  # one for each event, in order
        self.transitions: dict[Key, Transition] = {}
        self._time = 0.0

    def learn(self, state: State, time: float) -> None:
        """Take notice that `state` came at `time` [s].

        Raises:
            ValueError: It cannot be stored; the message says why and what to do.
        """
        key = self.after(self.keys[-1] if self.keys else (), state)
        if key in self.keys:
            raise ValueError(
                f"states {self.keys.index(key) + 1} and {len(self.keys) + 1} are the same, and so "
                f"are the {self.context} before them: what follows cannot be told; keep more of "
                f"them with sequence.context={self.context + 1}"
            )
        if self.keys:
            self._learn_transition(state, time - self._time)
        self.keys.append(key)
        self._time = time

    def after(self, key: Key, state: State) -> Key:
        """What stands for `state` when it comes after `key`."""
        return (*key, state)[-self.context - 1 :]

    def likeness(self, transition: Transition, elapsed: float, noise: Array) -> float:
        """Cosine between the battery `elapsed` [s] after the event and the learned one."""
        present = self.cells.activity(elapsed) + noise
        lengths = np.linalg.norm(present) * np.linalg.norm(transition.battery)
        return float(present @ transition.battery / lengths) if lengths > 0 else 0.0

    def _learn_transition(self, state: State, interval: float) -> None:
        cells = self.cells
        if not cells.shortest <= interval <= cells.longest:
            raise ValueError(
                f"state {len(self.keys) + 1} comes {interval:.3g} s after the one before; the time "
                f"cells tell {cells.shortest:g} to {cells.longest:g} s; set "
                "sequence.cells.shortest= or sequence.cells.longest="
            )
        self.transitions[self.keys[-1]] = Transition(state, cells.activity(interval))


class Replay:
    """The internal loop: plays a learned sequence from any of its states to its end.

    Args:
        sequence: What was learned.
        tick: Time between predictions [s].
    """

    def __init__(self, sequence: TimedSequence, tick: float) -> None:
        self.sequence, self.tick = sequence, tick

    def start(self, index: int, time: float, noise: Array | None = None) -> None:
        """Begin to play.

        Args:
            index: The learned sequence's state that is present now.
            time: Now [s].
            noise: Read-out noise on the time cells in the wait for each state, the first's unused,
                (states, cells) [0..1]; None for none.
        """
        shape = (len(self.sequence.keys), self.sequence.cells.count)
        self._noise = np.zeros(shape) if noise is None else noise
        self._key, self._time, self.index = self.sequence.keys[index], time, index

    @property
    def over(self) -> bool:
        """Whether the present state is the last one."""
        return self._key not in self.sequence.transitions

    def predict(self, time: float) -> int | None:
        """Index of the state that is due at `time` [s], present from now on; None: none is due.

        It is due when the battery is like the learned one and would be less so a tick later.
        """
        transition = self.sequence.transitions.get(self._key)
        if transition is None:
            return None
        elapsed, noise = time - self._time, self._noise[self.index + 1]
        now = self.sequence.likeness(transition, elapsed, noise)
        later = self.sequence.likeness(transition, elapsed + self.tick, noise)
        if now < self.sequence.match or later > now:
            return None
        self._key = self.sequence.after(self._key, transition.next)
        self._time, self.index = time, self.index + 1
        return self.index


def recalled(sequence: TimedSequence, tick: float) -> list[float]:
    """The times between the states as the internal loop plays them, from the first on [s].

    Raises:
        ValueError: It waits for a state in vain.
    """
    replay, found, step = Replay(sequence, tick), [0.0], 0
    replay.start(0, 0.0)
    while not replay.over:
        step += 1
        if replay.predict(step * tick) is not None:
            found.append(step * tick)
        elif step * tick - found[-1] > 2 * sequence.cells.longest:
            raise ValueError(
                f"state {len(found) + 1} is never predicted; type a lower sequence.match= or a "
                "larger sequence.cells.width="
            )
    return [float(interval) for interval in np.diff(found)]
