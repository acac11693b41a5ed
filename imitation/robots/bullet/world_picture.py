"""Pictures of the PyBullet world, by its software renderer."""

from collections.abc import Mapping
from typing import Any

import cv2
import numpy as np

from imitation.arrays import Array, Image
from imitation.robots.bullet.silence import silence
from imitation.robots.bullet.world_table import Table, add_seen

with silence():
    import pybullet

WHITE = 0xFFFFFFFF  # what TinyRenderer leaves where nothing is drawn
SOFTWARE = {"renderer": pybullet.ER_TINY_RENDERER, "flags": pybullet.ER_NO_SEGMENTATION_MASK}
FLAT_LIGHT: Mapping[str, Any] = {
    "shadow": 0,
    "lightAmbientCoeff": 1.0,
    "lightDiffuseCoeff": 0.0,
    "lightSpecularCoeff": 0.0,
    **SOFTWARE,
}


def rendered(
    client: int, view: Array, projection: Array, size: tuple[int, int], light: Mapping[str, Any]
) -> Image:
    """A picture of the world of `client`: red, green, blue, opacity, (height, width, 4)."""
    width, height = size
    _, _, pixels, *_ = pybullet.getCameraImage(
        width, height, view.tolist(), projection.tolist(), physicsClientId=client, **light
    )
    return np.asarray(pixels, dtype=np.uint8).reshape(height, width, 4)


class Backdrop:
    """The table as a view shows it, laid behind everything else.

    It fills the view and would take most of the renderer's time: it is drawn once for each view.

    Args:
        table: What is drawn.
    """

    def __init__(self, table: Table) -> None:
        self._table = table
        self._drawn: dict[bytes, Image] = {}  # of the newest view alone

    def behind(self, picture: Image, view: Array, projection: Array) -> Image:
        """The `picture` (height, width, 4) that a view gave with the table behind it, RGB."""
        key = view.tobytes() + projection.tobytes()
        if key not in self._drawn:
            height, width, _ = picture.shape
            self._drawn = {key: self._draw(view, projection, (width, height))}
        bare = (picture.view(np.uint32)[..., 0] == WHITE).view(np.uint8)
        image = cv2.cvtColor(picture, cv2.COLOR_RGBA2RGB)
        return np.asarray(cv2.copyTo(self._drawn[key], bare, image), dtype=np.uint8)

    def _draw(self, view: Array, projection: Array, size: tuple[int, int]) -> Image:
        client = pybullet.connect(pybullet.DIRECT)
        add_seen(self._table, client)
        picture = rendered(client, view, projection, size, FLAT_LIGHT)
        pybullet.disconnect(client)
        return picture[..., :3].copy()
