"""Fig. 1: the robot in its world, with its camera's picture; whether it sees its hand truly."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from imitation.analysis.claims import Claim, every_claim, value_claim
from imitation.analysis.figure_style import FULL_WIDTH, INK, Drawn, style
from imitation.arrays import Array, Image
from imitation.visual_field import VisualField

ON_PICTURE = "#FFFFFF"  # lines and numbers drawn on the camera's picture


@dataclass(frozen=True)
class Sightings:
    """Random postures of the exploration hull, each seen once."""

    true_px: Array  # true projection of the mark on the hand, (n, 2) [px]
    seen_px: Array  # where it was seen, (n, 2) [px]; nan: not seen


@dataclass(frozen=True)
class Scene:
    """What is drawn."""

    side: Image  # the robot from the side, RGB
    frame: Image  # its camera's picture, RGB
    hand: Array  # where the hand is seen in it, (2,) [px]
    camera: Array  # where that camera is in `side`, (2,) [px]
    base: Array  # where the arm's base is in `side`, (2,) [px]
    mark: Array  # where the mark on the hand is in `side`, (2,) [px]
    view: Array  # the corners in `side` of what the camera sees of the table, (4, 2) [px]
    joints: int  # of the arm


@dataclass(frozen=True)
class HandInView:
    """Settings of Fig. 1; its YAML says what each means."""

    inset_px: float
    error_px: float
    cell_px: int
    covered: float
    resamples: int


def draw_fig1(
    scene: Scene,
    field: VisualField,
    sightings: Sequence[Sightings],
    reached: Array,
    settings: HandInView,
) -> Drawn:
    """The robot in its world, and what is claimed of its view of its hand.

    Args:
        scene: What is drawn.
        field: The areas drawn on the camera's picture.
        sightings: Of each seed.
        reached: True projections of many postures of the hull, (n, 2) [px].
        settings: What is asked.
    """
    with style():
        figure = Figure(figsize=(FULL_WIDTH, 3.9))
        _side(figure.add_axes((0.0, 0.0, 0.725, 1.0)), scene)
        _camera_picture(figure.add_axes((0.555, 0.41, 0.43, 0.5)), scene, field)
    return figure, _claims(field, sightings, reached, settings)


def _side(axes: Any, scene: Scene) -> None:
    height, width, _ = scene.side.shape
    axes.imshow(scene.side, extent=(0, width, height, 0))
    for corner in scene.view:
        ray = np.array((scene.camera, corner))
        axes.plot(*ray.T, color=INK, linewidth=0.5, linestyle=(0, (4, 3)))
    axes.fill(*scene.view.T, facecolor="none", edgecolor=INK, linewidth=0.7)
    labels = (
        ("camera on a neck\nthat pans and tilts", scene.camera, (0.03, 0.10)),
        (f"arm, {scene.joints} joints", scene.base, (0.03, 0.70)),
        ("red tag on the hand", scene.mark, (0.74, 0.715)),
        ("what the camera sees\nof the table", scene.view[scene.view[:, 0].argmax()], (0.94, 0.90)),
    )
    for words, at, (x, y) in labels:
        axes.annotate(
            words,
            at,
            xytext=(x * width, y * height),
            va="center",
            arrowprops={"arrowstyle": "-", "linewidth": 0.6, "color": INK, "shrinkB": 3},
            annotation_clip=False,
        )
    axes.set(xlim=(0, width), ylim=(height, 0))
    axes.set_axis_off()


def _camera_picture(axes: Any, scene: Scene, field: VisualField) -> None:
    width, height = field.size
    axes.imshow(scene.frame, extent=(0, width, height, 0), interpolation="nearest")
    x_edges, y_edges = field.edges
    axes.vlines(x_edges[1:-1], 0, height, color=ON_PICTURE, linewidth=0.8)
    axes.hlines(y_edges[1:-1], 0, width, color=ON_PICTURE, linewidth=0.8)
    for (row, column), within in np.ndenumerate(field.reachable):
        if within:
            x, y = field.centres[row, column]
            number = axes.text(x, y, f"{row},{column}", color=ON_PICTURE, ha="center", va="center")
            number.set(fontsize=6, path_effects=[withStroke(linewidth=1.2, foreground=INK)])
    axes.plot(*scene.hand, "o", color=ON_PICTURE, markersize=14, markerfacecolor="none")
    axes.set_title(f"its camera's picture, {width}x{height} px, with the areas", loc="left")
    axes.set(xlim=(0, width), ylim=(height, 0), xticks=np.arange(0, width + 1, 40))
    axes.set_yticks(np.arange(0, height + 1, 40))
    axes.tick_params(length=2)
    for side in axes.spines.values():
        side.set_visible(True)


def _claims(
    field: VisualField, sightings: Sequence[Sightings], reached: Array, settings: HandInView
) -> list[Claim]:
    inset, rng = settings.inset_px, np.random.default_rng(0)
    inside = [_within(one.true_px, np.zeros(2), np.array(field.size), inset) for one in sightings]
    seen = np.concatenate(
        [np.isfinite(one.seen_px[ok, 0]) for one, ok in zip(sightings, inside, strict=True)]
    )
    errors = [
        np.linalg.norm(one.seen_px[ok] - one.true_px[ok], axis=1)
        for one, ok in zip(sightings, inside, strict=True)
    ]
    share = np.mean(np.concatenate(inside))
    return [
        every_claim(
            f"The hand is seen in every posture of the hull that brings it {inset:g} px or more "
            f"inside the image ({share:.0%} of random ones do).",
            seen,
        ),
        value_claim(
            "It is seen where it truly is: largest distance of the seen centre from its true "
            "projection, without camera noise.",
            [values[np.isfinite(values)] for values in errors],
            lambda values: float(np.max(values, initial=0.0)),
            "at most",
            settings.error_px,
            "px",
            rng,
            settings.resamples,
        ),
        _coverage(field, reached, settings),
    ]


def _coverage(field: VisualField, reached: Array, settings: HandInView) -> Claim:
    """That the hand comes into the cells of the right part of the image."""
    (width, height), side, left = field.size, settings.cell_px, field.left
    columns, rows = round((width - left) / side), round(height / side)
    ok = _within(reached, np.array((left, 0.0)), np.array(field.size, dtype=float), 0.0)
    cells = np.floor((reached[ok] - (left, 0.0)) / side).astype(int)
    entered = np.zeros((rows, columns), dtype=bool)
    entered[cells[:, 1], cells[:, 0]] = True
    covered = float(entered.mean())
    return Claim(
        sentence=f"Postures of the hull bring the hand into the right {width - left:g}x{height} px "
        f"(share of {side:g} px cells, {len(reached)} postures; all counted, so no interval).",
        comparison="at least",
        asked=settings.covered,
        measured=covered,
        low=covered,
        high=covered,
        n=entered.size,
        unit="share",
        passed=covered >= settings.covered,
    )


def _within(places: Array, low: Array, high: Array, inset: float) -> Any:
    return np.all((places >= low + inset) & (places < high - inset), axis=1)
