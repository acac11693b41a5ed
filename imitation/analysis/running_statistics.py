"""Statistics of vectors that come a few at a time."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from imitation.arrays import Array


@dataclass
class Statistics:
    """Smallest, largest, mean and spread of a vector over all frames."""

    count: int = 0
    low: Any = np.inf
    high: Any = -np.inf
    total: Any = 0.0
    squares: Any = 0.0

    def add(self, values: Array) -> None:
        """Vectors of some frames, (n, length)."""
        self.count += len(values)
        self.low = np.minimum(self.low, values.min(axis=0))
        self.high = np.maximum(self.high, values.max(axis=0))
        self.total = self.total + values.sum(axis=0)
        self.squares = self.squares + (values**2).sum(axis=0)

    def told(self, shape: tuple[int, ...]) -> dict[str, Any]:
        """All of them by name, as lists of `shape`."""
        mean = self.total / self.count
        spread = np.sqrt(np.maximum(self.squares / self.count - mean**2, 0.0))
        parts = {"min": self.low, "max": self.high, "mean": mean, "std": spread}
        numbers = {name: np.reshape(part, shape).tolist() for name, part in parts.items()}
        return numbers | {"count": [self.count]}
