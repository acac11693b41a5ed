"""All commands together: their help in groups, their errors in one line."""

import sys
from typing import Any

from typer.core import TyperGroup
from typer.exceptions import TyperException

from cli.errors import BAD_INPUT, in_usage, no_such, say

GROUPS = {
    "Experiments": ("learn-map", "reach", "mimic", "demo-record", "replay", "figure"),
    "Recordings": ("view", "inspect", "verify", "explain", "export", "recover"),
    "Robots": ("doctor", "check-map", "twin", "emulate"),
}
WIDEST = 120  # of a command's line in the help


class Commands(TyperGroup):
    """Commands in groups, whose errors are one line instead of Typer's box."""

    def main(self, *args: Any, **more: Any) -> Any:
        """Run the program and exit."""
        more |= {"standalone_mode": False, "prog_name": "imitate"}
        try:
            code = super().main(*args, **more)
        except TyperException as error:
            say(in_usage(error))
            code = BAD_INPUT
        sys.exit(code)

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """The command that was typed, refused with all the names there are."""
        if args[0] not in self.commands and not args[0].startswith("-"):
            raise TyperException(no_such("command", args[0], list(self.commands)))
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write the commands, group by group."""
        for title, names in GROUPS.items():
            with formatter.section(title):
                formatter.write_dl(
                    [(name, self.commands[name].get_short_help_str(WIDEST)) for name in names]
                )
