"""What the bench tells as JSON."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from imitation.recording.run_files import write_whole


def write_json(path: Path, content: dict[str, Any]) -> None:
    """Write a file for people and programs; what is no number becomes null.

    Raises:
        OSError: It cannot be written; what was there before is there still.
    """
    text = json.dumps(plain(content), indent=2, allow_nan=False, ensure_ascii=False)
    write_whole(path, lambda unfinished: unfinished.write_text(f"{text}\n", encoding="utf-8"))


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
