"""Where a hand triggers an action, and where it does not: places over the whole image, tried."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from cli.build import Bench
from cli.experiments import composed
from cli.replaying import recalling
from imitation.analysis.triggers import Probe, Triggers
from imitation.arrays import Array
from imitation.recording.action_file import Action
from imitation.robot import Command
from imitation.robots.hand_paths import Beside
from imitation.sample import Event
from imitation.visual_field import VisualField
from imitation.visuo_motor_map import VisuoMotorMap


@dataclass(frozen=True)
class Trying:
    """How places are tried; its YAML says what each means."""

    across: int
    hidden: float
    shown: float


@dataclass(frozen=True)
class OneAfterTheOther(Beside):
    """A hand at one place after the other, out of sight before each.

    Args:
        places: (n, 2) [px].
        hidden: It is out of sight for this long [s].
        shown: Then it is seen for this long [s].
    """

    places: Array
    hidden: float
    shown: float

    def place(self, time: float) -> Array | None:
        """Where it is, (2,) [px]; None: out of sight."""
        # A time that is a whole number of slots may come out a little less.
        number, within = divmod(time + 1e-6, self.hidden + self.shown)
        seen = within >= self.hidden and number < len(self.places)
        return np.asarray(self.places[int(number)]) if seen else None


def probes(field: VisualField, across: int) -> Array:
    """Places in a grid of `across` by `across` in each area of the whole image, (n, 2) [px]."""
    shares = (np.arange(across) + 0.5) / across
    x, y = ((edges[:-1, None] + shares * np.diff(edges)[:, None]).ravel() for edges in field.edges)
    return np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)


def triggers(seed: int, learned: VisuoMotorMap, action: Action, trying: Trying) -> Triggers:
    """What a hand at each place triggers while the arm rests and nothing else is in view."""
    bench = Bench({**composed("replay", "map=given", "action=given", "~object"), "seed": seed})
    places, field = probes(learned.field, trying.across), learned.field
    assert bench.demonstrator is not None
    gesture = OneAfterTheOther(places, trying.hidden, trying.shown)
    bench.demonstrator = replace(bench.demonstrator, gesture=gesture)
    perception, robot = bench.perception(field), bench.robot
    steps = round((trying.hidden + trying.shown) / robot.period)
    still, seen, found = Command(np.zeros(len(bench.rest))), robot.reset(bench.rest), []
    for place in places:
        recall, told = recalling(bench, learned, action), list[Event]()
        for _ in range(steps):
            told += recall.notice(perception.perceive(seen))
            seen, _ = robot.step(still)
        state: Any = next((one.facts["state"] for one in told if one.kind == "trigger"), None)
        found.append(Probe(place, state))
    robot.close()
    return Triggers(field, recall.areas, found)
