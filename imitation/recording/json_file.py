"""What the bench tells as JSON."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np


def write_json(path: Path, content: dict[str, Any]) -> None:
    """Write a file for people and programs; what is no number becomes null.

    Raises:
        OSError: It cannot be written; what was there before is there still.
    """
    text = json.dumps(plain(content), indent=2, allow_nan=False, ensure_ascii=False)
    unfinished = path.with_name(f".{path.name}")
    try:
        unfinished.write_text(f"{text}\n", encoding="utf-8")
        unfinished.replace(path)
    except OSError as error:
        unfinished.unlink(missing_ok=True)
        error.filename = str(path)  # what was asked for, not the hidden one
        raise


def plain(value: Any) -> Any:
    """`value` as JSON can hold it: lists and numbers of Python, None for what is no number."""
    if isinstance(value, dict):
        return {str(key): plain(one) for key, one in value.items()}
    if isinstance(value, list | tuple | set):
        return [plain(one) for one in value]
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value
