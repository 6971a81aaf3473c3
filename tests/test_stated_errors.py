"""Tests of stated errors: they cover the true errors, or the number is marked as not converged."""

import ast
import json
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple, cast

import h5py
import numpy as np
import pytest
from command import outcome, rows, slipstick
from contact_scenes import (
    INDENTERS,
    LIMIT,
    LOAD,
    MU,
    PRESS,
    RADIUS,
    YOUNG,
    A,
    grid,
    hertz,
    paraboloid,
    push,
    scene,
    steel,
)
from scene_texts import COARSE, STEEL_BALL_PRESSED
from scipy.optimize import minimize_scalar

import contact_errors
import fem_reference
import slipstick as package
from contact_errors import coarse_solves
from contact_errors.coarse_solves import (
    add_effects,
    coarse_increment_counts,
    fewest_increments,
    ratios,
)
from contact_errors.error_formula import (
    Comparison,
    SolvedRun,
    build_stated_error,
    characteristic_size,
    largest_so_far,
    prescribed_scalars,
    unknown_error,
    values_of,
)
from contact_errors.known_pressing import known_pressing
from contact_errors.stress_errors import largest_stresses, stress_at, stress_errors
from contact_results.number_text import doubt_texts
from contact_results.stress.loaded_bodies import LoadedBodies, state_of_result
from contact_results.stress.on_cells import OnCells
from contact_results.stress.stress_maxima import extremes
from contact_scene import (
    RIGID,
    Body,
    Cone,
    CoulombFriction,
    Ellipsoid,
    FiniteElementDiscretisation,
    FlatPunch,
    HeightMap,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    RadialDiscretisation,
    RevolvedProfile,
    Scene,
    SurfaceDiscretisation,
    discretised,
)
from contact_scene.contact_features import PEAK, Features
from contact_scene.discretised import Fineness
from contact_scene.quantities.field_metadata import Kind
from contact_scene.quantities.stated_error import (
    ErrorStatus,
    StatedError,
)
from contact_scene.quantities.summary import OF_CYCLES
from contact_scene.reading.scene_file import read_scene_file
from contact_scene.rig import Rig
from contact_scene.solver_errors import NotConverged
from contact_scene.stepping.increment_error import (
    has_increment_error,
    near_gross_slip,
)
from fem_reference import Method
from fem_reference import Path as ElementPath
from fem_reference.discretised import ElementSolver
from radial.discretised import RingSolver
from semi_analytical import SurfaceGrid, solve
from semi_analytical.discretised import CellSolver
from semi_analytical.edge_correction import pressure as pressure_correction
from semi_analytical.edge_correction.pressure import left_over
from slipstick import stated_errors
from verification.cases.frictional_pressing import WEAK
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.coated_indentation import paraboloid as pressed_coating
from verification.closed_forms.flat_punch import ConeContact
from verification.closed_forms.hertz import EllipticalContact, contact_modulus, tangential_modulus
from verification.closed_forms.huber_stress import axis_stress, trailing_edge_tension
from verification.problems.drawn.drawing import Profile
from verification.problems.drawn.families import Similar
from verification.problems.problem import surface_of

SLOW = pytest.mark.slow
SCENES = Path(__file__).parents[1] / "scenes"


def size(error: StatedError) -> float:
    assert error.error is not None
    return float(np.max(error.error))


def largest_tension(result: Any) -> tuple[float, StatedError]:
    """Of the body, at the end."""
    of_body = largest_stresses(result, stated_errors(result), ["max_principal@body"])
    ((value, error),) = of_body.values()
    assert error is not None
    return value, error


# ---- the formula ------------------------------------------------------------------------------


def errors_of_one(order: float, comparisons: list[Comparison], features: Features) -> StatedError:
    """Error of an approach of 2 with the natural sizes of a contact."""
    names = ("normal_force", "contact_radius", "contact_area", "peak_pressure")
    values = {name: np.ones(1) for name in names} | {"approach": np.array([2.0])}
    needed = {comparison.part: [True] for comparison in comparisons} or {"cells": [True]}
    run = SolvedRun(scene(PRESS), [values], [1e-8], [features], comparisons, needed, {})
    return next(run.errors())["approach"]


def test_a_worked_example() -> None:
    """2 on the run, 2.06 and 1.98 on half and 8/15 of the cells: 3 times the root mean square of
    0.06/(2^4 + 1)^½ = 0.01455 and 0.02/(1.875^4 + 1)^½ = 0.00547; increments 0.01/(2^0.6 - 1) =
    0.01939; tolerance 10·2e-8."""
    two, coarse, other, recut = ([{"approach": np.array([x])}] for x in (2.0, 2.06, 1.98, 2.01))
    comparisons = [
        Comparison("cells", two, coarse, [2.0]),
        Comparison("cells", two, other, [1.875]),
        Comparison("increments", two, recut, [2.0]),
    ]
    found = errors_of_one(2.0, comparisons, Features(contact=10))
    assert found.status is ErrorStatus.ESTIMATED
    assert found.parts == pytest.approx(
        {"cells": 0.03298, "increments": 0.01939, "tolerance": 2e-7}, rel=2e-4
    )
    few = errors_of_one(2.0, comparisons, Features(contact=3.9))
    far = [Comparison("cells", two, [{"approach": np.array([5.0])}], [2.0])]
    assert few.status is ErrorStatus.NOT_CONVERGED
    assert "contact is 3.9 cells, below the limit 4" in (few.reason or "")
    large = errors_of_one(2.0, far, Features(10))
    assert large.status is ErrorStatus.NOT_CONVERGED
    assert "exceeds the number" in (large.reason or "")
    unknown = errors_of_one(2.0, [], Features(10))
    assert unknown.error is None
    assert "coarse solve" in (unknown.reason or "")
    assert found.reason is None


@pytest.mark.parametrize(
    ("ratios", "finest"),
    [({"cells": 2.0}, 1.0), ({"cells": 0.5}, 0.5), ({"cells": 2.0, "increments": 0.5}, 1.0)],
    ids=["the run", "a finer solve", "other increments"],
)
def test_the_finest_solve_has_to_resolve_the_contact(ratios, finest) -> None:
    """Four of its cells are the least, however wide those of the run are."""
    same = [{"approach": np.array([2.0])}]
    compared = [Comparison(part, same, same, [ratio]) for part, ratio in ratios.items()]
    found = [errors_of_one(2.0, compared, Features(contact=4 * finest * x)) for x in (1.01, 0.99)]
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
    "frictionless": (scene(PRESS, body=steel(0.1), friction=None), {"stick": 9.0}, False),
}


@pytest.mark.parametrize("name", ["dissipated_energy", "energy_per_cycle", "torque"])
@pytest.mark.parametrize(("history", "features", "hidden"), HISTORIES.values(), ids=HISTORIES)
def test_energy_that_no_cell_loses_is_unknown_where_the_edge_slips(
    history, features, hidden, name
) -> None:
    """Slip at the edge of a smooth contact may be narrower than a cell; torque needs no slip."""
    names = ("normal_force", "contact_radius", "contact_area", "peak_pressure")
    end = {one: np.ones(1) for one in names} | {name: np.zeros(1)}
    steps = [end] * len(history.loading)
    cells = Comparison("cells", steps, steps, [2.0] * len(steps))
    known = [Features(10, **features)] * len(steps)
    run = SolvedRun(
        history, steps, [1e-8] * len(steps), known, [cells], {"cells": [True] * len(steps)}, {}
    )
    *_, errors = run.errors()
    assert errors[name].error == (None if hidden and name != "torque" else 0.0)


