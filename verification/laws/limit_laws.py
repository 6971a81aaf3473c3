"""Laws of the surface frequency response function (FRF) of layered bodies.

The FRF is the surface displacement per unit traction in Fourier space. The laws are limits, bounds,
monotonicity, equal descriptions of one body, and positive energy.

Each function draws a random layered body and returns the violation of one law.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from semi_analytical.frf.depth import Descent, Level
from semi_analytical.frf.response_matrix import response_matrix
from semi_analytical.frf.stack import Film, HalfSpace, Stack
from semi_analytical.frf.surface import (
    half_space_scalars,
    remainder_scalars,
    scalars,
)
from semi_analytical.influence.layered import LayeredCoefficients
from verification.norms import max_norm

SEED = 20_240_511
DRAWS = 200
# Accepted rounding error of one evaluation, relative to the largest entry. The FRFs have errors of
# about 1e-15.
ROUNDING = 1e-14


@dataclass(frozen=True)
class Law:
    """Hold a law of the surface FRF and the function that measures its violation.

    FRF (frequency response function): surface displacement per unit traction of a wavenumber.

    name       name of the verdict on the law
    statement  law in words
    violation  function from a random generator to the relative violation for one random body
    allowed    accepted violation, due to rounding or to the next order of the law
    draws      number of random bodies
    """

    name: str
    statement: str
    violation: Callable[[Generator], float]
    allowed: float = ROUNDING
    draws: int = DRAWS


def worst_violation(law: Law) -> float:
    """Compute the largest violation of a law over its random layered bodies [1].

    The result is NaN if any violation is NaN. The random bodies are equal in every call.

    law  law of the surface frequency response
    """
    rng = np.random.default_rng([SEED, *law.name.encode()])
    return float(np.max([law.violation(rng) for _ in range(law.draws)]))


def apart(F: NDArray[np.complex128], expected: NDArray[np.complex128]) -> float:
    """Compute the largest difference of two FRF matrices, over the largest entry of the second [1].

    FRF (frequency response function): surface displacement per unit traction of a wavenumber.

    F         matrix that is tested (..., 3, 3) [length^3/force]
    expected  matrix that the law requires, of the same shape
    """
    return max_norm(F - expected) / max_norm(expected)


def deficit(larger: NDArray[np.complex128], smaller: NDArray[np.complex128]) -> float:
    """Compute the violation of the matrix inequality larger - smaller >= 0 (Loewner order) [1].

    A stiffer body must have the smaller compliance for all tractions. The result is the magnitude
    of the most negative eigenvalue of the difference, over the largest entry of `larger`; 0 if the
    inequality holds.

    larger   compliance matrix of the softer body (3, 3)
    smaller  compliance matrix of the stiffer body (3, 3)
    """
    least = float(np.linalg.eigvalsh(larger - smaller).min())
    return max(0.0, -least / max_norm(larger))


SPECIAL_RATIOS = (0.0, 0.3, 0.5)


def decades(rng: Generator, low: float, high: float) -> float:
    """Draw a random number between 10^low and 10^high, whose logarithm is uniformly distributed.

    rng  random generator
    """
    return float(10 ** rng.uniform(low, high))


def half_space(rng: Generator) -> HalfSpace:
    """Draw a random elastic material for a half-space.

    The shear modulus lies between 1e-3 and 1e3, ν between -0.95 and exactly 1/2.
    """
    ratio = rng.choice(SPECIAL_RATIOS) if rng.random() < 0.3 else rng.uniform(-0.95, 0.5)
    return HalfSpace(decades(rng, -3, 3), float(ratio))


def film(rng: Generator) -> Film:
    """Draw a random elastic layer with a thickness between 1e-2 and 1e2.

    The shear modulus lies between 1e-3 and 1e3.
    """
    return Film(*half_space(rng), decades(rng, -2, 2))


def stack(rng: Generator, most_layers: int = 5) -> Stack:
    """Draw a random layered body: one to five layers on a half-space.

    In 1/4 of the draws the base is rigid.

    most_layers  largest number of layers
    """
    films = [film(rng) for _ in range(rng.integers(1, most_layers, endpoint=True))]
    return Stack(films, None if rng.random() < 0.25 else half_space(rng))


def wave_vector(rng: Generator) -> tuple[float, float]:
    """Draw a random wave vector (m, n) of any direction, with a wavenumber between 1e-4 and 1e4."""
    alpha, angle = decades(rng, -4, 4), rng.uniform(-np.pi, np.pi)
    return float(alpha * np.cos(angle)), float(alpha * np.sin(angle))


# Bound of the effect of all material below the outer layer on the FRF, in units of 1/(G alpha).
# The softest base has 24 (1 - nu) at x = 1.
ECHO = 50.0


def _thick_layer_error(rng: Generator) -> float:
    """Compute the effect of all that lies below the outer layer on the surface response, over its
    bound.

    For short waves the response (FRF) must be that of a half-space of the outer layer. The bound is
    50 (1 + x²) e^(-2x) with x = wavenumber times layer thickness. The random body is layered.
    """
    body, x = stack(rng), rng.uniform(1, 300)
    alpha = x / body.layers[0].thickness
    outer = half_space_scalars(body.outer, alpha)
    bound = ECHO * (1 + x * x) * np.exp(-2 * x) + ROUNDING
    difference = np.subtract(scalars(body, alpha), outer)
    return float(max_norm(difference) / (bound * float(outer.csh)))


def _stiffer_layer_deficit(rng: Generator) -> float:
    body, k, factor = stack(rng), wave_vector(rng), decades(rng, 0, 3)
    place = int(rng.integers(0, len(body.layers) + (body.base is not None)))
    if place == len(body.layers) and body.base is not None:
        stiffer = Stack(body.layers, (factor * body.base[0], body.base[1]))
    else:
        stiffer = _replace_layer(
            body,
            place,
            body.layers[place]._replace(shear_modulus=factor * body.layers[place].shear_modulus),
        )
    return deficit(response_matrix(body, *k), response_matrix(stiffer, *k))


def _long_wave_error(rng: Generator) -> float:
    films = [film(rng) for _ in range(rng.integers(1, 4))]
    softest = min(f.shear_modulus for f in films)
    # Layers are sheared by h/G and, held sideways, squeezed by h (1 - 2 nu) / 2G(1 - nu).
    shear = np.array([f.thickness / f.shear_modulus for f in films])
    nu = np.array([f.poisson_ratio for f in films])
    uniform = np.diag([shear.sum(), shear.sum(), (shear * (0.5 - nu) / (1 - nu)).sum()])
    contrast = max(f.shear_modulus for f in films) / softest
    alpha = 1e-9 / (contrast * sum(f.thickness for f in films))
    return apart(response_matrix(Stack(films), alpha, 0.0), uniform.astype(np.complex128))


def _incompressible_limit_error(rng: Generator) -> float:
    body, alpha = stack(rng), np.hypot(*wave_vector(rng))
    G, _, h = body.layers[0][:3]
    limit, close = (
        np.array(scalars(_replace_layer(body, 0, Film(G, nu, h)), alpha))
        for nu in (0.5, 0.5 - 1e-13)
    )
    # d(1/M)/d(nu) = -4/G per unit thickness, at most, and a few more for c11 and c12.
    scale = limit.max() + min(h, 1 / alpha) / G
    return float(max_norm(close - limit) / scale)


def _count_non_finite_entries(rng: Generator) -> float:
    body, m = stack(rng), decades(rng, 3, 6)
    values = [*response_matrix(body, m, -m).ravel(), *remainder_scalars(body, m)]
    return float(np.count_nonzero(~np.isfinite(values)))


def _interface_jump(rng: Generator) -> float:
    """Compute the errors of the boundary and interface conditions inside a random layered body [1].

    At the surface the fields must be the applied tractions and the surface response (FRF). At an
    interface tractions and displacements on both sides must agree. The result is the largest
    relative error.
    """
    body = stack(rng, most_layers=3)
    alpha = np.array([rng.uniform(0.1, 3) / sum(f.thickness for f in body.layers)])
    descent = Descent(body, alpha)
    top = descent.at(Level(0.0, 0))
    c11, c12, c22, _ = scalars(body, alpha)
    surface = np.array([[c11, c12], [c12, c22]])
    worst = max(
        max_norm(top.traction[..., 0] - np.eye(2)),
        max_norm(top.displacement - surface) / max_norm(surface),
    )
    below = len(body.layers) - (body.base is None)
    for k, depth in enumerate(np.cumsum([f.thickness for f in body.layers])[:below]):
        above, under = (descent.at(Level(float(depth), layer)) for layer in (k, k + 1))
        for one, other, scale in (
            (above.traction, under.traction, 1.0),
            (above.displacement, under.displacement, max_norm(surface)),
        ):
            worst = max(worst, max_norm(one - other) / scale)
    return worst


def _replace_layer(body: Stack, place: int, new: Film) -> Stack:
    return Stack([*body.layers[:place], new, *body.layers[place + 1 :]], body.base)


def _negative_energy(rng: Generator) -> float:
    body, k = stack(rng), wave_vector(rng)
    c11, c12, c22, csh = scalars(body, np.hypot(*k))
    if not (c11 > 0 and c22 > 0 and csh > 0 and c11 * c22 > c12**2):
        return np.inf
    F = response_matrix(body, *k)
    return max(0.0, -float(np.linalg.eigvalsh(F).min() / max_norm(F)))


def _homogeneous_layers_error(rng: Generator) -> float:
    material, k = half_space(rng), wave_vector(rng)
    films = [(*material, film(rng).thickness) for _ in range(rng.integers(1, 6))]
    return apart(
        response_matrix(Stack(films, material), *k), response_matrix(Stack((), material), *k)
    )


def _cut_layer_error(rng: Generator) -> float:
    body, k = stack(rng), wave_vector(rng)
    G, nu, h = body.layers[0][:3]
    parts = rng.uniform(0.05, 1, rng.integers(2, 7))
    pieces = [(G, nu, h * part) for part in parts / parts.sum()]
    return apart(
        response_matrix(Stack([*pieces, *body.layers[1:]], body.base), *k),
        response_matrix(body, *k),
    )


def _vanishing_layer_error(rng: Generator) -> float:
    body, k, place = stack(rng), wave_vector(rng), int(rng.integers(0, 6))
    # Thinner than rounding: at most max(G)/min(G) alpha h = 1e6 * 1e4 * 1e-28.
    films = [*body.layers[:place], (*half_space(rng), 1e-28), *body.layers[place:]]
    return apart(response_matrix(Stack(films, body.base), *k), response_matrix(body, *k))


def _negative_operator_energy(rng: Generator) -> float:
    """Compute the most negative eigenvalue of the influence matrix of a layered body [1].

    The matrix maps the tractions of 4 × 3 cells to the displacements of their centres. It is
    symmetric by its assembly, and must be positive. The displacement of the cell centre has the
    wrong sign for one to two waves per cell. On wide cells a stiff film on a soft one responds most
    to these waves.
    """
    body = stack(rng, 3)
    side = decades(rng, -2, 0) * sum(film.thickness for film in body.layers)
    K = LayeredCoefficients(body, (side, side * rng.uniform(0.2, 1)), (4, 3))
    operator = dense_operator(K, (4, 3))
    return max(0.0, float(-np.linalg.eigvalsh(operator).min() / max_norm(operator)))


def dense_operator(K: LayeredCoefficients, shape: tuple[int, int]) -> np.ndarray:
    """Assemble the dense matrix from the tractions of all cells to the displacements of all cells.

    The matrix has the shape (3 nx ny, 3 nx ny), with the x, y and z components one after another.

    K      influence coefficients: displacement at a cell per unit traction on another cell
    shape  numbers of cells (nx, ny) along x and y
    """
    i, j = (index.ravel() for index in np.indices(shape))
    di, dj = i[:, None] - i, j[:, None] - j
    at = abs(di), abs(dj)
    odd_x, odd_y = np.sign(di), np.sign(dj)
    xy, zx, zy = K["xy"][at] * odd_x * odd_y, K["zx"][at] * odd_x, K["zy"][at] * odd_y
    return np.block([[K["xx"][at], xy, -zx], [xy, K["yy"][at], -zy], [zx, zy, K["zz"][at]]])


LAWS = (
    Law(
        "positive_definite",
        "strain energy is positive: all eigenvalues of F are > 0",
        _negative_energy,
    ),
    Law(
        "homogeneous",
        "layers of the substrate's material have no effect",
        _homogeneous_layers_error,
    ),
    Law(
        "cutting",
        "the division of a layer into layers of its material has no effect",
        _cut_layer_error,
        1e-11,
    ),
    Law(
        "no_thickness",
        "a layer of any material with vanishing thickness has no effect",
        _vanishing_layer_error,
    ),
    Law(
        "discrete_energy",
        "the matrix of influence coefficients of all three components is positive, on cells no "
        "wider than the total thickness of the layers",
        _negative_operator_energy,
        1e-11,
        40,
    ),
    Law(
        "thick_layer",
        "short waves depend only on the outer layer; distance over the "
        "bound 50 (1 + x²) e⁻²ˣ / αG, x = αh",
        _thick_layer_error,
        1.0,
    ),
    Law(
        "stiffer",
        "a stiffer material in any layer reduces the compliance (Loewner order)",
        _stiffer_layer_deficit,
    ),
    Law(
        "long_waves",
        "long waves over a rigid base shear and squeeze every layer uniformly",
        _long_wave_error,
        1e-8,
    ),
    Law(
        "incompressible",
        "the response is continuous at ν = ½: the difference from ν = ½ - 1e-13",
        _incompressible_limit_error,
        1e-12,
    ),
    Law(
        "finite",
        "the response is finite up to αh = 1e8: number of entries that are not finite",
        _count_non_finite_entries,
        0.5,
    ),
    Law(
        "depth",
        "traction and displacement at z = 0 are the applied traction and the "
        "FRF; traction and displacement are continuous at interfaces",
        _interface_jump,
        1e-12,
    ),
)
