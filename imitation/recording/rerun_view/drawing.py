"""Draws recorded steps in Rerun, as columns on the run's own clock."""

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np
import rerun as rr

from imitation.recording import messages
from imitation.recording.overview import Overview
from imitation.recording.picture_columns import Batch, learned_places
from imitation.recording.rerun_view.body_drawing import BodyDrawing
from imitation.recording.rerun_view.columns import send
from imitation.recording.rerun_view.look import (
    CYAN,
    FAINT,
    GREEN,
    WHITE,
    YELLOW,
    image_format,
    pictures,
)
from imitation.recording.rerun_view.panels import fields

GUIDE = """# What is what

**Camera** the picture the robot decides on, with the areas of its visual field

- cyan: the hand as it is seen
- white ring: where the robot's own hand truly is (known in simulation alone)
- yellow: the target
- green: where the hand was when an area was learned

**Demonstration** beside a replay: what was watched, timed so that what triggered it coincides

**Fields** what each area of the picture means to the robot

- *visual input*: where the hand is seen
- *selection*: which areas may pull the arm
"""
ACTIVATION = "- *activation*: how much each of them pulls now\n"
DYNAMICS = (
    ("dynamics/gain", "gain A"),
    ("dynamics/noise_level", "noise level ε"),
    ("distance", "distance"),
)
COLOURS = [
    (76, 175, 255),
    (255, 152, 62),
    (92, 214, 120),
    (240, 98, 146),
    (186, 140, 255),
    (230, 220, 90),
]
FIRST_COLOUR = {"curves/dynamics/noise_level": 1, "curves/places/own": 2}
TURN = np.linspace(0, 2 * np.pi, 17)
RING = 2.5 * np.column_stack((np.cos(TURN), np.sin(TURN)))  # around the true hand [px]
PLACES = {"/hand": ("camera/hand", CYAN, 1.2), "/target": ("camera/target", YELLOW, 1.6)}


