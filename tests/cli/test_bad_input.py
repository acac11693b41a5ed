"""Whatever a user gets wrong is said in one line, with exit code 2, and never a traceback."""

import json

import numpy as np
import pytest

from cli.errors import is_refusal

# what was typed, and words that the one line must hold
TYPED = [
    (["lern-map"], ["lern-map", "learn-map"]),
    (["nowhere"], ["no command nowhere", "learn-map, reach"]),
    (["--nope"], ["--nope", "imitate --help"]),
    (["inspect"], ["'RUN'", "type imitate inspect", "RUN"]),
    (["explain", "nowhere"], ["--at", "imitate explain --help"]),
    (["explain", "nowhere", "--at", "noon"], ["--at noon", "a valid number"]),
    (["export", "nowhere", "--to"], ["--to", "requires an argument"]),
    (["learn-map", "--multi"], ["--multi", "--multirun"]),
    (["learn-map", "seed"], ["KEY=VALUE", "seed"]),
    (["learn-map", "sede=1"], ["sede", "seed"]),
    (["learn-map", "robot.arm.sped=1"], ["robot.arm.sped", "robot.arm.speed"]),
    (["learn-map", "+robot.foo=1"], ["unknown key robot.foo"]),
    (["learn-map", "+robot.arm.foo=1"], ["unknown key robot.arm.foo"]),
    (
        ["mimic", "map=x", "demonstrator=trigger", "demonstrator.place=[200,75]"],
        ["outside", "0 to 160"],
    ),
    (["learn-map", "robot=idael"], ["idael", "did you mean ideal", "katana_sim"]),
    (["learn-map", "hydra/launcher=slurm"], ["slurm", "submitit_slurm"]),
    (["learn-map", "seed=abc"], ["seed=abc", "whole number"]),
    (["learn-map", "seed=-1"], ["seed=-1", "greater than or equal to 0"]),
    (["learn-map", "period=0"], ["period=0", "greater than or equal to 0.001"]),
    (["learn-map", "period=0.033"], ["period=0.033", "rate=250", "period=0.032"]),
    (["learn-map", "vision.hue=[0,400]"], ["vision.hue[1]=400", "179"]),
    (["learn-map", "camera.eye=[0,0]"], ["camera.eye", "3 items"]),
    (["learn-map", "recording.live=maybe"], ["recording.live=maybe", "true or false"]),
    (["learn-map", "robot=ideal", "recording.max_loss=0.01"], ["recording.max_loss=0.01"]),
    (["learn-map", "robot.guided=[[0,0],[1,1]]"], ["robot.guided[0] needs 5 numbers"]),
    (["learn-map", "robot.arm.force=[1]"], ["robot.arm.force needs 5 numbers"]),
    (["learn-map", "robot.arm.mark.radius=-1"], ["robot.arm.mark.radius=-1", "greater than 0"]),
    (["learn-map", "robot.arm.mark.link=x"], ["katana_6m180.urdf has no x", "gripper"]),
    (["learn-map", "robot.arm.gripper.palm=x"], ["katana_6m180.urdf has no x", "gripper"]),
    (["learn-map", "robot.arm.table.size=2"], ["robot.arm.table.size=2", "a list"]),
    (["learn-map", "robot=ideal", "robot.arm.mark.link=x"], ["no link x", "gripper"]),
    (["learn-map", "robot=ideal", "robot.arm.rate=1"], ["robot.arm.rate does not go with"]),
    (
        ["learn-map", "robot=ideal", "robot.guard.points=[]"],
        ["robot.guard.points=[]", "at least 1"],
    ),
    (["learn-map", "robot=ideal", "robot.guard.margin=5"], ["margin=5", "no room"]),
    (["learn-map", "robot.arm._target_=nowhere.arm"], ["nowhere.arm"]),
    (["learn-map", "fault.lasts=1"], ["fault.lasts does not go with", "fault= of", "camera_gone"]),
    (["learn-map", "fault="], ["no fault without a name", "camera_gone"]),
    (["learn-map", "--seed", "1"], ["--seed", "seed=VALUE"]),
    (["learn-map", "experiment=mimicry_controls"], ["mimicry_controls", "learn-map lacks"]),
    (["learn-map", "seed=0,1"], ["several values", "-m"]),
    (["learn-map", "seed=[1"], ["seed=[1", "quotes"]),
    (["learn-map", "~seed"], ["seed is missing"]),
    (["learn-map", "-m", "--cfg", "job"], ["-m", "--cfg"]),
    (["learn-map", "--cfg", "jb"], ["job, hydra, all", "jb"]),
    (["learn-map", "--cfg"], ["--cfg needs a value"]),
    (["learn-map", "--config-dir", "nowhere"], ["nowhere"]),
    (["learn-map", "-m", "sede=0,1"], ["sede", "seed"]),
    (["learn-map", "-m", "seed=0,1", "out=a,b"], ["out=a,b", "one folder"]),
    (["reach"], ["reach needs map", "map.npz", "map=MAP"]),
    (["reach", "map=nowhere"], ["nowhere", "imitate learn-map"]),
    (["reach", "map=nowhere", "controller=yuragy"], ["yuragy", "yuragi"]),
    (["reach", "map=nowhere", "target=there"], ["target=there", "random"]),
    (["reach", "map=nowhere", "target=[1,2,3]"], ["target=", "2 items"]),
    (["reach", "map=nowhere", "trials=0"], ["trials=0"]),
    (["reach", "map=nowhere", "reach.after=never"], ["stop", "hold"]),
    (["reach", "map=nowhere", "experiment=as_prnted"], ["as_prnted", "did you mean as_printed"]),
    (["learn-map", "experiment=as_printed"], ["as_printed", "does not fit learn-map"]),
    (["reach", "map=nowhere", "field=right"], ["field=right", "right_3x3"]),
    (["figure", "fig33"], ["fig33", "fig3"]),
    (["figure", "fig3a", "figure.fig3a.path=3"], ["figure.fig3a.paths"]),
    (["figure", "fig3a", "figure=fig1"], ["fig3a", "leave", "figure= out"]),
    (["demo"], ["did you mean demo-record? choose from demo-record, learn-map"]),
    (["reach", "map=nowhere", "fault=nonsense"], ["no fault nonsense; choose from camera_black"]),
    (["reach", "map=nowhere", "fault=camera"], ["did you mean camera_black?"]),
    (["reach", "map=nowhere", "beta=2"], ["did you mean dynamics.beta?"]),
    (["view", "nowhere"], ["nowhere"]),
    (["view", "nowhere", "--at", "1"], ["--screenshot FILE --at SECONDS"]),
]


