"""Checks a composed configuration before anything is made of it."""

from typing import Any

from omegaconf import DictConfig, OmegaConf
from omegaconf.errors import MissingMandatoryValue, OmegaConfBaseException

from cli.build import Config
from cli.errors import UserError


def checked(command: str, composed: DictConfig) -> Config:
    """The configuration as plain values.

    Raises:
        UserError: A value is missing, of the wrong type or out of its range, or a key is unknown.
    """
    try:
        cfg: Any = OmegaConf.to_container(composed, resolve=True, throw_on_missing=True)
    except MissingMandatoryValue as error:
        key = error.full_key or "a value"
        raise UserError(f"imitate {command} needs {key}: type {key}=...") from None
    except OmegaConfBaseException as error:
        raise UserError(f"configuration: {str(error).splitlines()[0]}") from None
    plain: Config = cfg
    return plain
