"""What Fig. 2 needs before it is drawn: real steps of learning and reaching, watched."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice

from cli.build import Bench
from cli.every_seed import on_every_seed
from cli.experiments import Experiment, radius_of, trials_for
from cli.stages import learning, reaching
from imitation import dynamics
from imitation.analysis.fig2 import Box, Trace, draw_fig2
from imitation.analysis.figure_style import Drawn
from imitation.analysis.reached import between_four
from imitation.analysis.tracing import watched
from imitation.perception import Perception
from imitation.sample import Sample
from imitation.visuo_motor_map import VisuoMotorMap


@dataclass(frozen=True)
class Fig2:
    """Runs of Fig. 2; its YAML says what each means."""

    experiment: Experiment


def fig2(seeds: Sequence[int], settings: Fig2) -> Drawn:
    """Run and draw Fig. 2."""
    experiment = settings.experiment
    work = partial(traces, experiment=experiment)
    found = on_every_seed("fig2", work, seeds, experiment.workers)
    with experiment.learning_bench(seeds[0]) as bench:
        return draw_fig2(boxes_of(bench, bench.perception(bench.field)), found)


def boxes_of(bench: Bench, perception: Perception) -> list[Box]:
    """The functions that a step runs on this bench, and what each hands on."""
    robot, field, space = bench.robot, perception.field, perception.space
    return [
        Box("look", "body", (0, 0), robot.camera.look, "camera on its neck", "frame",
            lambda shot: shot.frame, ("height", "width", "3"), after=("read",)),
        Box("pixels", "sense", (1, 0), perception.detector.hand_in, "what is red", "pixels",
            lambda pixels: pixels, ("pixels", "2"), after=("look",)),
        Box("space", "sense", (2, 0), space.to_visual_space, "visual space", "places",
            lambda places: places, ("pixels", "2"), after=("pixels",)),
        Box("activity", "sense", (3, 0), field.activity, "visual input", "I",
            lambda activity: activity, ("rows", "columns"), after=("space",)),
        Box("learn", "map", (4, 0), VisuoMotorMap.learn, "learning, eqs. 3 and 4", "area",
            lambda area: area, ("2",), after=("activity", "read")),
        Box("read", "body", (0, 1), robot.arm.read, "proprioception", "x",
            lambda reading: reading.posture, ("joints",), later=("move",)),
        Box("noise", "law", (1, 1), dynamics.uniform_noise, "noise", "noise",
            lambda noise: noise, ("joints",)),
        Box("reaching", "law", (2, 1), dynamics.reaching, "distance to target", "A, \u03b5",
            lambda strengths: strengths, ("2",), after=("space",)),
        Box("within", "map", (3, 1), field.within, "visual weighting", "V",
            lambda selection: selection, ("rows", "columns")),
        Box("attractors", "map", (4, 1), VisuoMotorMap.attractors, "visuo-motor map", "postures",
            lambda found: found.postures, ("attractors", "joints"), after=("within", "read"),
            later=("learn",)),
        Box("pull", "law", (4, 2), bench.dynamics.pull, "attraction f(x), eq. 2", "shares",
            lambda pull: pull.shares, ("attractors", "joints"), after=("attractors", "read")),
        Box("velocity", "law", (2, 2), bench.dynamics.velocity, "velocity, eq. 1", "wanted",
            lambda velocity: velocity, ("joints",), after=("pull", "reaching", "noise")),
        Box("limit", "body", (1, 2), robot.guard.limit, "guard", "allowed",
            lambda limited: limited[0], ("joints",), after=("velocity",)),
        Box("move", "body", (0, 2), robot.arm.move, "arm", "sent",
            lambda sent: sent, ("joints",), after=("limit",)),
    ]  # fmt: skip


def traces(seed: int, experiment: Experiment) -> list[Trace]:
    """One step of reaching with a learned map, and one of learning it."""
    with experiment.learning_bench(seed) as bench:
        learner, samples = learning(bench)
        first = _watched(bench, bench.perception(bench.field), samples)
        for _ in samples:
            pass
    learned = learner.learned
    with experiment.reaching_bench(seed) as bench:
        four = between_four(learned, radius_of(bench, learned), 0.0)
        target = learned.memories()[1].mean(axis=0) if four is None else four.target
        samples = reaching(bench, learned, trials_for(seed, learned, target, 1))
        return [_watched(bench, bench.perception(learned.field), samples), first]


def _watched(bench: Bench, perception: Perception, samples: Iterator[Sample]) -> Trace:
    """The first step of `samples`."""
    boxes = boxes_of(bench, perception)
    found: list[Sample] = []
    calls = watched(
        lambda: found.extend(islice(samples, 1)), {box.name: box.function for box in boxes}
    )
    sample, space = found[0], perception.space
    rows, columns = perception.field.shape
    sizes = {
        "height": space.size[1],
        "width": space.size[0],
        "rows": rows,
        "columns": columns,
        "joints": len(bench.robot.body.joint_names),
        "attractors": len(sample.decision.postures),
        "pixels": len(perception.detector.hand_in(sample.seen)),
    }
    return Trace(calls, sizes)
