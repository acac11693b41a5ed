"""A jaw on one servo of a bus, which feels by how hard it presses."""

from dataclasses import dataclass

import numpy as np

SHUT = 0.05  # opening up to which nothing is between the fingers, or it would be felt


@dataclass(frozen=True)
class Jaw:
    """A jaw; it has no sensors of its own.

    Args:
        id: Of its servo.
        opened: Angle when it is open [rad].
        closed: Angle when it is closed [rad].
        speed: Largest [rad/s].
        torque: Largest [share of what the servo can]: it presses no harder.
        pressing: From this load on it touches something [share of what the servo can].
        expected: What it does not see may be so far from it [m].
    """

    id: int
    opened: float
    closed: float
    speed: float
    torque: float
    pressing: float
    expected: float

    def opening(self, angle: float) -> float:
        """Opening 0..1 at `angle` [rad]."""
        return float(np.clip((angle - self.closed) / (self.opened - self.closed), 0.0, 1.0))

    def angle(self, opening: float) -> float:
        """Angle [rad] at `opening` 0..1."""
        return self.closed + float(np.clip(opening, 0.0, 1.0)) * (self.opened - self.closed)

    def proximity(self, opening: float, touching: bool) -> float:
        """Distance to what is between its fingers, as far as it can know [m]; inf: nothing is."""
        if touching:
            return 0.0
        return self.expected if opening > SHUT else float("inf")