@pytest.mark.parametrize(
    ("size", "status"),
    [(1e-20, ErrorStatus.ESTIMATED), (1e-6, ErrorStatus.NOT_CONVERGED)],
    ids=["round-off", "slip"],
)
def test_a_shift_that_is_round_off_needs_no_cells(size: float, status: ErrorStatus) -> None:
    """A slip annulus narrower than half a cell leaves the shift open only where something slips."""
    names = ("approach", "normal_force", "contact_radius", "contact_area", "peak_pressure")
    sizes = {name: np.ones(1) for name in names}
    fine, coarse = ([{**sizes, "tangential_shift": np.array([x, 0.0])}] for x in (size, 2 * size))
    cells = Comparison("cells", fine, coarse, [2.0])
    posed, features = scene({**PRESS, **push(0.1)}), Features(10, annulus=0.0)
    run = SolvedRun(posed, fine, [1e-8], [features], [cells], {"cells": [True]}, {})
    assert next(run.errors())["tangential_shift"].status is status


@pytest.mark.parametrize(
    ("name", "expected"),
    {"torque": 15.0, "approach": 2.0, "twist": 0.4, "elastic_energy": 6.0}.items(),
)
def test_a_size_is_made_of_those_with_its_unit(name, expected) -> None:
    sizes = {"approach": 2.0, "normal_force": 3.0, "contact_radius": 5.0}
    values = {key: np.array([size]) for key, size in sizes.items()}
    others = {"contact_area": np.zeros(1), "peak_pressure": np.zeros(1)}
    assert characteristic_size(name, values | others) == pytest.approx(expected)


def test_parts_without_a_coarse_solve_are_those_of_their_step_and_body() -> None:
    steps = [SimpleNamespace(worst_residual=size) for size in (1e-9, 1e-5)]
    rings = RingSolver(scene({"approach": 1e-6}), RadialDiscretisation())
    assert rings.residuals(cast("Any", SimpleNamespace(steps=steps))) == [1e-9, 1e-5]
    inclined = SimpleNamespace(plan=SimpleNamespace(path=ElementPath.SHEARING))
    elements = ElementSolver(rings.scene, FiniteElementDiscretisation())
    ratio = rings.scene.body.elastic_materials[0].poisson_ratio
    left = 1 - np.cos(ratio / (4 - 2 * ratio))  # of Mindlin's slip across the load
    assert elements.neglected_errors(cast("Any", inclined))["stick_radius"] == pytest.approx(
        left, rel=0.01
    )
    pushed = SimpleNamespace(
        plan=SimpleNamespace(path=ElementPath.HARMONICS),
        sections=[SimpleNamespace(outline=SimpleNamespace(box=40.0))],
    )
    mesh = FiniteElementDiscretisation(overlap=1e-3, harmonics=12)
    solver = ElementSolver(rings.scene, mesh, method=Method.PENALTY)
    solves = solver.mesh_coarse_solves(mesh, cast("Any", pushed))
    found = {coarse.key: (coarse.value, coarse.ratio) for coarse in solves}
    assert found == {"overlap": (1e-2, 10.0), "harmonics": (8, 1.5), "box": (10.0, 4.0)}


@pytest.mark.parametrize("order", [1.0, 2.0])
@pytest.mark.parametrize("ratios", [(1.9, 2.5, 3.0), (1.5, 2.0), (0.5,)])
@pytest.mark.parametrize("part", ["cells", "section"])
def test_an_error_that_falls_as_a_power_is_covered_and_not_by_much(order, ratios, part) -> None:
    """Three spreads cover a systematic error as well; the order of other parts is 2."""
    order = order if part == "cells" else 2.0
    exact, fine = 2.0, 2.0 + 0.1**order
    coarse = [2.0 + (0.1 * ratio) ** order for ratio in ratios]
    of_fine, *others = ([{"approach": np.array([x])}] for x in (fine, *coarse))
    comparisons = [
        Comparison(part, of_fine, other, [ratio])
        for other, ratio in zip(others, ratios, strict=True)
    ]
    found = errors_of_one(order, comparisons, Features(10, largest_order=order))
    assert abs(fine - exact) < size(found) < 3.0 * abs(fine - exact)


@pytest.mark.parametrize(
    ("name", "features", "resolved"),
    [
        ("approach", {"stick": 0.0, "annulus": 0.0, "layer": 1.0, "wave": 4.0}, True),
        ("approach", {"layer": 0.9}, False),
        ("approach", {"wave": 3.9}, False),
        ("stick_radius", {"stick": 0.9}, False),
        ("tangential_shift", {"stick": 9.0, "annulus": 0.1}, True),
        ("tangential_shift", {"stick": 0.0, "annulus": 9.0}, False),
        ("tangential_shift", {"stick": 0.0, "annulus": 9.0, "slides": True}, True),
        ("dissipated_energy", {"stick": 0.0, "annulus": 0.0}, False),
        ("peak_pressure", {"stick": 0.0}, True),
        ("peak_pressure", {"stick": 0.0, "cusp": True}, False),
        ("peak_pressure", {"stick": 0.0, "cusp": True, "slides": True}, True),
    ],
)
def test_a_number_needs_cells_for_what_it_depends_on(name, features, resolved) -> None:
    assert (Features(contact=10.0, **features).unresolved(name) is None) is resolved


@pytest.mark.parametrize(
    ("name", "asked", "solver"),
    [
        ("semi-analytical", SurfaceDiscretisation(cells=(24, 24)), CellSolver),
        ("fem", FiniteElementDiscretisation(elements_per_radius=8), ElementSolver),
        ("radial", RadialDiscretisation(), RingSolver),
    ],
)
def test_the_peak_of_a_coupled_contact_is_a_cusp(name, asked, solver) -> None:
    """Friction changes the pressure below a rigid ball, and not between two alike bodies."""
    orders = []
    for like in (False, True):
        posed = rubbed(body=Body(material=steel()), like=like)
        result = package.solve(posed, name, asked)
        orders.append(solver.of(result).features(result)[-1].convergence_order("peak_pressure"))
    assert orders[0] == 0.5 < orders[1]


def test_a_slip_zone_smaller_than_a_cell_leaves_a_cell_open() -> None:
    """Shear that no cell of 16² slips by is locked in; on 12² and 24² none slips either."""
    unloaded = {"normal_force": 0.5 * LOAD}
    posed = rubbed(push(0.67), push(0.0), unloaded, body=Body(material=steel()))
    few, many = (package.solve(posed, "semi-analytical", cells(count)) for count in (16, 96))
    error = size(stated_errors(few).steps[-1]["stick_radius"])
    wrong = abs(few.steps[-1].stick_radius - many.steps[-1].stick_radius)
    assert 0.01 * A < wrong < error < 5 * wrong


def test_a_coarse_edge_that_is_not_fitted_does_not_count_for_a_fitted_one() -> None:
    """On a third of 40² cells the stick zone has 3 cells; all three solves give 4.4 times."""
    posed = rubbed(push(0.9), body=Body(material=steel(0.0)))
    result = package.solve(posed, "semi-analytical", cells(40))
    radius = 0.1 ** (1 / 3) * hertz(poisson_ratio=0.0).contact_radius
    wrong = abs(result.steps[-1].stick_radius - radius)
    assert wrong < size(stated_errors(result).steps[-1]["stick_radius"]) < 3 * wrong


def test_slip_of_torsion_on_cells_states_a_regular_error() -> None:
    """The edge correction leaves torsion out: three times the spread of the coarse solves is too
    small on 56² cells. The closed form on rings is the reference."""
    turns = [{"torque": part * LIMIT * A} for part in (0.5, -0.5, 0.5)]
    posed = rubbed(*turns, body=Body(material=steel()))
    found, exact = (
        package.solve(posed, solver, asked)
        for solver, asked in (("semi-analytical", cells(56)), ("radial", RadialDiscretisation()))
    )
    ours, known = (values_of(one)[-1]["slip_amplitude"][0] for one in (found, exact))
    error = size(stated_errors(found).steps[-1]["slip_amplitude"])
    assert 0.5 * error < abs(ours - known) < error


def test_a_stick_zone_in_the_middle_has_an_exact_centre() -> None:
    posed = rubbed(push(0.6), push(-0.6), push(0.6), body=Body(material=LOOSE))
    result = package.solve(posed, "semi-analytical", cells(24))
    assert stated_errors(result).steps[-1]["stick_centre"].status is ErrorStatus.EXACT


