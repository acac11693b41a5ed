"""imitate inspect: what a recording holds, on one screen."""

import json
import os
import shlex
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.table import Table

from cli.errors import DONE
from cli.following import reach_with, replay_of
from cli.printed import as_it_stands, facts, on_stdout
from cli.settings import settings
from imitation.analysis.seal import broken, cited
from imitation.recording.mcap_recording import Recording
from imitation.recording.survey import Survey, survey
from imitation.robot import SECOND

MOST = 6  # settings or results that are named one by one
CADENCE = ("late_ticks", "achieved_rate_hz", "frames_used")
BESIDE = ("command", "status", "seed", "robot_time_s", "wall_time_s", "steps", *CADENCE)


def inspect(run: Path, as_json: bool) -> int:
    """Tell what a recording holds; the exit code."""
    found = survey(run)
    told = {"path": str(run), "kind": found.kind, "whole": found.whole, "lasted_s": found.lasting}
    try:
        told |= of_ours(Recording.open(run))
    except ValueError:  # of another program: its topics are all that can be told
        bags = sorted(run.glob("*.mcap")) if run.is_dir() else [run]
        told["next"] = [f"rerun {shlex.quote(str(one))}" for one in bags if one.suffix == ".mcap"]
    told["topics"] = [
        {
            "topic": name,
            "type": topic.type,
            "messages": topic.messages,
            "rate_hz": topic.rate,
            "largest_gap_s": topic.gap_ns / SECOND,
            "bytes": topic.bytes,
        }
        for name, topic in sorted(found.topics.items())
    ]
    if as_json:
        print(json.dumps(told, indent=2, ensure_ascii=False))
    else:
        show(told, found)
    return DONE


def of_ours(recording: Recording) -> dict[str, Any]:
    """What a recording of this bench tells beside its topics."""
    run, folder = recording.metadata["run"], recording.path.parent
    metrics, digest = results(folder), recording.digest()
    return {
        "kind": "run",
        **run,
        "packages": json.loads(run.get("packages", "{}")),
        "recovered": recording.metadata.get("recovered"),
        "settings": settings(recording),
        "attachments": {name: len(data) for name, data in recording.attachments.items()},
        "digest": digest,
        "digest_matches": not broken(recording),
        "metrics": metrics,
        "next": list(following(recording, metrics)),
    }


def results(folder: Path) -> dict[str, Any]:
    """What metrics.json says; nothing when there is none that can be read."""
    try:
        told = json.loads((folder / "metrics.json").read_text())
    except (OSError, RecursionError, ValueError):
        return {}
    return told if isinstance(told, dict) else {}


def following(recording: Recording, metrics: Mapping[str, Any]) -> Iterator[str]:
    """The commands to type next."""
    path = recording.path
    run = shlex.quote(os.path.relpath(path.parent if path.name == "run.mcap" else path))
    if not recording.whole:
        yield f"imitate recover {run}"
        return
    yield f"imitate verify {run}"
    yield f"imitate view {run}"
    told = recording.metadata["run"]
    robot, done = told.get("robot", ""), metrics.get("status") == "done"
    if told.get("command") == "learn-map" and done:
        yield reach_with(run, [f"robot={robot}"])
    if told.get("command") == "demo-record" and done:
        yield replay_of(run, robot, [f"robot={robot}"], ())


def show(told: Mapping[str, Any], found: Survey) -> None:
    """Print it."""
    console = on_stdout()
    console.print(facts(f"imitate inspect {told['path']}", rows(told)))
    table = Table(box=SIMPLE_HEAD, padding=(0, 1, 0, 0))
    table.add_column("topic", no_wrap=True)
    table.add_column("type", no_wrap=True)
    for heading in ("messages", "Hz", "gap [s]", "size"):
        table.add_column(heading, justify="right", no_wrap=True)
    for name, topic in sorted(found.topics.items()):
        rate = "" if topic.rate is None else f"{topic.rate:.4g}"
        kind = topic.type.rpartition("/")[2]
        gap = f"{topic.gap_ns / SECOND:.3g}"
        cells = (name, kind, str(topic.messages), rate, gap, size(topic.bytes))
        table.add_row(*as_it_stands(cells))
    console.print(table)
    for number, command in enumerate(told["next"]):
        console.print(f"{'' if number else 'next':6} {command}", markup=False)


def rows(told: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Name and value of everything but the topics."""
    whole = "whole" if told["whole"] else "truncated: it was killed; what is there can be read"
    if told["kind"] != "run":
        yield "kind", told["kind"]
        yield "lasted", f"{told['lasted_s']:.2f} s"
        yield "state", whole
        return
    metrics = told["metrics"]
    changed = " and changes" if told.get("git_dirty") == "true" else ""
    yield "ran", f"imitate {told['command']}, robot {told.get('robot')}, seed {told.get('seed')}"
    if "what_if" in told:
        yield "what if", told["what_if"]
    yield "by", f"version {told.get('version')} at {told.get('git_revision', '')[:12]}{changed}"
    yield "settings", _some(told["settings"]) or "the defaults"
    yield "lasted", " · ".join(lasted(told, metrics))
    yield "state", f"{whole}, {metrics['status']}" if metrics else whole
    values = [f"{key} {short(value)}" for key, value in metrics.items() if _is_result(key, value)]
    if values:
        yield "results", _some(values)
    seal = "matches the content" if told["digest_matches"] else "does NOT match: see imitate verify"
    yield "digest", f"{cited(told['digest']) or 'none'}  {seal}"
    yield "attached", ", ".join(f"{name} {size(n)}" for name, n in told["attachments"].items())


def lasted(told: Mapping[str, Any], metrics: Mapping[str, Any]) -> Iterator[str]:
    """How long it took, in robot time and at the wall."""
    yield f"{told['lasted_s']:.2f} s of robot time"
    if metrics:
        yield f"{metrics.get('steps')} steps"
    if wall := metrics.get("wall_time_s"):
        yield f"{wall} s at the wall"
    if rate := metrics.get("achieved_rate_hz"):
        yield f"{rate:.2f} steps a second, {metrics.get('late_ticks', 0)} late"


def short(value: Any) -> str:
    """A number with as many digits as people read."""
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def size(count: float) -> str:
    """A number of bytes for people."""
    for unit in ("B", "kB"):
        if count < 1000:
            return f"{count:.0f} {unit}"
        count /= 1000
    return f"{count:.1f} MB"


def _is_result(key: str, value: Any) -> bool:
    return key not in BESIDE and isinstance(value, int | float | str) and value != 0


def _some(words: list[str]) -> str:
    more = f" and {len(words) - MOST} more (--json)" if len(words) > MOST else ""
    return " · ".join(words[:MOST]) + more
