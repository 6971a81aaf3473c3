"""Response of a layered body's surface to a wave of traction, as a matrix for the axes x, y, z.

The four scalars of `surface` belong to the direction of the wave; the matrix belongs to the axes.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact_scene.array_types import Array
from contact_scene.body import Body
from semi_analytical.frf.stack import Stack, stack_of
from semi_analytical.frf.surface import SurfaceScalars, scalars


def surface_response(body: Body, m: ArrayLike, n: ArrayLike) -> NDArray[np.complex128]:
    """Return the displacement of a layered body's surface per unit of a wave of traction.

    Under the tractions t exp(i(m x + n y)) the surface moves by F t exp(i(m x + n y)). The z axis
    points into the body, and the tractions t = (q_x, q_y, p) act on the body: p > 0 presses. With
    the wavenumber α = √(m² + n²) and four real functions of α (docs/theory/frequency_responses.md),

        F_xx = (m² C11 + n² Csh)/α²        F_xz = -F_zx = i m C12/α
        F_yy = (n² C11 + m² Csh)/α²        F_yz = -F_zy = i n C12/α
        F_xy = F_yx = m n (C11 - Csh)/α²   F_zz = C22

    F is Hermitian and positive definite. The error of an entry is a few units in the last place of
    the largest entry. Transforms with the opposite sign in the exponent need the conjugate matrix.

    Parameters
    ----------
    body : Body
        Layers and base. The displacement of a rigid body is 0.
    m, n : array_like
        Wavenumbers along x and y [1/length], broadcast together, not both zero.

    Returns
    -------
    numpy.ndarray
        F of the shape (..., 3, 3): row = displacement (x, y, z), column = traction (x, y, z)
        [length³/force].

    Raises
    ------
    ValueError
        A wavenumber α is 0 or not finite: an infinite body has no finite displacement under a
        uniform load.
    """
    return response_matrix(stack_of(body), m, n)


def response_matrix(stack: Stack, m: ArrayLike, n: ArrayLike) -> NDArray[np.complex128]:
    """Compute the matrix of `surface_response` from the elastic constants of a body.

    stack  layers and base of the body
    m, n   wavenumbers along x and y [1/length], broadcast together, not both zero
    """
    m, n = np.broadcast_arrays(np.asarray(m, np.float64), np.asarray(n, np.float64))
    return matrix_for_axes(scalars(stack, np.hypot(m, n)), m, n)


def matrix_for_axes(response: SurfaceScalars, m: Array, n: Array) -> NDArray[np.complex128]:
    """Convert responses along and across a wave to the matrix for the axes x, y, z.

    The result has the shape (..., 3, 3): row = displacement, column = traction.

    response  responses along, across and normal to the wave, and their coupling [length^3/force]
    m, n      wavenumbers along x and y [1/length], of one shape
    """
    alpha = np.hypot(m, n)
    mm, nn = m / alpha, n / alpha
    c11, c12, c22, csh = response
    F = np.empty((*alpha.shape, 3, 3), dtype=np.complex128)
    F[..., 0, 0] = mm * mm * c11 + nn * nn * csh
    F[..., 1, 1] = nn * nn * c11 + mm * mm * csh
    F[..., 0, 1] = F[..., 1, 0] = mm * nn * (c11 - csh)
    F[..., 2, 2] = c22
    F[..., 0, 2] = 1j * mm * c12
    F[..., 1, 2] = 1j * nn * c12
    F[..., 2, 0] = -F[..., 0, 2]
    F[..., 2, 1] = -F[..., 1, 2]
    return F
