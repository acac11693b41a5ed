"""The trigger table of an action: probe places over the whole image, and what each triggered."""

from collections.abc import Sequence
from dataclasses import dataclass

from imitation.arrays import Array
from imitation.visual_field import Area, VisualField


@dataclass(frozen=True)
class Probe:
    """A hand shown at one place."""

    place: Array  # (2,) [px]
    triggered: int | None  # the state that the action began with; None: it did not begin


@dataclass(frozen=True)
class Triggers:
    """All places tried with one map and one action."""

    field: VisualField
    areas: Sequence[Area | None]  # of each state
    probes: Sequence[Probe]

    def expected(self, probe: Probe) -> int | None:
        """The first state in whose area the place lies, if another follows it; None: none."""
        area = self.field.area_of(probe.place)
        return next((k for k, one in enumerate(self.areas[:-1]) if one == area), None)

    @property
    def right(self) -> float:
        """Share of the places that triggered what they should, or rightly nothing."""
        found = [one.triggered == self.expected(one) for one in self.probes]
        return sum(found) / len(found)
