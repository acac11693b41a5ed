"""make video7: the film that accompanies Fig. 7, demonstration and reproduction side by side."""

import sys
from pathlib import Path

import cv2
import numpy as np

from cli.experiments import composed
from cli.fig7_runs import Fig7, Watched, watched_runs
from cli.make import made
from imitation.arrays import Image

FILM = Path("data/figures/video7.mp4")
EVERY = 2  # every second step is a frame
INK = (34, 34, 34)  # of what is written into the film
FRAMES_PER_S = 12.5  # so that the film lasts as long as the action did


def main() -> int:
    """Render the film."""
    cfg = composed("figure", "name=fig7", "figure=fig7")
    settings: Fig7 = made(cfg["figure"]["fig7"])
    runs = dict(list(watched_runs(cfg["first_seed"], settings).items())[:2])
    length = max(len(run.moments) for run in runs.values())
    width, height = settings.portrait.size
    FILM.parent.mkdir(parents=True, exist_ok=True)
    codec = cv2.VideoWriter.fourcc(*"mp4v")
    film = cv2.VideoWriter(str(FILM), codec, FRAMES_PER_S, (2 * width, height))
    for at in range(0, length, EVERY):
        both = np.hstack([_frame(name, run, at, settings) for name, run in runs.items()])
        film.write(cv2.cvtColor(both, cv2.COLOR_RGB2BGR))
    film.release()
    print(f"file  {FILM}")
    return 0


def _frame(name: str, run: Watched, at: int, settings: Fig7) -> Image:
    assert run.lit is not None
    moment = run.moments[min(at, len(run.moments) - 1)]
    run.lit.arrange(moment)
    picture = np.ascontiguousarray(settings.portrait.drawn(run.lit))
    told = f"{name}, {moment.time:.1f} s"
    place = (8, picture.shape[0] - 10)
    cv2.putText(picture, told, place, cv2.FONT_HERSHEY_SIMPLEX, 0.5, INK, 1, cv2.LINE_AA)
    return picture


if __name__ == "__main__":
    sys.exit(main())
