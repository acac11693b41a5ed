"""What Fig. 7 and its film need: demonstrations and replays, and how everything stood in them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from cli.build import Bench
from cli.deferred_runs import demonstrated, replayed
from cli.every_seed import on_every_seed
from cli.experiments import Experiment, learned_map
from cli.trigger_table import Trying, triggers
from imitation.analysis.fig7 import Movement, Strip, draw_fig7
from imitation.analysis.fig7_claims import Asked, Deferred
from imitation.analysis.figure_style import Drawn
from imitation.arrays import Array
from imitation.recording.action_file import Action
from imitation.robots.bullet.world_portrait import LitWorld, Moment, lit_up
from imitation.sample import Sample
from imitation.visuo_motor_map import VisuoMotorMap

EMPTY_HANDED = "~object"


@dataclass(frozen=True)
class Fig7:
    """Runs and drawing of Fig. 7; its YAML says what each means."""

    demonstration: Sequence[str]
    conditions: Mapping[str, Sequence[str]]
    reproductions: Mapping[str, Sequence[str]]
    other_arm: Sequence[str]
    trying: Trying
    all_from: int
    fade: float
    portrait: Any  # of imitation.robots
    drawing: Asked
    workers: int


@dataclass
class Watched:
    """How everything stood at each step of a run, and where its mark was."""

    moments: list[Moment] = field(default_factory=list)
    marks: list[Array] = field(default_factory=list)  # of whoever acts, (3,) [m]
    ends: list[int] = field(default_factory=list)  # the last step of each state's stay
    lit: LitWorld | None = None
    _left_rest: bool = False  # until the first state is due the arm is not yet at one

    def robot(self, sample: Sample, bench: Bench) -> None:
        """Note a step of the robot's own doing."""
        self._note(sample, bench)
        mark, _ = bench.robot.arm.truth() or (np.full(3, np.nan), None)
        self.marks.append(mark)
        told = {event.kind for event in sample.events}
        if told & {"trigger", "ended"} or ("predicted" in told and self._left_rest):
            self.ends.append(len(self.moments) - 1)
        self._left_rest |= "predicted" in told

    def person(self, sample: Sample, bench: Bench) -> None:
        """Note a step of a demonstration."""
        self._note(sample, bench)
        other = self.moments[-1].other
        self.marks.append(np.full(3, np.nan) if other is None else other)

    def _note(self, sample: Sample, bench: Bench) -> None:
        seen, arm = sample.seen, bench.robot.arm
        _, thing = arm.truth() or (None, None)
        other = bench.demonstrator.at(seen.time).mark if bench.demonstrator else None
        self.moments.append(Moment(seen.time, seen.posture, seen.opening, thing, other))
        if self.lit is None:
            self.lit = lit_up(arm.world, seen.posture)  # type: ignore[attr-defined]


def fig7(seeds: Sequence[int], settings: Fig7) -> Drawn:
    """Run and draw Fig. 7."""
    few = len(seeds) < settings.all_from
    work = partial(first_outcome if few else outcomes, settings=settings)
    runs = on_every_seed("fig7", work, seeds, settings.workers)
    return draw_fig7(strips(seeds[0], settings), runs, settings.drawing)


def outcomes(seed: int, settings: Fig7) -> Deferred:
    """What came of each condition with the seed's own map and demonstration."""
    learned = map_of(seed)
    action = demonstrated(seed, *settings.demonstration)
    found = {
        name: replayed(seed, learned, action, *words) for name, words in settings.conditions.items()
    }
    paths = {}
    if settings.other_arm:
        other = learned_map(seed, Experiment(settings.other_arm, [], [], 1))
        found["other arm"] = replayed(seed, other, action, *settings.other_arm, EMPTY_HANDED)
        paths = {"Katana": found["without a can"].path(), "other arm": found["other arm"].path()}
    delays = np.diff([state.time for state in action.states]).tolist()
    told = {name: {**one.result(), "delays_s": delays} for name, one in found.items()}
    return Deferred(told, paths, triggers(seed, learned, action, settings.trying))


def first_outcome(seed: int, settings: Fig7) -> Deferred:
    """The same of the first condition alone."""
    first = dict(list(settings.conditions.items())[:1])
    return outcomes(seed, replace(settings, conditions=first, other_arm=()))


def map_of(seed: int) -> VisuoMotorMap:
    """The seed's own map."""
    return learned_map(seed, Experiment([], [], [], 1))


def watched_runs(seed: int, settings: Fig7) -> dict[str, Watched]:
    """The demonstration and the reproductions, as a visitor sees them."""
    learned, shown = map_of(seed), Watched()
    action = demonstrated(seed, *settings.demonstration, look=shown.person)
    shown.ends = stays(shown, action)
    found = {"demonstration": shown}
    for name, words in settings.reproductions.items():
        found[name] = Watched()
        replayed(seed, learned, action, *words, look=found[name].robot)
    return found


def stays(shown: Watched, action: Action) -> list[int]:
    """The last step of each state's stay in a demonstration."""
    marks = np.array(shown.marks)
    speed = np.linalg.norm(np.diff(marks, axis=0), axis=1)
    ends = []
    for state, later in zip(action.states, [*action.states[1:], None], strict=True):
        until = np.inf if later is None else later.time
        times = np.array([moment.time for moment in shown.moments[:-1]])
        still = (times >= state.time) & (times < until) & (speed < 1e-4)
        ends.append(int(np.flatnonzero(still)[-1]))
    return ends


def strips(seed: int, settings: Fig7) -> list[Strip]:
    """The pictures, a strip for each run: two successive positions in each."""
    found = []
    for name, run in watched_runs(seed, settings).items():
        assert run.lit is not None
        pictures = []
        for first, last in zip(run.ends, run.ends[1:], strict=False):
            before, after = (picture(run, at, settings) for at in (first, last))
            blended = settings.fade * before + (1 - settings.fade) * after
            way = [settings.portrait.place_of(run.marks[at]) for at in (first, last)]
            pictures.append(Movement(blended.round().astype(np.uint8), np.array(way)))
        run.lit.close()
        found.append(Strip(name, pictures))
    return found


def picture(run: Watched, at: int, settings: Fig7) -> Array:
    """How everything stood at one step, (height, width, 3) [0..255]."""
    assert run.lit is not None
    run.lit.arrange(run.moments[at])
    return np.asarray(settings.portrait.drawn(run.lit), dtype=np.float64)
