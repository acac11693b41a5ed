"""The grasp reflex: the gripper closes on what comes between its fingers (section IV, note 3)."""

from dataclasses import dataclass
from enum import Enum

OPEN, CLOSED = 1.0, 0.0  # wanted opening


class Hand(Enum):
    """What the gripper is doing."""

    EMPTY = "empty"  # open, nothing held
    CLOSING = "closing"
    HOLDING = "holding"
    MISSED = "closed on nothing"
    OPENING = "opening"


@dataclass
class GraspReflex:
    """Closes by itself, opens when told to.

    Args:
        close_within: Closes on what is nearer to the palm than this [m].
        firm: A grasp is firm when both fingers have touched for this long [s].
        closing: Closing ends after this long, whatever was felt [s].
        opening: Opening takes this long [s].
    """

    close_within: float
    firm: float
    closing: float
    opening: float
    hand: Hand = Hand.EMPTY
    _let_go: bool = False  # what was let go is still within reach, and not grasped again

    @property
    def moving(self) -> bool:
        """Whether the fingers open or close, so that the arm had better wait."""
        return self.hand in (Hand.CLOSING, Hand.OPENING)

    @property
    def shut(self) -> bool:
        """Whether the fingers have closed, on something or on nothing."""
        return self.hand in (Hand.HOLDING, Hand.MISSED)

    def feel(self, time: float, proximity: float, touching: bool, arrived: bool) -> float | None:
        """The opening that is wanted; None: as it is.

        Args:
            time: Now [s].
            proximity: Distance of the palm to what is between the fingers [m]; inf: nothing.
            touching: Both fingers touch something.
            arrived: The arm is where it was going, so that nothing will come nearer.
        """
        if proximity == float("inf"):
            self._let_go = False
        if self.hand is Hand.EMPTY and self._within_grasp(proximity, arrived):
            self.hand, self._since, self._touched = Hand.CLOSING, time, time
            return CLOSED
        if self.hand is Hand.CLOSING:
            if not touching:
                self._touched = time
            if time - self._touched >= self.firm or time - self._since >= self.closing:
                self.hand = Hand.HOLDING if touching else Hand.MISSED
        elif self.hand is Hand.OPENING and time - self._since >= self.opening:
            self.hand = Hand.EMPTY
        return None

    def release(self, time: float) -> float:
        """Open the gripper; returns the opening that is wanted."""
        self.hand, self._since, self._let_go = Hand.OPENING, time, True
        return OPEN

    def _within_grasp(self, proximity: float, arrived: bool) -> bool:
        near = proximity < self.close_within or (arrived and proximity < float("inf"))
        return near and not self._let_go