class Drawing:
    """Draws the steps of one run.

    Args:
        shown: What there is to show.
    """

    def __init__(self, shown: Overview) -> None:
        self._shown = shown
        self._body = BodyDrawing(shown) if shown.urdf else None
        self._learned: list[tuple[float, float]] = []

    def draw_constants(self, stream: rr.RecordingStream) -> None:
        """Draw what does not change."""

        def log(entity: str, *what: Any) -> None:
            stream.log(entity, *what, static=True)

        guide = GUIDE + (ACTIVATION if self._shown.activation else "")
        log("guide", rr.TextDocument(guide, media_type="text/markdown"))
        if "config.yaml" in self._shown.attachments:
            text = self._shown.attachments["config.yaml"].decode()
            log(
                "configuration",
                rr.TextDocument(f"```yaml\n{text}\n```", media_type="text/markdown"),
            )
        areas = [[(x, y) for x, y in line] for line in self._shown.grid.lines]
        log("camera/areas", rr.LineStrips2D(areas, colors=FAINT, radii=0.15))
        for entity, _ in fields(self._shown).values():
            self._draw_field(stream, entity)
        if "map.npz" in self._shown.attachments:
            places = learned_places(self._shown.attachments["map.npz"])
            log("camera/learned_before", rr.Points2D(places, colors=GREEN, radii=0.8))
        if self._shown.frame_size:
            width, height = self._shown.frame_size
            log("camera/image", rr.Image.from_fields(format=image_format(width, height, "RGB")))
        for entity, colour, radius in PLACES.values():
            log(entity, rr.Points2D.from_fields(colors=colour, radii=radius))
        log("camera/learned", rr.Points2D.from_fields(colors=GREEN, radii=0.8))
        log("camera/true_hand", rr.LineStrips2D.from_fields(colors=WHITE, radii=0.25))
        for entity, names in self._lines().items():
            first = FIRST_COLOUR.get(entity, 0)
            colours = list(itertools.islice(itertools.cycle(COLOURS), first, first + len(names)))
            log(entity, rr.SeriesLines(names=names, colors=colours))
        if self._body:
            self._body.draw_constants(stream)

    def draw(self, stream: rr.RecordingStream, batch: Batch) -> None:
        """Draw some steps."""
        self._draw_camera(stream, batch)
        self._draw_fields(stream, batch)
        self._draw_curves(stream, batch)
        self._draw_events(stream, batch)
        if self._body:
            self._body.draw(stream, batch)

    def _draw_field(self, stream: rr.RecordingStream, entity: str) -> None:
        lines = (np.array(self._shown.grid.lines) / self._shown.grid.tile).tolist()
        stream.log(f"{entity}/areas", rr.LineStrips2D(lines, colors=FAINT, radii=0.03), static=True)
        tiles = self._shown.grid.tiled(np.zeros((1, *self._shown.grid.shape)))[0]
        look = rr.DepthImage.from_fields(
            format=image_format(tiles.shape[1], tiles.shape[0], "L"),
            colormap="inferno",
            depth_range=(0, 255),
            magnification_filter="nearest",
        )
        stream.log(f"{entity}/tiles", look, static=True)

    def _lines(self) -> dict[str, list[str]]:
        """Entities of the curves with the names of their lines."""
        joints = short(self._shown.topics["/joint_states"].names)
        places = {
            "curves/places/seen": ["x seen", "y seen"],
            "curves/places/own": ["x own", "y own"],
        }
        return (
            {"curves/joints": joints, "curves/velocity": joints}
            | places
            | {f"curves/{entity}": [name] for entity, name in self._dynamics()}
        )

    def _dynamics(self) -> list[tuple[str, str]]:
        return [curve for curve, told in zip(DYNAMICS, self._shown.dynamics, strict=True) if told]

    def _draw_camera(self, stream: rr.RecordingStream, batch: Batch) -> None:
        if "/camera/image" in batch:
            send(stream, "camera/image", batch.times("/camera/image"), pictures(batch))
        captured = batch.captured()
        for topic in set(PLACES) & set(self._shown.topics):
            places, told = batch.places(topic)
            points = rr.Points2D.columns(positions=places).partition(told)
            send(stream, PLACES[topic][0], captured, points)
        if "/truth/hand" in batch:
            rings = batch.places("/truth/hand")[0][:, None] + RING
            lines = rr.LineStrips2D.columns(strips=list(rings))
            send(stream, "camera/true_hand", batch.times("/truth/hand"), lines)
        learned = batch.learned()
        if learned:
            before, self._learned = len(self._learned), [*self._learned, *learned.values()]
            ends = range(before + 1, len(self._learned) + 1)
            places = np.concatenate([self._learned[:end] for end in ends])
            points = rr.Points2D.columns(positions=places).partition(list(ends))
            send(stream, "camera/learned", np.array(list(learned)), points)

    def _draw_fields(self, stream: rr.RecordingStream, batch: Batch) -> None:
        for topic, (entity, _) in fields(self._shown).items():
            values = self._shown.grid.tiled(batch.grids(topic, self._shown.grid))
            shades = (255 * np.clip(values, 0, 1)).astype(np.uint8)
            tiles = rr.DepthImage.columns(buffer=shades.reshape(len(shades), -1))
            send(stream, f"{entity}/tiles", batch.times(topic), tiles)

    def _draw_curves(self, stream: rr.RecordingStream, batch: Batch) -> None:
        curves = {
            "joints": ("/joint_states", batch.vectors("/joint_states", "position")),
            "velocity": ("/joint_command/sent", batch.vectors("/joint_command/sent", "velocity")),
        }
        dynamics = batch.vectors("/dynamics")
        curves |= {
            curve[0]: ("/dynamics", values[:, None])
            for curve, values in zip(DYNAMICS, dynamics.T, strict=True)
            if curve in self._dynamics()
        }
        curves["places/seen"] = ("/camera/used", batch.places_or_nan("/hand"))
        if "/truth/hand" in batch:
            curves["places/own"] = ("/truth/hand", batch.places("/truth/hand")[0])
        for name, (topic, values) in curves.items():
            send(stream, f"curves/{name}", batch.times(topic), rr.Scalars.columns(scalars=values))

    def _draw_events(self, stream: rr.RecordingStream, batch: Batch) -> None:
        told = zip(batch.times("/events"), batch.messages("/events"), strict=True)
        for guard, events in itertools.groupby(told, lambda event: event[1].name == "limited"):
            times, logs = zip(*events, strict=True)
            text = rr.TextLog.columns(
                text=[messages.split_log(log)[0] for log in logs], level=[log.name for log in logs]
            )
            send(stream, "guard" if guard else "events", np.array(times), text)


def short(names: Sequence[str]) -> list[str]:
    """Names without the words that all of them begin or end with."""
    words = [name.split("_") for name in names]
    while all(len(name) > 1 for name in words) and len({name[0] for name in words}) == 1:
        words = [name[1:] for name in words]
    while all(len(name) > 1 for name in words) and len({name[-1] for name in words}) == 1:
        words = [name[:-1] for name in words]
    return [" ".join(name) for name in words]
