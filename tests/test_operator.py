"""Tests of the FFT operators: they equal the dense matrices of the influence coefficients."""

from dataclasses import replace

import coupled_scenes
import numpy as np
import pytest
from contact_scenes import (
    APPROACH,
    LIMIT,
    MU,
    PRESS,
    RADIUS,
    A,
    bump,
    grid,
    push,
    scene,
    slide,
    steel,
)

from contact_scene import (
    RIGID,
    Body,
    Ellipsoid,
    FrictionMap,
    Paraboloid,
)
from contact_scene.geometry import Gap
from contact_solver.slip_compliance_bins import COMPLIANCES, RATIO, beyond, shares
from semi_analytical import SurfaceGrid, all_effects, plan, solve
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.model import ContactModel
from semi_analytical.operator.domain import QUARTER, WINDOW, ReducedDomain
from semi_analytical.operator.operator import DisplacementOperator
from semi_analytical.operator.transforms import MAX_BY_MATRIX, Convolutions, offsets_for
from verification.problems.problem import ShiftedGrid

SHAPES = [(6, 5), (2, 7), (7, 11), (16, 8), (13, 17), (31, 3)]
SPACINGS = [(1.0, 1.0), (0.3, 1.7)]
ROUND_OFF = 1e-13
ELASTIC = Body(material=steel()), Paraboloid(radius=1, material=steel(0.3))


def coefficients(shape, spacing, bodies=ELASTIC):
    return influence_coefficients(*bodies, spacing, offsets_for(shape))


def operator(shape, spacing=(0.3, 1.7), bodies=ELASTIC):
    K = coefficients(shape, spacing, bodies)
    return DisplacementOperator(K, shape, WINDOW, Convolutions())


def dense(values, shape, parity):
    """The matrix of a component from its first quadrant and its parity along x and y."""
    i, j = (axis.ravel() for axis in np.indices(shape))
    di, dj = i[:, None] - i, j[:, None] - j
    sign = np.where(di < 0, parity[0], 1) * np.where(dj < 0, parity[1], 1)
    return sign * values[np.abs(di), np.abs(dj)]


@pytest.mark.parametrize("spacing", SPACINGS)
@pytest.mark.parametrize("shape", SHAPES)
def test_operators_are_dense_matrices(shape, spacing, rng):
    """Pressure moves sideways as shear moves normally, with the opposite sign and transposed."""
    bodies = ELASTIC[0], Paraboloid(radius=1, material=RIGID)
    K, A = coefficients(shape, spacing, bodies), operator(shape, spacing, bodies)
    parity = {
        "xx": (1, 1),
        "yy": (1, 1),
        "zz": (1, 1),
        "xy": (-1, -1),
        "zx": (-1, 1),
        "zy": (1, -1),
    }
    xx, yy, zz, xy, zx, zy = (dense(K[c], shape, sign) for c, sign in parity.items())
    p, q = rng.standard_normal(shape), rng.standard_normal((2, *shape))
    for found, expected in (
        (A.normal(p), zz @ p.ravel()),
        (A.tangential(q), np.block([[xx, xy], [xy, yy]]) @ q.ravel()),
        (A.normal_by_shear(q), np.hstack([zx, zy]) @ q.ravel()),
        (A.tangential_by_pressure(p), -np.vstack([zx, zy]) @ p.ravel()),
        (
            A.together(np.concatenate([q, p[None]])),
            np.block([[xx, xy, -zx], [xy, yy, -zy], [zx, zy, zz]]) @ [*q.ravel(), *p.ravel()],
        ),
    ):
        assert np.max(np.abs(found.ravel() - expected)) < ROUND_OFF * np.max(np.abs(expected))


def test_bins_share_a_slipping_cell_and_hand_over_beyond_the_last_one():
    """The squared weights have the sum 1 up to the last bin; one bin beyond it none is left."""
    d = COMPLIANCES[-1] * RATIO ** np.array([-9, -1.4, -0.3, 0, 0.25, 1, 9])
    np.testing.assert_allclose(
        [*np.sum(shares(d[:4]) ** 2, axis=0), *beyond(d)],
        [1] * 4 + [0] * 4 + [0.25, 1, 1],
        atol=1e-14,
    )


REDUCED_ROUND_OFF = 1e-14
HALF_X = ReducedDomain((True, False))
HALF_Y = ReducedDomain((False, True))
ALONG_X, ALONG_Y, TWISTED = (ReducedDomain((True, True), s) for s in ((-1, 1), (1, -1), (-1, -1)))
DOMAINS = (
    *(QUARTER, ALONG_X, ALONG_Y, TWISTED, HALF_X, HALF_Y),
    *(ReducedDomain((True, False), (-1, 1)), ReducedDomain((False, True), (1, -1))),
)
COUPLED = (QUARTER, HALF_X, HALF_Y)
LONG = MAX_BY_MATRIX + 2


def reduced_operator(domain, window, counter=None):
    """Of coupled bodies, on a domain of so many cells of the window."""
    described = coupled_scenes.scene(PRESS)
    cells, counter = domain.cells(window), counter or Convolutions()
    K = influence_coefficients(
        described.body, described.indenter, (0.3 * A, 0.5 * A), offsets_for(window)
    )
    return DisplacementOperator(K, cells, domain, counter)


