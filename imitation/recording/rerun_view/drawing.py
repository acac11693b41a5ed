"""A recording as a Rerun file that shows at first sight what happened. The one module of Rerun."""

import itertools
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa  # type: ignore[import-untyped]
import rerun as rr
import rerun.blueprint as rrb
from rerun.urdf import UrdfTree

from imitation.recording import messages
from imitation.recording.mcap_recording import Recording
from imitation.recording.picture_columns import Batch, Grid, Times, learned_places

TIMELINE = "run_time"
CHUNKS_AT_ONCE = 8  # of the recording; more would be faster by little and need more memory
GUIDE = """# What is what

**Camera** the picture the robot decides on, with the areas of its visual field

- cyan: the hand as it is seen
- white ring: where it truly is (known in simulation alone)
- yellow: the target
- green: where the hand was when an area was learned

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
CURVES = {
    "joints": "Joints [rad]",
    "velocity": "Velocity sent to the arm [rad/s]",
    "distance": "Distance from hand to target [px]",
    "dynamics": "Gain A and noise level ε",
}
COLOURS = [
    (76, 175, 255),
    (255, 152, 62),
    (92, 214, 120),
    (240, 98, 146),
    (186, 140, 255),
    (230, 220, 90),
]
LEGEND = 1.4  # end of the curves' time axis [durations of the run]: the legend lies beside the run
TURN = np.linspace(0, 2 * np.pi, 17)
RING = 2.5 * np.column_stack((np.cos(TURN), np.sin(TURN)))  # around the true hand [px]
FAINT = (255, 255, 255, 90)
CYAN, WHITE, YELLOW, GREEN = (0, 220, 255), (255, 255, 255), (255, 220, 0), (60, 220, 90)
PLACES = {"/hand": ("camera/hand", CYAN, 1.2), "/target": ("camera/target", YELLOW, 1.6)}
FIELDS = {
    "/visual_input": ("fields/visual_input", "Visual input I"),
    "/selection": ("fields/selection", "Selection V"),
    "/attractors/activation": ("fields/activation", "Activation"),
}


def derive(run: Path, rrd: Path) -> None:
    """Write the Rerun file of a recording.

    Args:
        run: A run folder or its `run.mcap`; may be cut.
        rrd: Where to write.

    Raises:
        ValueError: There is no recording at `run`, or it is damaged.
        OSError: `rrd` cannot be written.
    """
    recording = Recording.open(run)
    if not recording.topics:
        raise ValueError(f"{recording.path} holds no step: there is nothing to show")
    drawing = Drawing(recording)
    stream = rr.RecordingStream("imitation", send_properties=False)
    rrd.unlink(missing_ok=True)
    stream.save(rrd, default_blueprint=drawing.blueprint())
    try:
        drawing.draw_constants(stream)
        chunks = recording.chunks()
        while told := list(itertools.islice(chunks, CHUNKS_AT_ONCE)):
            batch = Batch(itertools.chain.from_iterable(told), recording.topics)
            drawing.draw(stream, batch)
    finally:
        stream.disconnect()


class Drawing:
    """Draws the steps of one recording and knows which panels it needs.

    Args:
        recording: Tells topics, visual field and attachments.
    """

    def __init__(self, recording: Recording) -> None:
        self._topics, self._attachments = recording.topics, recording.attachments
        self._title = recording.metadata["run"].get("command", "run")
        self._grid = Grid.of(recording)
        self._arm = _urdf(recording.attachments)
        self._fields = _fields(recording)
        self._duration_ns, self._dynamics = _duration_and_dynamics(recording)
        self._format = _image_format(recording)
        self._learned: list[tuple[float, float]] = []

    def blueprint(self) -> rrb.Blueprint:
        """The panels: those that have something to show."""
        (left, *_, right), (top, *_, bottom) = self._grid.x_edges, self._grid.y_edges
        camera = rrb.Spatial2DView(
            origin="camera",
            name="Camera: what the robot sees",
            visual_bounds=rrb.VisualBounds2D(x_range=(left, right), y_range=(top, bottom)),
        )
        fields = [
            rrb.Spatial2DView(
                origin=entity,
                name=name,
                visual_bounds=rrb.VisualBounds2D(
                    x_range=(left / self._grid.tile, right / self._grid.tile),
                    y_range=(top / self._grid.tile, bottom / self._grid.tile),
                ),
            )
            for entity, name in self._fields.values()
        ]
        words: list[Any] = [rrb.TextDocumentView(origin="guide", name="What is what")]
        if "config.yaml" in self._attachments:
            words.append(rrb.TextDocumentView(origin="configuration", name="Configuration"))
        columns = rrb.TextLogColumns(
            timeline_columns=[TIMELINE], text_log_columns=["LogLevel", "Body"]
        )
        events = rrb.Tabs(
            rrb.TextLogView(origin="events", name="Events", columns=columns),
            rrb.TextLogView(origin="guard", name="Guard", columns=columns),
            active_tab=0,
        )
        arm = [_arm_view()] if self._arm else []
        return rrb.Blueprint(
            rrb.Horizontal(
                rrb.Vertical(camera, rrb.Horizontal(*fields), row_shares=[3, 1.2]),
                rrb.Vertical(*self._curves()),
                rrb.Vertical(*arm, events, rrb.Tabs(*words, active_tab=0)),
                column_shares=[4, 3, 3],
            ),
            rrb.TimePanel(state="collapsed", timeline=TIMELINE),
            rrb.BlueprintPanel(state="hidden"),
            rrb.SelectionPanel(state="hidden"),
        )

    def draw_constants(self, stream: rr.RecordingStream) -> None:
        """Draw what does not change."""

        def log(entity: str, *what: Any) -> None:
            stream.log(entity, *what, static=True)

        guide = GUIDE + (ACTIVATION if "/attractors/activation" in self._fields else "")
        log("guide", rr.TextDocument(guide, media_type="text/markdown"))
        if "config.yaml" in self._attachments:
            text = self._attachments["config.yaml"].decode()
            log(
                "configuration",
                rr.TextDocument(f"```yaml\n{text}\n```", media_type="text/markdown"),
            )
        areas = [[(x, y) for x, y in line] for line in self._grid.lines]
        log("camera/areas", rr.LineStrips2D(areas, colors=FAINT, radii=0.15))
        for entity, _ in self._fields.values():
            self._draw_field(stream, entity)
        if "map.npz" in self._attachments:
            places = learned_places(self._attachments["map.npz"])
            log("camera/learned_before", rr.Points2D(places, colors=GREEN, radii=0.8))
        if self._format:
            log("camera/image", rr.Image.from_fields(format=self._format))
        for entity, colour, radius in PLACES.values():
            log(entity, rr.Points2D.from_fields(colors=colour, radii=radius))
        log("camera/learned", rr.Points2D.from_fields(colors=GREEN, radii=0.8))
        log("camera/true_hand", rr.LineStrips2D.from_fields(colors=WHITE, radii=0.25))
        for entity, names in self._lines().items():
            first = 1 if entity.endswith("noise_level") else 0
            colours = list(itertools.islice(itertools.cycle(COLOURS), first, first + len(names)))
            log(entity, rr.SeriesLines(names=names, colors=colours))
        if self._arm:
            self._arm.log_urdf_to_recording(stream)

    def draw(self, stream: rr.RecordingStream, batch: Batch) -> None:
        """Draw some steps."""
        self._draw_camera(stream, batch)
        self._draw_fields(stream, batch)
        self._draw_curves(stream, batch)
        self._draw_events(stream, batch)
        if self._arm:
            self._draw_arm(stream, self._arm, batch)

    def _has(self, topic: str) -> bool:
        return topic in self._topics

    def _draw_field(self, stream: rr.RecordingStream, entity: str) -> None:
        lines = (np.array(self._grid.lines) / self._grid.tile).tolist()
        stream.log(f"{entity}/areas", rr.LineStrips2D(lines, colors=FAINT, radii=0.03), static=True)
        tiles = self._grid.tiled(np.zeros((1, *self._grid.shape)))[0]
        look = rr.DepthImage.from_fields(
            format=rr.components.ImageFormat(
                width=tiles.shape[1], height=tiles.shape[0], color_model="L", channel_datatype="U8"
            ),
            colormap="inferno",
            depth_range=(0, 255),
            magnification_filter="nearest",
        )
        stream.log(f"{entity}/tiles", look, static=True)

    def _curves(self) -> list[rrb.View]:
        axis = rrb.TimeAxis(
            view_range=rrb.TimeRange(
                start=rrb.TimeRangeBoundary.absolute(seq=0),
                end=rrb.TimeRangeBoundary.absolute(seq=int(LEGEND * self._duration_ns)),
            )
        )
        legend = rrb.PlotLegend(rrb.Corner2D.RightTop)
        return [
            rrb.TimeSeriesView(origin=f"curves/{curve}", name=name, plot_legend=legend, axis_x=axis)
            for curve, name in CURVES.items()
            if any(entity.startswith(f"curves/{curve}") for entity in self._lines())
        ]

    def _lines(self) -> dict[str, list[str]]:
        """Entities of the curves with the names of their lines."""
        joints = short(self._topics["/joint_states"].names)
        return {"curves/joints": joints, "curves/velocity": joints} | {
            f"curves/{entity}": [name] for entity, name in self._dynamics
        }

    def _draw_camera(self, stream: rr.RecordingStream, batch: Batch) -> None:
        if "/camera/image" in batch:
            send(stream, "camera/image", batch.times("/camera/image"), self._pictures(batch))
        captured = batch.captured()
        for topic in set(PLACES) & set(self._topics):
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

    def _pictures(self, batch: Batch) -> Any:
        if self._topics["/camera/image"].type == messages.COMPRESSED_IMAGE:
            blobs = [message.data.tobytes() for message in batch.messages("/camera/image")]
            return rr.EncodedImage.columns(blob=blobs, media_type=["image/jpeg"] * len(blobs))
        return rr.Image.columns(buffer=batch.pixels())

    def _draw_fields(self, stream: rr.RecordingStream, batch: Batch) -> None:
        for topic, (entity, _) in self._fields.items():
            values = self._grid.tiled(batch.grids(topic, self._grid))
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
            if curve in self._dynamics
        }
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

    def _draw_arm(self, stream: rr.RecordingStream, arm: UrdfTree, batch: Batch) -> None:
        postures = batch.vectors("/joint_states", "position")
        names = [list(self._topics["/joint_states"].names)] * len(postures)
        told = arm.compute_joint_transform_batches(pa.array(names), pa.array(postures.tolist()))
        parts = told.flatten()
        times = batch.times("/joint_states").repeat(postures.shape[1])
        transforms = rr.Transform3D.columns(
            translation=np.array(parts.field("translation").to_pylist()),
            quaternion=np.array(parts.field("quaternion").to_pylist()),
            parent_frame=parts.field("parent_frame").to_pylist(),
            child_frame=parts.field("child_frame").to_pylist(),
        )
        send(stream, "arm/joints", times, transforms)


def send(stream: rr.RecordingStream, entity: str, times_ns: Times, columns: Any) -> None:
    """Send the columns of an entity on the run's own clock."""
    clock = rr.TimeColumn(TIMELINE, duration=times_ns.astype("timedelta64[ns]"))
    rr.send_columns(entity, [clock], columns, recording=stream)


