"""One job of a command: from the composed configuration to an exit code, never an exception."""

import json
import logging
import signal
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

from hydra.core.hydra_config import HydraConfig
from hydra.types import RunMode
from omegaconf import DictConfig

from cli.check import checked
from cli.errors import BAD_INPUT, DEVICE, DONE, INTERRUPTED, NOT_TRUE, UserError, is_refusal, say
from cli.folder import make_run_folder
from cli.interruption import terminate_like_ctrl_c
from cli.report import show
from cli.run import Outcome, Run
from imitation.recording.mcap_recording import RecorderError

Work = Callable[[Run], Outcome]

codes: list[int] = []  # exit codes of the jobs that ran in this process


def job(command: str, composed: DictConfig, work: Work) -> int:
    """Do `work` in a run folder of its own and return the exit code."""
    before = signal.getsignal(signal.SIGTERM)
    terminate_like_ctrl_c()
    try:
        code = _attempt(command, composed, work)
    finally:
        signal.signal(signal.SIGTERM, before)
    codes.append(code)
    if _in_sweep():
        _tell_sweep(code)
        if code == INTERRUPTED:
            raise KeyboardInterrupt  # the jobs to come are not wanted either
    return code


def _attempt(command: str, composed: DictConfig, work: Work) -> int:
    try:
        cfg = checked(command, composed)
        run = Run(command, cfg, make_run_folder(_out(cfg), command))
    except UserError as error:
        say(str(error))
        return BAD_INPUT
    try:
        outcome = work(run)
    except Exception as error:
        run.write_metrics("failed", {})
        run.log.exception("failed")
        return _explain(error, run.log)
    except KeyboardInterrupt:
        run.write_metrics("interrupted", {})
        run.log.info("interrupted")
        say(f"interrupted; what was recorded until then is in {run.folder}")
        return INTERRUPTED
    finally:
        run.close()
    return _finish(run, outcome)


def _explain(error: Exception, log: logging.Logger) -> int:
    if is_refusal(error):
        say(str(error))
        return BAD_INPUT
    if isinstance(error, RecorderError):
        say(str(error))
        return DEVICE
    traceback.print_exception(error)  # a bug of this program, nothing a user could mend
    return NOT_TRUE


def _finish(run: Run, outcome: Outcome) -> int:
    run.write_metrics("done", outcome.metrics)
    show(run.command, run.folder, outcome)
    if outcome.complaint:
        say(outcome.complaint)
        return NOT_TRUE
    return DONE


def _in_sweep() -> bool:
    return HydraConfig.get().mode == RunMode.MULTIRUN


def _out(cfg: Any) -> str | None:
    if not _in_sweep():
        out = cfg["out"]
        return None if out is None else str(out)
    return str(Path(HydraConfig.get().sweep.dir, str(HydraConfig.get().job.num)))


def _tell_sweep(code: int) -> None:
    """Leave the exit code where whoever launched the sweep finds it, on whatever machine."""
    hydra = HydraConfig.get()
    told = {"job": hydra.job.num, "overrides": list(hydra.overrides.task), "exit_code": code}
    path = Path(hydra.sweep.dir, f".job-{hydra.job.num}.json")
    path.write_text(json.dumps(told))
