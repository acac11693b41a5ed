"""Every run is decided anew to the last bit, and nothing in a recording can be changed unseen."""

import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from tampering import counts, rewrite

from cli.verify import verify
from imitation.analysis.comparison import Comparison
from imitation.recording import messages
from imitation.recording.mcap_recording import Recording

PLACES = 3  # that are changed on each topic
REACH = ("reach", "robot=ideal", "reach.limit=1", "reach.required=0", "trials=2")
CONTROLLERS = ("corrected_aim", "yuragi", "noise", "nearest")


@pytest.fixture(scope="module")
def reached(learned, tmp_path_factory):
    """Two short trials of reaching: not to be changed."""
    from typer.testing import CliRunner

    from cli.main import app

    folder = tmp_path_factory.mktemp("reached") / "run"
    told = CliRunner().invoke(app, [*REACH, "controller=yuragi", f"map={learned}", f"out={folder}"])
    assert told.exit_code == 0, told.output
    return folder


def test_learning_is_the_same_bit_for_bit(imitate, learned):
    told = imitate("verify", str(learned))
    assert told.exit_code == 0, told.output
    assert "the same, bit for bit" in told.stdout
    assert "matches the content" in told.stdout


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_reaching_is_the_same_bit_for_bit(imitate, learned, controller):
    imitate(*REACH, f"controller={controller}", f"map={learned}", "seed=4", "out=run")
    told = imitate("verify", "run")
    assert told.exit_code == 0, told.output


@pytest.mark.parametrize(
    "words", [("camera.delay_frames=4",), ("experiment=as_printed",), ("vision=skin",)]
)
def test_reaching_in_other_ways_is_the_same_bit_for_bit(imitate, learned, words):
    imitate(*REACH, f"map={learned}", *words, "out=run")
    told = imitate("verify", "run")
    assert told.exit_code == 0, told.output


@pytest.mark.parametrize("words", [("selection=soft",), ("demonstrator=square", "seed=2")])
def test_mimicking_is_the_same_bit_for_bit(imitate, learned, words):
    imitate("mimic", "robot=ideal", f"map={learned}", "duration=4", *words, "out=run")
    told = imitate("verify", "run")
    assert told.exit_code == 0, told.output


def test_watching_is_the_same_bit_for_bit(imitate):
    imitate("demo-record", "robot=ideal", "demo.duration=6", "out=run")
    told = imitate("verify", "run")
    assert told.exit_code == 0, told.output


def test_replaying_is_the_same_bit_for_bit(imitate, learned):
    imitate("demo-record", "robot=ideal", "out=action")
    words = ("robot=ideal", f"map={learned}", "action=action", "replay.limit=8", "out=run")
    imitate("replay", *words)
    told = imitate("verify", "run")
    assert told.exit_code == 0, told.output
    assert Recording.open(Path("run")).attachments.keys() >= {"map.npz", "action.json"}


def test_a_device_that_failed_is_no_decision(reached):
    from imitation.recording.step_messages import event_message
    from imitation.sample import Event

    failed = event_message(0, Event("device", "the arm is silent"))
    told = Comparison(Recording.open(reached).topics)
    told.add([failed], [])
    assert told.first is None


def test_what_a_film_shows_is_the_same_bit_for_bit(imitate, tmp_path):
    from made_up_films import film

    film(tmp_path / "film.mp4", frames=40)
    words = ("robot=ideal", "camera=video", "camera.path=film.mp4", "vision.min_pixels=1")
    imitate("demo-record", *words, "out=run")
    assert "CompressedImage" in imitate("inspect", "run").stdout
    told = imitate("verify", "run")
    assert told.exit_code == 0, told.output


def test_what_a_live_camera_shows_is_the_same_bit_for_bit(imitate, learned, tmp_path):
    from made_up_films import film

    film(tmp_path / "film.mp4", frames=60)
    words = ("camera=webcam", "camera.device=film.mp4", "duration=1")
    told = imitate("mimic", "robot=ideal", f"map={learned}", *words, "out=run")
    assert "steps a second" in told.stdout, told.output
    told = imitate("verify", "run")
    assert told.exit_code == 0, told.output


