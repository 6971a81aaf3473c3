"""The limit of infinitely long waves: a uniform traction over the whole surface."""

import numpy as np
from numpy.typing import NDArray

from semi_analytical.frf.stack import Stack


def uniform_load_matrix(stack: Stack) -> NDArray[np.float64]:
    """FRF at m = n = 0: every layer is sheared by h/G and, held sideways, squeezed by h/M.

    1/M = (1 - 2 nu) / 2G(1 - nu) is the compliance of uniaxial strain; pressure and shear do not
    couple.

    returns  (3, 3): row = displacement, column = traction [length^3/force]
    Raises ValueError on an elastic half-space, which moves without bound.
    """
    if stack.base is not None:
        raise ValueError("an elastic half-space moves without bound under a uniform traction")
    shear = sum(film.thickness / film.shear_modulus for film in stack.layers)
    squeeze = sum(
        film.thickness
        * (0.5 - film.poisson_ratio)
        / (film.shear_modulus * (1 - film.poisson_ratio))
        for film in stack.layers
    )
    return np.diag([shear, shear, squeeze])
