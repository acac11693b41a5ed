"""Checks a composed configuration before anything is made of it."""

from collections.abc import Iterator, Mapping
from inspect import Parameter, signature
from pkgutil import resolve_name
from typing import Any, get_type_hints

from omegaconf import DictConfig, OmegaConf
from omegaconf.errors import MissingMandatoryValue, OmegaConfBaseException
from pydantic import BaseModel, ConfigDict, ValidationError, create_model

from cli.build import Config
from cli.config_dir import not_known
from cli.errors import UserError, nearest
from cli.keys import comments, experiments_setting, known_targets
from cli.kinds import Target
from cli.ranges import RANGES
from cli.schema import COMMANDS

# Given by cli/build.py when asked for.
SUPPLIED = {
    "arm",
    "camera",
    "space",
    "reference",
    "gaze",
    "rng",
    "demonstrator",
    "thing",
    "acceleration",
    "period",
}

LARGEST = 1e9  # number that anything is measured in, whatever its unit
UNLIMITED = ("seed", "first_seed", "distance_cap")

PYDANTIC = {
    "Input should be ": "",
    "List should have ": "a list of ",
    " after validation": "",
    "a valid integer": "a whole number",
    "a valid boolean": "true or false",
    "a valid ": "a ",
}


def checked(command: str, composed: DictConfig) -> Config:
    """The configuration as plain values.

    Raises:
        UserError: A value is missing, of the wrong type or out of its range, or a key is unknown.
    """
    try:
        cfg: Any = OmegaConf.to_container(composed, resolve=True, throw_on_missing=True)
    except MissingMandatoryValue as error:
        raise UserError(missing(command, str(error.full_key))) from None
    except OmegaConfBaseException as error:
        raise UserError(f"configuration: {str(error).splitlines()[0]}") from None
    try:
        model = COMMANDS[command].model_validate(cfg)
        for path, target in targets(model, ()):
            check_target(target, path, cfg)
        check_joints(cfg.get("robot"))
        check_shown(cfg)
    except ValidationError as error:
        raise UserError(in_words(command, error, cfg, ())) from None
    check_numbers(cfg, ())
    plain: Config = cfg
    return plain


def missing(command: str, key: str) -> str:
    """That a key must be given."""
    told = comments(command).get(key, "")
    what = key.rpartition(".")[2].upper()
    return f"{command} needs {key}={f' ({told})' if told else ''}; type {key}={what}"


def targets(model: BaseModel, path: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], Target]]:
    """Every node with a `_target_` below a checked model, and where it stands."""
    for name in type(model).model_fields:
        value = getattr(model, name)
        if isinstance(value, Target):
            yield (*path, name), value
        elif isinstance(value, BaseModel):
            yield from targets(value, (*path, name))
        elif isinstance(value, dict):
            yield from _targets_of_dict(value, (*path, name))


def _targets_of_dict(
    node: dict[str, Any], path: tuple[str, ...]
) -> Iterator[tuple[tuple[str, ...], Target]]:
    if "_target_" in node:
        yield path, Target.model_validate(node)
    for key, value in node.items():
        if isinstance(value, dict):
            yield from _targets_of_dict(value, (*path, key))


def check_target(node: Target, path: tuple[str, ...], cfg: Config) -> None:
    """Check a node's keys and values against the parameters of its `_target_`."""
    dotted = ".".join(path)
    given = dict(node.model_extra or {})
    name = given.pop("_target_", None)
    if name not in known_targets():  # nothing that a file names is called unless we know it
        raise UserError(f"{dotted}.{not_known(str(name))}")
    try:  # pydoc.locate would take a Ctrl-C for an error of the module
        target: Any = resolve_name(str(name))
    except (ImportError, AttributeError) as error:
        raise UserError(f"{dotted}._target_={name}: {error}") from None
    if not callable(target):
        raise UserError(f"{dotted}._target_={name}: nothing of that name can be called")
    parameters = signature(target).parameters
    hints = get_type_hints(target)
    fields: dict[str, Any] = {}
    for parameter in parameters.values():
        if parameter.name in given or _must_be_given(parameter):
            fields[parameter.name] = (_kind(path[0], parameter.name, hints), ...)
    model = create_model(dotted, __config__=ConfigDict(extra="forbid", strict=True), **fields)
    try:
        model.model_validate(given)
    except ValidationError as error:
        raise UserError(in_words("", error, cfg, path, list(parameters))) from None


