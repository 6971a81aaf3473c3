"""Laws of the surface FRF that hold at every wavenumber: P1 to P8, P11, P19 and P20."""

import numpy as np
from numpy.random import Generator

from semi_analytical.frf.stack import HalfSpace, Stack
from semi_analytical.frf.surface import scalars
from semi_analytical.influence.layered import LayeredCoefficients
from verification.laws.frf_matrix import composite_frf_matrix, frf_matrix
from verification.laws.law import Law, apart
from verification.laws.random_stacks import decades, film, half_space, stack, wave_vector


def _hermitian(rng: Generator) -> float:
    F = frf_matrix(stack(rng), *wave_vector(rng))
    return apart(F, F.conj().T)


def _real(rng: Generator) -> float:
    body, (m, n) = stack(rng), wave_vector(rng)
    return apart(frf_matrix(body, -m, -n), frf_matrix(body, m, n).conj())


def _parity(rng: Generator) -> float:
    body, (m, n) = stack(rng), wave_vector(rng)
    F, turned = frf_matrix(body, m, n), frf_matrix(body, -m, -n)
    sign = np.array([[1, 1, -1], [1, 1, -1], [-1, -1, 1]])
    imaginary = np.where(sign > 0, F.imag, F.real)
    return max(apart(turned, sign * F), float(np.abs(imaginary).max() / np.abs(F).max()))


def _positive(rng: Generator) -> float:
    body, k = stack(rng), wave_vector(rng)
    c11, c12, c22, csh = scalars(body, np.hypot(*k))
    if not (c11 > 0 and c22 > 0 and csh > 0 and c11 * c22 > c12**2):
        return np.inf
    F = frf_matrix(body, *k)
    return max(0.0, -float(np.linalg.eigvalsh(F).min() / np.abs(F).max()))


def _turns(rng: Generator) -> float:
    body, k, angle = stack(rng), wave_vector(rng), rng.uniform(-np.pi, np.pi)
    cos, sin = np.cos(angle), np.sin(angle)
    Q = np.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]]) @ np.diag([1, rng.choice([-1, 1]), 1])
    m, n = Q[:2, :2] @ k
    return apart(frf_matrix(body, m, n), Q @ frf_matrix(body, *k) @ Q.T)


def _isotropic(rng: Generator) -> float:
    body, (m, n) = stack(rng), wave_vector(rng)
    F = frf_matrix(body, m, n)
    return apart(frf_matrix(body, n, m), F[np.ix_([1, 0, 2], [1, 0, 2])])


def _scales(rng: Generator) -> float:
    body, (m, n) = stack(rng), wave_vector(rng)
    length, stiffness = decades(rng, -3, 3), decades(rng, -3, 3)
    films = [(G * stiffness, nu, h * length) for G, nu, h in body.layers]
    base = None if body.base is None else (body.base[0] * stiffness, body.base[1])
    scaled = frf_matrix(Stack(films, base), m / length, n / length)
    return apart(scaled, frf_matrix(body, m, n) * length / stiffness)


def _homogeneous(rng: Generator) -> float:
    material, k = half_space(rng), wave_vector(rng)
    films = [(*material, film(rng).thickness) for _ in range(rng.integers(1, 6))]
    return apart(frf_matrix(Stack(films, material), *k), frf_matrix(Stack((), material), *k))


def _cut(rng: Generator) -> float:
    body, k = stack(rng), wave_vector(rng)
    G, nu, h = body.layers[0]
    parts = rng.uniform(0.05, 1, rng.integers(2, 7))
    pieces = [(G, nu, h * part) for part in parts / parts.sum()]
    return apart(
        frf_matrix(Stack([*pieces, *body.layers[1:]], body.base), *k), frf_matrix(body, *k)
    )


def _nothing_inserted(rng: Generator) -> float:
    body, k, place = stack(rng), wave_vector(rng), int(rng.integers(0, 6))
    # Thinner than rounding: at most max(G)/min(G) alpha h = 1e6 * 1e4 * 1e-28.
    films = [*body.layers[:place], (*half_space(rng), 1e-28), *body.layers[place:]]
    return apart(frf_matrix(Stack(films, body.base), *k), frf_matrix(body, *k))


