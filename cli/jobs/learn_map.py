"""imitate learn-map: babble, watch the own hand, save the map."""

from typing import Any

import hydra
import numpy as np
from omegaconf import DictConfig

from cli.build import Bench
from cli.following import reach_with
from cli.guide import guide, typed_answer, write_guided
from cli.job import job
from cli.run import Outcome, Run
from cli.stages import learning
from imitation.analysis.metrics import learn_map_metrics
from imitation.arrays import Array
from imitation.hull import clip_outline, outline
from imitation.recording.map_file import LearnedMap, fingerprint, save_map
from imitation.stages.learn_map import Learner


@hydra.main(version_base="1.3", config_path="pkg://conf", config_name="learn_map")
def main(cfg: DictConfig) -> int:
    """One job."""
    return job("learn-map", cfg, learn)


def learn(run: Run) -> Outcome:
    """Learn a map and save it beside the recording."""
    if run.cfg["guide"]:
        guide_by_hand(run)
    learner, samples = learning(run.bench)
    run.record(samples, run.bench.field)
    if run.cfg["dry_run"]:
        return unmoved(run.bench)
    save_map(run.folder / "map.npz", learned_by(run.bench, learner))
    metrics = learn_map_metrics(learner.learned, learner.shown)
    limit = learner.run.limit if run.robot_time_s >= learner.run.limit else None
    return Outcome(
        metrics=metrics,
        rows=map_card(metrics),
        next=reach_with("{run}", run.typed) if metrics["areas_learned"] else "imitate view {run}",
        complaint=complaint(metrics, limit),
    )


def unmoved(bench: Bench) -> Outcome:
    """What a dry run brings: no map, as no posture it imagined was that of the hand it saw."""
    metrics = learn_map_metrics(bench.empty_map(), {})
    return Outcome(
        metrics=metrics,
        rows=map_card(metrics),
        next="imitate view {run}",
        complaint="a dry run: the arm was not moved, so nothing is learned and no map.npz saved",
    )


def guide_by_hand(run: Run) -> None:
    """Replace the configured guided postures by those the arm is led to now."""
    robot = run.bench.robot
    postures = guide(robot.arm, run.cfg["robot"]["name"], ask=typed_answer)
    run.bench.guided, robot.home = postures, postures.mean(axis=0)
    run.cfg["robot"]["guided"] = postures.tolist()  # what is recorded is what was done
    run.write_config()
    write_guided(run.folder / "guided.yaml", postures)


def learned_by(bench: Bench, learner: Learner) -> LearnedMap:
    """The map, with the border of where the hand was seen within reach."""
    told = fingerprint(bench.robot.body, bench.field, bench.learning_space)
    return LearnedMap(learner.learned, _outline(learner), told)


def map_card(metrics: dict[str, Any]) -> list[tuple[str, str]]:
    """What is printed of a map."""
    return [
        ("areas learned", f"{metrics['areas_learned']} of {metrics['areas_total']}"),
        ("place error", _px(metrics, "place_error_px", "place_error_max_px")),
        ("prediction error", _px(metrics, "prediction_error_px")),
        ("spread of neighbours", _number(metrics["neighbour_spread"], "of the joints' range / 2")),
        ("areas never seen", _areas(metrics["areas_never_seen"])),
    ]


def complaint(metrics: dict[str, Any], limit: float | None) -> str | None:
    """Why the map is not what was asked for; None when it is.

    Args:
        metrics: Of the map.
        limit: The limit that ended learning [s]; None when it ended by itself.
    """
    if not np.any(metrics["visits"]):
        return "the hand was never seen: does it carry the colour of vision=, in the camera's view?"
    if limit is not None:
        learned = f"{metrics['areas_learned']} of {metrics['areas_total']} areas are learned"
        return f"the limit of {limit:g} s came first: {learned}; give more time by learning.limit="
    missed = metrics["areas_not_confirmed"]
    if missed:
        return f"reached but not learned: {_areas(missed)}; another seed may do, such as seed=1"
    return None


def _outline(learner: Learner) -> Array:
    places = np.array(learner.places).reshape(-1, 2)
    if not len(places):
        return places
    field = learner.learned.field
    low, high = np.array((field.left, 0.0)), np.array(field.size, dtype=float)
    return clip_outline(outline(places), low, high)


def _px(metrics: dict[str, Any], median: str, largest: str | None = None) -> str:
    told = _number(metrics[median], "px in the median")
    return f"{told}, {_number(metrics[largest], 'px at most')}" if largest else told


def _number(value: float | None, unit: str) -> str:
    return "none" if value is None else f"{value:.2f} {unit}"


def _areas(areas: list[list[int]]) -> str:
    return ", ".join(str(area) for area in areas) or "none"
