"""imitate mimic experiment=mirror: a line is drawn; then the hand that is seen is another's."""

from dataclasses import asdict

from cli import stages
from cli.jobs.reach import the_map
from cli.mimic_runs import mirrored
from cli.report import verdict
from cli.run import Outcome, Run
from imitation.analysis.mirror import corrects_against, follows, grows


def mirror(run: Run) -> Outcome:
    """Record the drawing with the deviation of the demonstrator; measure it with all of them."""
    learned = the_map(run).map
    run.record(stages.drawing(run.bench, learned), learned.field)
    found = mirrored(run.cfg, learned)
    against, growing, following = corrects_against(found), grows(found), follows(found)
    asked = {
        "the drawing arm goes to the other side": against,
        "the more, the farther": growing,
        "the following arm goes to the same side": following,
    }
    wrong = [sentence for sentence, true in asked.items() if not true]
    rows = [
        (
            f"hand seen {one.deviation_px:g} px aside",
            f"drawing arm {one.drawn_px:+.1f} px, following arm {one.followed_px:+.1f} px",
        )
        for one in found
    ]
    rows += [(sentence, verdict(true)) for sentence, true in asked.items()]
    told = {"opposite": against, "grows": growing, "homeostat_same_side": following}
    return Outcome(
        metrics={"mirror": [asdict(one) for one in found], **told},
        rows=rows,
        next="imitate view {run}",
        complaint=f"did not come true: {'; '.join(wrong)}" if wrong else None,
    )
