"""What all tests share: one map, learned once by the ideal arm."""

import pytest
from on_bench import Lesson, lesson


@pytest.fixture(scope="session")
def ideal_lesson() -> Lesson:
    """16 areas learned by the ideal arm: not to be changed."""
    return lesson("robot=ideal")