def one_line(result, *expected):
    assert result.exit_code == 2
    assert result.stderr.count("\n") == 1, result.stderr
    assert "Traceback" not in result.output
    for words in expected:
        assert words in result.stderr


@pytest.mark.parametrize(("typed", "expected"), TYPED, ids=lambda part: " ".join(part))
def test_is_said_in_one_line(imitate, tmp_path, typed, expected):
    one_line(imitate(*typed), *expected)
    assert not list(tmp_path.rglob("run.mcap"))


def test_a_yaml_error_names_file_and_line(imitate, tmp_path):
    broken = tmp_path / "mine" / "robot" / "broken.yaml"
    broken.parent.mkdir(parents=True)
    broken.write_text("name: broken\narm: [1\n")
    result = imitate("learn-map", "robot=broken", "--config-dir", "mine")
    one_line(result, "broken.yaml, line 3", "not valid YAML")


def test_the_nearest_choice_may_be_a_users_own(imitate, tmp_path):
    own = tmp_path / "mine" / "robot" / "gripling.yaml"
    own.parent.mkdir(parents=True)
    own.write_text("name: gripling\n")
    result = imitate("learn-map", "robot=gripln", "--config-dir", "mine")
    one_line(result, "did you mean gripling?", "katana_sim")


def test_a_folder_that_cannot_be_written_is_refused(imitate, tmp_path):
    (tmp_path / "file").write_text("")
    one_line(imitate("learn-map", "robot=ideal", "out=file"), "out=", "is a file")
    one_line(imitate("learn-map", "robot=ideal", "out=file/run"), "out=", "cannot be made")