@pytest.mark.slow
def test_runs_in_the_engine_are_the_same_bit_for_bit(imitate):
    imitate("learn-map", "out=map")
    imitate("reach", "map=map", "trials=2", "controller=yuragi", "reach.limit=8", "out=run")
    for run in ("map", "run"):
        assert imitate("verify", run).exit_code == 0


def places():
    """One after the other on each topic of a run of reaching."""
    return [(topic, number) for topic in TOPICS for number in range(PLACES)]


TOPICS = (
    *("/camera/image", "/camera/used", "/joint_states", "/gaze", "/gripper", "/hand"),
    *("/hand/noise", "/visual_input", "/target", "/selection", "/attractors/index"),
    *("/attractors/activation", "/attractors/pull", "/dynamics", "/dynamics/noise"),
    *("/joint_command/requested", "/joint_command/limited", "/joint_command/sent"),
    *("/events", "/truth/hand"),
)


def changed(told, rng):
    """A message with one number, byte or letter of it changed; None when it holds none."""
    kind = told.__msgtype__
    if kind == messages.IMAGE:
        data = told.data.copy()
        data[rng.integers(data.size)] ^= 1
        told.data = data
    elif kind == messages.JOINT_STATE:
        part = "position" if told.position.size and rng.random() < 0.5 else "velocity"
        setattr(told, part, _nudged(getattr(told, part), rng))
    elif kind in (messages.FLOATS, messages.INTEGERS):
        if not told.data.size:
            return None
        told.data = _nudged(told.data, rng)
    elif kind == messages.POINT:
        told.point.x = float(np.nextafter(told.point.x, 1e9))
    elif kind == messages.HEADER:
        told.stamp.nanosec ^= 1
    elif kind == messages.LOG:
        told.msg = told.msg[:-2] + ("0" if told.msg[-2] != "0" else "1") + told.msg[-1]
    return messages.serialised(told)


def _nudged(values, rng):
    values = values.copy()
    at = rng.integers(values.size)
    old = values[at]
    whole = values.dtype.kind == "i"
    values[at] = old + 1 if whole else (np.nextafter(old, 1e9) if np.isfinite(old) else 0.0)
    return values


def test_the_topics_that_are_changed_are_all_there_are(reached):
    assert set(TOPICS) == set(counts(reached / "run.mcap"))
    assert len(places()) >= 50


@pytest.mark.parametrize(("topic", "number"), places())
def test_a_change_is_found_with_its_topic_and_time(reached, tmp_path, capsys, topic, number):
    rng = np.random.default_rng([TOPICS.index(topic), number])
    recording = Recording.open(reached)
    wanted = int(rng.integers(counts(reached / "run.mcap")[topic]))
    when = []

    def change(name, count, data):
        if name != topic or count < wanted or when:
            return data
        other = changed(messages.decoded(data, recording.topics[topic].type), rng)
        if other is None:
            return data
        when.append(count)
        return other

    rewrite(reached / "run.mcap", tmp_path / "run.mcap", change)
    times = [time_ns / 1e9 for time_ns, _ in recording.messages(topic)]
    assert verify(tmp_path) == 1
    told = capsys.readouterr().err
    first = told.splitlines()[0]
    assert f"{topic} was changed" in first
    start, end = (float(word) for word in first.split()[-4:-1:2])
    assert start <= round(times[when[0]], 2) <= end


def test_a_changed_decision_is_told_with_time_term_and_size(reached, tmp_path, capsys):
    def change(topic, number, data):
        if topic != "/dynamics" or number != 10:
            return data
        told = messages.decoded(data, messages.FLOATS)
        told.data = told.data + np.array((0.5, 0, 0))
        return messages.serialised(told)

    rewrite(reached / "run.mcap", tmp_path / "run.mcap", change)
    assert verify(tmp_path) == 1
    told = capsys.readouterr().err
    assert "at 0.400 s on /dynamics, gain: recorded " in told
    assert "off by 0.5" in told


@pytest.mark.parametrize("sealed", [False, True])
def test_rewriting_without_a_change_breaks_nothing(reached, tmp_path, sealed):
    rewrite(reached / "run.mcap", tmp_path / "run.mcap", sealed=sealed)
    assert verify(tmp_path) == 0
    assert Recording.open(tmp_path).digest() == Recording.open(reached).digest()


