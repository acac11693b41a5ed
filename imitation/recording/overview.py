"""What there is to show of a run: topics, areas and frames, and which values were ever told."""

import itertools
import json
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from imitation.arrays import Array
from imitation.recording import messages
from imitation.recording.mcap_recording import Recording
from imitation.recording.step_messages import Topic, topics
from imitation.robot import Body
from imitation.sample import Sample
from imitation.visual_field import VisualField


@dataclass(frozen=True)
class Grid:
    """The areas of the visual field on the image."""

    x_edges: Array  # borders of the columns [px]
    y_edges: Array  # borders of the rows [px]

    @classmethod
    def of(cls, recording: Recording) -> "Grid":
        """The visual field that a recording was made with."""
        told = recording.metadata["field"]
        return cls(
            np.array(json.loads(told["x_edges_px"])), np.array(json.loads(told["y_edges_px"]))
        )

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return len(self.y_edges) - 1, len(self.x_edges) - 1

    @cached_property
    def lines(self) -> list[list[tuple[float, float]]]:
        """The borders between the areas, each from end to end [px]."""
        (left, *_, right), (top, *_, bottom) = self.x_edges.tolist(), self.y_edges.tolist()
        upright = [[(x, top), (x, bottom)] for x in self.x_edges.tolist()]
        return upright + [[(left, y), (right, y)] for y in self.y_edges.tolist()]

    @cached_property
    def tile(self) -> int:
        """Side of the largest square that tiles every area [px]."""
        edges = np.concatenate((self.x_edges, self.y_edges)).round().astype(int)
        return int(np.gcd.reduce(edges))

    def tiled(self, values: Array) -> Array:
        """Values of the areas (n, rows, columns) as pictures of tiles, (n, height, width)."""
        heights = (np.diff(self.y_edges) / self.tile).round().astype(int)
        widths = (np.diff(self.x_edges) / self.tile).round().astype(int)
        return values.repeat(heights, axis=1).repeat(widths, axis=2)


@dataclass(frozen=True)
class Overview:
    """What there is to show of a run."""

    topics: dict[str, Topic]
    attachments: dict[str, bytes]
    grid: Grid
    frame_size: tuple[int, int] | None  # width, height [px]; None: JPEG, which tells it itself
    duration_ns: int | None  # None: it still goes on
    dynamics: tuple[bool, bool, bool]  # whether gain, noise level and distance are ever told
    activation: bool  # whether an attractor of the map ever took part
    drawn: bool  # whether any attractor ever did
    moved: bool  # whether the arm was ever sent a movement
    events: bool  # whether anything happened
    guard: bool  # whether the guard ever limited a command

    @property
    def urdf(self) -> bytes | None:
        """The arm's model, if there is one."""
        found = (data for name, data in self.attachments.items() if name.endswith(".urdf"))
        return next(found, None)

    @property
    def curves(self) -> set[str]:
        """The curves that have a line."""
        gain, noise, distance = self.dynamics
        told = {"distance": distance, "places": not distance, "velocity": self.moved}
        told["dynamics"] = self.moved and (gain or noise)
        return {"joints"} | {curve for curve, there in told.items() if there}

    @classmethod
    def of(cls, recording: Recording) -> "Overview":
        """Go through a recording once.

        Raises:
            ValueError: It holds no step.
        """
        last: int | None = None
        frame: Any = None
        dynamics, activation, kinds = np.zeros(3, dtype=bool), False, set()
        drawn = moved = False
        for message in itertools.chain.from_iterable(recording.chunks()):
            if message.topic == "/dynamics":
                last = message.time_ns
                told = messages.decoded(message.data, messages.FLOATS)
                dynamics |= np.isfinite(told.data)
            elif message.topic == "/camera/image" and frame is None:
                frame = messages.decoded(message.data, recording.topics[message.topic].type)
            elif message.topic == "/attractors/index" and not activation:
                index = messages.decoded(message.data, messages.INTEGERS)
                activation, drawn = bool((index.data >= 0).any()), drawn or index.data.size > 0
            elif message.topic == "/joint_command/sent" and not moved:
                sent = messages.decoded(message.data, messages.JOINT_STATE)
                moved = bool(np.any(sent.velocity))
            elif message.topic == "/events":
                kinds.add(messages.decoded(message.data, messages.LOG).name)
        if last is None:
            raise ValueError(f"{recording.path} holds no step: there is nothing to show")
        raw = frame is not None and hasattr(frame, "width")
        size = (frame.width, frame.height) if raw else None
        gain, noise, distance = (bool(told) for told in dynamics)
        return cls(
            recording.topics,
            recording.attachments,
            Grid.of(recording),
            frame_size=size,
            duration_ns=last,
            dynamics=(gain, noise, distance),
            activation=activation,
            drawn=drawn,
            moved=moved,
            events=bool(kinds - {"limited"}),
            guard="limited" in kinds,
        )

    @classmethod
    def of_live(
        cls, body: Body, field: VisualField, attachments: dict[str, bytes], sample: Sample
    ) -> "Overview":
        """A run that goes on, of which `sample` is a step: everything may come."""
        jpeg = sample.seen.jpeg is not None
        height, width, _ = sample.seen.frame.shape
        return cls(
            topics(body, field, jpeg),
            attachments,
            Grid(*field.edges),
            frame_size=None if jpeg else (width, height),
            duration_ns=None,
            dynamics=(True, True, True),
            activation=True,
            drawn=True,
            moved=True,
            events=True,
            guard=True,
        )