def test_a_run_is_never_written_over(imitate, learned):
    before = (learned / "run.mcap").read_bytes()
    result = imitate("learn-map", "robot=ideal", f"out={learned}")
    one_line(result, "holds a run already", f"out={learned}-2")
    assert (learned / "run.mcap").read_bytes() == before


@pytest.mark.parametrize(
    ("name", "content"),
    [("empty.npz", b""), ("foreign.npz", b"what is this?"), ("cut.npz", None)],
)
def test_a_file_that_is_no_map_is_refused(imitate, tmp_path, learned, name, content):
    whole = (learned / "map.npz").read_bytes()
    (tmp_path / name).write_bytes(whole[: len(whole) // 2] if content is None else content)
    one_line(imitate("reach", "robot=ideal", f"map={name}"), name, "no map")


def test_the_map_of_another_arm_is_refused_with_the_reason(imitate, tmp_path, learned):
    with np.load(learned / "map.npz") as stored:
        arrays = dict(stored)
    facts = json.loads(str(arrays["facts"]))
    facts["fingerprint"]["arm"] = "another"
    np.savez(tmp_path / "map.npz", **{**arrays, "facts": np.array(json.dumps(facts))})
    one_line(imitate("reach", "robot=ideal", "map=map.npz"), "another", "katana_6m180", "robot=")


def test_another_field_than_the_maps_is_refused(imitate, learned):
    result = imitate("reach", "robot=ideal", f"map={learned}", "field=right_3x3")
    one_line(result, "right_3x3", "right_4x4")


def test_an_area_beside_a_target_is_refused(imitate, learned):
    result = imitate("reach", "robot=ideal", f"map={learned}", "target=[90,60]", "area=[1,2]")
    one_line(result, "area=[1, 2]", "target=[90, 60]", "one of them")


def test_a_target_outside_the_learned_region_is_refused_unless_forced(imitate, learned):
    words = ["reach", "robot=ideal", f"map={learned}", "target=[2,2]", "reach.limit=1"]
    one_line(imitate(*words), "outside", "reach.force=true")
    assert imitate(*words, "reach.force=true").exit_code == 1


def test_an_area_that_is_not_learned_is_refused(imitate, learned):
    one_line(imitate("reach", "robot=ideal", f"map={learned}", "area=[0,0]"), "not learned")
    one_line(imitate("reach", "robot=ideal", f"map={learned}", "area=[9,0]"), "rows are 0..3")


def test_a_check_is_told_from_a_bug():
    def refuse():
        raise ValueError("no map there")

    for function, refused in ((refuse, True), (lambda: np.zeros(2) + np.zeros(3), False)):
        try:
            function()
        except ValueError as error:
            assert is_refusal(error) is refused


def test_no_red_thing_in_view_is_said_and_its_map_is_refused(imitate, tmp_path):
    unseen = ("robot=ideal", "vision.hue=[80,100]", "learning.patience=2")
    result = imitate("learn-map", *unseen, f"out={tmp_path / 'empty'}")
    assert result.exit_code == 1
    assert "the hand was never seen" in result.stderr
    assert "next   imitate view" in result.stdout
    result = imitate("mimic", f"map={tmp_path / 'empty'}", "robot=ideal")
    one_line(result, "holds no learned area")


@pytest.mark.parametrize("name", ["x" * 5000, "file/run", "./" * 3000])
@pytest.mark.parametrize("command", ["inspect", "verify", "recover", "view"])
def test_a_place_that_cannot_be_is_said_in_one_line(imitate, tmp_path, command, name):
    (tmp_path / "file").write_text("")
    one_line(imitate(command, name))
