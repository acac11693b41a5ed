"""Deferred imitation scored as psychology does: target acts and their order, beside controls."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import permutations
from typing import Any

import numpy as np

from cli.build import Config
from cli.deferred_runs import Stage, judged
from cli.every_seed import on_every_seed
from cli.replaying import exploring, replaying
from cli.report import verdict
from cli.run import Outcome
from imitation.analysis.deferred import acts_done, all_in_order
from imitation.analysis.statistics import bootstrap, wilson
from imitation.recording.action_file import Action
from imitation.visuo_motor_map import VisuoMotorMap


@dataclass(frozen=True)
class Shown:
    """What all conditions share."""

    cfg: Config  # of the replay
    learned: VisuoMotorMap
    action: Action  # as it was demonstrated

    def replayed(self, seed: int, played: Action) -> dict[str, Any]:
        """What comes of playing an action, judged as the one that was demonstrated."""
        hand = {**self.cfg["demonstrator"], "place": played.states[0].place.tolist()}
        cfg = {**self.cfg, "seed": seed, "demonstrator": hand}
        return self._judged(cfg, lambda bench: replaying(bench, self.learned, played)[1])

    def explored(self, seed: int) -> dict[str, Any]:
        """What comes of as much time without an action."""
        lasting = self.action.states[-1].time - self.action.states[0].time
        cfg = {**self.cfg, "seed": seed}
        return self._judged(cfg, lambda bench: exploring(bench, self.learned, lasting))

    def _judged(self, cfg: Config, stage: Stage) -> dict[str, Any]:
        return judged(cfg, self.learned, self.action, stage).result()


def controls(shown: Shown) -> list[dict[str, Any]]:
    """A row for each condition: the demonstration, chance, the same states in other orders."""
    asked, first = shown.cfg["controls"], shown.cfg["seed"]
    seeds = range(first, first + asked["seeds"])
    count = len(shown.action.states)
    orders = [reordered(shown.action, order) for order in list(permutations(range(count)))[1:]]
    conditions: dict[str, tuple[Callable[[int], dict[str, Any]], Sequence[int]]] = {
        "as demonstrated": (partial(shown.replayed, played=shown.action), seeds),
        "spontaneous exploration": (shown.explored, seeds),
        "in every other order": (partial(_in_order, shown, orders), range(len(orders))),
    }
    return [
        scored(name, on_every_seed(name, work, over, asked["workers"]), asked["resamples"])
        for name, (work, over) in conditions.items()
    ]


def _in_order(shown: Shown, orders: Sequence[Action], number: int) -> dict[str, Any]:
    return shown.replayed(shown.cfg["seed"] + number, orders[number])


def reordered(action: Action, order: Sequence[int]) -> Action:
    """The same states in another order, with the same times between them."""
    states = tuple(
        replace(action.states[k], time=now.time)
        for k, now in zip(order, action.states, strict=True)
    )
    return replace(action, states=states)


def scored(condition: str, results: Sequence[dict[str, Any]], resamples: int) -> dict[str, Any]:
    """Of a condition's replays: target acts done, and how many did all of them in order."""
    done = [np.array([acts_done(result)]) for result in results]
    complete = sum(all_in_order(result) for result in results)
    rng = np.random.default_rng(0)
    share = bootstrap(done, lambda values: float(np.mean(values)), rng, resamples)
    whole = wilson(complete, len(results))
    return {
        "condition": condition,
        "n": len(results),
        "target_acts": float(np.mean(done)),
        "target_acts_95": [share.low, share.high],
        "all_in_order": complete / len(results),
        "all_in_order_95": [whole.low, whole.high],
        "order_correct": sum(result["order_correct"] for result in results),
        "grasped": sum(result["grasped"] for result in results),
    }


def with_controls(told: Outcome, rows: Sequence[dict[str, Any]]) -> Outcome:
    """`told` of the recorded replay, with all conditions beside it."""
    shown = [
        (
            f"{row['condition']}, n = {row['n']}",
            f"all acts in order {row['all_in_order']:.0%} [{_interval(row['all_in_order_95'])}], "
            f"target acts {row['target_acts']:.0%} [{_interval(row['target_acts_95'])}]",
        )
        for row in rows
    ]
    true, *others = rows
    worse = all(true["target_acts_95"][0] > other["target_acts_95"][1] for other in others)
    shown.append(("beyond all controls", verdict(worse)))
    complaint = told.complaint
    if not worse:
        complaint = "a control does as well as the demonstrated action"
    metrics = {**told.metrics, "controls": list(rows)}
    return replace(told, metrics=metrics, rows=[*told.rows, *shown], complaint=complaint)


def _interval(ends: Sequence[float]) -> str:
    return f"{ends[0]:.0%}, {ends[1]:.0%}"
