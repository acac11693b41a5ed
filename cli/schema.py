"""What the keys of each command may hold. The values themselves stand in conf/ alone."""

from typing import Annotated, Any, Literal

from pydantic import Field as Within

from cli.common_schema import Common, Field, Named
from cli.kinds import (
    Count,
    NotNegative,
    Pair,
    Place,
    Positive,
    Section,
    Share,
    Whole,
)


class Clusters(Section):
    """`map` of learn-map."""

    neurons: Annotated[int, Within(ge=1, le=1000)]
    alpha: Annotated[float, Within(gt=0, le=1)]
    min_activity: Share
    radius: NotNegative
    excitation: Positive
    inhibition: Positive


class Learning(Section):
    """`learning`."""

    limit: Positive
    patience: Positive
    arrival: Positive
    blocked: Positive
    pairing: Positive


class Curiosity(Section):
    """`curiosity`."""

    central: Positive
    spacing: NotNegative
    bandwidth: Positive
    ridge: Positive
    jitter: NotNegative
    random: Share


class LearnMap(Common):
    """`imitate learn-map`."""

    field: Field
    guide: bool
    map: Clusters
    learning: Learning
    curiosity: Curiosity


class Reaching(Section):
    """`reach`."""

    tolerance: Positive
    hold_frames: Count
    noise_px: NotNegative
    sure: NotNegative
    limit: Positive
    after: Literal["stop", "hold"]
    required: Share | None
    inset: NotNegative
    border: NotNegative
    force: bool


class Reach(Common):
    """`imitate reach`."""

    field: Field | None = None  # the map's, so that none is given
    map: Place
    target: Literal["random"] | Pair
    area: Annotated[list[Whole], Within(min_length=2, max_length=2)] | None
    trials: Count
    controller: Named
    reach: Reaching


class TimeCells(Section):
    """`sequence.cells`."""

    shortest: Positive
    longest: Positive
    count: Annotated[int, Within(ge=2, le=1000)]
    width: Annotated[float, Within(ge=0.01, le=1)]


class Sequence(Section):
    """`sequence`."""

    cells: TimeCells
    context: Whole
    match: Annotated[float, Within(gt=0, lt=1)]
    noise: Annotated[float, Within(ge=0, le=0.1)]  # with more, predictions fail to come


class Watching(Section):
    """`demo`."""

    duration: Positive
    gone: Positive
    margin: Annotated[float, Within(ge=0, le=10)]


class VisualStates(Section):
    """`states`."""

    dwell: Positive
    still: Positive
    hysteresis: Annotated[float, Within(ge=0, lt=1)]
    lost: NotNegative


class DemoRecord(Common):
    """`imitate demo-record`."""

    field: Field
    sequence: Sequence
    demo: Watching
    states: VisualStates


class Mimicry(Section):
    """`mimic`."""

    turning: Whole
    endless: Positive
    catching_up: NotNegative
    largest_lag: NotNegative
    shortest: NotNegative
    grace: NotNegative
    near: Positive
    jitter_hz: Pair
    frechet_points: Annotated[int, Within(ge=2)]
    required: Share


class MirrorExperiment(Section):
    """`mirror`."""

    deviations: Annotated[list[NotNegative], Within(min_length=1)]
    window: Positive
    after: Positive
    settled: Positive


class Controls(Section):
    """`controls`."""

    look: str
    still: Positive
    permutations: Count
    quantile: Share
    batch: Count
    workers: Count


class Mimic(Common):
    """`imitate mimic`."""

    field: Field | None = None  # the map's, so that none is given
    map: Place
    duration: Positive | None
    shift: Pair
    selection: Named
    controller: Named | None = None  # of the arm that draws before a mirror
    mimic: Mimicry
    mirror: MirrorExperiment | None
    controls: Controls | None


class Replaying(Section):
    """`replay`."""

    precision: Literal["area", "seen"]
    patience: Positive
    after: NotNegative
    limit: Positive
    own_hand: NotNegative


class Arrivals(Section):
    """`arrivals`."""

    appearing: Annotated[float, Within(gt=0, le=1)]
    leaving: Annotated[float, Within(gt=0, le=1)]
    absence: NotNegative
    one_hand: Positive


class Arriving(Section):
    """`arriving`."""

    passing: Positive
    looking: Positive
    near: Positive
    settled: NotNegative
    still: Positive
    pairing: Positive


class DeferredControls(Section):
    """`controls` of replay."""

    seeds: Count
    noise_level: NotNegative
    noise_steps: Count
    resamples: Count
    workers: Count


class Replay(Common):
    """`imitate replay`."""

    field: Field | None = None  # the map's, so that none is given
    map: Place
    action: Place
    aim: Named
    sequence: Sequence
    states: VisualStates
    replay: Replaying
    arrivals: Arrivals
    arriving: Arriving
    controls: DeferredControls | None


class Figure(Section):
    """`imitate figure`."""

    figure: dict[str, Any]
    name: str
    out: Place
    first_seed: Whole
    seeds: Count
    demo: bool
    demo_seeds: Count


class Checking(Section):
    """`check`."""

    postures: Count
    slowness: Annotated[float, Within(ge=1)]
    arrival: Positive
    frames: Count
    blocked: Positive
    tolerance: Positive
    common: Positive
    sure: Positive


class CheckMap(Common):
    """`imitate check-map`."""

    field: Field | None = None  # the map's, so that none is given
    map: Place
    check: Checking


COMMANDS: dict[str, type[Section]] = {
    "learn-map": LearnMap,
    "reach": Reach,
    "mimic": Mimic,
    "demo-record": DemoRecord,
    "replay": Replay,
    "check-map": CheckMap,
    "figure": Figure,
}
