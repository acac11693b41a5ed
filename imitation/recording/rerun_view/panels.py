"""The panels of the Rerun view: only those that have something to show."""

from collections.abc import Iterator
from typing import Any

import rerun.blueprint as rrb

from imitation.recording.overview import Overview

TIMELINE = "run_time"
CURVES = {
    "joints": "Joints [rad]",
    "velocity": "Velocity sent to the arm [rad/s]",
    "places": "Hand in visual space [px]",
    "distance": "Distance from hand to target [px]",
    "dynamics": "Gain A and noise level ε",
}
FIELDS = {
    "/visual_input": ("fields/visual_input", "Visual input I"),
    "/selection": ("fields/selection", "Selection V"),
    "/attractors/activation": ("fields/activation", "Activation"),
}
LEGEND = 1.4  # end of the curves' time axis [durations of the run]: the legend lies beside the run


def blueprint(shown: Overview, demonstrated: bool = False) -> rrb.Blueprint:
    """Camera and fields on the left, curves in the middle, arm and words on the right.

    Args:
        shown: What there is to show.
        demonstrated: Whether the demonstration is shown beside its reproduction.
    """
    camera: rrb.View | rrb.Container = _camera(shown)
    if demonstrated:
        camera = rrb.Horizontal(_demonstration(shown), camera)
    left = rrb.Vertical(
        camera, rrb.Horizontal(*_fields(shown)), row_shares=[2 if demonstrated else 3, 1.2]
    )
    arm = [_arm()] if shown.urdf else []
    return rrb.Blueprint(
        rrb.Horizontal(
            left,
            rrb.Vertical(*_curves(shown)),
            rrb.Vertical(*arm, *_events(shown), _words(shown)),
            column_shares=[6 if demonstrated else 4, 3, 3],
        ),
        rrb.TimePanel(state="collapsed", timeline=TIMELINE),
        rrb.BlueprintPanel(state="hidden"),
        rrb.SelectionPanel(state="hidden"),
    )


def fields(shown: Overview) -> dict[str, tuple[str, str]]:
    """Entity and name of each field that has something in it, by topic."""
    filled = {"/selection": shown.drawn, "/attractors/activation": shown.activation}
    return {topic: field for topic, field in FIELDS.items() if filled.get(topic, True)}


def _camera(shown: Overview) -> rrb.View:
    return rrb.Spatial2DView(
        origin="camera", name="Camera: what the robot sees", visual_bounds=_bounds(shown, 1)
    )


def _demonstration(shown: Overview) -> rrb.View:
    return rrb.Spatial2DView(
        origin="demonstration", name="Demonstration", visual_bounds=_bounds(shown, 1)
    )


def _fields(shown: Overview) -> Iterator[rrb.View]:
    for entity, name in fields(shown).values():
        bounds = _bounds(shown, shown.grid.tile)
        yield rrb.Spatial2DView(origin=entity, name=name, visual_bounds=bounds)


def _bounds(shown: Overview, scale: float) -> rrb.VisualBounds2D:
    x, y = shown.grid.x_edges / scale, shown.grid.y_edges / scale
    return rrb.VisualBounds2D(x_range=(x[0], x[-1]), y_range=(y[0], y[-1]))


def _curves(shown: Overview) -> Iterator[rrb.View]:
    more: dict[str, Any] = {}
    if shown.duration_ns is not None:
        start = rrb.TimeRangeBoundary.absolute(seq=0)
        end = rrb.TimeRangeBoundary.absolute(seq=int(LEGEND * shown.duration_ns))
        more["axis_x"] = rrb.TimeAxis(view_range=rrb.TimeRange(start=start, end=end))
    for curve, name in CURVES.items():
        if curve in shown.curves:
            yield rrb.TimeSeriesView(
                origin=f"curves/{curve}",
                name=name,
                plot_legend=rrb.PlotLegend(rrb.Corner2D.RightTop),
                **more,
            )


def _arm() -> rrb.View:
    eye = rrb.EyeControls3D(position=(0.75, -0.6, 0.5), look_target=(0.18, 0.0, 0.12))
    return rrb.Spatial3DView(
        origin="arm", name="Arm", contents=["/arm/**", "/tf_static"], eye_controls=eye
    )


def _events(shown: Overview) -> list[rrb.Container]:
    columns = rrb.TextLogColumns(timeline_columns=[TIMELINE], text_log_columns=["LogLevel", "Body"])
    logs = {"events": ("Events", shown.events), "guard": ("Guard", shown.guard)}
    views = [
        rrb.TextLogView(origin=origin, name=name, columns=columns)
        for origin, (name, told) in logs.items()
        if told
    ]
    return [rrb.Tabs(*views, active_tab=0)] if views else []


def _words(shown: Overview) -> rrb.Container:
    words = [rrb.TextDocumentView(origin="guide", name="What is what")]
    if "config.yaml" in shown.attachments:
        words.append(rrb.TextDocumentView(origin="configuration", name="Configuration"))
    return rrb.Tabs(*words, active_tab=0)
