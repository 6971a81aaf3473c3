"""Normal response of a film on a half-space whose bond is compliant.

In plane strain with the Airy function f(z) cos kx (Timoshenko and Goodier 1970, section 24), z
downwards:

    σ_zz = -k² f        σ_xz = k f'        2G k u = (1-ν) f'' + ν k² f
    2G k² w = (1-ν) f''' - (2-ν) k² f'

with the factors cos kx of σ_zz and w, and sin kx of σ_xz and u. The film has the solutions e^(-kz),
kz e^(-kz) and their two images about its lower side, the base has the first two. The bond carries
the traction: w_base - w_film = σ_zz/k_n and u_base - u_film = σ_xz/k_s.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class BondedFilm(NamedTuple):
    """Film on a half-space with a compliant bond.

    film, base     shear modulus [force/length²] and Poisson's ratio of both materials
    thickness      thickness of the film [length]
    normal, shear  stiffnesses of the bond [force/length³]; infinite for a rigid one
    """

    film: tuple[float, float]
    base: tuple[float, float]
    thickness: float
    normal: float
    shear: float

    def normal_response(self, k: Array) -> Array:
        """Compute the normal surface displacement per unit pressure at wavenumbers k.

        k  wavenumbers (n,) [1/length], > 0
        """
        x = np.asarray(k * self.thickness)
        nothing = np.zeros_like(x)
        top, bottom = (
            np.concatenate([_solutions(z, self.film[1]), _solutions(x - z, self.film[1], -1.0)], 1)
            for z in (nothing, x)
        )
        base = _solutions(nothing, self.base[1])
        # Displacements in units of 1/(2 G k), stresses in units of k² f.
        G, G_base = self.film[0], self.base[0]
        system = np.zeros((6, 6, *x.shape))
        system[0, :4], system[1, :4] = top[0], top[1]
        system[2, :4], system[2, 4:] = bottom[0], -base[0]
        system[3, :4], system[3, 4:] = bottom[1], -base[1]
        opening, jump = 2 * G * k / self.normal, 2 * G * k / self.shear
        system[4, :4], system[4, 4:] = bottom[3] + opening * bottom[0], -base[3] * G / G_base
        system[5, :4], system[5, 4:] = bottom[2] + jump * bottom[1], -base[2] * G / G_base
        load = np.zeros((*x.shape, 6, 1))
        load[..., 0, 0] = -1.0
        found = np.linalg.solve(np.moveaxis(system, (0, 1), (-2, -1)), load)[..., 0]
        return np.asarray(np.einsum("in,ni->n", top[3], found[:, :4]) / (2 * G * k))


def _solutions(x: Array, nu: float, up: float = 1.0) -> Array:
    """Return σ_zz, σ_xz, u and w of the solutions e^(-x) and x e^(-x) (4, 2, n), x = kz.

    Stresses are in units of k² and displacements in units of k/(2G).

    nu  Poisson's ratio
    up  -1 for solutions that decay upwards
    """
    e = np.exp(-x)
    # f and its derivatives by x; odd ones change sign upwards.
    f = np.stack([e, x * e])
    first = up * np.stack([-e, (1 - x) * e])
    second = np.stack([e, (x - 2) * e])
    third = up * np.stack([-e, (3 - x) * e])
    return np.stack([-f, first, (1 - nu) * second + nu * f, (1 - nu) * third - (2 - nu) * first])
