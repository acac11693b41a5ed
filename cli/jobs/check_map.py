"""imitate check-map: has the camera or the arm moved since a map was learned?"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import hydra
import numpy as np
from omegaconf import DictConfig

from cli.build import Config
from cli.job import job
from cli.jobs.reach import the_map
from cli.make import made_of
from cli.run import Outcome, Run
from cli.stages import checking
from imitation.arrays import Array
from imitation.stages.check_map import Visit


@hydra.main(version_base="1.3", config_path="pkg://conf", config_name="check_map")
def main(cfg: DictConfig) -> int:
    """One job."""
    return job("check-map", cfg, check)


def check(run: Run) -> Outcome:
    """Visit learned postures and judge what is seen there."""
    learned = the_map(run).map
    visits, samples = checking(run.bench, learned)
    run.record(samples, learned.field)
    if run.cfg["dry_run"]:
        return unmoved()
    return outcome(visits, run.cfg["check"])


def unmoved() -> Outcome:
    """What a dry run tells: its postures were imagined, but what was seen was not."""
    verdict = "nothing can be told"
    return Outcome(
        metrics={"visited": 0, "seen": 0, "off_px": [], "verdict": verdict},
        rows=[("postures visited", "none, a dry run moves nothing"), ("verdict", verdict)],
        next="imitate view {run}",
        complaint="a dry run: the arm was not moved, so nothing can be told of the map",
    )


def outcome(visits: Sequence[Visit], cfg: Config) -> Outcome:
    """What is told of the visits: how far all are off together, and how far each from that."""
    offs = np.array([visit.off for visit in visits if visit.off is not None]).reshape(-1, 2)
    common = np.median(offs, axis=0) if len(offs) else np.full(2, np.nan)
    rest = float(np.median(np.linalg.norm(offs - common, axis=1))) if len(offs) else np.nan
    scattered = Scatter(rest, len(offs))
    verdict, complaint = judged(common, scattered, len(visits) - len(offs), made_of(Allowed, cfg))
    return Outcome(
        metrics={
            "visited": len(visits),
            "seen": len(offs),
            "off_px": offs.tolist(),
            "moved_px": common,
            "scatter_px": rest,
            "verdict": verdict,
        },
        rows=[
            ("postures seen", f"{len(offs)} of {len(visits)}"),
            ("all are off by", f"[{common[0]:.1f}, {common[1]:.1f}] px" if len(offs) else "none"),
            ("each from that", f"{rest:.1f} px in the median" if len(offs) else "none"),
            ("verdict", verdict),
        ],
        next="imitate view {run}",
        complaint=complaint,
    )


@dataclass(frozen=True)
class Scatter:
    """How far apart from each other the postures' errors are."""

    median: float  # [px]
    postures: int

    @property
    def error(self) -> float:
        """Standard error of what they have in common [px]; of one posture alone nobody knows it."""
        return self.median / math.sqrt(self.postures) if self.postures > 1 else math.inf


@dataclass(frozen=True)
class Allowed:
    """How far off is still as it was."""

    tolerance: float  # of a posture [px]
    common: float  # of all together [px]
    sure: float  # of the same, in standard errors


def judged(moved: Array, scatter: Scatter, unseen: int, allowed: Allowed) -> tuple[str, str | None]:
    """In words what has moved, and what to do about it; None: nothing."""
    far = float(np.hypot(*moved))
    if unseen or not np.isfinite(far):
        return "hand unseen", (
            "the hand is not seen in every learned posture: look at camera and vision=, or relearn"
        )
    if scatter.median > allowed.tolerance:
        return "the arm has moved", (
            f"learned postures show the hand {scatter.median:.1f} px apart from each other's error:"
            " the arm, or its calibration, is not what it was; relearn"
        )
    if far > min(max(allowed.common, allowed.sure * scatter.error), allowed.tolerance):
        return "the camera has moved", (
            f"everything is seen {far:.1f} px away, [{moved[0]:.1f}, {moved[1]:.1f}]: the camera "
            "has moved, or the arm's base; put it back, or relearn"
        )
    return "nothing has moved", None
