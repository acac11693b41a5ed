"""The program `imitate`: one thin command for each stage."""

from pathlib import Path
from typing import Annotated, Any

import typer

from cli.command_group import Commands
from cli.errors import BAD_INPUT, no_such, say
from cli.figures import FIGURES
from cli.help import StageCommand, complete, figure_names
from cli.launch import launch

app = typer.Typer(cls=Commands, rich_markup_mode=None, pretty_exceptions_enable=False)

STAGE: dict[str, Any] = {
    "cls": StageCommand,
    "context_settings": {"allow_extra_args": True, "ignore_unknown_options": True},
}
Words = Annotated[
    list[str] | None,
    typer.Argument(metavar="KEY=VALUE", help="See below.", autocompletion=complete),
]


Recorded = Annotated[Path, typer.Argument(metavar="RUN", help="A run's folder, or its run.mcap.")]


@app.callback(invoke_without_command=True)
def imitate(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Show the version.")] = False,
) -> None:
    """A bench for experiments in emergent imitation.

    A robot arm learns by moving and watching itself which postures bring its hand where it sees
    it; with that map it reaches what it sees. Every run is a recording in data/runs/.
    """
    if version:
        from cli.provenance import program_version

        typer.echo(f"imitate {program_version()}")
    elif context.invoked_subcommand is None:
        typer.echo(context.get_help())


@app.command(**STAGE)
def learn_map(words: Words = None) -> None:
    """Babble, watch the own hand, and learn which postures bring it where."""
    raise typer.Exit(launch("learn-map", words or []))


@app.command(**STAGE)
def reach(words: Words = None) -> None:
    """Reach seen targets with a learned map."""
    raise typer.Exit(launch("reach", words or []))


@app.command(**STAGE)
def demo_record(words: Words = None) -> None:
    """Watch an action once and learn it as a timed sequence of visual states."""
    raise typer.Exit(launch("demo-record", words or []))


@app.command(**STAGE)
def check_map(words: Words = None) -> None:
    """Tell whether camera or arm has moved since a map was learned."""
    raise typer.Exit(launch("check-map", words or []))


@app.command(**STAGE)
def mimic(words: Words = None) -> None:
    """Follow a hand that is taken for the own one."""
    raise typer.Exit(launch("mimic", words or []))


@app.command(**STAGE)
def replay(words: Words = None) -> None:
    """Reproduce an action seen once, when a hand at one of its states triggers it."""
    raise typer.Exit(launch("replay", words or []))


@app.command(**STAGE)
def figure(
    name: Annotated[
        str, typer.Argument(metavar="NAME", help=" | ".join(FIGURES), autocompletion=figure_names)
    ],
    words: Words = None,
) -> None:
    """Draw a figure of the paper and check what it claims."""
    if name not in FIGURES:
        say(no_such("figure", name, list(FIGURES)))
        raise typer.Exit(BAD_INPUT)
    group, _ = FIGURES[name]
    raise typer.Exit(launch("figure", [f"name={name}", f"figure={group}", *(words or [])]))


@app.command()
def view(
    run: Annotated[
        Path, typer.Argument(metavar="RUN", help="A run's folder, its run.mcap or run.rrd.")
    ],
    screenshot: Annotated[
        Path | None, typer.Option(help="Save a picture here instead; needs no screen.")
    ] = None,
    at: Annotated[
        float | None,
        typer.Option(help="Of the picture, in seconds from the start of the run; else its end."),
    ] = None,
) -> None:
    """Look at a recording in Rerun; makes run.rrd if it is missing."""
    from cli.reading import reading
    from cli.view import view

    raise typer.Exit(reading(run, lambda: view(run, screenshot, at)))


@app.command()
def emulate(
    device: Annotated[str, typer.Argument(metavar="DEVICE", help="katana | ssc32 | servo-bus")],
    model: Annotated[
        str | None,
        typer.Option(help="Katana: 300, 400, 450; servos: sts3215, xl330, xl430, xm430."),
    ] = None,
    port: Annotated[int | None, typer.Option(help="TCP port on 127.0.0.1; 0: a free one.")] = None,
    pty: Annotated[Path | None, typer.Option(help="Serial port to make.")] = None,
    fault: Annotated[
        list[str] | None,
        typer.Option(help="NAME[=WHICH][@START[-END]][xTIMES], in seconds; may be repeated."),
    ] = None,
    speed: Annotated[float, typer.Option(help="Times faster than the real device.")] = 1.0,
) -> None:
    """Be a device that speaks its wire protocol, to try drivers without hardware."""
    from cli.emulate import Asked, emulate
    from cli.job import attempt

    asked = Asked(model, port, pty, fault or [], speed)
    raise typer.Exit(attempt(lambda: emulate(device, asked)))


