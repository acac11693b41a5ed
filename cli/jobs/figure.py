"""imitate figure: draw a figure of the paper, write what it claims, say which claims came true."""

import os
from collections.abc import Sequence
from pathlib import Path
from pkgutil import resolve_name
from typing import Any

import hydra
from omegaconf import DictConfig
from rich.console import Console

from cli.build import Config
from cli.check import checked
from cli.errors import DONE, NOT_TRUE, UserError, say
from cli.figures import FIGURES
from cli.folder import writable
from cli.job import attempt
from cli.make import made
from cli.printed import listing
from imitation.analysis.claims import Claim, write_claims
from imitation.analysis.figure_style import mark_demo, save


@hydra.main(version_base="1.3", config_path="pkg://conf", config_name="figure")
def main(cfg: DictConfig) -> int:
    """One job."""
    return attempt(lambda: draw(checked("figure", cfg)))


def draw(cfg: Config) -> int:
    """Draw the figure and return the exit code."""
    name, demo = cfg["name"], cfg["demo"]
    if name not in cfg["figure"]:
        raise UserError(f"{name} is drawn with its own settings; leave name= and figure= out")
    folder = writable(Path(str(cfg["out"])))
    _, function = FIGURES[name]
    drawing: Any = resolve_name(function)
    count = cfg["demo_seeds"] if demo else cfg["seeds"]
    seeds = range(cfg["first_seed"], cfg["first_seed"] + count)
    figure, claims = drawing(seeds, made(cfg["figure"][name]))
    if demo:
        mark_demo(figure, count)
    files = [*save(figure, folder, name), write_claims(folder, name, claims, count, demo)]
    asked = [claim for claim in claims if claim.comparison != "reported"]
    show(f"{name}{f' (demo, n = {count})' if demo else ''}", asked, len(claims), files)
    failed = [claim for claim in asked if not claim.passed]
    if not failed or demo:
        return DONE
    say(f"{name}: {len(failed)} of {len(asked)} claims did not come true")
    return NOT_TRUE


def show(title: str, claims: Sequence[Claim], count: int, files: Sequence[Path]) -> None:
    """Print the claims and where the figure is; of `count` values what is no claim is a report."""
    rows = [_row(claim) for claim in claims]
    console = Console(highlight=False)
    console.print(listing(title, ("claim", "asked", "measured", "95 % interval", ""), rows))
    paths = [os.path.relpath(path) for path in files]
    if reports := count - len(claims):
        console.print(f"told   {reports} more values, in {paths[-1]}", soft_wrap=True, markup=False)
    console.print("files  " + " ".join(paths), soft_wrap=True, markup=False)


def _row(claim: Claim) -> tuple[str, ...]:
    unit = "" if claim.unit == "share" else f" {claim.unit}"
    return (
        claim.sentence,
        f"{claim.comparison} {claim.asked:g}{unit}",
        f"{claim.measured:.4g}",
        f"{claim.low:.3g} .. {claim.high:.3g}",
        "true" if claim.passed else "not true",
    )
