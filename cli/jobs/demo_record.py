"""imitate demo-record: watch an action once, save it as a timed sequence of visual states."""

from collections.abc import Sequence
from itertools import pairwise

import hydra
from omegaconf import DictConfig

from cli.build import Bench
from cli.following import camera_words, replay_of
from cli.job import job
from cli.provenance import program_version
from cli.run import Outcome, Run
from cli.stages import watching
from imitation.recording.action_file import Action, save_action
from imitation.sequence import recalled
from imitation.visual_states import VisualState


@hydra.main(version_base="1.3", config_path="pkg://conf", config_name="demo_record")
def main(cfg: DictConfig) -> int:
    """One job."""
    return job("demo-record", cfg, watch)


def watch(run: Run) -> Outcome:
    """Watch, save the action, and see that it can be played."""
    found, samples = watching(run.bench)
    run.record(samples, run.bench.field)
    states = found.states
    if len(states) >= 2:
        made_by = f"imitate demo-record, version {program_version()}"
        action = Action.watched(run.bench.field, states, run.cfg["demo"]["margin"])
        save_action(run.folder / "action.json", action, made_by)
    delays = [round(later.time - state.time, 6) for state, later in pairwise(states)]
    played, complaint = play(run.bench, states)
    errors = [round(again - delay, 6) for again, delay in zip(played, delays, strict=False)]
    camera = camera_words(run.typed) if shows_the_arm(run.bench) else []
    replay = replay_of("{run}", run.cfg["robot"]["name"], run.typed, camera)
    return Outcome(
        metrics={"states": len(states), "delays_s": delays, "clock_error_s": errors},
        rows=rows(states, delays),
        next="imitate view {run}" if complaint else replay,
        complaint=complaint,
    )


def shows_the_arm(bench: Bench) -> bool:
    """Whether the camera that watched an action can show the arm itself: a film cannot."""
    return "path" not in bench.cfg["camera"] and bench.robot.arm.live == bench.robot.camera.live


def play(bench: Bench, states: Sequence[VisualState]) -> tuple[list[float], str | None]:
    """The delays as the internal loop plays them, or why it cannot."""
    if not states:
        return [], (
            "no hand was seen to rest: has it the colour of vision=, and does it rest for longer "
            "than states.dwell?"
        )
    if len(states) < 2:
        return [], (
            f"the hand rested in area {list(states[0].area)} alone, an action needs 2 states or "
            "more; let it rest in each for longer than states.dwell"
        )
    sequence = bench.empty_sequence()
    try:
        for state in states:
            sequence.learn(state.area, state.time)
        return recalled(sequence, bench.robot.period), None
    except ValueError as error:
        return [], str(error)


def rows(states: Sequence[VisualState], delays: Sequence[float]) -> list[tuple[str, str]]:
    """What is printed of the states."""
    told = [("visual states", str(len(states)))]
    since = ["", *(f", {delay:.2f} s after" for delay in delays)]
    for number, (state, after) in enumerate(zip(states, since, strict=False), start=1):
        x, y = state.place
        told.append(
            (f"state {number}", f"area {list(state.area)}, at ({x:.1f}, {y:.1f}) px{after}")
        )
    return told
