"""Whether what a camera shows is fit to be decided on: neither late, nor frozen, nor dark."""

from dataclasses import dataclass

from imitation.arrays import Image
from imitation.robot import SECOND


@dataclass(frozen=True)
class VisionWatch:
    """Tells what is wrong with the newest frame.

    Args:
        stale: It may be this old [s].
        frozen: Frames may have been equal for this long [s]; None: for ever.
        dark: Its mean brightness may be this low [0..255].
        lost: A camera that has delivered nothing for this long has failed [s].
    """

    stale: float
    frozen: float | None
    dark: float
    lost: float

    def trouble(self, frame: Image, age_ns: int, equal_ns: int) -> str | None:
        """Why nothing should move on this `frame`; None: it may.

        Args:
            frame: The newest one.
            age_ns: How old it is [ns].
            equal_ns: For how long all frames have been equal to it [ns].
        """
        if age_ns > self.stale * SECOND:
            return "stale vision"
        if self.frozen is not None and equal_ns > self.frozen * SECOND:
            return "frozen vision"
        return "dark vision" if frame.mean() < self.dark else None

    def is_lost(self, age_ns: int) -> bool:
        """Whether the camera has failed when its newest frame is so old [ns]."""
        return age_ns > self.lost * SECOND
