"""Tests of the formula of stated errors: parts, sizes, orders, and numbers that need more cells."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from contact_scenes import (
    INDENTERS,
    LOAD,
    PRESS,
    paraboloid,
    push,
    scene,
    steel,
)
from error_scenes import size

from contact_errors.error_formula import (
    Comparison,
    SolvedRun,
    _annulus_of_pressing,
    build_stated_error,
    characteristic_size,
    largest_so_far,
)
from contact_scene import (
    RIGID,
    FiniteElementDiscretisation,
    RadialDiscretisation,
    Scene,
)
from contact_scene.contact_features import Features
from contact_scene.quantities.stated_error import (
    ErrorStatus,
    StatedError,
)
from fem_reference import Method
from fem_reference import Path as ElementPath
from fem_reference.discretised import ElementSolver
from radial.discretised import RingSolver
from verification.references import load_reference

NATURAL = ("normal_force", "contact_radius", "contact_area", "peak_pressure")


def stated(
    asked: Scene, steps: list[dict], comparisons: list[Comparison], *features: Features
) -> list[dict[Any, StatedError]]:
    """Errors of numbers at the ends of load steps of a contact whose natural sizes are 1."""
    given = [dict.fromkeys(NATURAL, np.ones(1)) | step for step in steps]
    parts = {comparison.part for comparison in comparisons} or {"cells"}
    needed = {part: [True] * len(steps) for part in parts}
    tolerances = [1e-8] * len(steps)
    return [*SolvedRun(asked, given, tolerances, features, comparisons, needed, {}).errors()]


def approach(size: float) -> list[dict]:
    return [{"approach": np.array([size])}]


def errors_of_one(comparisons: list[Comparison], features: Features) -> StatedError:
    """Error of an approach of 2."""
    return stated(scene(PRESS), approach(2.0), comparisons, features)[0]["approach"]


@pytest.mark.parametrize(
    ("indenter", "annulus", "status"),
    [
        (paraboloid(), 0.3, "exact"),  # alike bodies: slip is symmetric
        (paraboloid(RIGID), 0.3, "not converged"),  # narrower than the cells, which all stick
        (paraboloid(RIGID), None, "not converged"),  # hidden: a smooth edge slips
    ],
)
def test_a_stick_zone_with_a_centre_at_0_on_every_grid(indenter, annulus, status):
    middle = [{"stick_centre": np.zeros(2), "stick_area": np.ones(1)}] * 2
    features = Features(contact=10.0, stick=9.7, annulus=annulus)
    same = Comparison("cells", middle, middle, [2.0, 2.0], [features] * 2)
    asked = scene(PRESS, push(0.1), indenter=indenter)
    assert stated(asked, middle, [same], features, features)[1]["stick_centre"].status == status


def test_the_annulus_of_pressing_is_nearly_that_of_spence():
    """It decides if slip at a rim may hide: its order of magnitude counts."""
    row = load_reference("frictional_indentation_homogeneous")["rows"][1]
    posed = scene(PRESS, indenter=paraboloid(RIGID), body=steel(row["nu"]), friction=row["mu"])
    assert 1 < (1 - row["c_over_a"]) / _annulus_of_pressing(posed) < 1.5


def test_a_worked_example():
    """2 on the run, 2.06 and 1.98 on half and 8/15 of the cells: 3 times the root mean square of
    0.06/(2^4 + 1)^½ = 0.01455 and 0.02/(1.875^4 + 1)^½ = 0.00547; increments 0.01/(2^0.6 - 1) =
    0.01939; tolerance 10·2e-8."""
    two, coarse, other, recut = map(approach, (2.0, 2.06, 1.98, 2.01))
    comparisons = [
        Comparison("cells", two, coarse, [2.0]),
        Comparison("cells", two, other, [1.875]),
        Comparison("increments", two, recut, [2.0]),
    ]
    found = errors_of_one(comparisons, Features(contact=10))
    assert found.status is ErrorStatus.ESTIMATED
    assert found.parts == pytest.approx(
        {"cells": 0.03298, "increments": 0.01939, "tolerance": 2e-7}, rel=2e-4
    )
    few = errors_of_one(comparisons, Features(contact=3.9))
    far = [Comparison("cells", two, approach(5.0), [2.0])]
    assert few.status is ErrorStatus.NOT_CONVERGED
    assert "contact is 3.9 cells, below the limit 4" in (few.reason or "")
    large = errors_of_one(far, Features(10))
    assert large.status is ErrorStatus.NOT_CONVERGED
    assert "exceeds the number" in (large.reason or "")
    unknown = errors_of_one([], Features(10))
    assert unknown.error is None
    assert "coarse solve" in (unknown.reason or "")
    assert found.reason is None


@pytest.mark.parametrize(
    ("ratios", "finest"),
    [({"cells": 2.0}, 1.0), ({"cells": 0.5}, 0.5), ({"cells": 2.0, "increments": 0.5}, 1.0)],
    ids=["the run", "a finer solve", "other increments"],
)
def test_the_finest_solve_has_to_resolve_the_contact(ratios, finest):
    """Four of its cells are the least, however wide those of the run are."""
    same = approach(2.0)
    compared = [Comparison(part, same, same, [ratio]) for part, ratio in ratios.items()]
    found = [errors_of_one(compared, Features(contact=4 * finest * x)) for x in (1.01, 0.99)]
    assert [one.status for one in found] == [ErrorStatus.ESTIMATED, ErrorStatus.NOT_CONVERGED]


HISTORIES = {
    "sticks": (scene(PRESS, push(0.1)), {"stick": 9.0}, True),
    "narrow": (scene(PRESS, push(0.1)), {"stick": 9.0, "annulus": 0.05}, True),
    "resolved": (scene(PRESS, push(0.1)), {"stick": 9.0, "annulus": 0.2}, False),
    "slides": (scene(PRESS, push(0.1)), {"stick": None}, False),
    "twisted": (scene(PRESS, {"twist": 1e-5}), {"stick": 9.0}, True),
    "after a push": (scene(PRESS, push(0.1), push(0.0)), {"stick": 9.0}, True),
    "unlike": (scene(PRESS, body=steel(0.1)), {"stick": 9.0}, True),
    "pressed": (scene(PRESS, {"normal_force": LOAD / 2}), {"stick": 9.0}, False),
    "growing": (scene({**PRESS, **push(0.1)}), {"stick": 9.0}, False),
    "rim": (scene(PRESS, push(0.1), indenter=INDENTERS["flat punch"]), {"stick": 9.0}, False),
    "unlike rim": (
        scene(PRESS, indenter=INDENTERS["flat punch"], body=steel(0.1)),
        {"stick": 9.0},
        True,
    ),
    "sticky rim": (
        scene(PRESS, indenter=INDENTERS["flat punch"], body=steel(0.1), friction=5.0),
        {"stick": 9.0},
        False,
    ),
    "frictionless": (scene(PRESS, body=steel(0.1), friction=None), {"stick": 9.0}, False),
}


@pytest.mark.parametrize("name", ["dissipated_energy", "energy_per_cycle", "torque"])
@pytest.mark.parametrize(("history", "features", "hidden"), HISTORIES.values(), ids=HISTORIES)
def test_energy_that_no_cell_loses_is_unknown_where_the_edge_slips(history, features, hidden, name):
    """Slip at the edge of a smooth contact may be narrower than a cell; torque needs no slip."""
    steps = [{name: np.zeros(1)}] * len(history.loading)
    cells = Comparison("cells", steps, steps, [2.0] * len(steps))
    *_, errors = stated(history, steps, [cells], *[Features(10, **features)] * len(steps))
    assert errors[name].error == (None if hidden and name != "torque" else 0.0)


@pytest.mark.parametrize(
    ("size", "status"),
    [(1e-20, ErrorStatus.ESTIMATED), (1e-6, ErrorStatus.NOT_CONVERGED)],
    ids=["round-off", "slip"],
)
def test_a_shift_that_is_round_off_needs_no_cells(size, status):
    """A slip annulus narrower than half a cell leaves the shift open only where something slips."""
    one = {"approach": np.ones(1)}
    fine, coarse = ([one | {"tangential_shift": np.array([x, 0.0])}] for x in (size, 2 * size))
    cells = Comparison("cells", fine, coarse, [2.0])
    posed, features = scene({**PRESS, **push(0.1)}), Features(10, annulus=0.0)
    assert stated(posed, fine, [cells], features)[0]["tangential_shift"].status is status


@pytest.mark.parametrize(
    ("name", "expected"),
    {"torque": 15.0, "approach": 2.0, "twist": 0.4, "elastic_energy": 6.0}.items(),
)
def test_a_size_is_made_of_those_with_its_unit(name, expected):
    sizes = {"approach": 2.0, "normal_force": 3.0, "contact_radius": 5.0}
    values = {key: np.array([size]) for key, size in sizes.items()}
    others = {"contact_area": np.zeros(1), "peak_pressure": np.zeros(1)}
    assert characteristic_size(name, values | others) == pytest.approx(expected)


def test_parts_without_a_coarse_solve_are_those_of_their_step_and_body():
    steps = [SimpleNamespace(worst_residual=size) for size in (1e-9, 1e-5)]
    rings = RingSolver(scene({"approach": 1e-6}), RadialDiscretisation())
    assert rings.residuals(SimpleNamespace(steps=steps)) == [1e-9, 1e-5]
    inclined = SimpleNamespace(plan=SimpleNamespace(path=ElementPath.SHEARING))
    elements = ElementSolver(rings.scene, FiniteElementDiscretisation())
    ratio = rings.scene.body.elastic_materials[0].poisson_ratio
    left = 1 - np.cos(ratio / (4 - 2 * ratio))  # of Mindlin's slip across the load
    assert elements.neglected_errors(inclined)["stick_radius"] == pytest.approx(left, rel=0.01)
    pushed = SimpleNamespace(
        plan=SimpleNamespace(path=ElementPath.HARMONICS),
        sections=[SimpleNamespace(outline=SimpleNamespace(box=40.0))],
    )
    mesh = FiniteElementDiscretisation(overlap=1e-3, harmonics=12)
    solver = ElementSolver(rings.scene, mesh, method=Method.PENALTY)
    solves = solver.mesh_coarse_solves(mesh, pushed)
    found = {coarse.key: (coarse.value, coarse.ratio) for coarse in solves}
    assert found == {"overlap": (1e-2, 10.0), "harmonics": (8, 1.5), "box": (10.0, 4.0)}


@pytest.mark.parametrize(
    ("last", "status"), [(push(0.1), "not converged"), ({"normal_force": 2 * LOAD}, "estimated")]
)
def test_a_cusp_stays_unresolved_until_the_normal_load_changes(last, status):
    small, large = (Features(contact=10.0, stick=stick, cusp=True) for stick in (0.5, 5.0))
    peaks = [[{"peak_pressure": np.array([value])}] * 2 for value in (1.0, 1.1)]
    levels = [Comparison("cells", *peaks, [2.0, 2.0])]
    found = stated(scene(PRESS, last), peaks[0], levels, small, large)
    assert [one["peak_pressure"].status for one in found] == ["not converged", status]
    first, second = (one["peak_pressure"].reason for one in found)
    assert first is not None
    assert second == (f"since step 1, {first}" if status == "not converged" else None)


@pytest.mark.parametrize("order", [1.0, 2.0])
@pytest.mark.parametrize("ratios", [(1.9, 2.5, 3.0), (1.5, 2.0), (0.5,)])
@pytest.mark.parametrize("part", ["cells", "section"])
def test_an_error_that_falls_as_a_power_is_covered_and_not_by_much(order, ratios, part):
    """Three spreads cover a systematic error as well; the order of other parts is 2."""
    order = order if part == "cells" else 2.0
    exact, fine = 2.0, 2.0 + 0.1**order
    coarse = [2.0 + (0.1 * ratio) ** order for ratio in ratios]
    comparisons = [
        Comparison(part, approach(fine), approach(other), [ratio])
        for other, ratio in zip(coarse, ratios, strict=True)
    ]
    found = errors_of_one(comparisons, Features(10, largest_order=order))
    assert abs(fine - exact) < size(found) < 3.0 * abs(fine - exact)


def test_an_error_is_no_smaller_than_that_of_an_earlier_step():
    at_2, at_3 = ({"peak_pressure": np.full(1, size)} for size in (2.0, 3.0))
    part = Comparison("cells", [at_2, at_2], [at_3, at_2], [2.0, 2.0])
    posed, features = scene({"approach": 1e-6}, {"approach": 2e-6}), Features(contact=10)
    errors = stated(posed, [at_2] * 2, [part], features, features)
    first, second = (step["peak_pressure"].error for step in errors)
    assert second == first > 0.1


def test_components_of_a_vector_share_one_size():
    steps = [{"tangential_shift": np.array(shift)} for shift in ((3.0, 1e-12), (2.0, -1.0))]
    sizes = [found["tangential_shift"] for found in largest_so_far(steps)]
    np.testing.assert_array_equal(sizes, [[3.0, 3.0]] * 2)  # also where it has become smaller
    assert build_stated_error({"cells": np.array([1.0, 2.0])}, None).error == (1.0, 2.0)


@pytest.mark.parametrize(
    ("name", "features", "resolved"),
    [
        ("approach", {"stick": 0.0, "annulus": 0.0, "layer": 1.0, "wave": 4.0}, True),
        ("approach", {"layer": 0.9}, False),
        ("approach", {"layer": 1.9, "layer_at_edge": 2.0}, True),
        ("contact_radius", {"layer": 1.9}, True),
        ("contact_radius", {"layer": 1.9, "layer_at_edge": 2.0}, False),
        ("approach", {"wave": 3.9}, False),
        ("stick_radius", {"stick": 0.9}, False),
        ("tangential_shift", {"stick": 9.0, "annulus": 0.1}, True),
        ("tangential_shift", {"stick": 0.0, "annulus": 9.0}, False),
        ("tangential_shift", {"stick": 0.0, "annulus": 9.0, "slides": True}, True),
        ("dissipated_energy", {"stick": 0.0, "annulus": 0.0}, False),
        ("dissipated_energy", {"stick": 9.0, "annulus": 0.0}, False),
        ("peak_pressure", {"stick": 0.0}, True),
        ("peak_pressure", {"stick": 0.0, "cusp": True}, False),
        ("peak_pressure", {"stick": 0.0, "cusp": True, "slides": True}, True),
    ],
)
def test_a_number_needs_cells_for_what_it_depends_on(name, features, resolved):
    assert (Features(contact=10.0, **features).unresolved(name) is None) is resolved
