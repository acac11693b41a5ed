"""The numbers of the README, measured over many seeds: make results."""

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from hydra import compose, initialize_config_module
from omegaconf import OmegaConf
from rich.console import Console
from rich.table import Table

from cli.build import Bench, Config, generator
from cli.every_seed import on_every_seed
from cli.experiments import composed
from cli.jobs.learn_map import learned_by
from cli.jobs.reach import reaching, trials_of
from cli.printed import as_it_stands
from cli.results_deferred import replay_one, told_of_replays
from cli.stages import learning
from imitation.analysis.metrics import learn_map_metrics
from imitation.analysis.statistics import bootstrap, wilson
from imitation.arrays import Array
from imitation.recording.json_file import write_json
from imitation.recording.map_file import LearnedMap
from imitation.stages.trials import from_learned_postures

RESULTS = Path("data/results.json")


@dataclass(frozen=True)
class Learned:
    """What one seed's babbling brought."""

    stored: LearnedMap
    metrics: dict[str, Any]
    robot_time_s: float
    off_truth: Array  # distance of each learned place to where its posture truly shows it [px]


def learn_one(task: tuple[int, Sequence[str]]) -> Learned:
    """Learn the map of one seed and hold its places against the truth."""
    seed, words = task
    bench = Bench({**composed("learn-map", *words), "seed": seed})
    learner, samples = learning(bench)
    for _ in samples:
        pass
    robot, lasted = bench.robot, learner.seen.time
    postures, places = learner.learned.memories()
    off = []
    for posture, place in zip(postures, places, strict=True):
        robot.reset(posture)
        off.append(float(np.linalg.norm(robot.truth()[-1].hand_px - place)))
    robot.close()
    metrics = learn_map_metrics(learner.learned, learner.shown)
    return Learned(learned_by(bench, learner), metrics, lasted, np.array(off))


def reach_one(task: tuple[int, LearnedMap, Sequence[str], int, bool]) -> dict[str, Any]:
    """Reach `count` targets with one seed's map: random ones, or the learned places."""
    seed, stored, words, count, learned_places = task
    bench = Bench({**composed("reach", "map=given", f"trials={count}", *words), "seed": seed})
    if learned_places:
        rng = generator(seed, "starts")
        trials = from_learned_postures(stored.map.memories()[1], stored.map, rng)
    else:
        trials = trials_of(bench, stored)
    samples, metrics = reaching(bench, stored, trials)
    for sample in samples:
        metrics.add(sample, bench.robot.truth())
    bench.robot.close()
    return metrics.result(bench.cfg["controller"]["name"])


def told_of_learning(name: str, runs: Sequence[Learned]) -> dict[str, Any]:
    """One row of the table of learning."""
    full = [run for run in runs if run.metrics["coverage"] == 1.0]
    times = np.array([run.robot_time_s for run in runs])
    places = [run.metrics["place_error_px"] for run in runs if run.metrics["place_error_px"]]
    off = np.concatenate([run.off_truth for run in runs])
    return {
        "condition": name,
        "maps complete": f"{len(full)} of {len(runs)}",
        "complete within 60 s": sum(run.robot_time_s <= 60 for run in full),
        "robot time median [s]": float(np.median(times)),
        "robot time max [s]": float(times.max()),
        "place error median [px]": float(np.median(places)) if places else None,
        "place error worst map [px]": max(places, default=None),
        "off truth median [px]": float(np.median(off)) if len(off) else None,
        "off truth max [px]": float(off.max()) if len(off) else None,
    }


