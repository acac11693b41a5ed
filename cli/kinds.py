"""Kinds of values that keys may hold, by type, range and length."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict
from pydantic import Field as Within

Whole = Annotated[int, Within(ge=0)]
Count = Annotated[int, Within(ge=1, le=1_000_000)]
Positive = Annotated[float, Within(gt=0)]
NotNegative = Annotated[float, Within(ge=0)]
Share = Annotated[float, Within(ge=0, le=1)]
Pair = Annotated[list[float], Within(min_length=2, max_length=2)]
HueRange = Annotated[list[Annotated[int, Within(ge=0, le=179)]], Within(min_length=2, max_length=2)]
ByteRange = Annotated[
    list[Annotated[int, Within(ge=0, le=255)]], Within(min_length=2, max_length=2)
]
Size = Annotated[list[Annotated[int, Within(ge=1, le=4096)]], Within(min_length=2, max_length=2)]
Place = str | int  # a file or folder; one may be named 1
Posture = Annotated[list[float], Within(min_length=1)]
Triple = Annotated[list[float], Within(min_length=3, max_length=3)]
Colour = Annotated[list[Share], Within(min_length=4, max_length=4)]
Names = Annotated[list[str], Within(min_length=1)]


class Section(BaseModel):
    """Keys that belong together; no other key is taken."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)


class Target(BaseModel):
    """A node whose `_target_` names what is built of it: other keys are its parameters."""

    model_config = ConfigDict(extra="allow", strict=True, allow_inf_nan=False)
