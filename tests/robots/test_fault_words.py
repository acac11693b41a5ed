"""Faults of emulated devices as people type them."""

import math

import pytest

from imitation.robots.faults import Fault, Kind, read_fault

KNOWN = {"silence": Kind("no reply"), "crashed_motor": Kind("motor WHICH collides", parts=6)}


@pytest.mark.parametrize(
    ("written", "fault"),
    [
        ("silence", Fault("silence", 0, 0.0, math.inf, math.inf)),
        ("silencex3", Fault("silence", 0, 0.0, math.inf, 3.0)),
        ("silence@1x3", Fault("silence", 0, 1.0, math.inf, 3.0)),
        ("crashed_motorx3", Fault("crashed_motor", 0, 0.0, math.inf, 3.0)),
        ("crashed_motor=6x3", Fault("crashed_motor", 6, 0.0, math.inf, 3.0)),
        ("crashed_motor=2@1-2.5x3", Fault("crashed_motor", 2, 1.0, 2.5, 3.0)),
    ],
)
def test_each_part_of_a_fault_may_be_left_out(written, fault):
    assert read_fault(written, KNOWN) == fault


@pytest.mark.parametrize(
    ("written", "told"),
    [
        ("crashed_motor@5-2", "ends before it begins; type crashed_motor@START-END"),
        ("crashed_motor@5-5", "ends before it begins"),
        ("crashed_motor=0", "type crashed_motor=1 to crashed_motor=6"),
        ("crashed_motor=7x2", "type crashed_motor=1 to crashed_motor=6"),
        (f"crashed_motor={'9' * 5000}", "type crashed_motor=1 to crashed_motor=6"),
        ("silence=2", "silence is of the whole device"),
        ("silence3", "no fault silence3"),
    ],
)
def test_a_fault_that_cannot_be_is_refused_with_what_it_may_be(written, told):
    with pytest.raises(ValueError, match=told):
        read_fault(written, KNOWN)
