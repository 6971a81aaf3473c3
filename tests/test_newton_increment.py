"""Newton's method for pressure and shear at once: product, derivative, start and cost."""

from dataclasses import replace

import numpy as np
import pytest
from contact_scenes import grid
from coupled_scenes import bulk, press, push, scene
from random_compliance import compliance
from test_alternation import LOADS, DenseContact, assert_lawful

from contact_scene.solver_errors import NotConverged
from semi_analytical import globalisation, newton_increment, solve, springs
from semi_analytical.coupled_problem import PATCHES
from semi_analytical.generalised_derivative import Natural, Point, Zones
from semi_analytical.globalisation import solve_together
from semi_analytical.grades import STIFFNESSES
from semi_analytical.krylov import least_residual
from semi_analytical.linearised_increment import LinearisedIncrement
from semi_analytical.model import ContactModel
from semi_analytical.newton_increment import solve_by_newton
from semi_analytical.newton_iterate import reached
from semi_analytical.predictor import Lens, predicted
from semi_analytical.pressing import NormalTarget
from semi_analytical.shearing import TangentialTarget

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


def test_the_inverse_of_coupled_bodies_is_that_of_both_problems_in_single_precision(rng):
    contact = model()
    A, shape = contact.operator((32, 16)), (32, 16)
    stiffness = contact.self_compliance * STIFFNESSES
    u = 1e-9 * rng.standard_normal((3 + len(stiffness), *shape))
    t = A.inverse(u)
    sheared = np.delete(u, 2, axis=0)
    expected = A.shear_inverse(sheared)
    expected = np.insert(expected, 2, A.precondition(u[2]), axis=0)
    np.testing.assert_allclose(t, expected, rtol=0, atol=1e-5 * np.max(np.abs(expected)))
    # The stiffer a cell is held, the nearer it is to its own spring.
    held = stiffness[:, None, None]
    off = np.linalg.norm(held * t[3:] - u[3:], axis=(1, 2)) / np.linalg.norm(u[3:], axis=(1, 2))
    assert np.all(np.diff(off) < 0)
    assert off[-1] < 0.2


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


@pytest.mark.parametrize("seed", range(3))
def test_a_step_near_the_solution_squares_the_error(seed, rng):
    contact = DenseContact(seed, 0.3)
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
    assert left(1e-4) < 30 * 1e-8
    assert left(1e-5) < 30 * 1e-10


@pytest.mark.parametrize("seed", range(3))
def test_a_step_closes_the_gap_of_its_whole_zone(seed):
    """Also of cells that would let go at the point it starts from."""
    contact = DenseContact(seed, 0.3)
    problem = contact.problem(*LOADS)
    solution = contact.solved(*LOADS, solver=solve_together)
    exact = np.concatenate([solution.shear, solution.pressure[None]])
    at = Point(exact, problem.together(exact), solution.approach, solution.motion)
    zones = Zones.of(Natural.at(at, problem), problem)
    pressed = zones.contact
    t = exact * np.where(np.cumsum(pressed).reshape(pressed.shape) % 2 == 0, 0.2, 1.0)
    base, _ = reached(problem, t, solution.motion)
    natural = Natural.at(base, problem)
    assert np.any(pressed & ~natural.contact)
    increment = LinearisedIncrement(problem, zones)
    step = increment.solved(increment.unsolved(base, natural), 1e-13)
    gap = problem.gap + base.displacements[2] + step.displacements[2]
    closure = np.broadcast_to(base.closure + step.closure, gap.shape)
    np.testing.assert_allclose(gap[pressed], closure[pressed], atol=1e-6)


@pytest.mark.parametrize("seed", range(3))
def test_slip_that_has_turned_is_kept_where_its_direction_is_taken_a_little_wrong(seed):
    """But for the square of the angle."""
    contact = DenseContact(seed, 0.3)
    problem = contact.problem(*LOADS)
    solution = contact.solved(*LOADS, solver=solve_together, tolerance=1e-13)
    exact = np.concatenate([solution.shear, solution.pressure[None]])
    at = Point(exact, problem.together(exact), solution.approach, solution.motion)
    zones, angle = Zones.of(Natural.at(at, problem), problem), 1e-3

    def turned(v):
        return np.cos(angle) * v + np.sin(angle) * np.stack([-v[1], v[0]])

    wrong = replace(zones, tangent=turned(zones.tangent), pulled=turned(zones.pulled))
    kept = LinearisedIncrement(problem, wrong).admissible(exact)
    assert np.any(solution.in_slip)
    np.testing.assert_allclose(kept, exact, atol=angle**2 * np.max(exact))


