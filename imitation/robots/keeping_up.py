"""Whether a real arm goes where it is sent: something may hold it, or it may be hot."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array
from imitation.device import DeviceError


@dataclass
class KeepingUp:
    """Refuses an arm that stays behind.

    Args:
        names: What moves, (n,).
        following: How far each may be from where it was sent [rad].
        overdue: For how long it may be [s].
    """

    names: Sequence[str]
    following: float
    overdue: float
    _kept_up_at: float | None = None  # [s]

    def check(self, away: Array, now: float) -> None:
        """Take in how far `away` (n,) [rad] each is at the time `now` [s].

        Raises:
            DeviceError: One has been too far away for too long.
        """
        if self._kept_up_at is None or (away <= self.following).all():
            self._kept_up_at = now
        elif now - self._kept_up_at > self.overdue:
            furthest = int(np.argmax(away))
            raise DeviceError(
                f"{self.names[furthest]} is {away[furthest]:.2f} rad from where it was sent: it "
                "does not move; see whether something holds it, and whether it is hot"
            )