def check_numbers(node: Any, path: tuple[str, ...]) -> None:
    """Check that no number is one that nothing here is measured in."""
    for name, value in node.items() if isinstance(node, dict) else enumerate(node):
        here = (*path, str(name))
        if isinstance(value, dict | list):
            check_numbers(value, here)
        elif isinstance(value, int | float) and name not in UNLIMITED and not abs(value) <= LARGEST:
            raise UserError(f"{'.'.join(here)}={_short(value)}: wanted {LARGEST:g} at most")


def check_joints(robot: Config | None) -> None:
    """Check that what is given for each joint is given for all of them."""
    if not robot or "joints" not in robot["arm"]:
        return
    count = len(robot["arm"]["joints"])
    given = {f"robot.guided[{i}]": posture for i, posture in enumerate(robot["guided"])}
    given["robot.rest"] = robot["rest"]
    given["robot.arm.force"] = robot["arm"].get("force")
    offsets = ("drawn_back", "lifted", "lowered", "leaving")
    given |= {f"robot.grasp.{name}": (robot["grasp"] or {}).get(name) for name in offsets}
    for key, values in given.items():
        if values is not None and len(values) != count:
            raise UserError(f"{key} needs {count} numbers, one a joint; got {_short(values)}")


def check_shown(cfg: Config) -> None:
    """Check that a hand that is to be seen is shown inside the image."""
    place = cfg.get("demonstrator", {}).get("place")
    size = cfg.get("camera", {}).get("size")
    if place and not all(0 <= one <= most for one, most in zip(place, size, strict=True)):
        raise UserError(
            f"demonstrator.place={_short(place)}: outside the image, where nobody is seen; x is "
            f"0 to {size[0]} px, y 0 to {size[1]} px"
        )


def in_words(
    command: str, error: ValidationError, cfg: Config, path: tuple[str, ...], valid: Any = ()
) -> str:
    """The first thing wrong, in one line."""
    first = error.errors()[0]
    key, value = _find(cfg, (*path, *first["loc"]))
    same = [one for one in error.errors() if _find(cfg, (*path, *one["loc"]))[0] == key]
    if first["type"] == "extra_forbidden":
        above, _, _ = key.rpartition(".")
        inside = f"{above}." if above else ""
        known = comments(command) if command else [inside + name for name in valid]
        if setting := experiments_setting(key) if command else []:
            named = " or ".join(setting)
            return f"experiment={named} sets {key}, which {command} lacks; leave it out"
        return f"unknown key {key}{nearest(key, known)}"
    if first["type"] == "missing":
        return f"key {'.'.join(map(str, (*path, *first['loc'])))} is missing from the configuration"
    wanted = " or ".join(dict.fromkeys(_wanted(one) for one in same))
    told = comments(command).get(key, "") if command else ""
    return f"{key}={_short(value)}: should be {wanted}{f' ({told})' if told else ''}"


def _must_be_given(parameter: Parameter) -> bool:
    several = parameter.kind in (Parameter.VAR_POSITIONAL, Parameter.VAR_KEYWORD)
    has_default = parameter.default is not Parameter.empty
    return not several and not has_default and parameter.name not in SUPPLIED


def _kind(section: str, name: str, hints: Mapping[str, Any]) -> Any:
    """What a parameter may hold; anything when neither its name nor its type tells."""
    if kind := RANGES.get(section, {}).get(name):
        return kind
    return hints[name] if hints.get(name) in (str, int, float, bool) else Any


def _find(cfg: Any, loc: tuple[int | str, ...]) -> tuple[str, Any]:
    """The part of `loc` that stands in `cfg`, dotted, and its value; the rest are Pydantic's."""
    found = ""
    for part in loc:
        inside = isinstance(cfg, dict) and part in cfg
        if not inside and not (isinstance(cfg, list) and isinstance(part, int) and part < len(cfg)):
            break
        found += f"[{part}]" if isinstance(part, int) else f".{part}"
        cfg = cfg[part]
    return found.strip("."), cfg


def _wanted(one: Any) -> str:
    told = str(one["msg"])
    for theirs, ours in PYDANTIC.items():
        told = told.replace(theirs, ours)
    return told


def _short(value: Any) -> str:
    text = str(value).replace("'", "")
    return text if len(text) <= 60 else f"{text[:57]}..."
