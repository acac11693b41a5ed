"""Local linear regression between seen places and postures."""

import numpy as np

from imitation.arrays import Array


def locally_linear(
    inputs: Array, outputs: Array, at: Array, bandwidth: float, ridge: float
) -> tuple[Array, Array]:
    """Fits outputs = value + slope (inputs - at), nearer samples weighing more.

    Args:
        inputs: (n, d).
        outputs: (n, m).
        at: Where the fit is centred, (d,).
        bandwidth: Distance at which a sample's Gaussian weight has fallen to 0.6 [inputs].
        ridge: Keeps the slope small where samples do not tell it [inputs squared].

    Returns:
        value (m,) and slope (d, m).
    """
    apart = inputs - at
    squared = np.sum(apart**2, axis=1)
    # Shifting keeps the weights of far samples from all underflowing to 0.
    weights = np.exp((squared.min() - squared) / (2 * bandwidth**2))
    weights /= weights.sum()
    design = np.column_stack((np.ones(len(apart)), apart))
    penalty = ridge * np.eye(design.shape[1])
    penalty[0, 0] = 0.0
    moments = design.T @ (weights[:, None] * design)
    solution = np.linalg.solve(moments + penalty, design.T @ (weights[:, None] * outputs))
    return solution[0], solution[1:]
