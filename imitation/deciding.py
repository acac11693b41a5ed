"""The step all stages share: attractors that take part, their pull, a velocity."""

import numpy as np

from imitation.arrays import Array
from imitation.dynamics import Dynamics, able_to_stop, ramped
from imitation.sample import Decision, attractors_not_in_map
from imitation.visuo_motor_map import Attractors


def drawn_by(
    attractors: Attractors,
    selection: Array,
    posture: Array,
    dynamics: Dynamics,
    gain: float,
    noise_level: float = 0.0,
    noise: Array | None = None,
    target: Array | None = None,
    distance: float = float("nan"),
) -> Decision:
    """What eqs. 1 and 2 make of the attractors: still and silent when none takes part.

    Args:
        attractors: Those that take part.
        selection: V, (rows, columns).
        posture: The present posture, (n_joints,) [rad].
        dynamics: Eqs. 1 and 2.
        gain: A.
        noise_level: epsilon.
        noise: The noise drawn, (n_joints,) [-1..1]; None for none.
        target: (2,) [px]; None without one.
        distance: From the seen hand to the target [px].
    """
    pull = dynamics.pull(posture, attractors.postures, attractors.weights)
    drawn = np.zeros(len(posture)) if noise is None or not len(pull.activation) else noise
    return Decision(
        selection=selection,
        index=attractors.index,
        postures=attractors.postures,
        activation=pull.activation,
        shares=pull.shares,
        gain=gain,
        noise_level=noise_level,
        noise=drawn,
        velocity=dynamics.velocity(pull, gain, drawn),
        target=target,
        distance=distance,
    )


def one_attractor(posture: Array) -> Attractors:
    """A single attractor at `posture` (n_joints,) [rad] that no cluster holds."""
    return Attractors(posture[None], np.ones(1), attractors_not_in_map(1))


def no_attractor(joints: int) -> Attractors:
    """None, for an arm of so many joints."""
    return Attractors(np.zeros((0, joints)), np.zeros(0), attractors_not_in_map(0))


def coming_to_rest(
    decision: Decision, posture: Array, acceleration: Array, period: float
) -> Decision:
    """`decision` slowed so that the arm can stop at its only attractor.

    Args:
        decision: Drawn by one attractor, or by none.
        posture: The present posture, (n_joints,) [rad].
        acceleration: What each joint may brake with, (n_joints,) [rad/s^2].
        period: Control period [s].
    """
    if not len(decision.postures):
        return decision
    to_go = decision.postures[0] - posture
    return braking(decision, able_to_stop(decision.velocity, to_go, acceleration, period))


def at_own_pace(
    decision: Decision,
    posture: Array,
    before: Array,
    acceleration: Array,
    period: float,
    turning: int,
) -> Decision:
    """The same, with joints that turn the whole arm about the vertical not waiting for the rest.

    The others keep together on their line, which keeps the hand at its height over the table.

    Args:
        decision: Drawn by one attractor, or by none.
        posture: The present posture, (n_joints,) [rad].
        before: Velocity of the last period, (n_joints,) [rad/s].
        acceleration: What each joint may be sped up and braked with, (n_joints,) [rad/s^2].
        period: Control period [s].
        turning: How many of the first joints turn the whole arm.
    """
    if not len(decision.postures):
        return decision
    velocity, to_go = decision.velocity.copy(), decision.postures[0] - posture
    for some in (slice(0, turning), slice(turning, None)):
        step = acceleration[some] * period
        slowed = able_to_stop(velocity[some], to_go[some], acceleration[some], period)
        velocity[some] = ramped(slowed, before[some], step)
    return braking(decision, velocity)


def braking(decision: Decision, velocity: Array) -> Decision:
    """`decision` with its velocity replaced, all else as drawn."""
    return Decision(**{**decision.__dict__, "velocity": velocity})
