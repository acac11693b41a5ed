"""A dry run imagines where the arm would be: nothing is concluded from what is seen meanwhile."""

import json


def test_a_dry_run_learns_no_map(imitate):
    result = imitate("learn-map", "robot=ideal", "--dry-run", "learning.limit=4", "out=dry")
    told = json.loads((imitate.folder / "dry" / "metrics.json").read_text())
    assert result.exit_code == 1
    assert "no map.npz" in result.stderr
    assert "imitate reach" not in result.stdout
    assert not (imitate.folder / "dry" / "map.npz").exists()
    assert told["dry_run"] is True and told["areas_learned"] == 0 and told["steps"] > 3


def test_a_dry_run_tells_nothing_of_a_map(imitate, learned):
    words = ("robot=ideal", f"map={learned}", "--dry-run", "check.blocked=2", "out=dry")
    result = imitate("check-map", *words)
    told = json.loads((imitate.folder / "dry" / "metrics.json").read_text())
    assert result.exit_code == 1
    assert "the arm was not moved" in result.stderr
    assert "relearn" not in result.stderr
    assert told["verdict"] == "nothing can be told"