def test_constants_are_those_that_are_explained() -> None:
    """A new constant in the package, or where a solver describes its discretisation, needs a
    derivation, and an entry here: no quantity and no kind of scene has a constant of its own.
    Functions have units and round-off alone."""
    found, within = set(), set()
    root = Path(contact_errors.__file__).parents[1]
    features = root / "contact_scene" / "contact_features.py"
    for path in (*root.glob("contact_errors/*.py"), *root.glob("*/discretised.py"), features):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for node in tree.body:
            if isinstance(node, ast.Assign | ast.AnnAssign) and numbers_in(node.value or node):
                target = node.targets[0] if isinstance(node, ast.Assign) else node.target
                found |= {part.id for part in ast.walk(target) if isinstance(part, ast.Name)}
            else:
                within |= numbers_in(node)
    assert found == CONSTANTS
    assert within <= {0, 0.5, 1, 2, 3, 4, 6, 10, 30, 1e-9, 1e-3}


def numbers_in(node: ast.AST) -> set[float]:
    parts = (part.value for part in ast.walk(node) if isinstance(part, ast.Constant))
    return {value for value in parts if type(value) in (int, float)}


CONSTANTS = {
    # of the formula
    *("SPREADS", "BELIEVED", "SMOOTH", "EDGE", "ROOT"),
    *("PER_TOLERANCE", "LARGEST_SHARE", "REFERENCE_PRECISION"),
    *(
        "ORDERS",
        "LIMITS",
        "FITTED_STICK",
        "FITTED_SLIP",
        "NARROWEST",
        "STICK_SIZES",
        "ROUND_OFF",
        "PRECISION",
        "HIGHEST",
    ),
    # of the coarse solves
    *("SHARES", "SHARES_OF_SMALL", "SMALL", "FEW", "MANY", "PER_RADIUS"),
    *("NEGLIGIBLE", "ROOM", "MAX_ENLARGEMENTS"),
    *("FEWEST_ELEMENTS", "SMALLEST_BOX", "FEWEST_HARMONICS", "LARGEST_OVERLAP", "LINEAR"),
    *("NEAR", "COARSE", "OF_FINER", "OF_ANOTHER_FIT", "EDGE_PRECISION", "FINENESS"),
    # of the refinement
    *("SPARE", "DOUBT", "FURTHEST", "MAX_AT_ONCE", "LEAST_AT_ONCE", "UNCONVERGED"),
    *("MAX_ROUNDS", "MAX_WORSE"),
    *("FIRST_CELLS", "FIRST_PATH_ACCURACY", "MAX_CELLS", "LEAST_TOLERANCE"),
    *("MAX_DOUBLINGS", "DOUBLING"),
    *("FIRST_ELEMENTS", "MAX_ELEMENTS", "MAX_HARMONICS", "LEAST_OVERLAP", "LARGEST_BOX"),
    *("FIRST_FINENESS", "MAX_FINENESS"),
    # of the cost estimate
    *("EXPONENT", "CELL_OVERHEAD", "ELEMENT_OVERHEAD", "RING_OVERHEAD", "SET_UP_INCREMENTS"),
    *("INCREMENTS", "STEPS", "MAX_STEPS"),
}


# ---- increments -------------------------------------------------------------------------------

LOOSE = steel(poisson_ratio=0.0)
FILM = Body(material=LOOSE, layers=(Layer(thickness=A, material=steel(young_modulus=2 * YOUNG)),))


def rubbed(*loading: dict[str, Any], body: Body, like: bool = True, **more: Any) -> Scene:
    ball = paraboloid(body.material if like else RIGID, **more)
    ball = ball.model_copy(update={"layers": body.layers if like else ()})
    return scene(PRESS, *loading, indenter=ball).model_copy(update={"body": body})


TWIST = {"torque": 1e-3}
BOTH = {"torque": 1e-3, "tangential_force": (50.0, 0.0)}
ACROSS = {"tangential_force": (0.0, 50.0)}
MATTERS = {
    "pressed, alike": (rubbed(body=Body(material=steel())), [False]),
    "pressed, coupled": (rubbed(body=Body(material=steel()), like=False), [True]),
    "pushed, ν = 0": (rubbed(push(0.6), push(-0.6), body=Body(material=LOOSE)), [False] * 3),
    "turned, ν = 0": (rubbed(push(0.6), ACROSS, body=Body(material=LOOSE)), [False, False, True]),
    "pushed, ν = 0.3": (rubbed(push(0.6), body=Body(material=steel())), [False, True]),
    "pushed, coated": (rubbed(push(0.6), body=FILM), [False, True]),
    "twisted, coated": (rubbed(TWIST, body=FILM), [False, False]),
    "twisted and pushed": (rubbed(BOTH, body=Body(material=LOOSE)), [False, True]),
    "unloaded while pushed": (
        rubbed(push(0.3), {"normal_force": LOAD / 2}, body=Body(material=LOOSE)),
        [False, False, True],
    ),
    "without friction": (scene(PRESS, friction=None), [False]),
}


@pytest.mark.parametrize("name", MATTERS)
def test_increments_have_no_error_in_three_proved_cases_alone(name: str) -> None:
    posed, expected = MATTERS[name]
    assert list(has_increment_error(posed)) == expected


def test_increments_of_coarse_solves() -> None:
    counts = (1, 2, 5, 20, 40)
    matters = (False, True, True, True, True)
    many, few = coarse_increment_counts(counts, matters)
    assert many == (1, 32, 32, 40, 80)
    assert few == (1, 8, 8, 8, 8)
    assert fewest_increments(counts, matters) == (1, 2, 5, 8, 8)
    # Four increments less are not worth one more solve.
    assert fewest_increments((8, 8, 8, 12), (True,) * 4) == (8, 8, 8, 12)
    # Without a load step of few increments, twice their number alone.
    assert coarse_increment_counts((1, 8, 40), (False, True, True)) == [(1, 32, 80)]
    # A step that inherits a state takes the ratio nearest to 1 so far.
    assert ratios(counts, many, matters) == (1.0, 1 / 16, 5 / 32, 1 / 2, 1 / 2)
    of_many, of_few = ([{"approach": np.array([x])}] for x in (3.0, 2.0))
    assert add_effects([{"approach": np.array([1.0])}], [(of_many, of_few)]) == [{"approach": 2.0}]


def test_a_push_near_gross_slip_is_marked() -> None:
    near, far, loose = (
        near_gross_slip(rubbed(push(part), push(0.1), body=Body(material=matter)))
        for part, matter in ((0.999, steel()), (0.9, steel()), (0.999, LOOSE))
    )
    assert near == (False, True, True)  # what has slipped remains
    assert not any((*far, *loose))


# ---- references of the pressing ----------------------------------------------------------------


@pytest.mark.parametrize("radii", [(0.01, 0.002), (0.002, 0.01), (0.01, 1.0)])
@pytest.mark.parametrize("by", ["force", "approach"])
def test_a_pressed_ellipsoid_is_that_of_hertz(radii, by) -> None:
    pair = steel(0.3)
    exact = EllipticalContact.under_load(LOAD, radii, contact_modulus((YOUNG, 0.3), (YOUNG, 0.3)))
    step = PRESS if by == "force" else {"approach": exact.approach}
    posed = scene(step, push(0.5), indenter=Ellipsoid(radii=radii, material=pair), body=pair)
    ((pressed, pushed),) = known_pressing(posed)
    a, b = exact.semi_axes
    expected = {
        "approach": exact.approach,
        "normal_force": LOAD,
        "contact_area": np.pi * a * b,
        "contact_radius": np.sqrt(a * b),
        "peak_pressure": exact.peak_pressure,
        "elastic_energy": 0.4 * LOAD * exact.approach,
    }
    for name, value in expected.items():
        assert pressed[name] == pytest.approx(value, rel=1e-11), name
    assert "elastic_energy" not in pushed  # the shear stores energy, too


