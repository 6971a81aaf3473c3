"""Tests of the references of challenges: solvers of this program answer them within a class."""

import numpy as np
import pytest

import slipstick
from contact_scene import RIGID, Body
from semi_analytical.influence.bodies import influence_coefficients
from verification import Answer, judge
from verification.challenge.cases import MOVED
from verification.challenge.solver_process import Posed
from verification.judging.outcome import Status

OTHER_NAMES = {"shift": "tangential_shift", "moment": "moment"}


def number(problem, key, steps):
    quantity, step = key
    end, (name, _, axis) = steps[step - 1], quantity.rpartition("_")
    if quantity == "energy_per_cycle":
        return float(end.dissipated_energy - steps[problem.since[key] - 1].dissipated_energy)
    found = getattr(end, OTHER_NAMES.get(name, quantity), None)
    return found if found is None or np.isscalar(found) else float(found["xy".index(axis)])


def answer(problem, on, solver, fineness):
    scene = slipstick.Scene.model_validate(problem.scene)
    increments = 1 if scene.friction is None else 10 * fineness
    loading = [
        s.model_copy(update={"increments": s.increments or increments}) for s in scene.loading
    ]
    steps = slipstick.solve(scene.model_copy(update={"loading": tuple(loading)}), solver, on).steps
    found = {key: number(problem, key, steps) for key in problem.asked}
    h = problem.window / fineness
    return Answer(h, {key: value for key, value in found.items() if value is not None})


def on_cells(problem: Posed, level: int) -> Answer:
    n, side = 32 * 2**level, problem.window
    on = slipstick.SurfaceDiscretisation(cells=(n, n), window=(side, side))
    return answer(problem, on, "semi-analytical", 2**level)


def on_radii(problem: Posed, level: int) -> Answer:
    on = slipstick.RadialDiscretisation(rings=32 * 2**level)
    return answer(problem, on, "radial", 2**level)


@pytest.mark.parametrize(
    ("name", "solve", "levels", "grade"),
    [
        ("hertz_elliptical", on_cells, 2, "C"),
        ("tilted_ball", on_cells, 2, "C"),
        ("torsion_loop", on_radii, 2, "C"),
        ("coated_paraboloid/E1_over_E2=4", on_radii, 2, "A"),
    ],
)
def test_solvers_answer_within_a_class(name, solve, levels, grade):
    found = judge(name, solve, levels, grade, seconds=None)
    failed = [row for row in found.rows if row.status is Status.FAIL]
    assert not failed
    assert sum(row.error is not None for row in found.rows) >= 1


@pytest.mark.parametrize("ratio", ["0.5", "2"])
def test_influence_coefficients_answer_the_patch(ratio):
    """The patch is one cell, and the points are centres of others."""

    def solve(problem, level):
        side, traction = (problem.scene["patch"][name] for name in ("side", "traction"))
        body, points = Body.model_validate(problem.scene["body"]), {}
        for key, places in problem.places.items():
            i, j = np.rint(places[:, :2].T / side).astype(int)
            most = int(i.max()) + 1, int(np.abs(j).max()) + 1
            K = influence_coefficients(body, Body(material=RIGID), (side, side), most)
            component = next(name for name, moved in MOVED.items() if moved == key[0])
            odd = np.sign(j) if component == "xy" else 1
            points[key] = traction * odd * K[component][i, np.abs(j)]
        return Answer(side, points=points)

    found = judge(f"layered_patch/G1_over_G2={ratio}", solve, 1, "A", seconds=None)
    assert found.exit_code() == 0, found.rows
