"""Spontaneous exploration: eq. 1 over all learned attractors, with noise; what chance does."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array
from imitation.deciding import drawn_by
from imitation.dynamics import Dynamics, uniform_noise
from imitation.grasp import CLOSED, OPEN, GraspReflex
from imitation.perception import Perception
from imitation.robot import Command, Robot
from imitation.sample import Event, Sample
from imitation.visuo_motor_map import Attractors, VisuoMotorMap


@dataclass(frozen=True)
class Wandering:
    """How the arm explores."""

    duration: float  # [s]
    noise_level: float  # epsilon [-1..1]
    noise_steps: int  # noise is drawn anew after this many control steps


def explore(
    robot: Robot,
    perception: Perception,
    learned: VisuoMotorMap,
    dynamics: Dynamics,
    reflex: GraspReflex,
    lifted: Array,
    start: Array,
    wandering: Wandering,
    rng: np.random.Generator,
) -> Iterator[Sample]:
    """Wander between all learned postures, taking whatever comes between the fingers.

    Args:
        robot: The robot.
        perception: What it sees is recorded, and changes nothing.
        learned: The map.
        dynamics: Eqs. 1 and 2.
        reflex: Of the hand; it lets go at the end.
        lifted: Joint offset while its fingers are shut, (n_joints,) [rad].
        start: Where the arm begins, (n_joints,) [rad].
        wandering: How.
        rng: Draws the noise.
    """
    seen = robot.reset(start)
    begun, steps = seen.time, 0
    everywhere = learned.learned.astype(np.float64)
    events: tuple[Event, ...] = (Event("trigger", "it begins", {"state": 0, "since_s": begun}),)
    while seen.time - begun < wandering.duration + reflex.opening:
        if steps % wandering.noise_steps == 0:
            noise = uniform_noise(rng, len(start), wandering.noise_level)
        known = learned.attractors(everywhere, seen.posture)
        shift = lifted if reflex.shut else np.zeros_like(lifted)
        attractors = Attractors(known.postures + shift, known.weights, known.index)
        decision = drawn_by(
            attractors, everywhere, seen.posture, dynamics, 1.0, wandering.noise_level, noise
        )
        over = seen.time - begun >= wandering.duration
        grip = OPEN if over else reflex.feel(seen.time, seen.proximity, seen.touching, True)
        waiting = over or reflex.moving or grip == CLOSED
        command = Command(np.zeros_like(start) if waiting else decision.velocity, grip)
        sensed, applied = robot.step(command)
        yield Sample(seen, perception.perceive(seen), decision, command, applied, events)
        seen, steps, events = sensed, steps + 1, ()
