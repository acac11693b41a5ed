"""What the arm makes of predicted states: where each draws it, and what the hand does there."""

from dataclasses import dataclass
from enum import Enum

import numpy as np

from imitation.arrays import Array, Mask
from imitation.deciding import braking, coming_to_rest, drawn_by, no_attractor, one_attractor
from imitation.dynamics import Dynamics, homeostatic
from imitation.grasp import GraspReflex, Hand
from imitation.pairing import PostureHistory
from imitation.perception import Percept
from imitation.precision import Precision
from imitation.robot import SECOND, Observation
from imitation.sample import Decision
from imitation.visuo_motor_map import Attractors, VisuoMotorMap


class Phase(Enum):
    """What the arm is about."""

    RESTING = "rests after"
    APPROACHING = "approaches"  # the state, by a detour
    REACHING = "reaches for"  # the state itself
    LEAVING = "leaves"  # the last one
    RETURNING = "returns to rest from"


FOLLOWING = {
    Phase.RESTING: Phase.RESTING,
    Phase.APPROACHING: Phase.REACHING,
    Phase.REACHING: Phase.LEAVING,
    Phase.LEAVING: Phase.RETURNING,
    Phase.RETURNING: Phase.RESTING,
}


@dataclass(frozen=True)
class Detours:
    """Joint offsets from a state's posture, each (n_joints,) [rad]."""

    drawn_back: Array  # while an open hand makes ready: else it topples what it is to take
    lifted: Array  # while something is carried there
    lowered: Array  # when that is there: held just over the table
    leaving: Array  # after it was let go

    def of(self, phase: Phase, holding: bool) -> Array:
        """The offset in `phase`."""
        if phase is Phase.APPROACHING:
            return self.lifted if holding else self.drawn_back
        if phase is Phase.REACHING and holding:
            return self.lowered
        return self.leaving if phase is Phase.LEAVING else np.zeros_like(self.leaving)


@dataclass(frozen=True)
class Arriving:
    """When the arm is where it was going."""

    passing: float  # near enough to go on from a detour [rad]
    looking: float  # near enough to correct the aim by what is seen [rad]
    near: float  # near enough to a state's posture to act there [rad]
    settled: float  # when it was so near for this long [s]
    still: float  # so it is too when the arm gets no farther for this long [s]
    pairing: float  # frames older than this are not paired with a posture [s]


