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
    show(f"{name}{f' (demo, n = {count})' if demo else ''}", claims, files)
    failed = [claim for claim in claims if not claim.passed]
    if not failed or demo:
        return DONE
    asked = sum(claim.comparison != "reported" for claim in claims)
    say(f"{name}: {len(failed)} of {asked} claims did not come true")
    return NOT_TRUE


def show(title: str, claims: Sequence[Claim], files: Sequence[Path]) -> None:
    """Print the claims and where the figure is."""
    rows = [_row(claim) for claim in claims]
    console = Console(highlight=False)
    console.print(listing(title, ("claim", "asked", "measured", "95 % interval", ""), rows))
    console.print("files  " + " ".join(os.path.relpath(path) for path in files), soft_wrap=True)


def _row(claim: Claim) -> tuple[str, ...]:
    told = claim.comparison == "reported"
    return (
        claim.sentence,
        "" if told else f"{claim.comparison} {claim.asked:g} {claim.unit}",
        f"{claim.measured:.4g}{f' {claim.unit}' if told else ''}",
        f"{claim.low:.4g} .. {claim.high:.4g}",
        "told" if told else "true" if claim.passed else "not true",
    )
