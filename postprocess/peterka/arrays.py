"""Array types for annotations. Shapes and units are stated in the docstrings."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

Reals = NDArray[np.floating[Any]]
Integers = NDArray[np.integer[Any]]
Mask = NDArray[np.bool_]
ma: Any = np.ma  # masked arrays: numpy has no types for them
