"""Tests of the coupled solvers on small dense problems: contact law, friction law, convergence."""

import numpy as np
import pytest
from contact_scenes import grid
from coupled_scenes import press, push, scene
from hypothesis import given
from hypothesis import strategies as st
from random_compliance import as_map, compliance, graded_inverse, pressed, pushed, rough_inverse

from contact_solver.admissible_shear import magnitude
from contact_solver.binned_preconditioner import BinnedPreconditioner
from contact_solver.coupled_problem import CoupledProblem
from contact_solver.globalisation import solve_together
from contact_solver.krylov import least_residual
from contact_solver.slip_compliance_bins import COMPLIANCES
from semi_analytical import solve

TOLERANCE = 1e-11
POINTS = 12
NO_SHIFT = np.zeros(2)
ANGLES = st.floats(0, 2 * np.pi)


class Held:
    """Roughly the tractions by the diagonal of a compliance alone."""

    def __init__(self, diagonal, self_compliance):
        """diagonal  (3, n), in front of that of the grades"""
        grades = np.ones((len(COMPLIANCES), diagonal.shape[1]))
        grades *= self_compliance * (1 + COMPLIANCES[:, None])
        self._given = diagonal, self_compliance
        self._held = np.concatenate([diagonal, grades])

    exact = False

    def __call__(self, displacements):
        return displacements / self._held

    def in_zones(self, zones):
        return BinnedPreconditioner(zones, self, self._given[1])

    def with_compliance(self, compliance):
        return Held(*(part + compliance for part in self._given))


class DenseContact:
    """Bodies of a few cells that answer any traction (q_x, q_y, p) by a symmetric matrix."""

    def __init__(self, seed, friction, coupling=1.0):
        rng = np.random.default_rng(seed)
        self.matrix = compliance(rng, 3 * POINTS)
        self.matrix[2 * POINTS :, : 2 * POINTS] *= coupling
        self.matrix[: 2 * POINTS, 2 * POINTS :] *= coupling
        self.gap = 3 * rng.random(POINTS)
        self.gap[0] = 0.0
        self.target = 0.3 * rng.standard_normal((2, POINTS))
        self.friction = friction

    def limit(self, p):
        return self.friction * p

    def displacements(self, p, q):
        u = self.matrix @ np.concatenate([q.ravel(), p])
        return u[2 * POINTS :], u[: 2 * POINTS].reshape(2, POINTS)

    def problem(self, normal_load, tangential_load):
        tangent, normal = np.split(np.arange(3 * POINTS), [2 * POINTS])
        A_tt, A_zz = self.matrix[np.ix_(tangent, tangent)], self.matrix[np.ix_(normal, normal)]
        A_zt = self.matrix[np.ix_(normal, tangent)]
        rough, self_compliance = graded_inverse(A_tt), float(np.mean(np.diag(A_tt)))
        return CoupledProblem(
            normal=as_map(A_zz),
            inverse_on=lambda contact: rough_inverse(A_zz),
            tangential=as_map(A_tt),
            inverse_in=lambda zones: BinnedPreconditioner(zones, rough, self_compliance),
            normal_by_shear=lambda q: A_zt @ q.ravel(),
            shear_by_pressure=lambda p: (A_zt.T @ p).reshape(2, POINTS),
            together=as_map(self.matrix),
            inverse=Held(np.diag(self.matrix).reshape(3, POINTS), self_compliance),
            gap=self.gap,
            friction_limit=self.limit,
            friction_slope=lambda p: self.friction + 0 * p,
            target=self.target,
            closing=normal_load,
            shifting=tangential_load,
            self_compliance=self_compliance,
        )

    def solved(self, normal_load, tangential_load, tolerance=TOLERANCE):
        problem = self.problem(normal_load, tangential_load)
        return solve_together(problem, np.ones(POINTS), np.zeros((2, POINTS)), NO_SHIFT, tolerance)