def short(names: Sequence[str]) -> list[str]:
    """Names without the words that all of them begin or end with."""
    words = [name.split("_") for name in names]
    while all(len(name) > 1 for name in words) and len({name[0] for name in words}) == 1:
        words = [name[1:] for name in words]
    while all(len(name) > 1 for name in words) and len({name[-1] for name in words}) == 1:
        words = [name[:-1] for name in words]
    return [" ".join(name) for name in words]


def _urdf(attachments: dict[str, bytes]) -> UrdfTree | None:
    """The arm's model, if the recording holds one."""
    for name, data in attachments.items():
        if name.endswith(".urdf"):
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / name
                path.write_bytes(data)
                return UrdfTree.from_file_path(path, "arm")
    return None


def _arm_view() -> rrb.View:
    return rrb.Spatial3DView(
        origin="arm",
        name="Arm",
        contents=["/arm/**", "/tf_static"],
        eye_controls=rrb.EyeControls3D(position=(0.75, -0.6, 0.5), look_target=(0.18, 0.0, 0.12)),
    )


def _image_format(recording: Recording) -> rr.components.ImageFormat | None:
    """How the frames' pixels lie; None where frames are JPEG and tell it themselves."""
    if recording.topics["/camera/image"].type == messages.COMPRESSED_IMAGE:
        return None
    _, first = next(recording.messages("/camera/image"))
    return rr.components.ImageFormat(
        width=first.width, height=first.height, color_model="RGB", channel_datatype="U8"
    )


def _duration_and_dynamics(recording: Recording) -> tuple[int, list[tuple[str, str]]]:
    """How long the run lasted [ns], and which curves of its dynamics are not missing."""
    times, told = zip(*recording.messages("/dynamics"), strict=True)
    known = np.isfinite(np.stack([message.data for message in told]))
    return times[-1], [curve for curve, there in zip(DYNAMICS, known.T, strict=True) if there.any()]


def _fields(recording: Recording) -> dict[str, tuple[str, str]]:
    """The fields with something in them: activation may be that of attractors not in the map."""
    in_map = any(
        (message.data >= 0).any() for _, message in recording.messages("/attractors/index")
    )
    return {topic: field for topic, field in FIELDS.items() if in_map or "activation" not in topic}
