"""When control steps begin."""

import time

from imitation.clock import SimulatedClock, WallClock

PERIOD_NS = 10_000_000


def test_simulated_time_is_a_period_a_tick_whatever_the_wall_says():
    clock = SimulatedClock(PERIOD_NS)
    times = [clock.begin(), clock.tick(), clock.tick(), clock.begin(), clock.tick()]
    assert times == [PERIOD_NS * n for n in range(5)]
    assert clock.late == 0


def test_real_time_begins_at_0_and_ticks_at_deadlines():
    clock = WallClock(PERIOD_NS)
    assert clock.begin() == 0
    for number in range(1, 11):
        time.sleep(0.003)  # work of another length at each step does not add up
        assert PERIOD_NS * number <= clock.tick()
    assert clock.tick() < PERIOD_NS * 13 or clock.late


def test_a_step_that_takes_too_long_is_late_once_and_the_next_keep_to_the_grid():
    clock = WallClock(PERIOD_NS)
    clock.begin()
    time.sleep(0.035)
    late = clock.tick()
    assert clock.late == 1
    assert late >= 35_000_000
    assert clock.tick() >= 10_000_000 * (late // PERIOD_NS + 1)


def test_an_episode_begins_without_waiting_and_without_being_late():
    clock = WallClock(PERIOD_NS)
    clock.begin()
    time.sleep(0.03)
    begun = clock.begin()
    assert begun >= 30_000_000 and clock.late == 0
    assert clock.tick() >= begun + PERIOD_NS