def test_scenes_without_reference() -> None:
    pair = {"indenter": paraboloid(RIGID), "body": steel()}
    for posed in (
        scene(PRESS, **pair),  # coupled by friction
        scene({**PRESS, "tilt": (1e-3, 0.0)}),
        scene({"approach": 1e-6}).model_copy(update={"rig": Rig(normal_stiffness=1e8)}),
        mapped("paraboloid", 16).scene,
    ):
        assert not known_pressing(posed)
    assert known_pressing(scene(PRESS, friction=None, **pair))


def test_all_pressed_numbers_of_known_scenes_need_no_coarse_solve() -> None:
    """Their error is the difference from the reference, on cells and elements."""
    for solver in ("semi-analytical", "fem-complementarity"):
        result = package.solve(scene(PRESS, friction=None), solver)
        stated = stated_errors(result)
        assert not stated.coarse_solves
        for name, value in {"approach": hertz().approach, "contact_radius": A}.items():
            wrong = abs(float(values_of(result)[0][name][0]) - value)
            assert size(stated.steps[0][name]) == pytest.approx(wrong, rel=1e-2), (solver, name)


# ---- scenes with a known answer ----------------------------------------------------------------


class Known(NamedTuple):
    """A scene, the solver, and numbers of one step; `spoilt` numbers must be not converged."""

    scene: Scene
    exact: dict[str, float]
    asked: Any = None
    solver: str = "semi-analytical"
    step: int = -1
    spoilt: tuple[str, ...] = ()
    uncertain: float = 1e-6


def bodies(young: float, nu: float) -> IsotropicMaterial:
    return IsotropicMaterial(young_modulus=young, poisson_ratio=nu)


def alike(young: float, nu: float, radius: float, mu: float, *steps: LoadStep) -> Scene:
    matter = bodies(young, nu)
    return Scene(
        indenter=Paraboloid(radius=radius, material=matter),
        body=Body(material=matter),
        friction=CoulombFriction(coefficient=mu),
        loading=steps,
    )


def indented(
    radius: float,
    load: float,
    film: Layer | None,
    base: Any,
    mu: float | None = None,
    *more: LoadStep,
) -> Scene:
    return Scene(
        indenter=Paraboloid(radius=radius, material=RIGID),
        body=Body(material=base, layers=() if film is None else (film,)),
        friction=None if mu is None else CoulombFriction(coefficient=mu),
        loading=(LoadStep(normal_force=load), *more),
    )


def cells(count: int, **more: Any) -> SurfaceDiscretisation:
    return SurfaceDiscretisation(cells=(count, count), **more)


def hertzian(count: int) -> Known:
    exact = {n: getattr(hertz(), n) for n in ("approach", "contact_radius", "peak_pressure")}
    return Known(scene(PRESS), exact, cells(count))


def elements(count: int, solver: str) -> Known:
    known = hertzian(8)
    return known._replace(
        asked=FiniteElementDiscretisation(elements_per_radius=count),
        solver=solver,
        scene=scene(PRESS, friction=None),
    )


def cattaneo(solver: str = "semi-analytical") -> Known:
    contact = hertz(poisson_ratio=0.0)
    modulus = tangential_modulus((YOUNG, 0.0), (YOUNG, 0.0))
    state = PartialSlip(LOAD, contact.contact_radius, MU, modulus, 0.6 * MU * LOAD)
    exact = {
        "tangential_shift": state.shift,
        "stick_radius": state.stick_radius,
        "dissipated_energy": state.dissipated_energy,
    }
    return Known(rubbed(push(0.6), body=Body(material=LOOSE)), exact, None, solver)


def cone() -> Known:
    contact = ConeContact(0.02, contact_modulus((YOUNG, 0.3), (YOUNG, 0.3)), A)
    indenter = Cone(slope_angle=0.02, material=steel())
    pressed = scene({"normal_force": contact.load}, indenter=indenter, friction=None)
    return Known(pressed, {"contact_radius": A, "approach": contact.approach}, cells(32))


def pushed_cone(part: float) -> Known:
    """By the principle of Jaeger and Ciavarella, with ν = 0."""
    sharp = Cone(slope_angle=0.02, material=LOOSE)
    posed = scene(PRESS, push(part), indenter=sharp, body=LOOSE)
    shift, _, lost, _ = Similar(posed, LOAD, MU).first(part * MU * LOAD)
    return Known(posed, {"tangential_shift": shift, "dissipated_energy": lost}, cells(48))


def ridge(**shape: float) -> Known:
    """The largest pressure of a rounded flat or a ring, by finer cells."""
    profile = Profile(scale=RADIUS, material=steel(), **shape)
    posed = scene(PRESS, friction=None).model_copy(update={"indenter": profile})
    asked = SurfaceDiscretisation(window=(3 * A, 3 * A), cells=(60, 60))
    finer = asked.model_copy(update={"cells": (256, 256)})
    (end,) = package.solve(posed, "semi-analytical", finer).steps
    return Known(posed, {"peak_pressure": end.peak_pressure}, asked, uncertain=2e-4)


# Half width of a map, radius of its flat or of its tip.
HALF = 0.5e-3
FLAT = 0.2e-3
ROUND = 10e-3
MAPPED: dict[str, tuple[Callable[[Any], Any], dict[str, float]]] = {
    # Sneddon's solution by quadrature.
    "flat that ends in a parabola": (
        lambda r: np.square(np.maximum(r - FLAT, 0.0)) / (2 * ROUND),
        {"approach": 2.3496933e-6, "peak_pressure": 411.287e6, "contact_radius": 0.3227329e-3},
    ),
    "paraboloid": (
        lambda r: np.square(r) / (2 * ROUND),
        {"approach": 4.5639031e-6, "peak_pressure": 1046.1765e6, "contact_radius": 0.21363293e-3},
    ),
    "cone": (lambda r: 0.02 * r, {"approach": 6.3906732e-6}),
}


def mapped(name: str, count: int) -> Known:
    """A shape of revolution by the heights at some of its points."""
    height, exact = MAPPED[name]
    at = (np.arange(count) + 0.5) * 2 * HALF / count - HALF
    heights: Any = height(np.hypot(at[:, None], at))
    indenter = HeightMap(file=heights, spacing=2 * HALF / count, material=RIGID)  # type: ignore[arg-type]
    body = Body(material=bodies(70e9, 0.3))
    loads = (LoadStep(normal_force=100.0),)
    return Known(Scene(indenter=indenter, body=body, loading=loads), exact)


def revolved(name: str, count: int, solver: str) -> Known:
    """The same shapes by the heights at some radii."""
    height, exact = MAPPED[name]
    radii = np.linspace(0.0, 0.6e-3, count)
    posed = mapped(name, 4).scene
    profile = RevolvedProfile(file=np.stack([radii, height(radii)], axis=1), material=RIGID)  # type: ignore[arg-type]
    return Known(posed.model_copy(update={"indenter": profile}), exact, None, solver)


def coated_profile(solver: str) -> Known:
    known = revolved("flat that ends in a parabola", 31, solver)
    coating = Layer(thickness=1e-4, material=bodies(210e9, 0.25))
    posed = known.scene.model_copy(
        update={"body": known.scene.body.model_copy(update={"layers": (coating,)})}
    )
    exact = {"approach": 2.096421e-6, "contact_radius": 0.292295e-3, "elastic_energy": 9.99841e-5}
    return known._replace(scene=posed, exact=exact, uncertain=3e-6)


def stiff_film(stiffer: float, thickness: float, count: int) -> Known:
    film = Layer(thickness=thickness * A, material=steel(young_modulus=stiffer * YOUNG))
    body = Body(material=steel(), layers=(film,))
    contact = pressed_coating(surface_of(body), 0.018, A)
    peak = float(np.max(contact.pressure(np.linspace(0, A, 20001))))
    exact = {"contact_radius": A, "approach": contact.approach, "peak_pressure": peak}
    return Known(indented(0.018, contact.load, film, steel()), exact, cells(count))


