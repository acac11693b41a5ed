"""Which state of an action is present: seen at first, then predicted by the internal loop (IV)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array
from imitation.arrivals import Arrivals
from imitation.perception import Percept
from imitation.robot import SECOND
from imitation.sample import Event
from imitation.sequence import Replay
from imitation.visual_field import Area, VisualField


@dataclass
class Recall:
    """A learned action that a hand, arriving at one of its states, lets play to its end.

    Args:
        places: Where each state was seen, (2,) [px].
        loop: Plays the learned sequence.
        arrivals: Tells where hands have newly come to stay.
        field: Of the map: the states are those of its areas that hold the places.
        noise: Read-out noise on the time cells, standard deviation [0..1].
        rng: Draws it.
    """

    places: Sequence[Array]
    loop: Replay
    arrivals: Arrivals
    field: VisualField
    noise: float
    rng: np.random.Generator

    def __post_init__(self) -> None:
        self.areas = [self.field.area_of(place) for place in self.places]
        self.state: int | None = None  # None: the action is not playing
        self.staying = np.zeros(self.field.shape, dtype=bool)  # areas with a hand when it began

    @property
    def place(self) -> Array:
        """Where the present state was seen, (2,) [px]."""
        assert self.state is not None
        return self.places[self.state]

    @property
    def coming(self) -> Array | None:
        """Where the state was seen that follows the present one, (2,) [px]; None: none does."""
        return None if self.state is None or self.loop.over else self.places[self.state + 1]

    @property
    def over(self) -> bool:
        """Whether the last state is present."""
        return self.state is not None and self.loop.over

    @property
    def where(self) -> str:
        """Where in the action it is, in words."""
        return "before any state was seen" if self.state is None else f"in {self.called}"

    @property
    def called(self) -> str:
        """The present state, in words."""
        assert self.state is not None
        row, column = self.areas[self.state] or ("?", "?")
        return f"state {self.state + 1} of {len(self.places)}, area [{row}, {column}]"

    def notice(self, percept: Percept) -> list[Event]:
        """See which hands have arrived; one at a state triggers the action, unless it plays."""
        time = percept.time_ns / SECOND
        arrived = self.arrivals.notice(time, percept.visual_input, percept.places)
        state = None if self.state is not None else self._recognised(arrived)
        events = [_noticed(area, since) for area, since in arrived.items()]
        if state is None:
            return events
        since = arrived[self.areas[state] or (-1, -1)]
        self.state, self.staying = state, self.arrivals.present
        sequence = self.loop.sequence
        shape = len(sequence.keys), sequence.cells.count
        self.loop.start(state, since, self.noise * self.rng.standard_normal(shape))
        facts: dict[str, object] = {"state": state, "since_s": since}
        return [*events, Event("trigger", f"a hand is seen at {self.called}", facts)]

    def predict(self, time: float) -> Event | None:
        """That the next state is due at `time` [s], if it is."""
        if self.state is None:
            return None
        state = self.loop.predict(time)
        if state is None:
            return None
        self.state = state
        return Event("predicted", f"{self.called}, is due", {"state": state})

    def end(self) -> None:
        """The action is over: hands that are in view now are no news."""
        self.state = None
        self.arrivals.grow_familiar()

    def _recognised(self, arrived: Mapping[Area, float]) -> int | None:
        """The first state with a hand that something follows."""
        found = [k for k, area in enumerate(self.areas[:-1]) if area in arrived]
        return found[0] if found else None


def _noticed(area: Area, since: float) -> Event:
    row, column = area
    facts = {"area": [row, column], "since_s": since}
    return Event("noticed", f"a hand has come to stay in area [{row}, {column}]", facts)
