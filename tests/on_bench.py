"""Robots and runs as the commands build them, without a run folder."""

from dataclasses import dataclass

from cli.build import Bench
from cli.experiments import composed
from cli.jobs.learn_map import learned_by
from cli.stages import learning
from imitation.arrays import Array
from imitation.recording.map_file import LearnedMap
from imitation.sample import Event
from imitation.stages.learn_map import Learner


def bench(command: str, *words: str, seed: int = 0) -> Bench:
    """The parts of `imitate COMMAND WORDS`."""
    given = ["map=given"] if command in ("reach", "mimic") else []
    return Bench({**composed(command, *given, *words), "seed": seed})


@dataclass(frozen=True)
class Lesson:
    """A finished run of learn-map."""

    bench: Bench
    learner: Learner
    stored: LearnedMap
    times: list[float]  # of the steps [s]
    postures: list[Array]  # at each step, (n_joints,) [rad]
    events: list[Event]

    def truly_shown(self, posture: Array) -> Array:
        """Where a posture really shows the hand, (2,) [px]."""
        robot = self.bench.robot
        robot.truth()
        robot.reset(posture)
        (truth,) = robot.truth()
        return truth.hand_px

    @property
    def off(self) -> list[float]:
        """How far each stored place lies from where its posture really shows the hand [px]."""
        postures, places = self.learner.learned.memories()
        shown = [self.truly_shown(posture) for posture in postures]
        return [float(abs(complex(*(a - b)))) for a, b in zip(places, shown, strict=True)]


def lesson(*words: str, seed: int = 0) -> Lesson:
    """What `imitate learn-map WORDS` learns."""
    parts = bench("learn-map", *words, seed=seed)
    learner, samples = learning(parts)
    times, postures, events = [], [], []
    for sample in samples:
        times.append(sample.seen.time)
        postures.append(sample.seen.posture)
        events += sample.events
    return Lesson(parts, learner, learned_by(parts, learner), times, postures, events)
