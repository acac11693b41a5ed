"""From the words after a command to Hydra, and from its jobs back to one exit code."""

import os
import sys
from collections.abc import Callable
from importlib import import_module

from cli.errors import BAD_INPUT, DONE, INTERRUPTED, UserError, say
from cli.installed_bodies import search_path
from cli.interruption import sigterm_like_ctrl_c, waiting_for_the_jobs
from cli.words import Words, quoted, understand

# Runs, logs and configurations are kept by cli/run.py: Hydra makes no folder and no log.
QUIET = (
    "hydra.run.dir=.",
    "hydra.output_subdir=null",
    "hydra.job.chdir=false",
    "hydra/job_logging=none",
    "hydra/hydra_logging=none",
)


def launch(command: str, typed: list[str]) -> int:
    """Run a command, once or as a sweep, and return the exit code."""
    try:
        words = understand(typed)
        if words.config_dirs:
            from cli.config_dir import check_config_dir

            for folder in words.config_dirs:
                check_config_dir(folder)
        with sigterm_like_ctrl_c():
            return _run(command, words)
    except UserError as error:
        say(str(error))
        return BAD_INPUT
    except KeyboardInterrupt:
        return INTERRUPTED


def _run(command: str, words: Words) -> int:
    from cli import job, trouble

    main = import_module(f"cli.jobs.{command.replace('-', '_')}").main
    job.codes.clear()
    try:
        if words.sweep:
            return _sweep(command, words, main)
        _call(main, [*words.overrides, *QUIET, *search_path(), *words.flags])
    except Exception as error:
        raise trouble.as_user_error(command, error) from error
    return max(job.codes, default=DONE)


def _sweep(command: str, words: Words, main: Callable[[], None]) -> int:
    from cli.folder import make_run_folder, unmake_run_folder
    from cli.sweep import out_of, summary, told

    folder = make_run_folder(out_of(words.overrides), command)
    where = (f"hydra.sweep.dir={quoted(str(folder))}", "hydra.sweep.subdir=.")
    try:
        with waiting_for_the_jobs(folder):
            _call(main, [*words.overrides, *QUIET, *search_path(), *where, *words.flags])
    except Exception:
        if not told(folder):  # no job ran: the same out= may be typed again
            unmake_run_folder(folder)
        raise
    return summary(folder)


def _call(main: Callable[[], None], words: list[str]) -> None:
    """Call a Hydra function as if `words` had been typed after it."""
    before, full = sys.argv, os.environ.get("HYDRA_FULL_ERROR")
    sys.argv = [before[0], *words]
    os.environ["HYDRA_FULL_ERROR"] = "1"  # errors come to us, whole, instead of a summary
    try:
        main()
    finally:
        sys.argv = before
        if full is None:
            del os.environ["HYDRA_FULL_ERROR"]
