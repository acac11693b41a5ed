"""Help that teaches: examples, keys, groups, sweeps and exit codes, read from conf/."""

from typing import Any, ClassVar

from typer.core import TyperCommand

from cli.figures import FIGURES
from cli.keys import comments, defaults, groups_of, own_keys

EXIT_CODES = [
    ("0", "done"),
    ("1", "ran, but what was asked did not come true"),
    ("2", "bad input, said in one line"),
    ("3", "a device or the recorder failed; the arm was left safe"),
    ("130", "interrupted (Ctrl-C or SIGTERM); the recording is closed and readable"),
]
SWEEPS = [
    ("-m seed=0,1,2", "one run for each value, one folder a run"),
    ("-m 'seed=range(0,20)'", "values with brackets need quotes"),
    ("-m seed=0,1 hydra/launcher=joblib", "several at a time on this machine"),
    ("-m seed=0,1 hydra/launcher=submitit_slurm", "on a cluster"),
]
OPTIONS = [
    ("-m, --multirun", "sweep: run once for each combination of values"),
    ("--dry-run", "do everything but move the arm"),
    ("--yes", "let a real arm move without asking first"),
    ("--cfg job [--resolve]", "show the composed configuration, run nothing"),
    ("--info defaults", "show which files it is composed of"),
    ("--config-dir DIR", "take groups and experiments from DIR too"),
    ("--help", "show this"),
]
EXAMPLES = {
    "learn-map": [
        ("imitate learn-map", "16 areas on the simulated Katana"),
        ("imitate learn-map field=right_3x3 seed=1", "9 areas, other random numbers"),
        ("imitate learn-map robot=ideal", "a kinematic arm, without an engine"),
        ("imitate learn-map camera.delay_frames=5", "a slow camera"),
    ],
    "reach": [
        ("imitate reach map=RUN", "a random target with our controller"),
        ("imitate reach map=RUN controller=yuragi trials=6", "the paper's law, six trials"),
        ("imitate reach map=RUN 'target=[100,60]'", "a place; mind the quotes"),
        ("imitate reach map=RUN 'area=[1,2]'", "the place learned for an area"),
        (
            "imitate reach map=RUN fault=camera_gone fault.at=0.5 fault.lasts=1",
            "what it does when that happens",
        ),
    ],
    "demo-record": [
        ("imitate demo-record", "watch a hand take a can, carry it by and let it go"),
        ("imitate demo-record states.dwell=0.2", "shorter rests are states too"),
        ("imitate demo-record camera=video camera.path=FILM vision=skin", "a person in a film"),
        ("imitate demo-record camera=webcam camera.device=0 vision=skin", "a person here and now"),
    ],
    "mimic": [
        ("imitate mimic map=RUN", "follow a hand on a circle, as in the paper"),
        ("imitate mimic map=RUN selection=soft demonstrator=line", "between the areas too"),
        ("imitate mimic map=RUN demonstrator.period=4 duration=14", "a quick gesture"),
        ("imitate mimic map=RUN dynamics.tau=0.3", "smoother, later"),
        ("imitate mimic map=RUN experiment=mimicry_controls", "what makes the imitation"),
        ("imitate mimic map=RUN experiment=mirror", "Nielsen's mirror"),
    ],
    "check-map": [
        ("imitate check-map map=RUN", "visit five learned postures"),
        ("imitate check-map map=RUN check.postures=16", "all of them"),
    ],
    "replay": [
        ("imitate replay map=RUN action=RUN", "a hand at the action's first state triggers it"),
        ("imitate replay map=RUN action=RUN replay.precision=area", "as in the paper: eyes closed"),
        (
            "imitate replay map=RUN action=RUN 'demonstrator.place=[85,75]' "
            "'object.seen_px=[115,45]'",
            "a hand has begun, and brought the can to the third state: the robot takes it over",
        ),
        ("imitate replay map=RUN action=RUN object=null", "control: without the can"),
        (
            "imitate replay map=RUN action=RUN robot.arm.gripper.force=0",
            "control: a gripper that cannot hold",
        ),
        ("imitate replay map=RUN action=RUN experiment=deferred_controls", "beside chance"),
    ],
    "figure": [
        ("imitate figure fig3a", "all seeds; exit code 1 when a claim fails"),
        ("imitate figure fig3a demo=true", "a few seeds, at a glance"),
        ("imitate figure fig3b out=here seeds=5", "into the folder here/"),
    ],
}


class StageCommand(TyperCommand):
    """A command over a Hydra configuration; its help reads that configuration."""

    rich_help: ClassVar[bool] = False

    def format_epilog(self, ctx: Any, formatter: Any) -> None:
        """Write what can be typed after the command."""
        command = self.name or ""
        sections = {
            "Examples": EXAMPLES.get(command, []),
            "Keys": _keys(command),
            "Groups": [(name, " | ".join(found)) for name, found in groups_of(command).items()],
            "Sweeps": SWEEPS,
            "Hydra's options": OPTIONS,
            "Exit codes": EXIT_CODES,
        }
        for title, rows in sections.items():
            if rows:
                with formatter.section(title):
                    formatter.write_dl(rows, col_max=44)


def complete(ctx: Any, incomplete: str) -> list[tuple[str, str]]:
    """What a shell may offer for a KEY=VALUE word, with what conf/ says of it."""
    command = ctx.info_name
    groups, told = groups_of(command), comments(command)
    offers = [(f"{name}={one}", "") for name, choices in groups.items() for one in choices]
    offers += [(f"{key}=", told[key]) for key in told]
    # bash cuts words at "=", so that only what follows it is being completed.
    typed = ctx.params.get("words") or []
    if typed[-1:] == ["="]:
        return [(choice, "") for choice in groups.get(typed[-2], [])]
    return [(word, note) for word, note in offers if word.startswith(incomplete)]


def figure_names() -> list[str]:
    """What a shell may offer for a figure's name."""
    return list(FIGURES)


def _keys(command: str) -> list[tuple[str, str]]:
    told, values = comments(command), defaults(command)
    return [(f"{key}={values[key]}", told[key]) for key in own_keys(command) if values[key]]
