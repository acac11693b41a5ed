"""metrics.json: whatever becomes of a run, the same keys; null for what was not measured."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from imitation.recording.json_file import plain, write_json

DECIMALS = 6  # a micrometre, a microsecond: what is smaller is rounding

PROMISED: Mapping[str, Sequence[str]] = {  # beside what all commands tell
    "learn-map": (
        "areas_total",
        "areas_learned",
        "coverage",
        "visits",
        "place_error_px",
        "prediction_error_px",
    ),
    "reach": ("controller", "trials", "success_rate", "held_rate", "median_time_s"),
    "mimic": (
        "lag_s",
        "path_rmse_px",
        "floor_rmse_px",
        "dtw_px",
        "correlation",
        "areas_demonstrated",
        "areas_followed",
        "follow_rate",
    ),
    "demo-record": ("states", "delays_s"),
    "replay": (
        "triggered_at_s",
        "states_replayed",
        "order_correct",
        "timing_error_s",
        "clock_error_s",
        "grasped",
        "object_start_m",
        "object_end_m",
        "object_goal_m",
        "object_error_m",
    ),
    "check-map": ("visited", "seen", "off_px", "moved_px", "scatter_px", "verdict"),
}


def write_metrics(folder: Path, command: str, told: Mapping[str, Any]) -> None:
    """Write what a run told, and null for what it was to tell and did not measure."""
    missing = {key: None for key in PROMISED.get(command, ()) if key not in told}
    write_json(folder / "metrics.json", _rounded(plain({**told, **missing})))


def _rounded(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _rounded(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_rounded(one) for one in value]
    return round(value, DECIMALS) + 0.0 if isinstance(value, float) else value  # no -0.0
