"""Says in one line what Hydra found wrong."""

from cli.errors import UserError
from cli.words import Words


def as_user_error(command: str, words: Words, error: Exception) -> Exception:
    """The error to show instead of Hydra's."""
    if isinstance(error, UserError):
        return error
    return error