def told_of_reaching(
    name: str, field: str, results: Sequence[dict[str, Any]], late_s: float, resamples: int
) -> dict[str, Any]:
    """One row of the table of reaching; intervals of medians are by bootstrap over maps."""
    maps = [result["trials"] for result in results]
    trials = [trial for trials in maps for trial in trials]
    holding = results[0]["controller"] == "corrected_aim"
    key = "held" if holding else "reached"
    true_held = sum(
        trial["held"] and trial["true_distance_px"] is not None and trial["true_distance_px"] <= 3
        for trial in trials
    )
    rng = generator(0, "bootstrap")

    def median_of(value: Callable[[dict[str, Any]], float], far: bool) -> list[float | None]:
        groups = [
            np.array([value(one) for one in some if one[key] and (not far or _far(one))])
            for some in maps
        ]
        groups = [group for group in groups if len(group)]
        if not groups:
            return [None, None, None]
        interval = bootstrap(groups, lambda values: float(np.median(values)), rng, resamples)
        return [float(np.median(np.concatenate(groups))), interval.low, interval.high]

    return {
        "condition": name,
        "field": field,
        "trials": len(trials),
        "reached": _rate(sum(trial["reached"] for trial in trials), len(trials)),
        "held": _rate(sum(trial["held"] for trial in trials), len(trials)),
        "held, truly within 3 px": _rate(true_held, len(trials)),
        "median time [s]": median_of(lambda one: one["time_s"], far=False),
        "time less delay over the speed bound": median_of(
            lambda one: (one["time_s"] - late_s) / one["time_bound_s"], far=True
        ),
        "path over straight line": median_of(
            lambda one: one["path_length_px"] / one["straight_px"], far=True
        ),
        "true distance [px]": median_of(
            lambda one: one["true_distance_px"] if one["held"] else np.nan, far=False
        )
        if holding
        else None,
        "at the border, success": _rate(
            sum(trial[key] for trial in trials if trial["border"]),
            sum(trial["border"] for trial in trials),
        ),
    }


def _far(trial: dict[str, Any]) -> bool:
    return trial["straight_px"] is not None and trial["straight_px"] >= 20


def _rate(successes: int, n: int) -> list[float]:
    interval = wilson(successes, n)
    return [successes / n if n else float("nan"), interval.low, interval.high]


def measure(cfg: Config) -> dict[str, list[dict[str, Any]]]:
    """Run every condition."""
    seeds = range(cfg["first_seed"], cfg["first_seed"] + cfg["seeds"])
    found: dict[str, list[dict[str, Any]]] = {"learning": [], "reaching": [], "replaying": []}
    maps: dict[str, list[Learned]] = {}
    each = partial(on_every_seed, workers=cfg["workers"], counted="maps")
    for name, words in cfg["learning"].items():
        runs = each(f"learn: {name}", learn_one, [(seed, words) for seed in seeds])
        maps.setdefault(runs[0].stored.map.field.name, runs)
        found["learning"].append(told_of_learning(name, runs))
        write(cfg, found)
    for field in cfg["fields"]:
        for name, words in cfg["reaching"].items():
            for places in (False, True) if name in cfg["learned_places"] else (False,):
                tasks = [
                    (seed, run.stored, words, cfg["targets"], places)
                    for seed, run in zip(seeds, maps[field], strict=True)
                ]
                called = f"{name}, learned places" if places else name
                results = each(f"reach: {called} on {field}", reach_one, tasks)
                late = 0.2 if "experiment=late_camera" in words else 0.0
                row = told_of_reaching(called, field, results, late, cfg["resamples"])
                found["reaching"].append(row)
                write(cfg, found)
    for higher in cfg["heights"]:
        for name, words in cfg["replaying"].items():
            shown = [
                (seed, run.stored.map, higher, words)
                for seed, run in zip(seeds, maps["right_4x4"], strict=True)
            ]
            replays = each(f"replay: {name}, {100 * higher:g} cm higher", replay_one, shown)
            found["replaying"].append(told_of_replays(name, higher, replays))
            write(cfg, found)
    return found


def write(cfg: Config, found: dict[str, list[dict[str, Any]]]) -> None:
    """Write what was found so far to data/results.json."""
    RESULTS.parent.mkdir(exist_ok=True)
    write_json(RESULTS, {"settings": cfg, **found})


def show(rows: Sequence[dict[str, Any]], title: str) -> None:
    """Print one table."""
    table = Table(title=title, title_justify="left")
    for heading in rows[0]:
        table.add_column(heading, overflow="fold")
    for row in rows:
        table.add_row(*as_it_stands(_told(value) for value in row.values()))
    Console(width=200).print(table)


def _told(value: Any) -> str:
    if isinstance(value, list):
        if value[0] is None:
            return "-"
        return f"{value[0]:.3g} [{value[1]:.3g}, {value[2]:.3g}]"
    return f"{value:.3g}" if isinstance(value, float) else "-" if value is None else str(value)


def main(words: Sequence[str]) -> None:
    """Measure, print, and write data/results.json."""
    with initialize_config_module("conf", version_base="1.3"):
        cfg: Any = OmegaConf.to_container(compose("results", list(words)), resolve=True)
    found = measure(cfg)
    for title, rows in found.items():
        if rows:
            show(rows, title)


if __name__ == "__main__":
    main(sys.argv[1:])