def assert_lawful(contact, solution):
    """No tension, no overlap, no gap under pressure; sticks inside the disc, slips on its edge."""
    p, q = solution.pressure, solution.shear
    u_z, u_t = contact.displacements(p, q)
    (approach,) = solution.closing
    g = contact.gap + u_z - approach
    slip = solution.motion[:, None] + contact.target - u_t
    bound = contact.limit(p)
    assert np.all(p >= 0)
    assert np.all(g >= -1e-9)
    assert np.max(np.abs(g * p)) <= 1e-8 * np.max(p)
    assert np.all(magnitude(q) <= bound + 1e-12 * np.max(p))
    assert np.all(magnitude(slip)[(p > 0) & ~solution.in_slip] <= 1e-7)
    against = bound * magnitude(slip) - np.sum(q * slip, axis=0)
    assert np.max(against) <= 1e-8 * np.max(bound) * (1 + np.max(magnitude(slip)))


SEEDS = st.integers(0, 2**32 - 1)
FRICTION = st.sampled_from([0.01, 0.3, 1.0])


@given(SEEDS, FRICTION, st.sampled_from([0.0, 0.3, 0.95]), ANGLES)
def test_under_forces_all_laws_hold_and_the_loads_are_carried(seed, friction, part, angle):
    contact, total = DenseContact(seed, friction), 7.0
    force = part * friction * total * np.array([np.cos(angle), np.sin(angle)])
    solution = contact.solved(pressed(total), pushed(force))
    assert_lawful(contact, solution)
    assert np.sum(solution.pressure) == pytest.approx(total, rel=1e-12)
    np.testing.assert_allclose(np.sum(solution.shear, axis=1), force, atol=1e-11 * total)


@given(SEEDS, FRICTION, st.sampled_from([0.0, 0.3, 30.0]), ANGLES)
def test_under_prescribed_motions_all_laws_hold(seed, friction, size, angle):
    contact = DenseContact(seed, friction, coupling=0.5)
    shift = size * np.array([np.cos(angle), np.sin(angle)])
    solution = contact.solved(pressed(approach=2.0), pushed(shift=shift))
    assert solution.closing == [2.0]
    np.testing.assert_array_equal(solution.motion, shift)
    assert_lawful(contact, solution)


def test_strong_coupling_converges():
    contact = DenseContact(0, 10.0, coupling=1.5)
    assert_lawful(contact, contact.solved(*LOADS))


LOADS = pressed(7.0), pushed(np.array([0.5, 0.3]))


def test_a_single_point_carries_the_load_although_the_start_does_not():
    contact = DenseContact(3, 0.0)
    contact.gap[1:] = 1e3
    problem = contact.problem(pressed(7.0), pushed((0.0, 0.0)))
    start = np.where(contact.gap == 0, 1.0, 0.0)
    found = solve_together(problem, start, np.zeros((2, POINTS)), NO_SHIFT, TOLERANCE)
    assert np.sum(found.pressure) == pytest.approx(7.0, rel=1e-14)


LOOSE = 1e-8


def test_gmres_leaves_nothing_that_unknowns_or_free_motions_explain(rng):
    """Also where free motions depend on each other."""
    matrix = compliance(rng, 12) + 0.3 * np.triu(rng.standard_normal((12, 12)))
    one = rng.standard_normal(12)
    free = np.stack([one, 2 * one, rng.standard_normal(12)])
    right = rng.standard_normal(12)
    for depth in (1e-1, 1e-12):
        found = least_residual(lambda w: (3 * w, matrix @ w, 7 * w[:5]), right, free, 5, depth, 12)
        np.testing.assert_allclose(3 * found.image, matrix @ found.solution, atol=1e-12)
        np.testing.assert_allclose(3 * found.extra, 7 * found.solution[:5], rtol=1e-5, atol=1e-6)
    np.testing.assert_allclose(found.image + found.motion @ free, right, atol=1e-10)


def test_a_coupled_increment_takes_few_products():
    """Of three convolutions each; separate solvers in turns took 161."""
    described = scene(press(increments=15), push(0.9, increments=20))
    increments = solve(described, grid(64), LOOSE).increments
    assert all(increment.halvings == 0 for increment in increments)
    assert np.mean([increment.convolutions for increment in increments]) < 62