@pytest.mark.parametrize("name", ["config.yaml", "map.npz", "katana_6m180.urdf"])
def test_a_changed_attachment_is_found(reached, tmp_path, capsys, name):
    def attach(one, data):
        return data.replace(b"5", b"6", 1) if one == name else data

    rewrite(reached / "run.mcap", tmp_path / "run.mcap", attach=attach)
    assert verify(tmp_path) == 1
    told = capsys.readouterr()
    assert f"the attachment {name} was changed after it was written" in told.err
    assert "does not match the content" in told.out


@pytest.mark.parametrize(("name", "key"), [("run", "seed"), ("field", "x_edges_px")])
def test_a_changed_record_is_found(reached, tmp_path, capsys, name, key):
    def tell(one, told):
        return told | {key: told[key] + "1"} if one == name else told

    rewrite(reached / "run.mcap", tmp_path / "run.mcap", tell=tell)
    assert verify(tmp_path) == 1
    assert f"the record {name} was changed after it was written" in capsys.readouterr().err


def test_a_cut_recording_has_a_digest_of_its_attachments_too(imitate, reached, tmp_path):
    rewrite(reached / "run.mcap", tmp_path / "x.mcap", attach=lambda name, data: data + b"\n")
    whole = (tmp_path / "x.mcap").read_bytes()
    (tmp_path / "x.mcap").write_bytes(whole[: 4 * len(whole) // 5])
    told = imitate("verify", "x.mcap")
    assert told.exit_code == 1 and "the attachment config.yaml was changed" in told.stderr
    (tmp_path / "x.mcap").write_bytes((reached / "run.mcap").read_bytes()[: 4 * len(whole) // 5])
    assert imitate("verify", "x.mcap").exit_code == 0


def by_another(reached, target, config=lambda text: text, **record):
    """A sound recording that another program made."""
    rewrite(
        reached / "run.mcap",
        target,
        attach=lambda name, data: config(data) if name == "config.yaml" else data,
        tell=lambda name, told: told | record if name == "run" else told,
        sealed=True,
    )


def test_a_recording_of_another_version_is_told_with_what_to_do(imitate, reached, tmp_path):
    for record, todo in (
        ({"version": "9.1", "git_revision": ""}, "emergent-imitation-bench==9.1"),
        ({"version": "9.1", "git_revision": "0123456789abcdef"}, "git checkout 0123456789ab"),
    ):
        target = tmp_path / "newer.mcap"
        by_another(reached, target, lambda text: text + b"novelty: 3\n", **record)
        for words in (
            ["verify"],
            ["explain", "--at", "0.5"],
            ["verify", "--with", "dynamics.beta=3"],
        ):
            told = imitate(words[0], str(target), *words[1:])
            assert told.exit_code == 2 and len(told.stderr.splitlines()) == 1, told.output
            assert "recorded by version 9.1" in told.stderr and todo in told.stderr
            assert "unknown key novelty" in told.stderr
        assert imitate("inspect", str(target)).exit_code == 0


def test_another_revision_that_decides_alike_is_only_mentioned(imitate, reached, tmp_path):
    by_another(reached, tmp_path / "other.mcap", git_revision="0123456789abcdef", git_dirty="false")
    told = imitate("verify", "other.mcap")
    assert told.exit_code == 0 and "at 0123456789ab" in told.stdout


def test_another_revision_that_decides_otherwise_is_named_as_a_cause(imitate, reached, tmp_path):
    def steeper(text):
        return text.replace(b"beta: 2.0", b"beta: 3.0")

    by_another(reached, tmp_path / "other.mcap", steeper, git_revision="0123456789abcdef")
    told = imitate("verify", "other.mcap")
    assert told.exit_code == 1
    assert "what differs may be the program: it was recorded by version" in told.stderr


def test_learning_from_postures_led_to_by_hand_is_the_same_bit_for_bit(imitate, monkeypatch):
    from cli.build import Bench
    from cli.experiments import composed

    led = Bench(composed("learn-map", "robot=ideal")).guided + 0.01
    monkeypatch.setattr("cli.jobs.learn_map.guide", lambda arm, robot, ask: led)
    told = imitate("learn-map", "robot=ideal", "guide=true", "learning.patience=2", "out=run")
    assert told.exit_code in (0, 1), told.output
    assert imitate("verify", "run").exit_code == 0
    assert Path("run/guided.yaml").is_file()


def test_what_if_tells_differences_and_records_them(imitate, reached, tmp_path):
    run = tmp_path / "run"
    shutil.copytree(reached, run)
    told = imitate("verify", str(run), "--with", "dynamics.beta=9", "--with", "dynamics.tau=0.2")
    assert told.exit_code == 1, told.output
    assert "/joint_command/requested" in told.stdout and "/dynamics " not in told.stdout
    assert "rad/s" in told.stdout
    first, second = Recording.open(run), Recording.open(run / "what-if.mcap")
    assert second.whole and second.metadata["run"]["what_if"] == "dynamics.beta=9 dynamics.tau=0.2"
    for topic, same in (("/joint_states", True), ("/joint_command/requested", False)):
        assert (first.digest()[topic] == second.digest()[topic]) is same
    # What if is a run like others: it verifies, and nothing is written over.
    assert imitate("verify", str(run / "what-if.mcap")).exit_code == 0
    assert imitate("verify", str(run), "--with", "dynamics.beta=9").exit_code == 1
    assert (run / "what-if-2.mcap").is_file()


def test_what_if_with_the_same_parameters_changes_nothing(imitate, reached, tmp_path):
    shutil.copytree(reached, tmp_path / "run")
    told = imitate("verify", "run", "--with", "controller=yuragi")
    assert told.exit_code == 0, told.output
    assert "the same, bit for bit" in told.stdout


def test_what_if_goes_on_where_an_episode_would_last_longer_or_end_sooner(imitate, reached):
    run = reached.parent / "copy"
    shutil.copytree(reached, run)
    for limit, word in (("0.5", "goes on"), ("2", "is over")):
        told = imitate("verify", str(run), "--with", f"reach.limit={limit}")
        assert told.exit_code == 1 and word in told.stdout, told.output


@pytest.mark.parametrize(
    ("word", "told"),
    [
        ("camera.noise_px=2", "made the senses"),
        ("period=0.02", "made the senses"),
        ("dynamics.betta=2", "did you mean dynamics.beta"),
        ("controller=yuragy", "choose from"),
        ("dynamics.beta", "expected KEY=VALUE"),
        ("dynamics.beta=-1", "greater than 0"),
        ("target=[", "cannot be read"),
    ],
)
def test_a_bad_what_if_is_one_line(imitate, reached, word, told):
    result = imitate("verify", str(reached), "--with", word)
    assert result.exit_code == 2
    assert told in result.stderr and len(result.stderr.splitlines()) == 1


def test_nothing_that_a_recording_names_is_called_unless_we_know_it(imitate, reached, tmp_path):
    from mcap.writer import Writer

    recorded = Recording.open(reached).attachments["config.yaml"]
    config = re.sub(rb"_target_: imitation.vision\S*", b"_target_: os.system", recorded)
    with (tmp_path / "bad.mcap").open("wb") as stream:
        writer = Writer(stream)
        writer.start(profile="ros2")
        writer.add_metadata("run", {"command": "reach"})
        writer.add_metadata("field", {})
        writer.add_attachment(0, 0, "config.yaml", "", config)
        schema = writer.register_schema("std_msgs/msg/Header", "ros2msg", b"")
        writer.add_message(writer.register_channel("/camera/used", "cdr", schema), 0, b"", 0)
        writer.finish()
    result = imitate("verify", str(tmp_path / "bad.mcap"))
    assert result.exit_code == 2
    assert "os.system is no part of this program" in result.stderr


def test_one_with_takes_several_parameters_and_none_stands_alone(imitate, reached, tmp_path):
    shutil.copytree(reached, tmp_path / "run")
    told = imitate("verify", "run", "--with", "dynamics.beta=9", "dynamics.tau=0.2")
    assert "what if: dynamics.beta=9 dynamics.tau=0.2" in told.stdout, told.output
    alone = imitate("verify", "run", "dynamics.beta=9")
    assert alone.exit_code == 2 and "type --with dynamics.beta=9" in alone.stderr
