"""imitate mimic: follow a hand that is taken for the own one."""

from typing import Any

import hydra
from omegaconf import DictConfig

from cli import stages
from cli.job import job
from cli.jobs.mimic_controls import controls
from cli.jobs.mimic_mirror import mirror
from cli.jobs.reach import the_map
from cli.mimic_runs import judged
from cli.run import Outcome, Run


@hydra.main(version_base="1.3", config_path="pkg://conf", config_name="mimic")
def main(cfg: DictConfig) -> int:
    """One job."""
    return job("mimic", cfg, asked)


def asked(run: Run) -> Outcome:
    """The experiment that is asked for, or simply a hand to follow."""
    if run.cfg["mirror"]:
        return mirror(run)
    if run.cfg["controls"]:
        return controls(run)
    return follow(run)


def follow(run: Run) -> Outcome:
    """Let the arm follow what is seen."""
    learned = the_map(run).map
    metrics = judged(run.bench, learned)
    run.record(stages.mimicking(run.bench, learned), learned.field, metrics.add)
    told = metrics.result(run.cfg["selection"]["name"])
    return Outcome(
        metrics=told,
        rows=rows(told),
        next="imitate view {run}",
        complaint=complaint(told["follow_rate"], metrics.ever_seen, run.cfg),
    )


def rows(told: dict[str, Any]) -> list[tuple[str, str]]:
    """What is printed of a mimic run."""
    visits = f"{len(told['areas_followed'])} of {len(told['areas_demonstrated'])} visits"
    between = "; soft reads between them" if told["selection"] == "soft" else ""
    return [
        ("selection", told["selection"]),
        ("areas followed", visits),
        ("lag", _with_unit(told["lag_s"], "s", 2)),
        ("distance after the lag", _with_unit(told["path_rmse_px"], "px (RMSE)", 1)),
        ("area by area, at best", _with_unit(told["floor_rmse_px"], f"px (RMSE){between}", 1)),
        ("correlation", _with_unit(told["correlation"], "", 3)),
    ]


def complaint(rate: float | None, ever_seen: bool, cfg: Any) -> str | None:
    """Why the run is not what was asked for; None when it is."""
    if not ever_seen:
        if cfg["demonstrator"]["name"] == "none":
            return None  # nothing was to be seen
        return "no hand was ever seen: does vision= match the hand that is shown?"
    wanted = cfg["mimic"]["required"]
    if rate is not None and rate < wanted:
        return f"followed {rate:.0%} of the visits, asked were {wanted:.0%} (mimic.required)"
    return None


def _with_unit(value: float | None, unit: str, digits: int) -> str:
    return "none" if value is None or value != value else f"{value:.{digits}f} {unit}".strip()
