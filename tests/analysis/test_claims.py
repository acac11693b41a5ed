"""What is claimed, beside what was measured."""

import json

import numpy as np
import pytest

from imitation.analysis.claims import every_claim, rate_claim, reported, value_claim, write_claims


def median_claim(groups, comparison, bound):
    return value_claim(
        "The median keeps to its bound.",
        groups,
        lambda values: float(np.median(values)),
        comparison,
        bound,
        "px",
        np.random.default_rng(0),
        resamples=100,
    )


def test_a_rate_passes_by_the_lower_end_of_its_interval():
    met = rate_claim("Nine of ten succeed.", np.repeat([1, 0], [950, 50]), bound=0.9)
    assert met.passed
    assert met.measured == 0.95
    assert met.low < 0.95 < met.high
    assert not rate_claim("Nine of ten succeed.", np.repeat([1, 0], [9, 1]), bound=0.9).passed


def test_every_means_without_exception():
    assert every_claim("All succeed.", np.ones(5)).passed
    assert not every_claim("All succeed.", np.repeat([1, 0], [9999, 1])).passed
    assert not every_claim("All succeed.", np.empty(0)).passed


@pytest.mark.parametrize(
    ("comparison", "bound", "passed"),
    [
        ("at most", 2.0, True),
        ("at most", 1.9, False),
        ("at least", 2.0, True),
        ("at least", 2.1, False),
    ],
)
def test_a_value_passes_on_its_side_of_the_bound(comparison, bound, passed):
    claim = median_claim([np.array([1.0, 2.0]), np.array([2.0, 3.0])], comparison, bound)
    assert claim.measured == 2.0
    assert claim.passed is passed
    assert claim.n == 2


def test_what_was_never_measured_does_not_pass():
    assert not median_claim([], "at most", 2.0).passed
    assert not median_claim([np.array([np.nan])], "at least", 0.0).passed


def test_the_file_tells_figure_seeds_and_each_claim_as_json_without_nan(tmp_path):
    claims = [median_claim([], "at most", 2.0), every_claim("All succeed.", np.ones(3))]
    path = write_claims(tmp_path, "fig9", claims, seeds=3, demo=True)
    assert path == tmp_path / "fig9.claims.json"
    content = json.loads(path.read_text(), parse_constant=lambda name: pytest.fail(name))
    assert (content["figure"], content["demo"], content["seeds"]) == ("fig9", True, 3)
    unmeasured, every = content["claims"]
    assert unmeasured["measured"] is None
    assert unmeasured["passed"] is False
    assert every["sentence"] == "All succeed."
    assert (every["asked"], every["measured"], every["passed"]) == (1.0, 1.0, True)
    assert every["low"] < every["high"] == 1.0


def test_a_report_is_told_apart_from_the_claims(tmp_path):
    claims = [every_claim("All succeed.", np.ones(3)), reported(median_claim([], "at most", 2.0))]
    content = json.loads(write_claims(tmp_path, "fig9", claims, seeds=3, demo=True).read_text())
    assert [one["sentence"] for one in content["claims"]] == ["All succeed."]
    [told] = content["reports"]
    assert "passed" not in told
    assert "asked" not in told