def test_where_newton_stalls_far_away_it_ends_on_springs(monkeypatch):
    contact = DenseContact(3, 0.3)
    expected = contact.solved(*LOADS, solver=solve_together)
    attempts = []

    def at_the_third_attempt(*given):
        attempts.append(given)
        if len(attempts) < 3:
            raise NotConverged("the coupled increment", 0, 1.0, TOLERANCE)
        return solve_by_newton(*given)

    def too_dear(*given, **most):
        raise NotConverged("the coupled increment", 0, 1.0, TOLERANCE)

    for module in (globalisation, springs):
        monkeypatch.setattr(module, "solve_by_newton", at_the_third_attempt)
    monkeypatch.setattr(globalisation, "solve_coupled", too_dear)
    solution = contact.solved(*LOADS, solver=solve_together)
    # From nothing and after a round; then only once next to the answer is it asked again.
    assert len(attempts) == 3
    near = np.concatenate([expected.shear, expected.pressure[None]])
    assert np.sum(np.abs(attempts[2][1] - near)) < 0.02 * np.sum(np.abs(near))
    assert_lawful(contact, solution)


def test_where_newton_stalls_the_alternation_comes_nearer_or_ends(monkeypatch):
    contact, failed = DenseContact(3, 0.3), []

    def stalling(*given):
        failed.append(given)
        if len(failed) < 4:
            raise NotConverged("the coupled increment", 0, 1.0, TOLERANCE)
        return solve_by_newton(*given)

    monkeypatch.setattr(globalisation, "solve_by_newton", stalling)
    monkeypatch.setattr(globalisation, "solve_on_springs", None)
    solution = contact.solved(*LOADS, solver=solve_together)
    assert len(failed) == 3
    assert_lawful(contact, solution)
    assert_lawful(contact, contact.solved(*LOADS, solver=solve_together))
    assert len(failed) == 4


def test_where_newton_stalls_on_springs_the_alternation_takes_over(monkeypatch):
    contact = DenseContact(3, 0.3)
    monkeypatch.setattr(newton_increment, "MOST_STEPS", 0)
    monkeypatch.setattr(springs, "MOST_STEPS", 0)
    solution = contact.solved(*LOADS, solver=solve_together)
    assert_lawful(contact, solution)


def test_springs_at_rest_pull_at_nothing_and_others_in_proportion(rng):
    contact = DenseContact(1, 0.3)
    problem, rest = contact.problem(*LOADS), rng.random((3, *contact.gap.shape))
    on_springs, change = problem.yielding(0.7, rest), rng.random(rest.shape)
    for t in (rest, rest + change):
        u, plain = on_springs.together(t), problem.together(t)
        gap, slipped = on_springs.gap + u[2], on_springs.target - u[:2]
        more = 0.7 * (t - rest)
        np.testing.assert_allclose(gap, problem.gap + plain[2] + more[2], atol=1e-13)
        np.testing.assert_allclose(slipped, problem.target - plain[:2] - more[:2], atol=1e-13)


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


def test_the_lens_dilates_a_pressure_of_hertz_into_that_of_a_larger_contact():
    at = np.arange(48.0)
    r2 = (at[:, None] - 20) ** 2 + (at - 25) ** 2
    p, wider = (np.sqrt(np.maximum(0, 1 - r2 / a**2)) for a in (10, 12))
    lens = Lens.over(p, 1.2)
    np.testing.assert_allclose(lens.centre, (20, 25))
    grown, shear = lens.grown(p, np.stack([0.1 * p, 0 * p]), 1.2**2)
    # Linear in p² but for the cells of the edge.
    np.testing.assert_allclose(grown**2, wider**2, atol=0.04)
    np.testing.assert_allclose(shear[0], 0.1 * grown, atol=1e-12)


