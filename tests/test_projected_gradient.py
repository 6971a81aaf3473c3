"""Tests of the contact solver against an accelerated projected gradient method (Nesterov 1983).

The method knows no zones, multipliers or preconditioners. At the rigid motions of a solution it
computes the tractions anew, which are unique; the forces of the solution are checked by their sums.
"""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from contact_scenes import APPROACH, LOAD, A, grid, scene
from coupled_scenes import coated
from coupled_scenes import scene as coupled_scene
from fem_scenes import solved

import radial
from contact_scene import Scene
from contact_solver.newton_increment import solve_by_newton
from contact_solver.pressure import PressureProblem
from contact_solver.shear import ShearProblem
from fem_reference import Method
from fem_reference.contact import point_problem
from radial.angular_grid import RingAngles
from radial.discretised import RingSolver
from radial.tangential import ring_friction
from semi_analytical import solve
from semi_analytical.coupled import coupled_increment
from semi_analytical.increments import normal_solve, tangential_solve


def disc(z, limit):
    return z * np.minimum(1, limit / np.maximum(np.hypot(*z), 1e-300))


def by_projected_gradient(apply, law, shape):
    """Fixed point of a law: function of the trial tractions t - step u, and of the step."""
    t = v = np.random.default_rng(1).random(shape)
    for _ in range(20):  # largest eigenvalue of the compliance
        v = apply(v / np.linalg.norm(v))
    step, t, y, speed = 0.9 / np.linalg.norm(v), 0 * t, 0 * t, 1.0
    for _ in range(50_000):
        last, t = t, law(y - step * apply(y), step)
        if np.sum((y - t) * (t - last)) > 0:  # restart, O'Donoghue and Candès 2015
            speed = 1.0
        faster = 0.5 * (1 + np.sqrt(1 + 4 * speed**2))
        moved, y, speed = t - y, t + (speed - 1) / faster * (t - last), faster
        if np.max(np.abs(moved)) <= 1e-11 * np.max(np.abs(t)):
            return t
    raise AssertionError("the projected gradient method did not converge")


def again(problem, solution):
    """Tractions of a solution, and those by projected gradients at its rigid motions."""
    if isinstance(problem, PressureProblem):
        closed = problem.gap - problem.closure(solution.motion)
        return solution.pressure, by_projected_gradient(
            problem.displace, lambda p, step: np.maximum(p - step * closed, 0), closed.shape
        )
    if isinstance(problem, ShearProblem):
        slip = problem.target + problem.motions.displacement(solution.motion)
        return solution.shear, by_projected_gradient(
            problem.displace, lambda q, step: disc(q + step * slip, problem.bound), slip.shape
        )
    closed = problem.gap - problem.pressing.closure(solution.closing)
    slip = problem.target + problem.shifting.displacement(solution.motion)

    def law(t, step):
        p = np.maximum(t[2] - step * closed, 0)
        return np.stack([*disc(t[:2] + step * slip, problem.friction_limit(p)), p])

    found = by_projected_gradient(problem.together, law, (3, *closed.shape))
    return np.stack([*solution.shear, solution.pressure]), found


def drawn(seed: int, *, of_revolution: bool = False) -> Scene:
    """A load history of two to four steps on similar or on coated bodies, and its friction.

    With the symmetry of rings it has loads along x or torsion alone.
    """
    rng = np.random.default_rng(seed)
    friction = float(10 ** rng.uniform(-2, -0.3))
    press = {"normal_force": LOAD * rng.uniform(0.5, 1)}
    alike = rng.random() < 0.5
    # Elements do not combine torsion and coupling.
    twists = of_revolution and alike and rng.random() < 0.3
    if not of_revolution:
        if alike and rng.random() < 0.3:
            press = {"approach": APPROACH * rng.uniform(0.7, 1)}
        if rng.random() < 0.2:
            press["moment"] = tuple(0.1 * LOAD * A * rng.uniform(-1, 1, 2))
    loading = [press]
    for part in rng.choice([-0.9, -0.6, 0.3, 0.6, 0.9], rng.integers(1, 4)):
        angle = 0.0 if of_revolution else rng.uniform(0, 2 * np.pi)
        along = 0.3 * friction * part * np.array([np.cos(angle), np.sin(angle)])
        step = {"tangential_force": tuple(LOAD * along)}
        if twists:
            step = {"torque": 0.2 * friction * LOAD * A * part}
        if not of_revolution and rng.random() < 0.3:
            step = {"tangential_shift": tuple(APPROACH * along)}
        if not of_revolution and rng.random() < 0.2:
            step["torque"] = 0.02 * friction * LOAD * A * rng.uniform(-1, 1)
        loading.append(step)
    loading = [{"increments": 1, **step} for step in loading]
    if alike:
        return scene(*loading, friction=friction)
    film = coated(10 ** rng.uniform(-0.7, 1), rng.uniform(0.3, 1), rng.choice([0.0, 0.3, 0.49]))
    return coupled_scene(*loading, body=film, friction=friction)