@app.command()
def inspect(
    run: Annotated[
        Path, typer.Argument(metavar="RUN", help="A run's folder, an .mcap of any program, a bag.")
    ],
    as_json: Annotated[bool, typer.Option("--json", help="For scripts.")] = False,
) -> None:
    """Tell on one screen what a recording holds, and what to type next."""
    from cli.inspect import inspect
    from cli.reading import reading

    raise typer.Exit(reading(run, lambda: inspect(run, as_json)))


@app.command()
def recover(run: Recorded) -> None:
    """Make the recording of a killed run whole again; the cut one is kept beside it."""
    from cli.reading import reading
    from cli.recover import recover_run

    raise typer.Exit(reading(run, lambda: recover_run(run)))


@app.command(context_settings={"allow_extra_args": True})
def verify(
    words: typer.Context,
    run: Recorded,
    with_: Annotated[
        list[str] | None,
        typer.Option("--with", metavar="KEY=VALUE...", help="What if: decide with these instead."),
    ] = None,
) -> None:
    """Make every decision of a recording anew, from what was sensed, and compare."""
    from cli.reading import reading
    from cli.verify import verify

    raise typer.Exit(reading(run, lambda: verify(run, with_ or [], words.args)))


@app.command()
def explain(
    run: Recorded,
    at: Annotated[float, typer.Option(help="When, in seconds from the start of the run.")],
) -> None:
    """Say in words and numbers why the arm moved as it did at one time of a run."""
    from cli.explain import explain
    from cli.reading import reading

    raise typer.Exit(reading(run, lambda: explain(run, at)))


@app.command()
def twin(
    words: Annotated[
        list[str] | None,
        typer.Argument(metavar="KEY=VALUE", help="Such as robot=so101 demonstrator=square."),
    ] = None,
    model: Annotated[
        str | None, typer.Option(help="Of the Katana: 300, 400 or 450; else 400.")
    ] = None,
    port: Annotated[int, typer.Option(help="TCP port of the arm; 0: a free one.")] = 5566,
    arm_pty: Annotated[
        Path, typer.Option(help="Serial port of an arm that has one, to make.")
    ] = Path("arm"),
    pty: Annotated[Path, typer.Option(help="Serial port of the neck, to make.")] = Path("neck"),
    stream: Annotated[int, typer.Option(help="TCP port of the camera; 0: a free one.")] = 8090,
    watching: Annotated[
        str, typer.Option(help="Who watches a demonstrator: demo-record, mimic or replay.")
    ] = "demo-record",
    fault: Annotated[
        list[str] | None,
        typer.Option(help="NAME[=WHICH][@START[-END]][xTIMES], in seconds; may be repeated."),
    ] = None,
) -> None:
    """Be a robot on this computer, the paper's by default: arm, neck and camera."""
    from cli.job import attempt
    from cli.twin import Asked, twin

    asked = Asked(words or [], watching, model, port, arm_pty, pty, stream, fault or [])
    raise typer.Exit(attempt(lambda: twin(asked)))


@app.command()
def doctor(
    words: Annotated[
        list[str] | None,
        typer.Argument(metavar="KEY=VALUE", help="Whose devices, such as robot=katana."),
    ] = None,
    config_dir: Annotated[
        Path | None, typer.Option(help="Take robots of your own from here too.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="For programs.")] = False,
) -> None:
    """Look whether all works here, and the devices of robot=..."""
    from cli.doctor import doctor
    from cli.job import attempt

    raise typer.Exit(attempt(lambda: doctor(words or [], config_dir, as_json)))


@app.command()
def export(
    paths: Annotated[list[Path], typer.Argument(metavar="RUN... OUT", help="Runs, then where to.")],
    to: Annotated[str, typer.Option(help="csv | parquet | video | lerobot")],
) -> None:
    """Write recordings as a table, a film or a LeRobot dataset."""
    from cli.export import export
    from cli.reading import reading

    raise typer.Exit(reading(paths[0], lambda: export(paths, to)))


def main() -> Any:
    """Run the program."""
    return app()