def _work(rng: Generator) -> float:
    F = frf_matrix(stack(rng), *wave_vector(rng))
    t = rng.normal(size=(3, 2)) @ [1, 1j]
    work = (t.conj() @ F @ t).real / (np.abs(F).max() * np.linalg.norm(t) ** 2)
    return max(0.0, -float(work))


def _symmetric_operator(rng: Generator) -> float:
    """Displacement is taken at the centre of a cell: of waves between one and two to a cell it has
    the wrong sign, and on wider cells a stiff film that floats on a soft one answers these most."""
    body = stack(rng, 3)
    side = decades(rng, -2, 0) * sum(film.thickness for film in body.layers)
    K = LayeredCoefficients(body, (side, side * rng.uniform(0.2, 1)), (4, 3))
    operator = dense_operator(K, (4, 3))
    largest = np.abs(operator).max()
    negative = -np.linalg.eigvalsh(operator).min() / largest
    return max(float(np.abs(operator - operator.T).max() / largest), float(negative), 0.0)


def dense_operator(K: LayeredCoefficients, shape: tuple[int, int]) -> np.ndarray:
    """All three displacements of every cell by all three tractions on every cell."""
    i, j = (index.ravel() for index in np.indices(shape))
    di, dj = i[:, None] - i, j[:, None] - j
    at = abs(di), abs(dj)
    odd_x, odd_y = np.sign(di), np.sign(dj)
    xy, zx, zy = K.xy[at] * odd_x * odd_y, K.zx[at] * odd_x, K.zy[at] * odd_y
    return np.block([[K.xx[at], xy, -zx], [xy, K.yy[at], -zy], [zx, zy, K.zz[at]]])


def _identical(rng: Generator) -> float:
    body, k = stack(rng), wave_vector(rng)
    twice = 2 * frf_matrix(body, *k)
    twice[:2, 2] = twice[2, :2] = 0
    return apart(composite_frf_matrix(body, body, *k), twice)


def _halved(rng: Generator) -> float:
    G, nu = half_space(rng)
    k = wave_vector(rng)
    soft = frf_matrix(Stack((), HalfSpace(G / 2, nu)), *k)
    soft[:2, 2] = soft[2, :2] = 0
    body = Stack((), HalfSpace(G, nu))
    return apart(composite_frf_matrix(body, body, *k), soft)


SYMMETRY_LAWS = (
    Law("hermitian", "P1", "F is Hermitian (Betti's reciprocity)", _hermitian),
    Law("real", "P2", "real tractions give real displacements: F(-m, -n) = conj F(m, n)", _real),
    Law("parity", "P3", "normal-tangential entries are imaginary and odd, all others real and even",
        _parity),
    Law("positive_definite", "P4", "strain energy is positive: all eigenvalues of F are > 0",
        _positive),
    Law("rotation", "P5", "F(Qk) = Q F(k) Qᵀ for rotations and reflections of the axes", _turns),
    Law("isotropy", "P6", "exchanging x and y exchanges the entries", _isotropic),
    Law("scaling", "P7", "lengths and moduli scale out: α G F depends on α h and ratios", _scales),
    Law("homogeneous", "P8", "layers of the substrate's material are no layers", _homogeneous),
    Law("cutting", "P11", "cutting a layer into pieces changes nothing", _cut, 1e-11),
    Law("no_thickness", "P11", "a layer of any material without thickness changes nothing",
        _nothing_inserted),
    Law("energy", "P19", "any traction does positive work", _work),
    Law("discrete_symmetry", "P19", "the matrix of influence coefficients of all three components "
        "is symmetric and does positive work, on cells no wider than the layers are thick in all",
        _symmetric_operator, 1e-11, 40),
    Law("identical_bodies", "P20", "two identical bodies do not couple", _identical),
    Law("half_stiffness", "P20", "two identical half-spaces are one of half the stiffness, "
        "uncoupled", _halved),
)  # fmt: skip