def ellipse(ratio: float) -> Known:
    radii, matter = (0.01, 0.01 * ratio), bodies(200e9, 0.3)
    contact = EllipticalContact.under_load(100.0, radii, 100e9 / (1 - 0.3**2))
    posed = Scene(
        indenter=Ellipsoid(radii=radii, material=matter),
        body=Body(material=matter),
        loading=(LoadStep(normal_force=100.0),),
    )
    exact = {
        "contact_area": np.pi * np.prod(contact.semi_axes),
        "approach": contact.approach,
        "peak_pressure": contact.peak_pressure,
    }
    return Known(posed, exact)


def pushed_pair(solver: str) -> Known:
    """76.149 ± 0.002 µm/100 by cells; elements neglect slip across the load."""
    steps = LoadStep(normal_force=100.0), LoadStep(tangential_force=(12.0, 0.0))
    posed = alike(70e9, 0.3, 0.01, 0.3, *steps)
    return Known(posed, {"tangential_shift": 0.761491e-6}, None, solver, uncertain=3e-5)


def strong_push(part: float, spoilt: tuple[str, ...] = ()) -> Known:
    """ν = .4999 with the default of one increment; the limit of 256 and 1024 increments."""
    push_ = LoadStep(tangential_force=(part * 0.35 * 90, 0.0))
    posed = alike(80e9, 0.4999, 0.01, 0.35, LoadStep(normal_force=90.0), push_)
    exact = {"dissipated_energy": 7.10343e-6, "tangential_shift": 2.229437e-6}
    return Known(posed, {} if spoilt else exact, None, spoilt=spoilt, uncertain=1e-5)


def unresolved_rings() -> Known:
    """A contact of a few rings, laid out for one that is twenty times as wide: Hertz's."""
    loads = (LoadStep(normal_force=0.01), LoadStep(normal_force=100.0))
    posed = alike(70e9, 0.3, 0.01, 0.3, *loads, LoadStep(tangential_shift=(1e-7, 0.0)))
    light = EllipticalContact.under_load(
        0.01, (0.01, 0.01), contact_modulus((70e9, 0.3), (70e9, 0.3))
    )
    exact = {"approach": light.approach, "peak_pressure": light.peak_pressure}
    return Known(posed, exact, None, "radial", 0)


KNOWN: dict[str, Callable[[], Known]] = {
    **{f"hertz, {n} cells": lambda n=n: hertzian(n) for n in (16, 23, 48, 64)},
    **{
        f"hertz, {n} elements, {solver}": lambda n=n, solver=solver: elements(n, solver)
        for n in (8, 14, 23)
        for solver in ("fem", "fem-complementarity")
    },
    "Cattaneo and Mindlin": cattaneo,
    "Cattaneo and Mindlin, elements": lambda: cattaneo("fem-complementarity"),
    "cone": cone,
    "cone pushed": lambda: pushed_cone(0.95),
    "rounded flat": lambda: ridge(flat=0.5 * A),
    "ring": lambda: ridge(ring=0.5 * A),
    **{
        f"map of a {name}, {n} points": lambda name=name, n=n: mapped(name, n)
        for name, counts in (
            ("flat that ends in a parabola", (32, 33, 65)),
            ("paraboloid", (16, 33)),
            ("cone", (33, 65)),
        )
        for n in counts
    },
    **{
        f"film, E ratio {E:g}, h = {h:g} a, {n} cells": lambda E=E, h=h, n=n: stiff_film(E, h, n)
        for E, h, n in ((20.0, 0.5, 48), (42.6, 0.5, 58), (40.0, 0.083, 37), (0.5, 0.2, 33))
    },
    **{
        f"profile of a {name}, {n} points, {solver}": lambda name=name, n=n, solver=solver: (
            revolved(name, n, solver)
        )
        for name in MAPPED
        for n, solver in (
            *((24, "semi-analytical"), (24, "radial"), (25, "radial")),
            *((24, "fem"), (24, "fem-complementarity")),
        )
    },
    # By `radial`.
    **{
        f"profile of a flat that ends in a parabola, coated, {solver}": lambda solver=solver: (
            coated_profile(solver)
        )
        for solver in ("semi-analytical", "fem-complementarity")
    },
    # Inputs whose stated error was once smaller than the true error.
    "push of incompressible bodies": lambda: strong_push(0.9),
    "push near gross slip": lambda: strong_push(
        0.9999, ("tangential_shift", "dissipated_energy", "stick_radius")
    ),
    "slip across the load, cells": lambda: pushed_pair("semi-analytical"),
    "slip across the load, penalty": lambda: pushed_pair("fem"),
    "slip across the load, exact law": lambda: pushed_pair("fem-complementarity"),
    "unresolved rings": unresolved_rings,
    "film on a rigid base": lambda: Known(
        indented(0.018, 1e3, Layer(thickness=1e-4, material=bodies(5e9, 0.35)), RIGID),
        {"contact_radius": 0.725773e-3},
        cells(64),
    ),
    **{f"ellipse 1:{ratio:g}": lambda ratio=ratio: ellipse(ratio) for ratio in (5.0, 10.0)},
}
EXPENSIVE: dict[str, Callable[[], Known]] = {
    **{f"ellipse 1:{ratio:g}": lambda ratio=ratio: ellipse(ratio) for ratio in (30.0, 1e3, 1e6)},
    # By four times the increments.
    "loop of the paper": lambda: Known(
        read_scene_file(SCENES / "fretting_loop.toml").scene,
        {"energy_per_cycle": 32.4984e-6},
        uncertain=3e-5,
    ),
    "thin stiff film": lambda: Known(
        indented(
            6.35e-3,
            50.0,
            Layer(thickness=4e-6, material=bodies(600e9, 0.2)),
            bodies(230e9, 0.3),
            0.5,
            *(LoadStep(tangential_shift=(x, 0.0)) for x in (5e-6, -5e-6, 5e-6)),
        ),
        {"stick_radius": 0.0},
        cells(128),
    ),
    # By `radial`.
    "elements coarser than a stiff film": lambda: Known(
        indented(
            0.018,
            450.0,
            Layer(thickness=3e-5, material=bodies(2100e9, 0.3)),
            bodies(210e9, 0.3),
            0.3,
        ),
        {
            "peak_pressure": 3.408e9,
            "contact_radius": 2.59382e-4,
            "approach": 4.64199e-6,
            "stick_radius": 1.6312e-4,
        },
        FiniteElementDiscretisation(elements_per_radius=20),
        "fem-complementarity",
    ),
    # By `radial`: round-off and the section decide.
    "elements on a film 1e8 times as stiff": lambda: Known(
        indented(
            0.018, 450.0, Layer(thickness=1e-4, material=bodies(2.1e19, 0.3)), bodies(210e9, 0.3)
        ),
        {
            "approach": 2.777e-8,
            "contact_radius": 6.409e-7,
            "peak_pressure": 5.231e14,
            "elastic_energy": 6.248e-6,
        },
        FiniteElementDiscretisation(elements_per_radius=10),
        "fem-complementarity",
        uncertain=2e-4,
    ),
}

# Three coarse solves agree with the run by chance, as for 1 of 80 numbers of the study
# error-coverage: 48², 26², 20² and 16² cells. On films of two elements the peak pressure converges
# with a lower order than 1.
MISSED = {
    ("cone pushed", "dissipated_energy"): 1.45,
    # The part by the elements alone is 1.46 times too small.
    ("elements coarser than a stiff film", PEAK): 1.4,
}

# The elements are 0.24 % off and the profile through 24 points 0.21 %, with opposite signs.
WIDE = {("profile of a flat that ends in a parabola, 24 points, fem-complementarity", PEAK): 2.0}


