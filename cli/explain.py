"""imitate explain: why the arm moved as it did at one time of a run, in words and numbers."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from rich.box import SIMPLE_HEAD
from rich.table import Table

from cli.errors import DONE, UserError
from cli.printed import on_stdout
from cli.recompute import anew
from imitation.analysis.explanation import (
    NOTICED,
    Moment,
    Reason,
    active_areas,
    moment,
    reason,
)
from imitation.arrays import Array
from imitation.dynamics import Dynamics
from imitation.recording.mcap_recording import Recording
from imitation.recording.recorded_steps import steps_told
from imitation.robot import SECOND

MOST = 8  # areas or attractors that are named one by one


def explain(run: Path, at: float) -> int:
    """Say why the arm moved as it did `at` seconds after the run's start; the exit code."""
    if not np.isfinite(at) or at < 0:
        raise UserError(f"--at {at}: give a time in seconds from the start of the run, 0 or later")
    recording = Recording.open(run)
    if "/camera/used" not in recording.topics:
        raise UserError(f"{run} holds no step: it ended before its first one, log.txt says why")
    with anew(recording) as decided:
        dynamics = decided.bench.dynamics
    when = moment(steps_told(recording), round(at * SECOND))
    why = reason(when.told, recording.topics)
    console = on_stdout()
    for sentence in sentences(when, why, dynamics):
        console.print(sentence, markup=False)
    if len(why.index):
        console.print(attractors(why))
    console.print(joints(why, dynamics, recording.topics["/joint_states"].names))
    return DONE


def sentences(when: Moment, why: Reason, dynamics: Dynamics) -> Iterator[str]:
    """The step in words."""
    since = f", {(why.seen.time_ns - when.episode_ns) / SECOND:.2f} s after: {when.episode}"
    yield f"At {why.seen.time:.2f} s, step {when.number + 1}{since if when.episode else ''}"
    yield _seen(why)
    yield _selected(why)
    if not len(why.index):
        yield "No attractor takes part, so nothing pulls the arm: it is to keep still."
    else:
        pull, noise = _fastest(why.pulled(dynamics)), _fastest(why.shaken(dynamics))
        count = f"{len(why.index)} attractor{'s take' if len(why.index) != 1 else ' takes'} part"
        pulled = f"the pull is up to {pull:.3g} rad/s with gain A = {why.gain:.3g}"
        if not why.gain:
            pulled = "but gain A = 0 and nothing pulls (shares: of what would pull)"
        yield (
            f"{count}, {pulled}; "
            f"noise of level ε = {why.noise_level:.3g} adds up to {noise:.3g} rad/s."
        )
    yield from _slowed(why, dynamics)
    yield _limited(why, when.reasons)
    for event in why.events:
        yield f"Event: {event}."


def _seen(why: Reason) -> str:
    if why.hand is None:
        return "The hand is not seen."
    late = (why.seen.time_ns - why.hand_ns) / SECOND
    old = f", in a frame {late:.2f} s old" if late > 0 else ""
    seen = f"The hand is seen at ({why.hand[0]:.1f}, {why.hand[1]:.1f}) px{old}"
    areas = ", ".join(f"{share:.0%} in area {name}" for name, share in _most(why.visual_input))
    seen += f": {areas}" if areas else ""
    if why.target is None:
        return f"{seen}."
    off = f", {why.distance:.1f} px away" if np.isfinite(why.distance) else ""
    return f"{seen}. The target is at ({why.target[0]:.1f}, {why.target[1]:.1f}) px{off}."


def _selected(why: Reason) -> str:
    selected = active_areas(why.selection)
    if not selected:
        return "No area is selected."
    named = ", ".join(name if value == 1 else f"{name} {value:.2g}" for name, value in selected)
    return f"{len(selected)} area{'s' * (len(selected) != 1)} selected: {named}."


def _slowed(why: Reason, dynamics: Dynamics) -> Iterator[str]:
    """What the stage itself changed of the velocity of eq. 1."""
    wanted = why.pulled(dynamics) + why.shaken(dynamics)
    before, after = _fastest(wanted), _fastest(why.requested)
    if len(why.index) and _fastest(wanted - why.requested) > NOTICED:
        word = "stops the arm" if after == 0 else "slows it, so that the arm can come to rest"
        yield f"The stage {word}: {after:.3g} rad/s are requested instead of {before:.3g}."


def _limited(why: Reason, reasons: tuple[str, ...]) -> str:
    taken = _fastest(why.requested - why.limited)
    sent = _fastest(why.sent)
    if not reasons:
        return f"The guard takes nothing away; the fastest joint is sent {sent:.3g} rad/s."
    return (
        f"The guard changes it by up to {taken:.3g} rad/s ({', '.join(reasons)}); "
        f"the fastest joint is sent {sent:.3g} rad/s."
    )


def attractors(why: Reason) -> Table:
    """Each attractor's part, the strongest first."""
    table = Table(box=SIMPLE_HEAD, padding=(0, 1, 0, 0))
    table.add_column("attractor")
    for heading in ("activation", "share of the pull"):
        table.add_column(heading, justify="right")
    shares = why.shares
    order = np.argsort(-why.activation, kind="stable")
    for one in order[:MOST]:
        row, column, neuron = why.index[one]
        name = "a posture of its own" if row < 0 else f"area [{row}, {column}], neuron {neuron}"
        table.add_row(name, f"{why.activation[one]:.1%}", f"{shares[one]:.1%}")
    if len(order) > MOST:
        rest = order[MOST:]
        others = f"{len(rest)} more"
        table.add_row(others, f"{why.activation[rest].sum():.1%}", f"{shares[rest].sum():.1%}")
    return table


def joints(why: Reason, dynamics: Dynamics, names: tuple[str, ...]) -> Table:
    """What became of each joint's velocity, one column a step of the way."""
    table = Table(box=SIMPLE_HEAD, padding=(0, 1, 0, 0))
    table.add_column("joint")
    for heading in ("posture", "pull", "noise", "requested", "guard", "sent"):
        table.add_column(heading, justify="right")
    table.add_row("", "[dim]rad", *["[dim]rad/s"] * 5)
    guard = why.limited - why.requested
    columns = (why.pulled(dynamics), why.shaken(dynamics), why.requested, guard, why.sent)
    for number, name in enumerate(names):
        numbers = (why.seen.posture[number], *(column[number] for column in columns))
        # Adding 0 makes -0 to 0.
        table.add_row(name, *(f"{round(number, 3) + 0.0:+.3f}" for number in numbers))
    return table


def _most(values: Array) -> list[tuple[str, float]]:
    return active_areas(values)[:MOST]


def _fastest(velocity: Array) -> float:
    return float(np.abs(velocity).max(initial=0.0))
