"""Names for the arrays that travel through the bench."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Image = NDArray[np.uint8]  # RGB, (height, width, 3)
Mask = NDArray[np.bool_]
Index = NDArray[np.int32]
