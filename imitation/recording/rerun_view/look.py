"""How pictures and colours look in the Rerun view."""

from typing import Any, Literal

import rerun as rr

from imitation.recording import messages
from imitation.recording.picture_columns import Batch

FAINT = (255, 255, 255, 90)
CYAN, WHITE, YELLOW, GREEN = (0, 220, 255), (255, 255, 255), (255, 220, 0), (60, 220, 90)


def image_format(
    width: int, height: int, colours: Literal["RGB", "L"]
) -> rr.components.ImageFormat:
    """How the pixels of a picture of bytes lie."""
    return rr.components.ImageFormat(
        width=width, height=height, color_model=colours, channel_datatype="U8"
    )


def pictures(batch: Batch) -> Any:
    """The frames of some steps as columns, raw or as JPEG."""
    if batch.type_of("/camera/image") == messages.COMPRESSED_IMAGE:
        blobs = [message.data.tobytes() for message in batch.messages("/camera/image")]
        return rr.EncodedImage.columns(blob=blobs, media_type=["image/jpeg"] * len(blobs))
    return rr.Image.columns(buffer=batch.pixels())
