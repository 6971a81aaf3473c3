"""Names for the types of numpy arrays: float64 arrays, Boolean masks and arrays of indices."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Field = NDArray[np.float64]
VectorField = NDArray[np.float64]
Vector = NDArray[np.float64]
Matrix = NDArray[np.float64]
Mask = NDArray[np.bool_]
Indices = NDArray[np.intp]
