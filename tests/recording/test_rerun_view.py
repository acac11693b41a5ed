import dataclasses
import io
import socket
from pathlib import Path

import made_up
import numpy as np
import pytest
import rerun as rr

from imitation.recording.rerun_view import LiveView, derive, screenshot
from imitation.recording.rerun_view.drawing import short
from imitation.robots.bullet import world

KATANA = (Path(world.__file__).parent / "katana_6m180.urdf").read_bytes()


@pytest.fixture
def derived(record, tmp_path):
    """Makes a run and its Rerun file, and tells the file and its entities."""

    def make(**more):
        rrd = tmp_path / "run.rrd"
        derive(record(**more).parent, rrd)
        chunks = rr.chunk.RrdReader(rrd).stream().to_chunks()
        return rrd, {chunk.entity_path for chunk in chunks}

    return make


def test_rerun_file_shows_camera_fields_curves_events_and_words(derived):
    rrd, entities = derived()
    assert rrd.stat().st_size > 10_000
    assert entities >= {
        "/camera/image",
        "/camera/areas",
        "/camera/hand",
        "/camera/true_hand",
        "/camera/target",
        "/fields/visual_input/tiles",
        "/fields/selection/tiles",
        "/fields/activation/tiles",
        "/curves/joints",
        "/curves/velocity",
        "/curves/distance",
        "/curves/dynamics/gain",
        "/curves/dynamics/noise_level",
        "/events",
        "/guard",
        "/guide",
        "/configuration",
    }


def test_arm_is_left_out_where_its_model_is_not_attached(derived):
    _, entities = derived()
    assert not any(entity.startswith("/arm") for entity in entities)


def test_arm_moves_where_its_model_is_attached(derived, monkeypatch):
    names = ("1_pan", "2_lift", "3_lift", "4_lift", "5_wrist_roll")
    joints = tuple(f"katana_motor{name}_joint" for name in names)
    body = dataclasses.replace(made_up.BODY, joint_names=joints)
    monkeypatch.setattr(made_up, "BODY", body)
    _, entities = derived(attachments={"katana_6m180.urdf": KATANA})
    assert "/arm/joints" in entities


def test_learned_places_of_an_attached_map_are_shown(derived):
    places = np.full((4, 5, 2, 2), np.nan)
    places[1, 2, 0] = 70.0, 45.0
    saved = io.BytesIO()
    np.savez(saved, places=places)
    _, entities = derived(attachments={"map.npz": saved.getvalue()})
    assert "/camera/learned_before" in entities


def test_a_demonstration_is_shown_beside_its_replay(record, tmp_path):
    path = record()
    derive(path.parent, tmp_path / "run.rrd", demonstration=path)
    chunks = rr.chunk.RrdReader(tmp_path / "run.rrd").stream().to_chunks()
    entities = {chunk.entity_path for chunk in chunks}
    assert {"/demonstration/image", "/demonstration/hand", "/camera/image"} <= entities


def test_cut_recording_is_shown_up_to_the_cut(record, tmp_path):
    path = record(steps=100)
    path.write_bytes(path.read_bytes()[:60_000])
    derive(path, tmp_path / "run.rrd")
    assert (tmp_path / "run.rrd").stat().st_size > 10_000


def test_a_view_that_was_not_finished_is_not_kept(record, tmp_path):
    path = record(attachments={"map.npz": b"no map"})
    with pytest.raises(ValueError, match="pickled"):
        derive(path, tmp_path / "run.rrd")
    assert not list(tmp_path.rglob("*.rrd"))


def test_recording_without_a_step_is_refused_in_one_sentence(tmp_path):
    made_up.recorder(tmp_path / "run.mcap").close()
    with pytest.raises(ValueError, match="holds no step"):
        derive(tmp_path, tmp_path / "run.rrd")


def test_time_is_the_run_s_own_clock(derived):
    rrd, _ = derived()
    chunks = rr.chunk.RrdReader(rrd).stream().filter(content="/curves/joints").to_chunks()
    timelines = {name for chunk in chunks for name in chunk.timeline_names}
    assert timelines == {"run_time"}


def test_joint_names_lose_the_words_they_share():
    assert short(["arm_pan_joint", "arm_lift_2_joint"]) == ["pan", "lift 2"]
    assert short(["joint1", "joint2"]) == ["joint1", "joint2"]
    assert short(["a", "a"]) == ["a", "a"]


def test_live_view_without_a_viewer_is_refused_in_one_sentence():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with pytest.raises(ValueError, match=f"rerun --bind 127.0.0.1 --port {port}"):
        LiveView(made_up.BODY, made_up.FIELD, {}, port)


@pytest.mark.slow
@pytest.mark.skipif(
    not any(Path("/usr/share/vulkan/icd.d").glob("*")), reason="needs a Vulkan renderer"
)
def test_a_screenshot_shows_the_end_or_the_time_asked_for(derived, tmp_path):
    rrd, _ = derived()
    for name, at in (("end", None), ("start", 0.0)):
        screenshot(rrd, tmp_path / f"{name}.png", at)
    end, start = ((tmp_path / f"{name}.png").read_bytes() for name in ("end", "start"))
    assert min(len(end), len(start)) > 50_000
    assert end != start
    with pytest.raises(ValueError, match="the run ends at"):
        screenshot(rrd, tmp_path / "late.png", 1e6)


@pytest.mark.slow
@pytest.mark.parametrize("told", ["warn", "error"])  # how much the viewer says
def test_screenshot_without_a_renderer_says_what_is_missing(derived, tmp_path, monkeypatch, told):
    monkeypatch.setenv("RUST_LOG", told)
    monkeypatch.setenv("VK_DRIVER_FILES", "/nowhere")
    monkeypatch.setenv("VK_ICD_FILENAMES", "/nowhere")
    rrd, _ = derived()
    with pytest.raises(RuntimeError, match="mesa-vulkan-drivers"):
        screenshot(rrd, tmp_path / "run.png")


def test_screenshot_of_nothing_is_refused(tmp_path):
    with pytest.raises(ValueError, match="no Rerun file"):
        screenshot(tmp_path / "run.rrd", tmp_path / "run.png")