@pytest.mark.parametrize(
    "known",
    [
        *KNOWN.values(),
        *(pytest.param(known, marks=SLOW) for known in EXPENSIVE.values()),
    ],
    ids=[*KNOWN, *EXPENSIVE],
)
def test_errors_cover_what_is_wrong(
    known: Callable[[], Known], request: pytest.FixtureRequest
) -> None:
    """Or the number is marked; an error is within 100 times what is wrong, or 2 % of the number."""
    posed, exact, asked, solver, step, spoilt, uncertain = known()
    result = package.solve(posed, solver, asked)
    stated = stated_errors(result).steps[step]
    values = values_of(result)[step]
    assert {*spoilt, *exact} <= {*stated}
    for name in spoilt:
        assert stated[name].status is ErrorStatus.NOT_CONVERGED, name
    for name, value in exact.items():
        wrong = abs(float(values[name][0]) - value)
        error = stated[name]
        if error.status is ErrorStatus.NOT_CONVERGED:
            continue
        key = request.node.callspec.id, name
        assert wrong <= MISSED.get(key, 1.0) * size(error) + uncertain * abs(value), name
        assert size(error) <= WIDE.get(key, 1.0) * (100 * wrong + 0.02 * abs(value)), name


@SLOW
@pytest.mark.parametrize("count", [24, 48])
def test_an_edge_that_may_have_the_largest_stress_leaves_it_open(count: int) -> None:
    """A stiff film pushed along: 2.0 GPa behind the contact, 1.6 GPa inside."""
    radius = (3 * 150 * 0.011 * (1 - 0.3**2) / 4 / 210e9) ** (1 / 3)
    film = Layer(thickness=0.4 * radius, material=bodies(840e9, 0.2))
    push_ = LoadStep(tangential_force=(0.6 * 0.3 * 150, 0.0))
    posed = indented(0.011, 150.0, film, bodies(210e9, 0.3), 0.3, push_)
    result = package.solve(posed, "semi-analytical", cells(count))
    value, error = largest_tension(result)
    assert error.status is ErrorStatus.NOT_CONVERGED or abs(value - 2.0e9) <= size(error)


@pytest.mark.parametrize(
    ("thickness", "modulus", "count", "widest"),
    [
        (0.04, 600e9, 24, 0.1),
        (0.04, 600e9, 64, 0.05),
        (0.4, 420e9, 48, 0.05),
        (0.4, 420e9, 64, 0.05),
    ],
)
def test_the_tension_at_a_coating_pressed_without_friction_is_known(
    thickness: float, modulus: float, count: int, widest: float
) -> None:
    """A film thinner than a cell, whose pressure the cells do not resolve, and a thicker one."""
    film = Layer(thickness=thickness * A, material=bodies(modulus, 0.25))
    posed = indented(0.018, 1e3, film, bodies(210e9, 0.3), None)
    result = package.solve(posed, "semi-analytical", cells(count))
    value, error = largest_tension(result)
    exact, _ = largest_tension(package.solve(posed, "radial"))
    assert error.status is ErrorStatus.ESTIMATED
    assert abs(value - exact) <= size(error) <= widest * exact


def test_a_stress_below_a_tip_is_not_converged_near_the_surface() -> None:
    posed = scene(PRESS, indenter=Cone(slope_angle=0.02, material=RIGID), friction=None)
    result = package.solve(posed, "semi-analytical", cells(24))
    names = ["von_mises@body", "max_shear@body"]
    found = [e for _, e in largest_stresses(result, stated_errors(result), names).values()]
    assert [error.status for error in found] == [ErrorStatus.NOT_CONVERGED] * len(names)
    assert all("infinite" in error.reason for error in found)


@pytest.mark.parametrize("deeper", [0.0, 0.03, 0.06, 0.09, 0.13])
def test_a_largest_stress_between_depths_is_covered(deeper: float) -> None:
    """Below Hertz's contact the stress on the axis is known (Johnson 1985, eq. 3.45)."""
    posed = scene(PRESS, indenter=paraboloid(steel(0.3)), body=steel(0.3))
    result = package.solve(posed, "semi-analytical", cells(64))
    state = state_of_result(result, 1, stated_errors(result))
    radius = result.steps[0].contact_radius
    depths = [z * radius for z in (0.0, 0.2, 0.35 + deeper, 0.55 + deeper, 0.8, 1.2)]
    field = OnCells(state).stress(depths)
    found = [e for e in extremes(field) if e.measure != "max_principal"]
    assert found
    z = np.linspace(0.3, 0.7, 4001)
    radial = 1.3 * (1 - z * np.arctan(1 / z)) - 1 / (2 * (1 + z**2))
    exact = hertz().peak_pressure * float(np.max(1 / (1 + z**2) - radial))
    for extreme, error in zip(
        found, stress_errors(state, field, found, at_depths=True), strict=True
    ):
        largest = exact if extreme.measure == "von_mises" else exact / 2
        assert abs(extreme.value - largest) <= size(error) <= 0.05 * largest


def test_the_error_of_two_coarse_tractions_is_their_root_mean_square(monkeypatch) -> None:
    result = solve(scene(PRESS), grid(24), 1e-8)
    state, sizes = state_of_result(result, 1, stated_errors(result)), {}
    field = OnCells(state).stress([0.0, 0.5 * A])
    for shifts in ((0, 1), (0, 0), (1, 1)):
        monkeypatch.setattr(
            OnCells, "compared", lambda cells, of=shifts: [*map(cells.on_wide_cells, of)]
        )
        found = stress_errors(state, field, extremes(field), at_depths=True)
        sizes[shifts] = np.array([one.error for one in found])
    one, other = sizes[0, 0], sizes[1, 1]
    found = sizes[0, 1]
    assert np.all((np.minimum(one, other) <= found) & (found <= np.maximum(one, other)))
    assert np.any((one < found) & (found < other))


def test_stress_near_the_surface_improves_slower_with_cells_than_that_below(monkeypatch) -> None:
    """The same change between cells leaves the larger error where the order is lower."""
    state = state_of_result(solve(scene(PRESS), grid(24), 1e-8), 1)
    depth = np.array([0.01 * A, A])
    monkeypatch.setattr(
        OnCells,
        "stress_at",
        lambda one, *_: SimpleNamespace(
            depth=depth, stress=np.full((6, 2), float(one.state is not state))
        ),
    )
    _, (near, below) = stress_at(state, depth, depth, [])
    assert near > 1.2 * below > 0


def test_a_stress_by_tractions_of_unknown_error_is_marked() -> None:
    """As in a run without errors; a contact that is pressed alone has no increment error."""
    result = solve(scene(PRESS, push(0.5)), grid(16), 1e-8)
    for step, expected in ((1, ErrorStatus.ESTIMATED), (2, ErrorStatus.NOT_CONVERGED)):
        state = state_of_result(result, step)
        field = OnCells(state).stress([0.0, 0.5 * A])
        (deepest, *_) = (e for e in extremes(field) if e.measure == "max_shear")
        (error,) = stress_errors(state, field, [deepest], at_depths=True)
        assert error.status is expected, error.reason


@pytest.mark.parametrize(("friction", "count"), [(0.1, 48), (0.6, 32)])
def test_the_tension_behind_a_sliding_ball_is_covered(friction: float, count: int) -> None:
    """Its place is the trailing edge, where both the fit of the edge and its evaluation err."""
    slid = {"tangential_shift": (1e-4, 0.0)}
    posed = scene(PRESS, slid, indenter=paraboloid(steel()), friction=friction)
    value, error = largest_tension(package.solve(posed, "semi-analytical", cells(count)))
    exact = trailing_edge_tension(hertz().peak_pressure, friction, 0.3)
    assert error.status is ErrorStatus.ESTIMATED
    assert abs(value - exact) <= size(error) <= 0.01 * exact


