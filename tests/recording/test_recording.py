import json

import made_up
import numpy as np
import pytest

from imitation.recording import messages
from imitation.recording.mcap_recording import Recording


def test_recording_gives_back_what_was_attached(record):
    recording = Recording.open(record(attachments={"config.yaml": b"a: 1\n", "map.npz": b"\0\1"}))
    assert recording.whole
    assert recording.attachments == {"config.yaml": b"a: 1\n", "map.npz": b"\0\1"}
    assert recording.metadata["run"] == {"command": "reach", "seed": "0"}


def test_recording_of_a_run_folder_is_its_run_mcap(record):
    path = record()
    assert Recording.open(path.parent).path == path


def test_entries_of_arrays_have_names(record):
    topics = Recording.open(record()).topics
    assert topics["/dynamics"].names == ("gain", "noise level", "distance")
    assert topics["/attractors/pull"].names == made_up.BODY.joint_names
    assert topics["/visual_input"].names[6] == "area 1,1"


def test_arrays_have_the_shape_of_their_layout(record):
    recording = Recording.open(record(steps=12))
    (sample, _), *_ = made_up.run(1)
    _, message = next(recording.messages("/selection"))
    assert np.array_equal(messages.array(message), sample.decision.selection)
    assert [dim.label for dim in message.layout.dim] == ["rows", "columns"]


def test_posture_is_told_only_where_an_attractor_is_not_in_the_map(record):
    times = [time_ns for time_ns, _ in Recording.open(record()).messages("/attractors/posture")]
    assert times == [step * made_up.PERIOD_NS for step in range(0, 60, 10)]


def test_hand_is_told_only_when_seen(record):
    times = [time_ns for time_ns, _ in Recording.open(record()).messages("/hand")]
    assert len(times) == 59 and 49 * made_up.PERIOD_NS not in times


def test_missing_numbers_are_nan(record):
    distances = [m.data[2] for _, m in Recording.open(record()).messages("/dynamics")]
    assert np.isnan(distances[49]) and np.isfinite(distances[48])


def test_stored_digest_is_that_of_the_content(record):
    recording = Recording.open(record())
    assert recording.recomputed_digest() == recording.digest()
    assert set(recording.digest()) > {
        *recording.topics,
        "all",
        "record:run",
        "attachment:config.yaml",
    }


def test_digest_changes_with_the_content(record):
    one, other = (
        Recording.open(record("a.mcap", steps=30)),
        Recording.open(record("b.mcap", steps=31)),
    )
    assert one.digest()["/hand"] != other.digest()["/hand"]


@pytest.mark.parametrize("share", [0.03, 0.2, 0.5, 0.99])
def test_cut_file_is_read_up_to_the_cut(record, share):
    path = record(steps=100)
    whole = path.read_bytes()
    path.write_bytes(whole[: int(share * len(whole))])
    recording = Recording.open(path)
    assert not recording.whole
    assert recording.attachments["config.yaml"]
    steps = sum(1 for _ in recording.messages("/joint_states"))
    assert share * 100 - 26 <= steps <= 100


@pytest.mark.parametrize("cut", [0, 1, 8, 20, 60])
def test_file_cut_in_its_first_bytes_is_refused_in_one_sentence(record, cut):
    path = record()
    path.write_bytes(path.read_bytes()[:cut])
    with pytest.raises(ValueError, match="no recording"):
        Recording.open(path)


def test_foreign_file_is_refused_in_one_sentence(tmp_path):
    path = tmp_path / "run.mcap"
    path.write_text(json.dumps({"a": 1}))
    with pytest.raises(ValueError, match="not an MCAP file"):
        Recording.open(path)


def test_missing_file_is_refused_in_one_sentence(tmp_path):
    with pytest.raises(ValueError, match="no recording at"):
        Recording.open(tmp_path)


def test_damaged_chunk_is_refused_in_one_sentence(record):
    path = record()
    data = bytearray(path.read_bytes())
    data[10_000] ^= 0xFF
    path.write_bytes(data)
    with pytest.raises(ValueError, match=r"damaged at 0.00 s"):
        list(Recording.open(path).messages("/hand"))
