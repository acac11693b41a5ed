"""imitate mimic experiment=mimicry_controls: what is needed for the imitation, and what is not."""

from functools import partial
from typing import Any

import numpy as np

from cli import stages
from cli.build import Config
from cli.every_seed import on_every_seed
from cli.experiments import composed
from cli.jobs.reach import the_map
from cli.mimic_runs import judged, measured, shuffled_correlations
from cli.report import verdict
from cli.run import Outcome, Run
from imitation.arrays import Array
from imitation.perception import Percept
from imitation.robot import Truth
from imitation.sample import Sample
from imitation.visuo_motor_map import VisuoMotorMap


def controls(run: Run) -> Outcome:
    """Record a run that imitates; measure those that should not."""
    if run.bench.demonstrator is None:
        raise ValueError("experiment=mimicry_controls needs a simulated demonstrator to leave out")
    learned, percepts = the_map(run).map, list[Percept]()
    metrics = judged(run.bench, learned)

    def watch(sample: Sample, truths: list[Truth]) -> None:
        percepts.append(sample.percept)
        metrics.add(sample, truths)

    run.record(stages.mimicking(run.bench, learned), learned.field, watch)
    told = metrics.result(run.cfg["selection"]["name"])
    null = shuffled_maps(run.cfg, learned, percepts)
    travelled = {
        name: measured(cfg, learned)[0].travelled() for name, cfg in without(run.cfg).items()
    }
    return outcome(told, null, travelled, metrics.travelled(), run.cfg["controls"])


def without(cfg: Config) -> dict[str, Config]:
    """The conditions in which there is nobody to imitate."""
    nobody = composed("mimic", "map=given", "demonstrator=none")["demonstrator"]
    other = {**cfg["demonstrator"], "hand": cfg["controls"]["look"]}
    return {
        "no hand shown": {**cfg, "demonstrator": nobody},
        "self and other told apart": {**cfg, "demonstrator": other},
    }


def shuffled_maps(cfg: Config, learned: VisuoMotorMap, percepts: list[Percept]) -> Array:
    """Correlations with shuffled maps, (permutations,)."""
    asked = cfg["controls"]
    batches = np.array_split(
        np.arange(asked["permutations"]), -(-asked["permutations"] // asked["batch"])
    )
    work = partial(shuffled_correlations, cfg=cfg, learned=learned, percepts=percepts)
    found = on_every_seed(
        "shuffled maps", work, [batch.tolist() for batch in batches], asked["workers"], "batches"
    )
    return np.array([one for batch in found for one in batch])


def outcome(
    told: dict[str, Any], null: Array, travelled: dict[str, float], own: float, asked: Config
) -> Outcome:
    """What is told of all conditions.

    Args:
        told: Metrics of the run that imitates.
        null: Correlations with shuffled maps, (n,).
        travelled: How far the hand went from where it was when nobody was to be imitated [px].
        own: The same in the run that imitates [px].
        asked: Of the configuration.
    """
    bound, far = float(np.quantile(null, asked["quantile"])), asked["still"]
    imitated = told["correlation"] > bound  # nan is not
    wrong = [
        f"{name}: the arm went {gone:.1f} px all the same"
        for name, gone in travelled.items()
        if gone > far
    ]
    correlated = f"correlation {told['correlation']:.3f}"
    if not imitated:
        wrong.append(f"{correlated} is not above {bound:.3f}")
    rows = [("hand shown", f"{correlated}, the arm goes {own:.1f} px")]
    rows += [
        (name, f"the arm goes {gone:.1f} px; asked {far:g} px at most: {verdict(gone <= far)}")
        for name, gone in travelled.items()
    ]
    spread = f"median {np.median(null):.3f}, {asked['quantile']:.0%} below {bound:.3f}"
    rows.append((f"{len(null)} shuffled maps", f"correlation {spread}"))
    rows.append(("more than by chance", f"{correlated} above {bound:.3f}: {verdict(imitated)}"))
    found = {
        "travelled_px": {"hand shown": own, **travelled},
        "shuffled_correlation": null,
        "shuffled_quantile": bound,
        "rank": float((null < told["correlation"]).mean()),
    }
    return Outcome(
        metrics={**told, "controls": found},
        rows=rows,
        next="imitate view {run}",
        complaint="; ".join(wrong) or None,
    )