@pytest.mark.parametrize("window", [(2, 4), (12, 14), (26, 2 * LONG), (2 * LONG, 98)], ids=str)
@pytest.mark.parametrize("domain", DOMAINS, ids=str)
def test_operators_on_a_domain_are_those_on_the_window(domain, window, rng):
    """Approximate inverses are compared by the iterations of whole histories."""
    on_window, on_domain = (reduced_operator(part, window) for part in (WINDOW, domain))
    t = rng.standard_normal((3, *domain.cells(window)))

    def extended(tractions):
        q, p = np.split(tractions, [2])
        return np.concatenate([domain.extend(q), [domain.extend(one) for one in p]])

    def alone(of, tractions):
        return np.concatenate([of.tangential(tractions[:2]), of.normal(tractions[2])[None]])

    for apply in (alone, DisplacementOperator.together)[: 1 + (domain in COUPLED)]:
        found, expected = extended(apply(on_domain, t)), apply(on_window, extended(t))
        assert np.max(np.abs(found - expected)) < REDUCED_ROUND_OFF * np.max(np.abs(expected))


@pytest.mark.parametrize("domain", [WINDOW, *COUPLED], ids=str)
def test_slopes_are_central_differences_on_the_whole_window(domain, rng):
    """They are one-sided at the border of the window."""
    field = rng.random(domain.cells((8, 10)))
    expected = np.stack(np.gradient(domain.extend(field)))
    np.testing.assert_allclose(domain.differences(field), domain.restrict(expected), atol=1e-13)


def even_map():
    """A coefficient of friction that varies along x and along y."""
    x = (np.arange(40) - 19.5) / 10
    waves = np.cos(2 * x)[:, None] + np.cos(3 * x)
    return FrictionMap(map=MU * (1 + 0.2 * waves), spacing=0.1 * A)


class Leaf(Ellipsoid):
    """Derived from an even shape, but not even itself."""

    def initial_gap(self, x, y) -> Gap:
        """Along a diagonal."""
        return super().initial_gap(np.add(x, y), np.subtract(x, y))


COUPLED_PRESS = dict(PRESS, increments=1)


def test_a_shape_derived_from_an_even_one_is_not_taken_for_even():
    leaf = Leaf(radii=(RADIUS, 2 * RADIUS), material=steel())
    assert plan(scene(PRESS, indenter=leaf)).symmetry == WINDOW


REDUCED = {
    "pressed": (scene(PRESS), QUARTER),
    "along x": (scene(PRESS, push(0.6), push(-0.4), friction=even_map()), ALONG_X),
    "along y": (scene(PRESS, slide(0, 0.9), slide(0, 20)), ALONG_Y),
    "twisted": (scene(PRESS, {"torque": 0.1 * LIMIT * A}, {"twist": 0.0}), TWISTED),
    "coupled": (coupled_scenes.scene(COUPLED_PRESS), QUARTER),
    "coupled, along x": (coupled_scenes.scene(COUPLED_PRESS, push(0.5), push(1.0)), HALF_Y),
    "coupled, slid along y": (coupled_scenes.scene(COUPLED_PRESS, slide(0, 30)), HALF_X),
}


FIELDS = "pressure", "shear", "slip", "slip_distance", "approach", "tangential_force", "torque"
ENERGIES = "elastic_energy", "input_work", "dissipated_energy", "unresolved_work"


@pytest.mark.parametrize(("described", "domain"), REDUCED.values(), ids=REDUCED)
def test_a_reduced_domain_gives_the_result_of_the_window(described, domain):
    decided, on = plan(described), SurfaceGrid((18, 22), (3.0 * A, 3.4 * A))
    assert decided.symmetry == domain
    assert all_effects(decided).symmetry == WINDOW
    runs = (
        solve(described, on, 1e-11, plan=replace(decided, symmetry=d)) for d in (domain, WINDOW)
    )
    for found, expected in zip(*(run.increments for run in runs), strict=True):
        assert (found.status, found.iterations) == (expected.status, expected.iterations)
        for name in (*FIELDS, *ENERGIES):
            one, other = getattr(found, name), getattr(expected, name)
            if other is None:
                continue
            # Slip and losses may vanish.
            least = {"slip": 1e-2 * APPROACH, "slip_distance": 1e-2 * APPROACH, "torque": LIMIT * A}
            size = max(np.max(np.abs(other)), least.get(name, 0.0))
            size = expected.elastic_energy if name in ENERGIES else size
            np.testing.assert_allclose(one, other, rtol=0, atol=4e-10 * size, err_msg=name)


@pytest.mark.parametrize("offset", [(0.0, 0.0), (0.5, 0.0), (0.1, 0.35)])
def test_cells_beside_the_axis_are_solved_on_the_window(offset):
    """The indenter is even, but not its gap at the cells."""
    beside = ShiftedGrid((8, 8), (3 * A, 3 * A), offset)
    domain = ContactModel.from_scene(scene(PRESS), beside, QUARTER).domain
    assert (domain == QUARTER) == (offset == (0.0, 0.0))


class Liar(Paraboloid):
    """Declares symmetry, which it has along x alone."""

    @property
    def is_even(self) -> bool:
        """No."""
        return True

    def initial_gap(self, x, y) -> Gap:
        """Off the middle."""
        return super().initial_gap(x, np.subtract(y, 0.01 * A))


def test_a_false_declaration_of_symmetry_is_refused():
    with pytest.raises(ValueError, match=r"declares symmetry .* its gap differs"):
        solve(scene(PRESS, indenter=Liar(radius=RADIUS, material=steel())), grid(), 1e-8)
    gap = bump(6, A) - 1.0
    gap[0, 0] *= 1 + 1e-15  # round-off, as at the cells of a map that dips below its lowest height
    QUARTER.require_even(gap)
    gap[0, 0] *= 1 + 1e-6
    with pytest.raises(ValueError, match="its gap differs"):
        QUARTER.require_even(gap)
