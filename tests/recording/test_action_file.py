"""An action survives its file, and whatever is edited into nonsense is refused with its line."""

import json
import re

import numpy as np
import pytest

from imitation.recording.action_file import Action, load_action, save_action
from imitation.visual_field import VisualField
from imitation.visual_states import VisualState

FIELD = VisualField("right_4x4", (160, 120), rows=4, columns=4, left=40.0)
STATES = (
    VisualState((1, 0), np.array([22.504, 44.0]), 0.2),
    VisualState((1, 2), np.array([85.126, 47.25]), 2.04),
    VisualState((3, 4), np.array([150.0, 119.5]), 3.88),
)
# Line in the file below, what it becomes, and what the error says beside the line's number.
EDITED = [
    (2, '"version": 7,', "version is 7"),
    (6, '"rows": 0,', "rows is 0; wanted a whole number from 1"),
    (6, '"rows": 2.5,', "rows is 2.5; wanted a whole number"),
    (6, '"rows": true,', "rows is true"),
    (9, '"size_px": [160]', "size_px is a list of 1 values; wanted a list of 2"),
    (13, '"area": [9, 0],', r"area\[0\] is 9; wanted a whole number from 0 to 3"),
    (13, '"area": [1, 5],', r"area\[1\] is 5; wanted a whole number from 0 to 4"),
    (13, '"area": "left",', 'area is "left"; wanted a list of 2 values'),
    (14, '"centre_px": [21, 45],', r"centre_px is \[21.0, 45.0\], but area \[1, 0\] .* \[20, 45\]"),
    (15, '"seen_px": [22.5, 130],', r"seen_px\[1\] is 130; wanted a number from 0 to 120"),
    (15, '"seen_px": [NaN, 44],', r"seen_px\[0\] is NaN; wanted a number"),
    (15, '"seen_px": [1e999, 44],', r"seen_px\[0\] is Infinity"),
    (15, '"seen_px": [150, 44],', r"seen_px is .*area \[1, 0\] is x 0 to 40.*agree"),
    (15, '"seen_px": null,', "seen_px is null; wanted a list"),
    (15, '"seen_pxl": [22.5, 44],', "unknown key seen_pxl; the keys are area, seen_px"),
    (17, '"delay_s": 3.0', "delay_s is 3.0; nothing comes before the first state"),
    (23, '"time_s": 0.1,', "time_s is 0.1; the state before comes at 0.2 s"),
    (23, '"time_s": 2.5,', "time_s is 2.5, but the delays until here say 2.04"),
    (23, '"time_s": "soon",', 'time_s is "soon"; wanted a number'),
    (24, '"delay_s": -1', "delay_s is -1; wanted a number from 0.2 to 20"),
    (24, '"delay_s": 100', "delay_s is 100; wanted a number from 0.2 to 20"),
    (24, '"delay_s": 1' + 400 * "0", "delay_s is 1000"),
    (24, '"delay_s" 1.84', "not valid JSON: Expecting ':' delimiter"),
    (24, '"delay_s": 1.84, "delay_s": 1.84', "delay_s is said a second time"),
    (24, '"area": [1, 2]', "area is said a second time"),
]


@pytest.fixture
def file(tmp_path):
    save_action(tmp_path / "action.json", Action(FIELD, STATES), "imitate 1.0")
    return tmp_path / "action.json"


def load(file):
    return load_action(file, shortest=0.2, longest=20.0)


def edit(file, number, becomes):
    """Replace a line, counted from 1."""
    lines = file.read_text().split("\n")
    lines[number - 1] = becomes
    file.write_text("\n".join(lines))


def test_an_action_survives_its_file(file):
    read = load(file.parent)
    assert read.field == FIELD
    assert [state.area for state in read.states] == [state.area for state in STATES]
    assert [state.time for state in read.states] == pytest.approx([0.2, 2.04, 3.88])
    assert read.states[1].place == pytest.approx([85.13, 47.25])


def test_a_rest_on_a_border_is_told_within_its_area():
    at_border, inside = np.array([99.4, 60.5]), np.array([52.0, 75.0])
    states = VisualState((1, 3), at_border, 0.0), VisualState((2, 1), inside, 1.0)
    told = [state.place.tolist() for state in Action.watched(FIELD, states, 2.0).states]
    assert told == [[102.0, 58.0], [52.0, 75.0]]


def test_the_file_holds_what_the_contract_says(file):
    told = json.loads(file.read_text())
    assert told["states"][1] == {
        "area": [1, 2],
        "centre_px": [85.0, 45.0],
        "seen_px": [85.13, 47.25],
        "time_s": 2.04,
        "delay_s": 1.84,
    }
    assert told["states"][0]["delay_s"] == 0
    assert told["made_by"] == "imitate 1.0"


def test_a_person_reads_one_value_a_line(file):
    lines = file.read_text().split("\n")
    assert '      "area": [1, 2],' in lines
    assert max(map(len, lines)) < 60


def refused(file, says):
    with pytest.raises(ValueError, match=rf"action\.json, {says}"):
        load(file)


@pytest.mark.parametrize(("number", "becomes", "says"), EDITED)
def test_nonsense_is_refused_with_its_line(file, number, becomes, says):
    edit(file, number, becomes)
    refused(file, f"line {number}: {says}")


def test_an_area_that_is_no_longer_where_its_centre_says_is_refused(file):
    edit(file, 13, '"area": [1, 1],')
    refused(
        file, r"line 14: centre_px is .*area \[1, 1\] is centred at \[55, 45\].*leave centre_px"
    )


@pytest.mark.parametrize("number", [20, 22])
def test_a_state_that_lacks_what_is_replayed_is_refused_where_it_begins(file, number):
    edit(file, number, "")
    refused(file, r"line 19: states\[1\] that begins here lacks")


def test_what_follows_from_the_rest_may_be_left_out(file):
    lines = file.read_text().split("\n")
    kept = [line for line in lines if not re.search("centre_px|time_s|made_by", line)]
    file.write_text("\n".join(kept).replace("1.84", "3.5"))
    assert [state.time for state in load(file).states] == [0.0, 3.5, 7.0]


def test_an_action_of_one_state_is_refused(file):
    save_action(file, Action(FIELD, STATES[:1]), "imitate 1.0")
    refused(file, "line 11: states is a list of 1 values; an action has 2 states or more")


@pytest.mark.parametrize("text", ["", "[]", "3", "what is this?", "[" * 100_000, "9" * 5000, "{}"])
def test_another_text_is_refused(file, text):
    file.write_text(text)
    refused(file, "line 1: ")


def test_what_is_no_text_or_too_large_or_not_there_is_refused(file, tmp_path):
    file.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ValueError, match="no text"):
        load(file)
    file.write_text(" " * 2**18 + "{}")
    with pytest.raises(ValueError, match="too large"):
        load(file)
    with pytest.raises(ValueError, match="imitate demo-record"):
        load(tmp_path / "nowhere")