@pytest.fixture(scope="module")
def marked_states():
    """Model and states of pressing, then pushing."""
    from semi_analytical import plan
    from semi_analytical.history import marked

    described = scene(press(increments=4), push(0.6, increments=4))
    contact = ContactModel.of(described, grid(32))
    return contact, [m.state for _, m in marked(contact, plan(described), TOLERANCE)]


@pytest.mark.parametrize("number", [2, 3, 6, 7])
def test_the_next_state_is_predicted_without_convolutions_and_nearer_than_by_the_last(
    marked_states, number
):
    contact, states = marked_states
    before, after = states[number - 1], states[number]
    count = contact.convolutions.count
    p, q = predicted(contact, before, after.target, TangentialTarget(force=after.sheared.force))
    assert contact.convolutions.count == count
    near = np.sum(np.abs(p - after.pressing.pressure)) + np.sum(np.abs(q - after.sheared.shear))
    last = np.sum(np.abs(before.pressing.pressure - after.pressing.pressure))
    last += np.sum(np.abs(before.sheared.shear - after.sheared.shear))
    assert near < 0.6 * last


def test_where_the_load_turns_the_path_says_nothing_of_its_end(marked_states):
    contact, states = marked_states
    back = TangentialTarget(force=0.5 * states[-1].sheared.force)
    p, q = predicted(contact, states[-1], states[-1].target, back)
    np.testing.assert_array_equal(p, states[-1].pressing.pressure)
    np.testing.assert_array_equal(q, states[-1].sheared.shear)
    assert predicted(contact, states[-1], NormalTarget(force=0.0), back) is None


def test_a_coupled_increment_takes_few_products():
    """Of three convolutions each; separate solvers in turns took 161."""
    described = scene(press(increments=15), push(0.9, increments=20))
    increments = solve(described, grid(64), TOLERANCE).increments
    assert all(increment.halvings == 0 for increment in increments)
    assert np.mean([increment.convolutions for increment in increments]) < 62


def test_on_many_cells_newton_alone_leads_to_the_end(monkeypatch):
    """In half more products than on a sixth of the cells along each side, at most."""
    monkeypatch.setattr(globalisation, "solve_coupled", None)
    described = scene(press(increments=5), push(0.2, increments=1))
    products = {}
    for cells in (48, 288):
        increments = solve(described, grid(cells), TOLERANCE).increments
        assert all(increment.halvings == 0 for increment in increments)
        products[cells] = sum(increment.convolutions for increment in increments)
    assert products[288] < 1.5 * products[48]


def test_newton_alone_presses_and_pushes_in_one_increment_each(monkeypatch):
    """By the compliance of single cells it stalls while the bodies are pressed together."""
    monkeypatch.setattr(globalisation, "solve_coupled", None)
    described = scene(press(increments=1), push(0.6, friction=0.3, increments=1), friction=0.3)
    increments = solve(described, grid(256), TOLERANCE).increments
    assert all(increment.halvings == 0 for increment in increments)


def test_the_natural_map_takes_single_cells_while_there_are_few():
    contact = DenseContact(0, 0.3)
    problem = contact.problem(*LOADS)
    assert problem.gamma * problem.self_compliance == pytest.approx(1)
    wide = replace(problem, gap=np.zeros((8 * PATCHES, 2 * PATCHES)))
    assert wide.gamma == pytest.approx(0.5 * problem.gamma)


@pytest.mark.parametrize("friction", [0.3, 1.0])
def test_strong_friction_starts_from_the_shear_that_comes_with_a_pressure(friction, monkeypatch):
    """Without shear Newton's method goes from all sticks to all slips and back: it took 142 and 171
    convolutions, by the alternation where it stalled."""
    monkeypatch.setattr(globalisation, "_from_nearer", None)
    of = scene(press(increments=1), body=bulk(0.4), friction=friction)
    (pressed,) = solve(of, grid(64), TOLERANCE).increments
    assert pressed.convolutions < 115