def keep_increments(monkeypatch: pytest.MonkeyPatch, *solvers: tuple[Any, str]) -> list[Any]:
    """A list to which these functions, by module and name, append their problems and solutions."""
    kept = []

    def watched(solver):
        def solve_and_keep(problem, *given, **more):
            solution = solver(problem, *given, **more)
            kept.append((problem, solution))
            return solution

        return solve_and_keep

    for module, name in solvers:
        monkeypatch.setattr(module, name, watched(getattr(module, name)))
    return kept


def assert_same_tractions(kept: list[Any]) -> None:
    """Compare the last increment of each kind of problem with projected gradients."""
    by_kind = {type(problem): (problem, solution) for problem, solution in kept}
    assert by_kind
    for problem, solution in by_kind.values():
        own, found = again(problem, solution)
        assert np.max(np.abs(own - found)) <= 1e-6 * np.max(np.abs(own))


@pytest.mark.parametrize("seed", range(12))
def test_drawn_increments_on_cells_have_the_tractions_of_projected_gradients(seed, monkeypatch):
    kept = keep_increments(
        monkeypatch,
        (normal_solve, "solve_pressure"),
        (tangential_solve, "solve_shear"),
        (coupled_increment, "solve_together"),
    )
    solve(drawn(seed), grid(20, 2.0), 1e-10)
    assert_same_tractions(kept[1:])


@pytest.mark.parametrize("law", Method)
@pytest.mark.parametrize("seed", range(6))
def test_drawn_increments_on_elements_have_the_tractions_of_projected_gradients(
    seed, law, monkeypatch
):
    names = ("solve_pressure", "solve_shear", "solve_together")
    kept = keep_increments(monkeypatch, *((point_problem, name) for name in names))
    solved(drawn(seed, of_revolution=True), 6, law, harmonics=3)
    assert_same_tractions(kept[1:])


@pytest.mark.parametrize("seed", range(12))
def test_drawn_increments_on_rings_have_the_tractions_of_projected_gradients(seed, monkeypatch):
    names = ("solve_by_newton", "solve_together")
    kept = keep_increments(monkeypatch, *((ring_friction, name) for name in names))
    asked = drawn(seed, of_revolution=True)
    chosen = radial.plan(asked)  # torsion at points, although it has a closed form
    few = replace(chosen, circle=chosen.circle or RingAngles.ONE, fineness=0.3)
    result = radial.solve(asked, plan=few)
    assert_same_tractions(kept[1:])
    _, last = kept[-1]
    assert RingSolver.of(result).unknowns(result) == last.pressure.size + last.shear.size


def test_a_loose_tolerance_gives_admissible_tractions(monkeypatch):
    """Exact inverses: iterates far from the solution are not admissible and do not count."""
    kept = keep_increments(monkeypatch, (point_problem, "solve_together"))
    solved(drawn(3, of_revolution=True), 6, harmonics=3)
    problem, solution = kept[-1]
    start = solution.pressure, 0.99 * solution.shear, solution.motion
    found = solve_by_newton(problem, *start, 0.1)
    assert found.closing == pytest.approx(solution.closing, rel=1e-2)
    assert np.all(np.hypot(*found.shear) <= problem.friction_limit(found.pressure) * (1 + 1e-9))