@pytest.mark.parametrize(("nu", "count"), [(0.2, 32), (0.49, 32), (0.499, 32), (0.47, 100)])
def test_a_tension_near_zero_has_the_error_of_the_tractions(nu: float, count: int) -> None:
    """At the edge of Hertz's contact it is (1 - 2ν)/3 of the peak, however close ν is to ½."""
    posed = scene(PRESS, indenter=paraboloid(steel(nu)), body=steel(nu))
    result = package.solve(posed, "semi-analytical", cells(count))
    value, error = largest_tension(result)
    exact = (1 - 2 * nu) / 3 * hertz(poisson_ratio=nu).peak_pressure
    assert abs(value - exact) <= size(error) <= 0.01 * hertz().peak_pressure


def test_what_the_load_prescribes_is_exact() -> None:
    of = scene({"normal_force": 1e3}, {"tangential_shift": (1e-7, 0.0)})
    by_force, by_shift = stated_errors(solve(of, grid(16), 1e-8)).steps
    assert by_force["normal_force"].status is ErrorStatus.EXACT
    assert by_force["approach"].status is ErrorStatus.ESTIMATED
    assert by_shift["tangential_shift"].status is ErrorStatus.EXACT
    assert by_shift["tangential_force"].status is ErrorStatus.ESTIMATED
    behind_spring = Rig(tangential_stiffness=1e8)
    for rig, own, other in ((None, "shift", "actuator"), (behind_spring, "actuator", "shift")):
        names = prescribed_scalars(of.load_path()[1], rig)
        assert f"{own}_amplitude" in names
        assert f"{other}_amplitude" not in names


@pytest.mark.parametrize(
    "indenter", [Cone(slope_angle=0.05, material=steel()), FlatPunch(radius=A, material=RIGID)]
)
def test_nobody_states_the_error_of_what_is_infinite(indenter: Any) -> None:
    of = scene({"normal_force": 1e3}, indenter=indenter, friction=None)
    (errors,) = stated_errors(package.solve(of)).steps
    assert errors["peak_pressure"].error is None
    assert errors["approach"].error is not None


@pytest.mark.parametrize("penalty", [1.0, 1e3])
def test_elements_leave_the_contact_radius_within_one_of_them(penalty: float) -> None:
    mesh = FiniteElementDiscretisation(elements_per_radius=16, penalty=penalty)
    result = fem_reference.solve(WEAK.problem(8).scene, mesh, Method.PENALTY)
    stated = stated_errors(result).steps[-1]["contact_radius"]
    assert stated.parts["elements"] <= result.radius / 16 < stated.parts["elements"] * 5


def test_a_contact_up_to_a_rim_has_its_area() -> None:
    """And, where all of it sticks, the stick zone, too: coupled bodies have no reference."""
    posed = scene(PRESS, indenter=FlatPunch(radius=A, material=RIGID), friction=5.0)
    result = package.solve(posed, "semi-analytical", cells(24, window=(3 * A, 3 * A)))
    stated, (end,) = stated_errors(result).steps[0], result.steps
    for name in ("contact_radius", "stick_radius"):
        assert getattr(end, name) == pytest.approx(A, rel=1e-12)
        assert size(stated[name]) < 1e-6 * A


