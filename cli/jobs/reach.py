"""imitate reach: reach seen targets with a learned map."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import hydra
import numpy as np
from omegaconf import DictConfig

from cli import stages
from cli.build import Bench, generator
from cli.errors import UserError
from cli.job import job
from cli.run import Outcome, Run
from imitation.analysis.metrics import ReachMetrics
from imitation.arrays import Array
from imitation.hull import depth_inside
from imitation.recording.map_file import LearnedMap, differences, fingerprint, load_map
from imitation.recording.run_files import file_in
from imitation.sample import Sample
from imitation.stages.reach import Trial
from imitation.stages.trials import from_learned_postures, random_targets

CONTROLS = ("noise", "nearest")  # nothing is asked of them


@hydra.main(version_base="1.3", config_path="pkg://conf", config_name="reach")
def main(cfg: DictConfig) -> int:
    """One job."""
    return job("reach", cfg, reach_targets)


def reach_targets(run: Run) -> Outcome:
    """Reach as many targets as asked for."""
    stored, name = the_map(run), run.cfg["controller"]["name"]
    samples, metrics = reaching(run.bench, stored, trials_of(run.bench, stored))
    run.record(samples, stored.map.field, metrics.add)
    cfg = run.cfg["reach"]
    stops = not metrics.holding and cfg["after"] == "stop"
    return outcome(metrics.result(name), metrics.holding, stops, required(cfg["required"], name))


def reaching(
    bench: Bench, stored: LearnedMap, trials: Sequence[Trial]
) -> tuple[Iterator[Sample], ReachMetrics]:
    """The steps of the trials, and what will measure them."""
    cfg = bench.cfg["reach"]
    metrics = ReachMetrics(
        stored.map,
        stored.outline,
        bench.robot.body,
        cfg["border"],
        holding=bench.cfg["controller"]["name"] not in (*CONTROLS, "yuragi"),
    )
    return stages.reaching(bench, stored.map, trials), metrics


def the_map(run: Run) -> LearnedMap:
    """The map that `map=` names, if it is this body's."""
    named = Path(str(run.cfg["map"])).expanduser()
    stored = load_map(named)
    if not stored.map.learned.any():
        raise UserError(f"map={named} holds no learned area; learn another: imitate learn-map")
    run.uses("map", file_in(named, "map.npz"))
    bench, field = run.bench, stored.map.field
    present = fingerprint(bench.robot.body, field, bench.learning_space)
    if found := differences(stored.fingerprint, present):
        raise UserError(
            f"map={named} is refused: {'; '.join(found)}; type the robot= and camera= that it was "
            "learned with, or learn another with: imitate learn-map"
        )
    asked = run.cfg.get("field")
    if asked is not None and asked["name"] != field.name:
        name = asked["name"]
        raise UserError(f"field={name}: the map was learned with {field.name}; leave field= out")
    return stored


def trials_of(bench: Bench, stored: LearnedMap) -> list[Trial]:
    """The trials that the configuration asks for."""
    cfg = bench.cfg
    targets_rng, starts_rng = generator(cfg["seed"], "targets"), generator(cfg["seed"], "starts")
    count, inset = cfg["trials"], cfg["reach"]["inset"]
    if cfg["area"] is not None and cfg["target"] != "random":
        raise UserError(f"area={cfg['area']} and target={cfg['target']}: give one of them")
    if cfg["area"] is not None:
        targets = [_learned_place(stored, cfg["area"])] * count
    elif cfg["target"] == "random":
        targets = random_targets(stored.outline, bench.space.size, inset, count, targets_rng)
    else:
        targets = [np.array(cfg["target"], dtype=float)] * count
    for target in targets:
        if depth_inside(stored.outline, target) < 0 and not cfg["reach"]["force"]:
            raise UserError(
                f"target [{target[0]:g}, {target[1]:g}] px lies outside the learned region "
                f"({_extent(stored.outline)}); type reach.force=true to reach for it all the same"
            )
    return from_learned_postures(targets, stored.map, starts_rng)


def required(asked: float | None, controller: str) -> float:
    """The success rate below which the exit code is 1."""
    if asked is not None:
        return asked
    return 0.0 if controller in CONTROLS else 1.0


def outcome(metrics: dict[str, Any], holding: bool, stops: bool, wanted: float) -> Outcome:
    """What is told of the trials.

    Args:
        metrics: Of the run.
        holding: Success is a target held, not only reached.
        stops: The arm was stopped for good where it first was near.
        wanted: The success rate that was asked for.
    """
    rate, count = metrics["success_rate"], len(metrics["trials"])
    word = "held" if holding else "reached"
    held = _share(metrics["held_rate"])
    if stops and metrics["held_rate"] < metrics["reached_rate"]:
        held += ": it stops once there (paper); reach.after=hold holds"
    complaint = f"{word} {rate:.0%} of the targets, asked were {wanted:.0%} (reach.required)"
    return Outcome(
        metrics=metrics,
        rows=[
            ("controller", metrics["controller"]),
            ("trials", str(count)),
            ("reached", _share(metrics["reached_rate"])),
            ("held", held),
            ("time to success", _seconds(metrics["median_time_s"])),
        ],
        next="imitate view {run}",
        complaint=complaint if rate < wanted else None,
    )


def _learned_place(stored: LearnedMap, area: list[int]) -> Array:
    learned = stored.map
    rows, columns = learned.field.shape
    if not (0 <= area[0] < rows and 0 <= area[1] < columns):
        raise UserError(f"area={area}: rows are 0..{rows - 1}, columns 0..{columns - 1}")
    places = learned.places[area[0], area[1]]
    known = places[~np.isnan(places[:, 0])]
    if not len(known):
        areas = ", ".join(str(list(map(int, one))) for one in np.argwhere(learned.learned))
        raise UserError(f"area={area} is not learned in this map; learned are {areas}")
    return np.asarray(known[0])


def _extent(outline: Array) -> str:
    low, high = outline.min(axis=0), outline.max(axis=0)
    return f"x {low[0]:.0f}..{high[0]:.0f}, y {low[1]:.0f}..{high[1]:.0f}"


def _share(rate: float) -> str:
    return f"{rate:.0%}"


def _seconds(value: float | None) -> str:
    return "none" if value is None else f"{value:.2f} s in the median"
