"""A run made up without a robot: a red disc on a circle, five joints, a reach."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from imitation.perception import Percept
from imitation.recording.recorder import Recorder
from imitation.recording.step_messages import Topic, topics
from imitation.robot import Applied, Body, Command, Observation, Truth
from imitation.sample import Decision, Event, Sample, attractors_not_in_map
from imitation.visual_field import VisualField

PERIOD_NS = 40_000_000
JOINTS = 5
BODY = Body(
    "made_up",
    tuple(f"joint{n}" for n in range(1, JOINTS + 1)),
    np.full(JOINTS, -2.0),
    np.full(JOINTS, 2.0),
    np.ones(JOINTS),
    np.full(JOINTS, 4.0),
)
FIELD = VisualField("right_4x4", (160, 120), rows=4, columns=4, left=40.0)
TARGET = np.array((110.0, 40.0))
PIXELS = np.stack(np.meshgrid(np.arange(160) + 0.5, np.arange(120) + 0.5), axis=-1)


def picture(place: np.ndarray) -> np.ndarray:
    """A red disc at `place` [px] on a grey table."""
    frame = np.full((120, 160, 3), 128, dtype=np.uint8)
    frame[np.linalg.norm(PIXELS - place, axis=-1) < 6] = (220, 20, 20)
    return frame


def run(steps: int, seed: int = 0, start: int = 0) -> Iterator[tuple[Sample, list[Truth]]]:
    """Samples of a run with the truths told after each."""
    rng = np.random.default_rng(seed)
    truths = [truth(0)]
    for step in range(start, start + steps):
        truths.append(truth(step + 1))
        yield sample(step, rng), truths
        truths = []


def place(step: int) -> np.ndarray:
    angle = 0.02 * step
    return np.array((100 + 45 * np.cos(angle), 60 + 45 * np.sin(angle)))


def truth(step: int) -> Truth:
    pose = np.array((0.3, 0.1, 0.02, 0.0, 0.0, 0.0, 1.0))
    return Truth(step * PERIOD_NS, place(step), np.zeros(3), pose)


def sample(step: int, rng: np.random.Generator) -> Sample:
    now, where = step * PERIOD_NS, place(step)
    noise = rng.normal(0, 0.5, 2)
    hand = None if step % 50 == 49 else where + noise
    activity = FIELD.activity(where[None])
    posture = np.sin(0.01 * step + np.arange(JOINTS))
    n = 1 + step % 4
    activation = rng.random(n)
    index = rng.integers(0, 4, (n, 3)).astype(np.int32)
    velocity = rng.normal(0, 1, JOINTS)
    distance = float(np.linalg.norm(where - TARGET))
    decision = Decision(
        selection=FIELD.within(TARGET, 35.0),
        index=index if step % 10 else attractors_not_in_map(n),
        postures=rng.normal(0, 1, (n, JOINTS)),
        activation=activation / activation.sum(),
        shares=rng.normal(0, 0.1, (n, JOINTS)),
        gain=0.02 * distance,
        noise_level=0.001 * distance,
        noise=rng.normal(0, 0.01, JOINTS),
        velocity=velocity,
        target=TARGET,
        distance=distance if hand is not None else float("nan"),
    )
    limited = np.clip(velocity, -1, 1)
    reasons = ("speed",) if (limited != velocity).any() else ()
    seen = Observation(
        time_ns=now,
        posture=posture,
        velocity=velocity,
        gaze=np.zeros(2),
        frame=picture(where),
        frame_time_ns=now,
        frame_gaze=np.zeros(2),
        place_noise=noise,
        opening=1.0,
        proximity=float("inf"),
        touching=False,
    )
    events = (
        (Event("episode", "A trial begins.", {"trial": step // 100}),) if not step % 100 else ()
    )
    places = np.full((*activity.shape, 2), np.nan)
    percept = Percept(now, hand, activity, places, where[None])
    applied = Applied(velocity, limited, limited, reasons, now)
    return Sample(seen, percept, decision, Command(velocity), applied, events)


def recorder(path: Path, reproducible: bool = True, **more: object) -> Recorder:
    """A recorder of the made-up run."""
    return Recorder(
        path,
        body=BODY,
        field=FIELD,
        period_ns=PERIOD_NS,
        metadata={"command": "reach", "seed": "0"},
        attachments=more.pop("attachments", {"config.yaml": b"seed: 0\n"}),
        max_loss=more.pop("max_loss", 1.0),
        reproducible=reproducible,
        **more,
    )


def all_topics() -> dict[str, Topic]:
    """Every topic of a made-up run."""
    return topics(BODY, FIELD, jpeg=False)
