"""Recording the guided postures by hand."""

import numpy as np
import pytest
from hydra import compose, initialize_config_dir

from cli.errors import UserError
from cli.guide import guide, write_guided
from imitation.robot import Body, JointReading


class HandledArm:
    """An arm that somebody moves 0.1 rad further each time it is asked for."""

    body = Body("handled", ("j",), *(np.zeros(1) for _ in range(4)))

    def __init__(self):
        self.limp, self.angle = False, 0.0

    def reset(self, posture): ...

    def move(self, velocity, grip, period):
        return velocity

    def read(self):
        assert self.limp, "postures are read while the arm is led"
        self.angle += 0.1
        return JointReading(np.array([self.angle]), np.zeros(1))

    def truth(self):
        return None

    def close(self): ...

    def go_limp(self):
        self.limp = True

    def go_stiff(self):
        self.limp = False


def test_postures_are_read_while_the_arm_is_limp_until_the_person_is_done():
    arm, answers = HandledArm(), iter(["", "", "", "", "done"])
    postures = guide(arm, "handled", lambda sentence: next(answers))
    assert postures.ravel() == pytest.approx([0.1, 0.2, 0.3, 0.4])
    assert not arm.limp


def test_done_before_three_postures_is_one_more_posture():
    arm, answers = HandledArm(), iter(["done", "", "", "done"])
    assert len(guide(arm, "handled", lambda sentence: next(answers))) == 3


def test_the_arm_is_stiff_again_when_the_person_gives_up():
    arm = HandledArm()

    def give_up(sentence):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        guide(arm, "handled", give_up)
    assert not arm.limp


def test_an_arm_that_cannot_be_made_limp_is_refused_with_the_way_out():
    class StiffArm:
        pass

    with pytest.raises(UserError, match=r"katana_sim cannot be made limp.*robot\.guided"):
        guide(StiffArm(), "katana_sim", lambda sentence: "")


def test_the_written_postures_compose_as_an_experiment(tmp_path):
    (tmp_path / "experiment").mkdir()
    write_guided(tmp_path / "experiment" / "by_hand.yaml", np.array([[0.1, -0.2], [0.3, 0.4]]))
    (tmp_path / "small.yaml").write_text(
        "defaults:\n  - experiment: by_hand\n  - _self_\nrobot:\n  name: any\n"
    )
    with initialize_config_dir(str(tmp_path), version_base="1.3"):
        assert compose("small").robot.guided == [[0.1, -0.2], [0.3, 0.4]]