def test_a_coarse_solve_without_result_leaves_its_part_to_the_other(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """And no number with an error where none has a result."""
    posed = rubbed(push(0.6), body=Body(material=LOOSE))
    result, refused = solve(posed, grid(16), 1e-8), {12}
    solved = CellSolver.solve

    def refusing(self: CellSolver, fineness: Fineness, *more: Any) -> Any:
        if fineness.space.cells[0] in refused:
            raise NotConverged("the increment", 3, 1e-3, 1e-8)
        return solved(self, fineness, *more)

    monkeypatch.setattr(CellSolver, "solve", refusing)
    stated = stated_errors(result)
    assert any("did not converge" in (solve.refused or "") for solve in stated.coarse_solves)
    assert stated.steps[1]["tangential_shift"].error is not None
    refused |= {24}
    last = stated_errors(result).steps[1]
    assert last["tangential_shift"].error is None
    assert last["approach"].error is not None  # known without a coarse solve


def test_points_are_left_out_of_a_map_alone_and_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """And no error is stated if the scene with half of the points has no result."""
    solved, indenters = CellSolver.solve, list[Any]()
    refused = list[Any]()

    def counting(self: CellSolver, fineness: Fineness, *more: Any) -> Any:
        if self.scene.indenter in refused:
            raise NotConverged("the increment", 3, 1e-3, 1e-8)
        indenters.append(self.scene.indenter)
        return solved(self, fineness, *more)

    monkeypatch.setattr(CellSolver, "solve", counting)
    for posed, times in ((mapped("paraboloid", 16).scene, 1), (scene(PRESS), 0)):
        result = package.solve(posed, "semi-analytical", cells(16))
        indenters.clear()
        parts = stated_errors(result).steps[0]["approach"].parts
        others = [indenter for indenter in indenters if indenter != posed.indenter]
        assert len(others) == times == ("map" in parts)
        refused += others
    result = package.solve(mapped("paraboloid", 16).scene, "semi-analytical", cells(16))
    assert stated_errors(result).steps[0]["approach"].error is None


@pytest.mark.parametrize(("count", "solves"), [(10, 2), (15, 3)])
def test_equal_coarse_solves_count_once(count: int, solves: int) -> None:
    """A third and 2/5 of 10 elements, rounded up, are 4 elements each."""
    posed = rubbed(push(0.6), body=Body(material=LOOSE))
    asked = FiniteElementDiscretisation(elements_per_radius=count)
    result = package.solve(posed, "fem-complementarity", asked)
    run, _ = coarse_solves.compare_with_coarse_solves(ElementSolver.of(result), result)
    assert len([one for one in run.comparisons if one.part == "elements"]) == solves


def test_coarse_solves_are_cheap_and_their_tolerance_has_no_effect(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    posed = rubbed(push(0.6), body=Body(material=steel()), like=False)
    result = package.solve(posed, "semi-analytical", cells(36))
    stated = stated_errors(result)
    work = [(solve.convolutions or 0) * np.prod(solve.cells) for solve in stated.coarse_solves]
    # The third coarse solve has (2/3)² of the cells.
    assert sum(work) < (1 + 4 / 9) * sum(step.convolutions for step in result.increments) * 36**2
    monkeypatch.setattr(discretised, "NEGLIGIBLE", 0.0)
    for errors, of_tight in zip(stated.steps, stated_errors(result).steps, strict=True):
        for name in ("approach", "peak_pressure", "elastic_energy", "dissipated_energy"):
            assert size(errors[name]) == pytest.approx(size(of_tight[name]), rel=0.02)


@pytest.mark.parametrize(
    ("changes", "left"),
    [
        ((1e-2,), 1.0),
        ((1e-2, 1e-3), 1.0),
        ((1e-2, 8e-4, 2e-4), 1 / 3),
        ((1, 8e-4, 1e-4, 2e-4), 1.0),
    ],
)
def test_an_iteration_leaves_its_last_change_times_the_contraction(changes, left) -> None:
    """A geometric series of the ratio κ sums to κ/(1-κ); κ = 1/2 where it is unknown."""
    assert left_over(changes) == pytest.approx(left)


def test_what_an_iteration_leaves_covers_what_it_misses(monkeypatch: pytest.MonkeyPatch) -> None:
    posed = scene(PRESS, friction=None)
    exact = package.solve(posed, "semi-analytical", cells(24)).steps[0]
    monkeypatch.setattr(pressure_correction, "SETTLED", 0.1)
    monkeypatch.setattr(pressure_correction, "STEADY", 1e-2)
    result = package.solve(posed, "semi-analytical", cells(24))
    (features,), (rough,) = CellSolver.of(result).features(result), result.steps
    for name in ("approach", "contact_radius", "peak_pressure"):
        assert 0 < abs(getattr(rough, name) / getattr(exact, name) - 1) <= 2 * features.left[name]


def test_an_area_leaves_twice_the_part_of_its_radius() -> None:
    result = package.solve(scene(PRESS, push(0.5)), "semi-analytical", cells(24))
    for features in CellSolver.of(result).features(result):
        for zone in ("contact", "stick"):
            assert features.left[f"{zone}_area"] == 2 * features.left[f"{zone}_radius"]
    assert min(features.left["contact_radius"], features.left["stick_radius"]) > 0


@pytest.mark.parametrize("shift", [0, 1])
def test_wide_cells_carry_the_same_force_at_the_same_place(shift: int) -> None:
    on = SurfaceGrid((9, 12), (3.0, 4.0))
    pressure = np.random.default_rng(1).random((9, 12))
    axes = {"x": on.x, "y": on.y}
    body = Body(material=steel())
    state = LoadedBodies("", body, body, 1, axes, {"pressure": pressure}, None)
    wide = OnCells(state).on_wide_cells(shift).state
    assert [len(wide.axes[axis]) for axis in "xy"] == [5, 6 + shift]
    means = wide.tractions["pressure"]
    assert 4 * np.sum(means) == pytest.approx(np.sum(pressure))
    assert wide.axes["x"][0] == pytest.approx(on.x[0] + (1 / 2 - shift) * on.spacing[0])


# ---- the command ------------------------------------------------------------------------------

FRETTING = (
    STEEL_BALL_PRESSED
    + "".join(f'[[loading]]\ntangential_force = ["{T} N", 0]\n' for T in (90, -90, 90, 60))
    + COARSE
)
TWENTY = '[semi_analytical]\ncells = [20, 20]\nwindow = ["1.2 mm", "1.2 mm"]\n'


def test_stress_counts_what_increments_leave_wrong_in_the_tractions(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    coupled = FRETTING.replace("420 GPa", "210 GPa", 1)
    path.write_text(coupled.split("[[loading]]\ntangential_force", 1)[0] + TWENTY, encoding="utf-8")
    common = ("--figures", "none", "-o")
    assert slipstick("run", path, *common, tmp_path / "run") == 0
    assert slipstick("stress", path, *common, tmp_path / "of_scene") == 0
    assert slipstick("stress", tmp_path / "run", *common, tmp_path / "of_run") == 0
    of_scene, of_run = (
        json.loads((tmp_path / name / "stress.json").read_text(encoding="utf-8"))["maxima"]
        for name in ("of_scene", "of_run")
    )
    assert of_scene == of_run
    for maximum in of_run:
        parts = maximum["error"]["parts"]
        assert 0 < parts["increments"] < 0.1 * maximum["value"]
        assert maximum["error"]["error"] == pytest.approx(sum(parts.values()))


def test_a_cycle_has_the_numbers_and_errors_of_the_step_that_closes_it(tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(FRETTING, encoding="utf-8")
    ended = outcome("run", "scene.toml", "-o", "out", "--figures", "none", cwd=tmp_path)
    assert ended.returncode == 0, ended.stderr
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    with h5py.File(tmp_path / "out" / "result.h5") as file:
        last = dict(file["last_cycle"].attrs)
    cycles = rows(tmp_path / "out" / "cycles.csv")
    assert [(row["start_step"], row["end_step"]) for row in cycles] == [("2", "4")]
    assert (last["start_step"], last["end_step"]) == (2, 4)
    end = summary["steps"][3]
    assert [step["cycle_start"] for step in summary["steps"]] == [None, None, None, 2, None]
    for name, mark in OF_CYCLES.items():
        parts = ("_x", "_y") if mark.kind is Kind.VECTOR else ("",)
        error = end["errors"].get(name, {"error": None})["error"]
        errors = [None] * len(parts) if error is None else [*np.broadcast_to(error, len(parts))]
        shown = [cycles[0][f"{name}{part}_error [{mark.unit or 1}]"] for part in parts]
        assert shown == ["" if size is None else repr(float(size)) for size in errors]


def test_an_error_is_no_smaller_than_that_of_an_earlier_step() -> None:
    names = ("normal_force", "contact_radius", "contact_area", "peak_pressure", "approach")
    at_2, at_3 = ({name: np.full(1, size) for name in names} for size in (2.0, 3.0))
    part = Comparison("cells", [at_2, at_2], [at_3, at_2], [2.0, 2.0])
    posed, features = scene({"approach": 1e-6}, {"approach": 2e-6}), [Features(contact=10)] * 2
    run = SolvedRun(posed, [at_2] * 2, [1e-8] * 2, features, [part], {"cells": [True] * 2}, {})
    first, second = (step["peak_pressure"].error for step in run.errors())
    assert second == first > 0.1


def test_question_marks_have_their_reasons_below_the_table() -> None:
    """One line for each reason, with the load steps of its numbers."""
    doubtful = unknown_error("too few cells")
    sure = build_stated_error({"cells": np.array([1.0])}, None)
    errors = [
        {"approach": doubtful, "peak_pressure": sure},
        {"approach": doubtful, "peak_pressure": doubtful, "contact_area": doubtful},
    ]
    assert doubt_texts(errors, ("approach", "peak_pressure")) == [
        "? approach (step 1, 2): too few cells",
        "? peak pressure (step 2): too few cells",
    ]


@pytest.mark.parametrize(
    ("solver", "eccentric", "advised"),
    [
        ("semi-analytical", False, True),
        ("radial", False, False),
        ("semi-analytical", True, False),
    ],
)
def test_a_question_mark_advises_the_radial_solver_where_it_can_solve_the_scene(
    solver: str, eccentric: bool, advised: bool, tmp_path: Path
) -> None:
    """The peak pressure of a cone is infinite. The radial solver solves no eccentric contact."""
    ball = 'shape = "sphere"\nradius = "18 mm"'
    scene_text = STEEL_BALL_PRESSED.replace(ball, 'shape = "cone"\nslope_angle = 0.05')
    if eccentric:
        scene_text += 'moment = ["0.01 N m", "0 N m"]\n'
    scene_text += "[semi_analytical]\ncells = [32, 32]\n"
    (tmp_path / "scene.toml").write_text(scene_text)
    run = outcome("run", "scene.toml", "-o", "out", "--solver", solver, cwd=tmp_path)
    assert run.returncode == 0
    assert "the exact value is infinite" in run.stdout
    stress = outcome("stress", "out", "-o", "below", cwd=tmp_path)
    assert stress.returncode == 0
    pages = [(tmp_path / page).read_text() for page in ("out/index.html", "below/stress.html")]
    for text in (run.stdout, stress.stdout, *pages):
        assert ("--solver radial can solve this: normal load" in text) is advised


@pytest.mark.parametrize("ratio", [0.0, 0.3])
def test_a_largest_stress_between_the_depths_of_the_radial_solver_is_covered(ratio: float) -> None:
    """Below a ball without friction, von Mises' stress is largest on the axis (Huber 1904)."""
    posed = scene(PRESS, friction=None, indenter=paraboloid(RIGID), body=steel(ratio))
    result = package.solve(posed, "radial", RadialDiscretisation())
    ((found, error),) = largest_stresses(result, stated_errors(result), ["von_mises@body"]).values()
    a, p0 = result.steps[-1].contact_radius, result.steps[-1].peak_pressure

    def negative(depth: float) -> float:
        stress = axis_stress(depth * a, a, p0, ratio)
        return -float(abs(stress.axial - stress.radial))

    exact = -minimize_scalar(negative, bounds=(0.2, 0.8), method="bounded").fun
    assert error is not None
    assert abs(found - exact) <= size(error) < 1e-8 * exact


def test_components_of_a_vector_share_one_size() -> None:
    steps = [{"tangential_shift": np.array(shift)} for shift in ((3.0, 1e-12), (2.0, -1.0))]
    sizes = [found["tangential_shift"] for found in largest_so_far(steps)]
    np.testing.assert_array_equal(sizes, [[3.0, 3.0]] * 2)  # also where it has become smaller
    assert build_stated_error({"cells": np.array([1.0, 2.0])}, None).error == (1.0, 2.0)
