"""The program `imitate`: one thin command for each stage."""

from typing import Annotated, Any

import typer

from cli.launch import launch

app = typer.Typer(no_args_is_help=True, rich_markup_mode=None, pretty_exceptions_enable=False)

HYDRA = {"allow_extra_args": True, "ignore_unknown_options": True}
Words = Annotated[list[str] | None, typer.Argument(metavar="[KEY=VALUE]... [-m]")]


@app.command(context_settings=HYDRA)
def learn_map(words: Words = None) -> None:
    """Babble, watch the own hand, and learn which postures bring it where."""
    raise typer.Exit(launch("learn-map", words or []))


@app.command(context_settings=HYDRA)
def reach(words: Words = None) -> None:
    """Reach seen targets with a learned map."""
    raise typer.Exit(launch("reach", words or []))


@app.callback()
def imitate() -> None:
    """A bench for experiments in emergent imitation."""


def main() -> Any:
    """Run the program."""
    return app()
