"""imitate mimic: follow a hand that is taken for the own one."""

from inspect import signature
from typing import Any

import hydra
from omegaconf import DictConfig

from cli.build import Bench
from cli.job import job
from cli.jobs.reach import the_map
from cli.run import Outcome, Run
from cli.stages import mimicking
from imitation.analysis.mimic_metrics import Judging, MimicMetrics
from imitation.visuo_motor_map import VisuoMotorMap


@hydra.main(version_base="1.3", config_path="pkg://conf", config_name="mimic")
def main(cfg: DictConfig) -> int:
    """One job."""
    return job("mimic", cfg, follow)


def follow(run: Run) -> Outcome:
    """Let the arm follow what is seen."""
    learned = the_map(run).map
    metrics = judged(run.bench, learned)
    run.record(mimicking(run.bench, learned), learned.field, metrics.add)
    told = metrics.result(run.cfg["selection"]["name"])
    return outcome(told, metrics.ever_seen, run.cfg)


def judged(bench: Bench, learned: VisuoMotorMap) -> MimicMetrics:
    """What will measure a mimic run of this bench."""
    shown, soft = bench.demonstrator, bench.cfg["selection"]["name"] == "soft"
    place = shown.place if shown else None
    asked, settings = signature(Judging).parameters, bench.cfg["mimic"]
    judging = Judging(**{name: settings[name] for name in asked})
    return MimicMetrics(learned, place, soft, bench.robot.period, judging)


def outcome(told: dict[str, Any], ever_seen: bool, cfg: Any) -> Outcome:
    """What is told of the run."""
    return Outcome(
        metrics=told,
        rows=[
            ("selection", told["selection"]),
            ("areas followed", _followed(told)),
            ("lag", _with_unit(told["lag_s"], "s", 2)),
            ("distance after the lag", _with_unit(told["path_rmse_px"], "px (RMSE)", 1)),
            ("best the areas allow", _with_unit(told["floor_rmse_px"], "px (RMSE)", 1)),
            ("correlation", _with_unit(told["correlation"], "", 3)),
        ],
        next="imitate view {run}",
        complaint=complaint(told["follow_rate"], ever_seen, cfg),
    )


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


def _followed(told: dict[str, Any]) -> str:
    return f"{len(told['areas_followed'])} of {len(told['areas_demonstrated'])} visits"


def _with_unit(value: float | None, unit: str, digits: int) -> str:
    return "none" if value is None or value != value else f"{value:.{digits}f} {unit}".strip()
