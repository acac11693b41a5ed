"""imitate replay: a hand at a learned state lets the robot do the whole action."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import hydra
from omegaconf import DictConfig

from cli.build import Bench
from cli.errors import UserError, say
from cli.job import job
from cli.jobs.reach import the_map
from cli.replaying import replaying
from cli.run import Outcome, Run
from imitation.analysis.deferred import DeferredMetrics
from imitation.recording.action_file import Action, load_action
from imitation.recording.run_files import file_in
from imitation.visuo_motor_map import VisuoMotorMap


@hydra.main(version_base="1.3", config_path="pkg://conf", config_name="replay")
def main(cfg: DictConfig) -> int:
    """One job."""
    return job("replay", cfg, replay_action)


# A real can tells nobody whether it moves with the hand.
GRASPED = {True: "yes", False: "no", None: "not known of a real can"}


def replay_action(run: Run) -> Outcome:
    """Wait for a hand at one of the action's states, and do what follows."""
    stored, action = the_map(run), the_action(run)
    metrics = deferred_metrics(run.bench, stored.map, action)
    recall, samples = replaying(run.bench, stored.map, action)
    try:
        run.record(samples, stored.map.field, metrics.add)
    except KeyboardInterrupt:
        say(f"the arm was stopped {recall.where}")
        raise
    told = outcome(metrics.result(), len(action.states))
    if recall.state is not None:
        limit = run.cfg["replay"]["limit"]
        complaint = f"the limit of {limit:g} s came first (replay.limit), stopped {recall.where}"
        told = replace(told, complaint=complaint)
    if not run.cfg["controls"]:
        return told
    from cli.deferred_controls import Shown, controls, with_controls  # needs this module

    return with_controls(told, controls(Shown(run.cfg, stored.map, action)))


def the_action(run: Run) -> Action:
    """The action that `action=` names, if it was seen in this body's visual space."""
    named = Path(str(run.cfg["action"])).expanduser()
    cells = run.cfg["sequence"]["cells"]
    action = load_action(named, cells["shortest"], cells["longest"])
    run.uses("action", file_in(named, "action.json"))
    if action.field.size != run.bench.space.size:
        raise UserError(
            f"action={named} was seen in an image of {_size(action.field.size)} px, this camera's "
            f"visual space is {_size(run.bench.space.size)} px; record it again with this camera"
        )
    return action


def deferred_metrics(bench: Bench, learned: VisuoMotorMap, action: Action) -> DeferredMetrics:
    """What will measure the replay."""
    areas = [learned.learned_area(state.place) for state in action.states]
    if not any(areas[1:]):
        raise UserError("the map has learned nothing where the action goes; learn a fuller one")
    times = [state.time for state in action.states]
    return DeferredMetrics(learned, areas, times, bench.object_goal(action.states[-1].place))


def outcome(metrics: dict[str, Any], states: int) -> Outcome:
    """What is told of the replay."""
    begun = metrics["triggered_at_s"] is not None
    return Outcome(
        metrics=metrics,
        rows=[("triggered", _triggered(metrics, states)), *(_done(metrics) if begun else [])],
        next="imitate view {run}",
        complaint=_complaint(metrics),
    )


def _done(metrics: dict[str, Any]) -> list[tuple[str, str]]:
    return [
        ("states entered", f"{metrics['states_replayed']} of {metrics['states_asked']}"),
        ("in order", "yes" if metrics["order_correct"] else "no"),
        ("timing error", _largest(metrics["timing_error_s"])),
        ("clock error", _largest(metrics["clock_error_s"])),
        ("grasped", GRASPED[metrics["grasped"]]),
        ("object to goal", _centimetres(metrics["object_error_m"])),
    ]


def _complaint(metrics: dict[str, Any]) -> str | None:
    if metrics["triggered_at_s"] is None:
        return (
            "nothing triggered the action: no hand came to rest in the area of a state that "
            "another follows; of an arm that rests in view, one there from the start may be its own"
        )
    if not metrics["order_correct"]:
        done, asked = metrics["states_replayed"], metrics["states_asked"]
        return f"the hand did not go through the action's states in order ({done} of {asked} came)"
    return None


def _triggered(metrics: dict[str, Any], states: int) -> str:
    if metrics["triggered_at_s"] is None:
        return "no: the arm rested all the time"
    state = metrics["triggered_by_state"] + 1
    return f"at {metrics['triggered_at_s']:.2f} s, by a hand at state {state} of {states}"


def _largest(errors: Sequence[float]) -> str:
    return f"{max(map(abs, errors)):.2f} s at most" if errors else "none"


def _centimetres(metres: float | None) -> str:
    return "none" if metres is None else f"{100 * metres:.1f} cm"


def _size(size: tuple[int, int]) -> str:
    return f"{size[0]}x{size[1]}"
