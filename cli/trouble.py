"""Says in one line what Hydra found wrong."""

import re

import yaml
from hydra.errors import (
    ConfigCompositionException,
    HydraException,
    MissingConfigException,
    OverrideParseException,
    SearchPathException,
)
from omegaconf.errors import OmegaConfBaseException

from cli.check import missing
from cli.errors import UserError, nearest, no_such
from cli.keys import CONF, comments, groups_of

BRACKETS = "put values that hold brackets or spaces in quotes, such as 'target=[80,60]'"

NO_SLURM = "srun is not on the PATH here; on one machine type hydra/launcher=joblib"


def as_user_error(command: str, error: Exception) -> Exception:
    """The error to show instead of Hydra's; a bug of this program as it is."""
    if isinstance(error, MissingConfigException):
        return UserError(_no_such_choice(command, error))
    if isinstance(error, OverrideParseException):
        return UserError(f"{error.override} cannot be read: {BRACKETS}")
    if isinstance(error, SearchPathException):
        return UserError(f"--config-dir: {_first_line(error)}")
    if isinstance(error, ConfigCompositionException):
        return UserError(_not_composed(command, error))
    if isinstance(error, yaml.YAMLError):
        return UserError(_bad_yaml(error))
    if isinstance(error, RuntimeError) and "srun" in str(error):
        return UserError(f"hydra/launcher=submitit_slurm: {NO_SLURM}")
    if isinstance(error, HydraException | OmegaConfBaseException):
        return UserError(_first_line(error))
    return error


def _no_such_choice(command: str, error: MissingConfigException) -> str:
    group, _, choice = (error.missing_cfg_file or "").rpartition("/")
    ours = {path.stem for path in (CONF / group).glob("*.yaml")}  # some are parts of others
    options = groups_of(command).get(group, []) + sorted(set(error.options or []) - ours)
    if not options:
        return _first_line(error)
    return f"{group}={choice}: {no_such(group, choice, options)}"


def _not_composed(command: str, error: ConfigCompositionException) -> str:
    text = str(error)
    if several := re.match(r"Ambiguous value for argument '(.*)'", text):
        return f"{several[1]} is several values: add -m to sweep over them, or write key=[a,b]"
    if mandatory := re.search(r"You must specify '([\w/]+)'", text):
        return missing(command, mandatory[1])
    if unfit := re.match(r"In '(\w+)/(\w+)': Could not override '(\w+)'", text):
        group, choice, missed = unfit.groups()
        return f"{group}={choice} does not fit {command}: it sets {missed}, which {command} lacks"
    unknown = re.match(r"Could not (?:override|append to config|delete).*?'(\S+?)'", text)
    if unknown:
        known = [*groups_of(command), *comments(command)]
        if unknown[1] in known:
            return _not_chosen(command, unknown[1])
        return f"unknown key {unknown[1]}{nearest(unknown[1], known)}"
    cause = error.__cause__
    return f"{_first_line(error)}{f': {_first_line(cause)}' if cause else ''}"


def _not_chosen(command: str, key: str) -> str:
    group, _, _ = key.partition(".")
    choices = groups_of(command).get(group)
    other = f"; choose another {group}= of {', '.join(choices)}" if choices else ""
    return f"key {key} does not go with the other words typed: their choice lacks it{other}"


def _bad_yaml(error: yaml.YAMLError) -> str:
    if not isinstance(error, yaml.MarkedYAMLError) or error.problem_mark is None:
        return f"a YAML file cannot be read: {_first_line(error)}"
    mark = error.problem_mark
    return f"{mark.name}, line {mark.line + 1}: not valid YAML: {error.problem}"


def _first_line(error: BaseException) -> str:
    return (str(error).strip().splitlines() or [type(error).__name__])[0]
