"""Builds what the `_target_`s of a configuration name, and gives each what it asks for."""

from collections.abc import Callable, Collection, Mapping
from inspect import signature
from typing import Any, TypeVar

from hydra.utils import get_method

Made = TypeVar("Made")


def without(node: Mapping[str, Any], *keys: str) -> dict[str, Any]:
    """The values of a node but for some keys."""
    return {key: value for key, value in node.items() if key not in keys}


def make(node: Mapping[str, Any], **more: Any) -> Any:
    """What a node's `_target_` builds from the node's other values and `more`.

    Hydra's own `instantiate` would turn dataclasses among the arguments into configurations.
    """
    return get_method(node["_target_"])(**without(node, "_target_"), **more)


def make_offered(node: Mapping[str, Any], offered: Mapping[str, Any]) -> Any:
    """What `make` builds, given those of the `offered` values that it asks for."""
    asked = asked_by(node)
    return make(node, **{name: value for name, value in offered.items() if name in asked})


def made_of(kind: Callable[..., Made], offered: Mapping[str, Any]) -> Made:
    """What `kind` makes of those of the `offered` values that it asks for."""
    asked = signature(kind).parameters
    return kind(**{name: value for name, value in offered.items() if name in asked})


def asked_by(node: Mapping[str, Any]) -> Collection[str]:
    """The parameters of what a node's `_target_` names."""
    return signature(get_method(node["_target_"])).parameters


def made(node: Any) -> Any:
    """`node` with everything built that a `_target_` in it names, innermost first."""
    if isinstance(node, list):
        return [made(one) for one in node]
    if not isinstance(node, dict):
        return node
    inside = {key: made(value) for key, value in node.items()}
    return make(inside) if "_target_" in inside else inside
