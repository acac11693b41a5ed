"""What reads a recording is told in one line that it is damaged, whatever the damage leads to."""

from collections.abc import Callable
from pathlib import Path

from cli.errors import UserError, is_refusal
from cli.job import attempt
from imitation.analysis.seal import broken
from imitation.recording.mcap_recording import Recording


def reading(path: Path, action: Callable[[], int]) -> int:
    """The exit code of `action`, which reads the recording at `path`."""
    return attempt(lambda: _told_of_damage(path, action))


def _told_of_damage(path: Path, action: Callable[[], int]) -> int:
    try:
        return action()
    except Exception as error:
        # An error on a sound recording is a bug of this program, and is to be seen as one.
        if is_refusal(error) or isinstance(error, OSError) or is_sound(path):
            raise
        why = str(error).splitlines()[0][:120] if str(error) else ""
        raise UserError(f"{path} is damaged: {type(error).__name__} {why}".strip()) from error


def is_sound(path: Path) -> bool:
    """Whether a recording says what the recorder wrote."""
    try:
        return not broken(Recording.open(path))
    except Exception:  # whatever damage may lead to
        return False
