import json

import pytest
from small_files import files_up_to

from imitation.recording.json_file import write_json


def test_what_is_no_number_becomes_null(tmp_path):
    path = tmp_path / "told.json"
    write_json(path, {"a": float("nan"), "b": [1.5, float("inf")]})
    assert json.loads(path.read_text()) == {"a": None, "b": [1.5, None]}


def test_file_that_cannot_be_written_is_as_it_was(tmp_path):
    path = tmp_path / "told.json"
    write_json(path, {"steps": 3})
    with files_up_to(100), pytest.raises(OSError, match="File too large") as refused:
        write_json(path, {"steps": list(range(100))})
    assert refused.value.filename == str(path)
    assert json.loads(path.read_text()) == {"steps": 3}
    assert list(tmp_path.iterdir()) == [path]
