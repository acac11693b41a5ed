from pathlib import Path

import made_up
import pytest


@pytest.fixture
def record(tmp_path):
    """Writes a made-up run and tells where."""

    def write(name: str = "run.mcap", steps: int = 60, **more: object) -> Path:
        path = tmp_path / name
        with made_up.recorder(path, **more) as recorder:
            for sample, truths in made_up.run(steps):
                recorder.write(sample, truths)
        return path

    return write
