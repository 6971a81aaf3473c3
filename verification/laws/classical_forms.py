"""How many digits the textbook forms of the layered FRF lose, and where.

All forms are exact in exact arithmetic. Transfer matrices (Thomson 1950, Haskell 1953) subtract
growing exponentials from each other, stiffness matrices (Kausel and Roesset 1981) subtract stiff
layers' entries, the closed form of O'Sullivan and King (1988) subtracts numbers near one. Each is
written here from its own equations and compared with the recursion the solver uses, which the
tests hold to 5e-15.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import cosh, exp, sinh

import numpy as np
from numpy.typing import NDArray

from semi_analytical.frf.stack import Film, HalfSpace, Stack
from semi_analytical.frf.surface import scalars

Matrix = NDArray[np.float64]
Form = Callable[[Film, HalfSpace, float], Matrix]


@dataclass(frozen=True)
class DigitLoss:
    """Error of one classical form at one point.

    contrast  Young's modulus of the layer over the substrate's
    depth     alpha h
    error     largest relative error of C11 and C22 that the form gives; inf where it fails
    """

    form: str
    contrast: float
    depth: float
    error: float


def transfer_matrix(film: Film, base: HalfSpace, alpha: float) -> Matrix:
    """Surface compliance by carrying (u, tau) from the substrate to the surface."""
    T = _propagator(film, alpha)
    compliance = _half_space_compliance(base, film, alpha)
    state = T @ np.vstack([compliance, np.eye(2)])
    return _restored(state[:2] @ np.linalg.inv(state[2:]), film, alpha)


def layer_stiffness(film: Film, base: HalfSpace, alpha: float) -> Matrix:
    """Surface compliance from the stiffness matrices of layer and substrate, added as elements."""
    T = _propagator(film, alpha)
    flexible = np.linalg.inv(T[:2, 2:])
    top = T[2:, 2:] @ flexible
    bottom = flexible @ T[:2, :2]
    coupling = T[2:, :2] - top @ T[:2, :2]
    substrate = np.linalg.inv(_half_space_compliance(base, film, alpha))
    stiffness = np.block([[top, coupling], [-flexible, bottom + substrate]])
    return _restored(np.linalg.inv(stiffness)[:2, :2], film, alpha)


def global_system(film: Film, base: HalfSpace, alpha: float) -> Matrix:
    """Surface compliance from all amplitudes at once, each exponential scaled to its own face."""
    x = alpha * film.thickness
    E = exp(-x) * np.array([[1, x], [0, 1]])
    down_u, down_s = _modes(film.poisson_ratio, 1.0)
    base_u, base_s = _modes(base.poisson_ratio, base.shear_modulus / film.shear_modulus)
    flip = np.diag([1.0, -1.0])
    up_u, up_s = flip @ down_u, -flip @ down_s
    none = np.zeros((2, 2))
    system = np.block(
        [
            [down_s, up_s @ E, none],
            [down_u @ E, up_u, -base_u],
            [down_s @ E, up_s, -base_s],
        ]
    )
    amplitudes = np.linalg.solve(system, np.vstack([-np.eye(2), none, none]))
    compliance: Matrix = np.hstack([down_u, up_u @ E]) @ amplitudes[:4]
    return _restored(compliance, film, alpha)


def closed_form(film: Film, base: HalfSpace, alpha: float) -> Matrix:
    """C11 and C22 in closed form (O'Sullivan and King 1988 for C22)."""
    G, nu, h = film
    mu = G / base.shear_modulus
    x, theta = alpha * h, exp(-2 * alpha * h)
    lam = 1 - 4 * (1 - nu) / (1 + mu * (3 - 4 * base.poisson_ratio))
    kappa = (mu - 1) / (mu + 3 - 4 * nu)
    determinant = 1 - (lam + kappa + 4 * kappa * x**2) * theta + lam * kappa * theta**2
    scale = (1 - nu) / (G * alpha * determinant)
    squared = 1 - lam * kappa * theta**2
    return np.diag(scale * (squared + np.array([-1, 1]) * 4 * x * kappa * theta))


FORMS: dict[str, Form] = {
    "transfer matrix": transfer_matrix,
    "layer stiffness": layer_stiffness,
    "global 6x6": global_system,
    "closed form": closed_form,
}
CONTRASTS = (1e-6, 4.0, 1e6)
DEPTHS = (1e-8, 1e-4, 1e-2, 1.0, 30.0, 316.0, 1e4)


def digit_losses(contrasts: tuple[float, ...], depths: tuple[float, ...]) -> list[DigitLoss]:
    """Errors of every classical form for one layer of unit thickness on a half-space."""
    nu1, nu2 = 0.3, 0.25
    base = HalfSpace(1.0, nu2)
    losses = []
    for contrast in contrasts:
        film = Film(contrast * (1 + nu2) / (1 + nu1), nu1, 1.0)
        for depth in depths:
            exact = scalars(Stack([film], base), depth)
            for name, form in FORMS.items():
                error = _error(form, film, base, depth, (float(exact.c11), float(exact.c22)))
                losses.append(DigitLoss(name, contrast, depth, error))
    return losses


def _error(
    form: Form, film: Film, base: HalfSpace, alpha: float, exact: tuple[float, float]
) -> float:
    """Largest relative error of the diagonal; inf if the form overflows or is singular."""
    try:
        with np.errstate(all="ignore"):  # failing is what is measured
            got = np.diag(form(film, base, alpha))
    except (OverflowError, np.linalg.LinAlgError):
        return np.inf
    error = float(np.max(np.abs(got / exact - 1)))
    return error if np.isfinite(error) else np.inf


def _propagator(film: Film, alpha: float) -> Matrix:
    """Matrix from (U, u_z, Q, p) at the underside to the top, displacement in units 1/(G alpha).

    The exponential of the equilibrium system, whose eigenvalues are +-alpha, each twice, by
    Hermite interpolation on them.
    """
    nu, x = film.poisson_ratio, alpha * film.thickness
    ratio, stretch = nu / (1 - nu), 2 / (1 - nu)
    system = -np.array(
        [
            [0, -1, -1, 0],
            [ratio, 0, 0, -(1 - 2 * nu) / (2 * (1 - nu))],
            [-stretch, 0, 0, -ratio],
            [0, 0, 1, 0],
        ]
    )
    c, s = cosh(x), sinh(x)
    square = system @ system
    return (
        (c - x * s / 2) * np.eye(4)
        + (3 * s - x * c) / 2 * system
        + x * s / 2 * square
        + (x * c - s) / 2 * square @ system
    )


def _half_space_compliance(base: HalfSpace, film: Film, alpha: float) -> Matrix:
    """Compliance of the substrate in units of the layer's 1/(G alpha)."""
    nu = base.poisson_ratio
    compliance = np.array([[1 - nu, 0.5 - nu], [0.5 - nu, 1 - nu]])
    return compliance * (film.shear_modulus / base.shear_modulus)


def _modes(nu: float, stiffness: float) -> tuple[Matrix, Matrix]:
    """Down-going modes: displacement and stress (U, u_z | S, N), columns."""
    c = (3 - 4 * nu) / 2
    return np.array([[1, -c], [-1, -c]]), stiffness * np.array([[-2.0, 1], [2, 1]])


def _restored(compliance: Matrix, film: Film, alpha: float) -> Matrix:
    """Compliance in physical units."""
    return compliance / (film.shear_modulus * alpha)
