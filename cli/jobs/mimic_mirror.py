"""imitate mimic experiment=mirror: a line is drawn; then the hand that is seen is another's."""

from dataclasses import asdict

from cli import stages
from cli.jobs.reach import the_map
from cli.mimic_runs import mirrored
from cli.run import Outcome, Run
from imitation.analysis.mirror import corrects_against, follows, grows


def mirror(run: Run) -> Outcome:
    """Record the drawing with the deviation of the demonstrator; measure it with all of them."""
    learned = the_map(run).map
    run.record(stages.drawing(run.bench, learned), learned.field)
    found = mirrored(run.cfg, learned)
    against, growing, following = corrects_against(found), grows(found), follows(found)
    wrong = [
        sentence
        for true, sentence in (
            (against, "the drawing arm did not go to the other side"),
            (growing, "a larger deviation did not move it farther"),
            (following, "the following arm did not go to the same side"),
        )
        if not true
    ]
    rows = [
        (
            f"hand seen {one.deviation_px:g} px aside",
            f"drawing arm {one.drawn_px:+.1f} px, following arm {one.followed_px:+.1f} px",
        )
        for one in found
    ]
    told = {"opposite": against, "grows": growing, "homeostat_same_side": following}
    return Outcome(
        metrics={"mirror": [asdict(one) for one in found], **told},
        rows=rows,
        next="imitate view {run}",
        complaint="; ".join(wrong) or None,
    )
