"""The geometry of a visual field as files of ours tell it, checked."""

from collections.abc import Mapping

from imitation.recording.json_lines import Node
from imitation.visual_field import VisualField

LARGEST = 10_000  # image that any camera has [px]
MOST = 100  # rows or columns of any field


def told_size(node: Node) -> tuple[int, int]:
    """Width and height of an image [px].

    Raises:
        LineError: It is none.
    """
    width, height = (side.whole(1, LARGEST) for side in node.items(2))
    return width, height


def told_field(told: Mapping[str, Node], size: tuple[int, int]) -> VisualField:
    """The field of `name`, `rows`, `columns` and `left_px` on an image of a `size` [px].

    Raises:
        LineError: It is none.
    """
    width, height = size
    return VisualField(
        name=told["name"].text(),
        size=size,
        rows=told["rows"].whole(1, min(height, MOST)),
        columns=told["columns"].whole(1, min(width, MOST)),
        left=told["left_px"].number(0, width - 1),
    )
