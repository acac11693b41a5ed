"""Fig. 2: what is drawn is what ran."""

import numpy as np

from imitation.analysis.fig2 import Box, Trace, draw_fig2
from imitation.analysis.figure_style import save
from imitation.analysis.tracing import watched


def seen(frame):
    return np.zeros((len(frame), 2))


def moved(seen):
    return np.zeros(5)


def never(posture):
    return posture


def step():
    moved(seen([1, 2, 3]))
    moved(seen([1]))


FUNCTIONS = {"seen": seen, "moved": moved, "never": never}


def box(name, function, shape, after=()):
    return Box(name, "body", (0, 0), function, name, "y", lambda y: y, shape, after)


def traced():
    return Trace(watched(step, FUNCTIONS), {"pixels": 3, "joints": 5})


def test_the_first_call_of_each_function_is_kept_in_order():
    calls = watched(step, FUNCTIONS)
    assert set(calls) == {"seen", "moved"}
    assert calls["seen"].order < calls["moved"].order
    assert calls["seen"].returned.shape == (3, 2)


def test_watching_a_method_finds_it_on_any_object_of_its_class():
    class Arm:
        def move(self):
            return 1

    calls = watched(Arm().move, {"move": Arm().move})
    assert calls["move"].returned == 1


def test_a_step_as_drawn_makes_both_claims_true():
    boxes = [box("seen", seen, ("pixels", "2")), box("moved", moved, ("joints",), ("seen",))]
    _, (shapes, order) = draw_fig2(boxes, [[traced()]])
    assert shapes.passed
    assert order.passed


def test_a_box_that_states_another_shape_or_did_not_run_is_found_out(tmp_path):
    boxes = [box("seen", seen, ("joints",)), box("never", never, ("joints",), ("seen",))]
    figure, (shapes, order) = draw_fig2(boxes, [[traced()]])
    assert (shapes.measured, order.measured) == (0.0, 0.0)
    assert all(path.stat().st_size > 0 for path in save(figure, tmp_path, "fig2"))


def test_an_arrow_against_the_order_of_the_step_is_found_out():
    boxes = [box("seen", seen, ("pixels", "2"), ("moved",)), box("moved", moved, ("joints",))]
    _, (_, order) = draw_fig2(boxes, [[traced()]])
    assert not order.passed


def test_arguments_are_those_of_the_function():
    assert box("seen", seen, ()).arguments == "(frame)"