@dataclass
class Enactor:
    """Follows predicted states by eqs. 1 and 2, and lets the hand have its reflex on the way.

    Args:
        learned: The map.
        precision: How exactly a state tells where to go.
        reflex: Of the hand.
        detours: Around the states' postures.
        arriving: When the arm is where it was going.
        rest: The posture to go back to, (n_joints,) [rad].
        acceleration: What each joint may brake with, (n_joints,) [rad/s^2].
        period: Control period [s].
    """

    learned: VisuoMotorMap
    precision: Precision
    reflex: GraspReflex
    detours: Detours
    arriving: Arriving
    rest: Array
    acceleration: Array
    period: float

    def __post_init__(self) -> None:
        self.phase, self.due, self.last = Phase.RESTING, False, False
        self.arrived = False
        self._target = np.full(2, np.nan)
        self._about: tuple[object, ...] = ()
        self._history = PostureHistory(self.arriving.pairing)
        self._began_ns = self._frame_ns = self._moved_ns = self._away_ns = 0
        self._there = self.rest

    @property
    def _detour(self) -> Array:
        return self.detours.of(self.phase, self._holding)

    @property
    def _holding(self) -> bool:
        return self.reflex.shut or self.reflex.hand is Hand.OPENING

    def make_ready(self, target: Array) -> None:
        """A state is coming whose place is `target` (2,) [px]: be near until it is due."""
        self._target, self.due, self.phase = target, False, Phase.APPROACHING

    def go_to(self, target: Array, last: bool) -> None:
        """A state is due whose place is `target` (2,) [px]; nothing follows the last one."""
        self._target, self.due, self.last = target, True, last
        if self.phase is Phase.REACHING and self.reflex.hand is not Hand.EMPTY:
            self.phase = Phase.APPROACHING  # lifted; an empty hand goes straight on

    @property
    def attended(self) -> Mask:
        """Areas that a hand counts in: the predicted one and its neighbours, (rows, columns)."""
        field = self.learned.field
        area = field.area_of(self._target) if self.phase is Phase.REACHING else None
        return np.zeros(field.shape, dtype=bool) if area is None else field.around(area)

    def rests(self, now_ns: int, looked_ns: int) -> bool:
        """Whether the arm is back at rest, and was so when it was last looked at [ns].

        Where nothing new is seen any more, as after a film, it is not waited for.
        """
        looked_ns = max(looked_ns, now_ns - round(self.arriving.pairing * SECOND))
        still = (looked_ns - self._moved_ns) / SECOND > self.arriving.still
        return self.phase is Phase.RESTING and still

    def decide(self, seen: Observation, percept: Percept, dynamics: Dynamics) -> Decision:
        """Where the arm is drawn now; held still while the hand opens or closes."""
        self._turn(seen.time_ns)
        self._look(seen, percept)
        attractors = self._attractors(seen.posture, dynamics)
        self._arrive(seen, attractors.postures)
        gain, level = homeostatic()
        selection, target = np.zeros(self.learned.field.shape), None
        if self.phase not in (Phase.RESTING, Phase.RETURNING):
            selection, target = self.precision.selection, self._target
        decision = drawn_by(
            attractors, selection, seen.posture, dynamics, gain, level, target=target
        )
        if self.reflex.moving or not len(attractors.postures):
            return braking(decision, np.zeros_like(decision.velocity))
        return coming_to_rest(decision, seen.posture, self.acceleration, self.period)

    def act(self, seen: Observation) -> float | None:
        """What the hand does now: the opening that is wanted; None: as it is."""
        there = self.phase is Phase.REACHING and self.arrived
        if there and self.last and self.reflex.shut:
            return self.reflex.release(seen.time)
        return self.reflex.feel(seen.time, seen.proximity, seen.touching, there)

    def go_on(self) -> None:
        """Begin what comes next, once the arm has arrived and the hand is done."""
        waiting = self.phase is Phase.APPROACHING and not self.due
        done = self.last and self.reflex.hand is Hand.EMPTY
        staying = self.phase is Phase.REACHING and not done
        if self.arrived and not (self.reflex.moving or waiting or staying):
            self.phase = FOLLOWING[self.phase]

    def _turn(self, time_ns: int) -> None:
        """Aim anew when what the arm is about has changed."""
        about = self.phase, self._holding, tuple(self._target)
        if about == self._about:
            return
        self._about, self.arrived = about, False
        self._began_ns = self._moved_ns = self._away_ns = time_ns
        if self.phase in (Phase.APPROACHING, Phase.REACHING):
            self.precision.begin(self.learned, self._target)

    def _look(self, seen: Observation, percept: Percept) -> None:
        """Correct the aim by where the hand is seen, once it is near."""
        self._history.note(seen.time_ns, seen.posture - self._detour)
        news = percept.time_ns >= self._began_ns and percept.time_ns != self._frame_ns
        if percept.hand is None or not news or self.phase is not Phase.REACHING:
            return
        posture = self._history.at(percept.time_ns)
        if _apart(self.precision.attractors(posture).postures, posture) < self.arriving.looking:
            self.precision.correct(posture, percept.hand)
            self._frame_ns = percept.time_ns

    def _attractors(self, posture: Array, dynamics: Dynamics) -> Attractors:
        if self.phase is Phase.RESTING:
            return no_attractor(len(posture))
        if self.phase is Phase.RETURNING:
            return one_attractor(self.rest)
        found = self.precision.attractors(posture - self._detour)
        if not len(found.postures) or not self._detour.any():
            return found
        shifted = found.postures[0] + self._detour
        return one_attractor(np.clip(shifted, dynamics.lower, dynamics.upper))

    def _arrive(self, seen: Observation, goals: Array) -> None:
        limits, now_ns = self.arriving, seen.time_ns
        if np.any(np.abs(seen.posture - self._there) > limits.near):
            self._there, self._moved_ns = seen.posture, now_ns
        reaching = self.phase is Phase.REACHING
        if _apart(goals, seen.posture) >= (limits.near if reaching else limits.passing):
            self._away_ns = now_ns
        near_for = (now_ns - self._away_ns) / SECOND
        still = (now_ns - self._moved_ns) / SECOND > limits.still
        self.arrived = still or near_for >= (limits.settled if reaching else self.period)


def _apart(goals: Array, posture: Array) -> float:
    """Largest joint distance to the only goal [rad]; 0 when there is none to reach."""
    return float(np.abs(goals - posture).max(initial=0.0))
