"""Array types for annotations, and `ma`, numpy's masked arrays, which have none. Shapes and units are stated in the docstrings."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

Reals = NDArray[np.floating[Any]]
Integers = NDArray[np.integer[Any]]
Mask = NDArray[np.bool_]
ma: Any = np.ma
