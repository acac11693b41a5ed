"""What a hand triggers, wherever it is shown."""

from cli.deferred_runs import demonstrated
from cli.trigger_table import Trying, probes, triggers


def test_each_area_is_tried_as_often(ideal_lesson):
    field = ideal_lesson.learner.learned.field
    areas = [field.area_of(place) for place in probes(field, 2)]
    assert {areas.count(area) for area in areas} == {4}
    assert len(set(areas)) == 20


def test_a_hand_triggers_in_the_areas_of_the_action_and_nowhere_else(ideal_lesson):
    action = demonstrated(0, "robot=ideal")
    found = triggers(0, ideal_lesson.learner.learned, action, Trying(1, 0.12, 0.52))
    assert found.right == 1.0
    assert sorted(k for one in found.probes if (k := one.triggered) is not None) == [0, 1, 2]
