"""Newton's method for pressure and shear at once: product, derivative, start and cost."""

import numpy as np
import pytest
from contact_scenes import grid
from coupled_scenes import bulk, press, push, scene
from random_compliance import compliance
from test_alternation import LOADS, DenseContact

from semi_analytical import solve
from semi_analytical.coupled.generalised_derivative import (
    Natural,
    Point,
    Zones,
)
from semi_analytical.coupled.globalisation import solve_together
from semi_analytical.coupled.krylov import least_residual
from semi_analytical.coupled.linearised_increment import LinearisedIncrement
from semi_analytical.coupled.newton_iterate import reached
from semi_analytical.model import ContactModel
from semi_analytical.operator.slip_compliance_bins import STIFFNESSES

TOLERANCE = 1e-8


def model(cells=32):
    return ContactModel.of(scene(press()), grid(cells))


@pytest.mark.parametrize("shape", [(32, 32), (16, 48), (80, 32)])
def test_the_fused_product_is_that_of_the_operators_and_takes_three_convolutions(shape, rng):
    A = model(96).operator(shape)
    tractions = rng.standard_normal((3, *shape))
    q, p = tractions[:2], tractions[2]
    u_t = A.tangential(q) + A.tangential_by_pressure(p)
    u_z = A.normal(p) + A.normal_by_shear(q)
    counter = A.transforms.counter
    before = counter.count
    u = A.together(tractions)
    assert counter.count == before + 3
    np.testing.assert_allclose(u[:2], u_t, rtol=0, atol=1e-14 * np.max(np.abs(u_t)))
    np.testing.assert_allclose(u[2], u_z, rtol=0, atol=1e-14 * np.max(np.abs(u_z)))


def test_gmres_leaves_nothing_that_unknowns_or_free_motions_explain(rng):
    """Also where free motions depend on each other."""
    matrix = compliance(rng, 12) + 0.3 * np.triu(rng.standard_normal((12, 12)))
    one = rng.standard_normal(12)
    free = np.stack([one, 2 * one, rng.standard_normal(12)])
    right = rng.standard_normal(12)
    for depth in (1e-1, 1e-12):
        found = least_residual(lambda v: (matrix @ v, 7 * v[:5]), right, free, 5, depth, 12)
        np.testing.assert_allclose(found.image, matrix @ found.solution, atol=1e-12)
        np.testing.assert_allclose(found.along, 7 * found.solution[:5], rtol=1e-5, atol=1e-6)
    np.testing.assert_allclose(found.image + found.motion @ free, right, atol=1e-10)


@pytest.mark.parametrize("saturation", [np.inf, 4.0])
@pytest.mark.parametrize("seed", range(3))
def test_a_step_near_the_solution_squares_the_error(seed, saturation, rng):
    """Under Coulomb's law, and under one whose slope is not the ratio of limit and pressure."""
    contact = DenseContact(seed, 0.3, saturation=saturation)
    problem = contact.problem(*LOADS)
    solution = contact.solved(*LOADS, solver=solve_together, tolerance=1e-13)
    exact = np.concatenate([solution.shear, solution.pressure[None]])
    direction = rng.standard_normal(exact.shape) * np.max(exact)

    def left(size):
        t = exact + size * direction * (exact[2] > 0)
        t[2] = problem.normal_load.admissible(t[2])
        at = Point(t, problem.together(t), solution.approach, solution.motion)
        zones = Zones.of(Natural.at(at, problem), problem)
        increment = LinearisedIncrement(problem, zones)
        base, _ = reached(problem, increment.admissible(t), solution.motion)
        unsolved = increment.unsolved(base, Natural.at(base, problem))
        step = increment.solved(unsolved, 1e-13)
        return np.max(np.abs(base.tractions + step.tractions - exact)) / np.max(exact)

    assert 0 < np.count_nonzero(solution.in_slip) < np.count_nonzero(solution.pressure)
    assert left(1e-6) < 0.03 * left(1e-5) + 1e-12


@pytest.mark.parametrize("softness", [0.01, 1.0, 100.0])
def test_the_inverse_of_cells_on_springs_is_that_of_the_sum_of_compliances(softness, rng):
    contact, shape = model(), (32, 16)
    own = contact.self_compliance
    A, more = contact.operator(shape), softness * contact.self_compliance
    found = A.inverse.yielding(more)
    u = 1e-9 * rng.standard_normal((3 + len(STIFFNESSES), *shape))
    # F + ρ by F of the coefficients, those of a cell on itself raised by the springs.
    rows, columns = A.transforms.half_period

    def unpadded(pair):
        return A.spectrum(pair)[::2][:, ::2].T

    spectra = np.fft.rfft2(u, (rows, columns))
    xx, yy, xy = (unpadded(pair) for pair in ("xx", "yy", "xy"))
    matrix = np.moveaxis(np.array([[xx + more, xy], [xy, yy + more]]), (0, 1), (-2, -1))
    sheared = np.linalg.solve(matrix, np.moveaxis(spectra[:2], 0, -1)[..., None])[..., 0]
    graded = 0.5 * (xx + yy) + more + (own + more) * STIFFNESSES[:, None, None]
    solved = np.concatenate(
        [
            np.moveaxis(sheared, -1, 0),
            spectra[2:3] / (unpadded("zz") + more),
            spectra[3:] / graded,
        ]
    )
    expected = np.fft.irfft2(solved, (rows, columns))[:, : shape[0], : shape[1]]
    size = np.max(np.abs(expected), axis=(1, 2), keepdims=True)
    np.testing.assert_allclose(found(u) / size, expected / size, atol=1e-5)


def test_a_coupled_increment_takes_few_products():
    """Of three convolutions each; separate solvers in turns took 161."""
    described = scene(press(increments=15), push(0.9, increments=20))
    increments = solve(described, grid(64), TOLERANCE).increments
    assert all(increment.halvings == 0 for increment in increments)
    assert np.mean([increment.convolutions for increment in increments]) < 62


def test_strong_friction_starts_from_the_shear_that_comes_with_a_pressure():
    """Without shear Newton's method goes from all sticks to all slips and back."""
    described = scene(press(increments=1), body=bulk(0.4), friction=1.0)
    (pressed,) = solve(described, grid(64), TOLERANCE).increments
    assert pressed.convolutions < 115
