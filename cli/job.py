"""One job of a command: from the composed configuration to an exit code, never an exception."""

import errno
import json
import os
import sys
import traceback
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from hydra.core.hydra_config import HydraConfig
from hydra.types import RunMode
from omegaconf import DictConfig

from cli.build import Config
from cli.check import checked
from cli.errors import BAD_INPUT, DEVICE, DONE, INTERRUPTED, NOT_TRUE, is_refusal, say
from cli.folder import make_run_folder, unmake_run_folder
from cli.following import OWN
from cli.interruption import STOP, sigterm_like_ctrl_c
from cli.report import show, show_ended
from cli.run import Outcome, Run
from cli.without_device import instead
from imitation.device import DeviceError
from imitation.recording.recorder import RecorderError

Work = Callable[[Run], Outcome]

# Why a file cannot be written, when it is the disk's fault.
DISK = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EIO)
# The same, and why one cannot be read, when the place that was named is none.
PLACE = (errno.EACCES, errno.EPERM, errno.ENOTDIR, errno.EISDIR, errno.ENAMETOOLONG, errno.ELOOP)

codes: list[int] = []  # exit codes of the jobs that ran in this process


def job(command: str, composed: DictConfig, work: Work) -> int:
    """Do `work` in a run folder of its own and return the exit code."""
    return attempt(lambda: _run(command, checked(command, composed), work))


def attempt(action: Callable[[], int]) -> int:
    """The exit code of `action`, whatever happens in it, kept for whoever launched the job."""
    sweep = _sweep()
    with sigterm_like_ctrl_c():
        try:
            code = INTERRUPTED if sweep and (sweep / STOP).exists() else action()
        except KeyboardInterrupt:
            _say("interrupted")
            code = INTERRUPTED
        except BrokenPipeError:  # whoever read our output, such as head, has seen enough
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            code = DONE
        except Exception as error:
            code = explain(error)
    codes.append(code)
    if sweep:
        _tell(sweep, code)
    return code


def explain(error: Exception) -> int:
    """Say what went wrong, and return the exit code."""
    if is_refusal(error):
        _say(str(error))
        return BAD_INPUT
    if failed := failed_device(error):
        _say(failed)
        return DEVICE
    if isinstance(error, OSError) and error.errno in PLACE:
        _say(f"{str(error.filename)[:200]}: {error.strerror}")
        return BAD_INPUT
    traceback.print_exception(error)  # a bug of this program, nothing a user could mend
    return NOT_TRUE


def failed_device(error: Exception) -> str | None:
    """What a device, the recorder or the disk did, if it was one of them."""
    if isinstance(error, RecorderError | DeviceError):
        return str(error)
    if isinstance(error, OSError) and error.errno in DISK:
        return f"{error.filename or 'the disk'} cannot be written: {error.strerror}"
    return None


def _run(command: str, cfg: Config, work: Work) -> int:
    typed = _typed()
    run = Run(command, cfg, make_run_folder(_out(cfg), command), typed, _sweep())
    try:
        outcome = work(run)
        return _finish(run, outcome)
    except KeyboardInterrupt:
        if not run.status:
            _try_to_write_metrics(run, "interrupted")
        run.log.info("interrupted")
        _say("interrupted")
        show_ended(run.folder)
        return INTERRUPTED
    except Exception as error:
        if not run.status:
            _try_to_write_metrics(run, "failed")
        run.log.exception("failed")
        if is_refusal(error) and not run.steps:
            run.close()
            unmake_run_folder(run.folder)  # nothing ran: the same out= may be typed again
        failed = failed_device(error)
        if not failed:
            raise
        absent = isinstance(error, DeviceError) and not run.steps and run.bench.real
        _say(f"{failed}; {instead(cfg['robot']['name'], typed)}" if absent else failed)
        show_ended(run.folder)
        return DEVICE
    finally:
        run.close()


def _typed() -> list[str]:
    """The words after the command, as they can be typed again."""
    hydra = HydraConfig.get()
    own = [
        f"{OWN}{os.path.relpath(source.path)}"
        for source in hydra.runtime.config_sources
        if source.provider == "command-line"
    ]
    return [*own, *hydra.overrides.task]


def _try_to_write_metrics(run: Run, status: str) -> None:
    with suppress(OSError):  # the disk may be what failed
        run.write_metrics(status, {})


def _finish(run: Run, outcome: Outcome) -> int:
    run.write_metrics("done", outcome.metrics)
    run.draw()
    show(run.command, run.folder, outcome, run.senses)
    begins = run.cfg.get("fault", {}).get("at")
    if begins is not None and begins >= run.robot_time_s:
        _say(f"the run was over before fault.at={begins:g} s; type a smaller one to spoil it")
    if outcome.complaint:
        _say(outcome.complaint)
        return NOT_TRUE
    return DONE


def _say(text: str) -> None:
    """Say it, and in a sweep which job it is about."""
    say(f"job {HydraConfig.get().job.num}: {text}" if _sweep() else text)


def _sweep() -> Path | None:
    """Folder of the sweep whose job this is; None outside a sweep."""
    if not HydraConfig.initialized() or HydraConfig.get().mode != RunMode.MULTIRUN:
        return None
    return Path(HydraConfig.get().sweep.dir)


def _out(cfg: Config) -> str | None:
    if sweep := _sweep():
        return str(sweep / str(HydraConfig.get().job.num))
    return None if cfg["out"] is None else str(cfg["out"])


def _tell(sweep: Path, code: int) -> None:
    """Leave the exit code where whoever launched the sweep finds it, on whatever machine.

    The jobs to come are not wanted either when this one was interrupted.
    """
    hydra = HydraConfig.get()
    told = {"job": hydra.job.num, "overrides": list(hydra.overrides.task), "exit_code": code}
    (sweep / f".job-{hydra.job.num}.json").write_text(json.dumps(told))
    if code == INTERRUPTED:
        (sweep / STOP).touch()
