"""How figures look and are saved. The one module that knows matplotlib's settings."""

from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.figure import Figure

from imitation.analysis.claims import Claim

matplotlib.use("Agg")

Drawn = tuple[Figure, list[Claim]]  # a figure and what it claims

FULL_WIDTH, HALF_WIDTH = 7.16, 3.5  # of a two-column page [inch]

# Okabe and Ito's palette, told apart by colour-blind readers too; without black, which is for
# what is no category.
COLOURS = (
    "#0072B2",
    "#D55E00",
    "#009E73",
    "#CC79A7",
    "#56B4E9",
    "#E69F00",
    "#7A5195",
    "#8C6D31",
)
INK, FAINT = "#222222", "#B0B0B0"

STYLE: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 8,
    "axes.labelsize": 8,
    "axes.titlesize": 8,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "legend.fontsize": 7,
    "legend.frameon": False,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "lines.linewidth": 1.0,
    "savefig.dpi": 300,
    "pdf.fonttype": 42,  # text stays text
}


def style() -> AbstractContextManager[None]:
    """Within it, figures are drawn in the common style."""
    return matplotlib.rc_context(STYLE)


def mark_demo(figure: Figure, seeds: int) -> None:
    """Say in the picture that it shows a few seeds only, too few to judge by."""
    with style():
        figure.text(
            0.005,
            0.005,
            f"demo, n = {seeds}",
            ha="left",
            va="bottom",
            color=COLOURS[1],
            fontsize=8,
        )


def save(figure: Figure, folder: Path, name: str) -> list[Path]:
    """Write NAME.png and NAME.pdf into `folder`, the same bytes each time."""
    folder.mkdir(parents=True, exist_ok=True)
    png, pdf = folder / f"{name}.png", folder / f"{name}.pdf"
    with style():
        figure.savefig(png, metadata={"Software": None})
        figure.savefig(pdf, metadata={"CreationDate": None})
    return [png, pdf]
