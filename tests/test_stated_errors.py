"""Every number of a run has an error, and the error is of the size of what is wrong."""

import json
from copy import deepcopy
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from command import outcome, slipstick
from contact_scenes import (
    APPROACH,
    LOAD,
    MU,
    NU,
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
from coupled_scenes import bulk, press
from coupled_scenes import push as pushed_by
from coupled_scenes import scene as coupled
from matplotlib.figure import Figure
from scene_texts import COARSE, STEEL_BALL_PRESSED

import fem_reference
from contact_errors import estimate, half_the_cells, on_cells, on_elements
from contact_errors.by_step import ByStep
from contact_errors.levels import path_changes, recut
from contact_errors.of_stress import on_wide_cells, stress_errors
from contact_errors.on_cells import stated_errors
from contact_errors.rules import RULES, Rule
from contact_errors.values import OF_CYCLES, PHYSICAL, lost_by_steps
from contact_results.cycles import fretting_cycles
from contact_results.directory import file_names
from contact_results.figures.figure_files import SHOWN, add_caption
from contact_results.stress.extremes import extremes
from contact_results.stress.loaded_bodies import LoadedBodies, state_of_result
from contact_results.stress.on_cells import stress_on_cells
from contact_scene import (
    RIGID,
    Body,
    Cone,
    FiniteElementDiscretisation,
    FlatPunch,
    Layer,
    Scene,
    SurfaceDiscretisation,
)
from contact_scene.stated_error import ErrorStatus, StatedError
from semi_analytical import Plan, Result, SurfaceGrid, plan, solve, solve_discretised
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.coated_indentation import LayeredIndentation
from verification.closed_forms.coated_indentation import paraboloid as pressed_coating
from verification.closed_forms.cone import ConeContact
from verification.closed_forms.moduli import contact_modulus, tangential_modulus
from verification.problems.layered_scene import surface_of

FRETTING = (
    STEEL_BALL_PRESSED
    + """
[[loading]]
tangential_force = ["90 N", 0]
[[loading]]
tangential_force = ["-90 N", 0]
[[loading]]
tangential_force = ["90 N", 0]
"""
    + COARSE
)

TWENTY = """
[semi_analytical]
cells = [20, 20]
window = ["1.2 mm", "1.2 mm"]
"""


def errors_of(of: Scene, on: SurfaceGrid) -> tuple[dict[str, StatedError], ...]:
    return tuple(map(dict, stated_errors(solve(of, on, 1e-8)).steps))


def size(error: StatedError) -> float:
    assert error.error is not None
    return float(np.max(error.error))


@pytest.mark.parametrize("order", [0.5, 1.0, 2.0])
def test_an_error_that_falls_as_a_power_is_found_exactly(order: float) -> None:
    rule = Rule(order, envelope=0.0, weight=0.0, factor=1.0)
    f, coarse = (np.array([2.0 + 0.3 * h**order]) for h in (0.1, 0.2))
    found = estimate.by_cells(rule, np.abs(f - coarse), 2.0, np.zeros(1))
    assert found == pytest.approx(f - 2.0)


def test_a_worked_example_of_a_stated_error() -> None:
    # f = 10.0 on fine and 10.6 on wide cells; order 2, scatter 0.1, weight 1/2, factor 1.1:
    # d = 0.6/3 = 0.2; √((0.5·0.01 + 0.04)/1.5) = 0.1732; times 1.1 = 0.1905
    rule = Rule(2, 0.25, 0.5, 1.1, path_factor=2.0, path_scatter=0.1)
    cells = estimate.by_cells(rule, np.array([0.6]), 2.0, np.array([0.1]))
    assert cells == pytest.approx(0.19053, abs=1e-5)
    # 0.05 less with half the increments: 2 √(0.05² + 0.01²) = 0.10198
    increments = estimate.by_increments(rule, np.array([0.05]), np.array([0.1]))
    assert increments == pytest.approx(0.10198, abs=1e-5)
    error = estimate.stated({"cells": cells, "increments": increments}, converged=True)
    assert error.error == pytest.approx(0.29251, abs=1e-5)


def test_a_charge_counts_where_other_increments_say_nothing_less() -> None:
    # Charged with 1: by a change of 0.03, √((2·0.03)² + (0.1·1)²) = 0.11662; by none, all of it;
    # by a change of 2, no more than all of it.
    rule = Rule(2, 0.25, 0.5, 1.1, path_factor=2.0, charge=0.1)
    for change, expected in ((np.array([0.03]), 0.11662), (None, 1.0), (np.array([2.0]), 1.0)):
        found = estimate.charged(rule, np.ones(1), change)
        assert found == pytest.approx(expected, abs=1e-5)


def test_energies_add_up_over_the_steps_that_lost_them() -> None:
    """And of a cycle over its own."""
    (cycle,), lost = [SimpleNamespace(cycle=SimpleNamespace(start=2, end=4))], [0.0, 1.0, 1.5, 4.0]
    values = [{"dissipated_energy": np.array([size])} for size in lost]
    *_, last = lost_by_steps(values, [cycle])
    assert last["dissipated_energy"] == {0: 0.0, 1: 1.0, 2: 0.5, 3: 2.5}
    assert last["energy_per_cycle"] == {2: 0.5, 3: 2.5}


def test_what_was_lost_keeps_the_error_that_it_had() -> None:
    """A push over a wide annulus and a little way back over a narrow one, which loses little."""
    matter, limit = steel(poisson_ratio=0.0), MU * LOAD
    ways = ({"tangential_force": (part * limit, 0.0)} for part in (0.9, 0.6))
    there_and_back = scene(PRESS, *ways, indenter=paraboloid(matter), body=matter)
    _, there, back = stated_errors(solve(there_and_back, grid(48), 1e-8)).steps
    assert size(back["dissipated_energy"]) < 1.5 * size(there["dissipated_energy"])


@pytest.mark.parametrize("cells", [16, 23, 48, 64])
def test_the_error_of_hertz_covers_what_is_wrong(cells: int) -> None:
    result = solve(scene({"normal_force": 1e3}), grid(cells), 1e-8)
    (errors,) = stated_errors(result).steps
    (end,) = result.steps
    exact = {
        "approach": APPROACH,
        "contact_radius": A,
        "peak_pressure": hertz().peak_pressure,
        "contact_area": np.pi * A**2,
    }
    for name, value in exact.items():
        wrong = abs(getattr(end, name) - value)
        assert wrong <= size(errors[name]), name
        assert size(errors[name]) < 0.1 * value


@pytest.mark.parametrize(
    ("cells", "per_radius"), [(10, 4.0), (14, 4.8), (18, 5.0), (20, 6.8), (22, 7.2), (34, 11.5)]
)
def test_a_peak_on_the_axis_is_covered_where_cells_differ_little(
    cells: int, per_radius: float
) -> None:
    """Those twice as wide, with or without a middle on the axis, may miss it alike by chance."""
    window = cells * A / per_radius
    result = solve(scene(PRESS), SurfaceGrid((cells, cells), (window, window)), 1e-8)
    (errors,), (end,) = stated_errors(result).steps, result.steps
    wrong = abs(end.peak_pressure - hertz().peak_pressure)
    assert 0.4 * size(errors["peak_pressure"]) < wrong <= size(errors["peak_pressure"])


def punch_pressed(friction: float, cells: int, window: float) -> Result:
    """A rigid punch of 0.3 mm on a half-space that it drags inwards, where ν is 0.3."""
    punch = FlatPunch(radius=3e-4, material=RIGID)
    pressed = scene(PRESS, indenter=punch, body=steel(), friction=friction)
    return solve(pressed, SurfaceGrid((cells, cells), (window, window)), 1e-8)


@pytest.mark.parametrize(("cells", "window"), [(18, 9.9e-4), (24, 1.11e-3), (60, 1.11e-3)])
def test_what_is_lost_below_a_rim_is_as_uncertain_as_its_radius(cells: int, window: float) -> None:
    """By 144² and 216² cells on 0.9 mm, and a third as much beyond: 10.42 ± 0.03 µJ."""
    result = punch_pressed(0.1, cells, window)
    (errors,), (end,) = stated_errors(result).steps, result.steps
    wrong = abs(end.dissipated_energy - 10.42e-6)
    assert wrong + 0.03e-6 <= size(errors["dissipated_energy"]) < 0.1 * end.dissipated_energy
    assert errors["dissipated_energy"].status is ErrorStatus.ESTIMATED


def test_what_slips_within_a_cell_of_a_rim_is_not_known() -> None:
    """No cell slips of so few, of more some do (0.7 µJ of 48², 1.9 of 96²)."""
    result = punch_pressed(0.4, 24, 1.2e-3)
    (errors,), (end,) = stated_errors(result).steps, result.steps
    assert end.dissipated_energy == 0.0
    assert errors["dissipated_energy"].error is None


@pytest.mark.parametrize("cells", [24, 48])
@pytest.mark.parametrize(
    ("push", "name", "power"),
    [
        ({"tangential_force": (50.0, 0.0)}, "tangential_shift", 1),
        ({"torque": 0.01}, "twist", 3),
        ({"moment": (0.0, 0.05)}, "tilt", 3),
    ],
)
def test_the_error_below_a_rim_covers_what_is_wrong(
    push: dict[str, Any], name: str, power: int, cells: int
) -> None:
    """A rigid punch that sticks on a half-space, which resists with 8 G a/(2 - ν) (Mindlin 1949),
    16 G a³/3 and 8 G a³/3(1 - ν): with ν = ½ all are 16/3."""
    a, shear_modulus = 3e-4, YOUNG / 3
    punch = FlatPunch(radius=a, material=RIGID)
    pressed = scene(PRESS, push, indenter=punch, body=steel(poisson_ratio=0.5))
    result = solve(pressed, SurfaceGrid((cells, cells), (4 * a, 4 * a)), 1e-8)
    errors, end = stated_errors(result).steps[-1], result.steps[-1]
    load = float(np.max([*push.values()]))
    moved = load / (16 / 3 * shear_modulus * a**power)
    work = 0.5 * (load * moved + LOAD**2 / (8 * shear_modulus * a))
    assert abs(np.max(getattr(end, name)) - moved) <= size(errors[name])
    for energy in ("elastic_energy", "input_work"):
        assert abs(getattr(end, energy) - work) <= size(errors[energy]), energy


def test_a_tilt_is_sure_where_the_load_is_on_a_mirror_of_the_cells() -> None:
    """x²/2R - φx = (x - Rφ)²/2R - Rφ²/2: the contact is a mirror image of itself about the load."""
    cells = grid(32)
    beside, along = 3.25 * cells.spacing[1], 3.5 * cells.spacing[0]
    pushed = scene(PRESS | {"moment": (LOAD * beside, LOAD * along)})
    result = solve(pushed, cells, 1e-10)
    (errors,), (end,) = stated_errors(result).steps, result.steps
    assert end.tilt is not None
    (off_mirror, on_mirror), stated = (
        end.tilt - np.array([beside, along]) / RADIUS,
        errors["tilt"].error,
    )
    assert isinstance(stated, tuple)
    assert abs(off_mirror) <= stated[0]
    assert abs(on_mirror) <= stated[1] < stated[0] / 2


def test_what_the_load_prescribes_is_exact() -> None:
    by_force, by_shift = errors_of(
        scene({"normal_force": 1e3}, {"tangential_shift": (1e-7, 0.0)}), grid(16)
    )
    assert by_force["normal_force"].status is ErrorStatus.EXACT
    assert by_force["approach"].status is ErrorStatus.ESTIMATED
    assert by_shift["tangential_shift"].status is ErrorStatus.EXACT
    assert by_shift["tangential_force"].status is ErrorStatus.ESTIMATED


def test_all_numbers_of_the_contact_have_a_rule() -> None:
    assert set(RULES) == {*PHYSICAL, *OF_CYCLES}


def test_a_contact_of_less_than_four_cells_has_not_converged() -> None:
    (errors,) = errors_of(scene({"normal_force": 1e3}), SurfaceGrid((16, 16), (4.2 * A, 4.2 * A)))
    assert errors["normal_force"].status is ErrorStatus.EXACT
    assert {errors[name].status for name in ("approach", "peak_pressure", "contact_radius")} == {
        ErrorStatus.NOT_CONVERGED
    }


def test_nobody_states_the_error_of_what_is_infinite() -> None:
    cone = scene({"normal_force": 1.0}, indenter=Cone(slope_angle=0.05, material=steel()))
    (errors,) = errors_of(cone, grid(16, radius=1e-5))
    assert errors["peak_pressure"].error is None


def test_a_companion_without_answer_leaves_no_number_with_an_error(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    from contact_errors import half_the_cells
    from contact_scene.solver_errors import NotConverged

    def fails(*_: object) -> None:
        raise NotConverged("the increment", 3, 1e-3, 1e-8)

    result = solve(scene({"normal_force": 1e3}), grid(16), 1e-8)
    monkeypatch.setattr(half_the_cells, "solve", fails)
    stated = stated_errors(result)
    assert {e.error for e in stated.steps[0].values() if e.status is not ErrorStatus.EXACT} == {
        None
    }
    assert "did not converge" in (stated.companions[0].refused or "")


def test_a_companion_that_takes_more_than_the_run_is_given_up(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    from contact_errors import half_the_cells

    result = solve(scene({"normal_force": 1e3}), grid(16), 1e-8)
    monkeypatch.setattr(half_the_cells, "FEW_CONVOLUTIONS", 0)
    assert stated_errors(result).companions[0].refused is None
    monkeypatch.setattr(half_the_cells, "MOST_CONVOLUTIONS", 0.1)
    stated = stated_errors(result)
    assert "more than the run itself" in (stated.companions[0].refused or "")
    assert stated.steps[0]["approach"].error is None


def test_the_error_of_the_work_covers_what_its_trapezoids_miss() -> None:
    # Nothing is lost: the work is the energy stored, 2/5 of load times approach (Hertz).
    result = solve(scene({"normal_force": 1e3, "increments": 2}), grid(24), 1e-8)
    (errors,) = stated_errors(result).steps
    end = result.steps[0]
    assert end.input_work is not None
    missed = abs(end.input_work - 0.4 * 1e3 * hertz().approach)
    assert missed > 1e-2 * end.input_work
    assert missed <= size(errors["input_work"]) <= 2 * missed


def test_doubled_increments_tell_half_of_an_error_that_falls_with_their_number() -> None:
    exact, off = 1.0, 0.2
    few, many = 2, 8
    of = {n: {"shift": np.array([exact + off / n])} for n in (few, recut(few), many, recut(many))}
    (told,) = path_changes([of[few]], [of[recut(few)]], [few], [True])
    assert told["shift"] == pytest.approx(off / few)
    (told,) = path_changes([of[many]], [of[recut(many)]], [many], [True])
    assert told["shift"] == pytest.approx(off / many)


def test_few_increments_are_doubled_where_many_are_halved() -> None:
    steps = scene(
        {"normal_force": 1e3, "increments": 3},
        {"tangential_force": (50.0, 0.0), "normal_force": 500.0, "increments": 9},
        friction=0.3,
    )
    decided = plan(steps)
    assert [step.path_matters for step in decided.path] == [False, True]
    matters = tuple(step.path_matters for step in decided.path)
    assert ByStep(decided.increments, matters).recut_from(0) == [3, 4]
    assert ByStep((3, 2), matters).recut_from(0) == [3, 4]


@pytest.mark.parametrize("cells", [20, 32, 47])
def test_the_error_of_partial_slip_covers_what_is_wrong(cells: int) -> None:
    """With ν = 0: Cattaneo and Mindlin leave out the slip across the force that others have."""
    matter, push = steel(poisson_ratio=0.0), {"tangential_force": (60.0, 0.0)}
    pushed = scene({"normal_force": 1e3}, push, indenter=paraboloid(matter), body=matter)
    result = solve(pushed, grid(cells), 1e-8)
    _, errors = stated_errors(result).steps
    _, end = result.steps
    assert end.stick_radius is not None
    assert end.tangential_shift is not None
    modulus = tangential_modulus((YOUNG, 0.0), (YOUNG, 0.0))
    contact_radius = hertz(poisson_ratio=0.0).contact_radius
    exact = PartialSlip(LOAD, contact_radius, MU, modulus, 60.0)
    assert abs(end.stick_radius - exact.stick_radius) <= size(errors["stick_radius"])
    assert abs(end.tangential_shift[0] - exact.shift) <= size(errors["tangential_shift"])


@pytest.mark.parametrize("part", [0.99995, 0.99999])
def test_stick_of_less_than_a_cell_has_not_converged_and_the_shift_is_known_still(
    part: float,
) -> None:
    matter, force = steel(poisson_ratio=0.0), part * MU * LOAD
    pushed = scene(
        PRESS, {"tangential_force": (force, 0.0)}, indenter=paraboloid(matter), body=matter
    )
    result = solve(pushed, grid(64), 1e-8)
    errors, end = stated_errors(result).steps[-1], result.steps[-1]
    modulus = tangential_modulus((YOUNG, 0.0), (YOUNG, 0.0))
    exact = PartialSlip(LOAD, hertz(poisson_ratio=0.0).contact_radius, MU, modulus, force)
    assert exact.stick_radius < result.grid.spacing[0]
    assert errors["stick_radius"].status is ErrorStatus.NOT_CONVERGED
    assert end.tangential_shift is not None
    assert abs(end.tangential_shift[0] - exact.shift) <= size(errors["tangential_shift"])


def test_stick_that_no_cell_shows_may_be_a_cell_wide() -> None:
    """Below a ball that is only pressed, on a body that it drags far: so little sticks."""
    pressed = coupled(press(), body=bulk(0.1))
    result, fine = (solve(pressed, grid(cells, 1.2), 1e-8) for cells in (32, 128))
    errors, (end,), (truth,) = stated_errors(result).steps[0], result.steps, fine.steps
    assert end.stick_radius == 0.0
    assert truth.stick_radius is not None
    assert truth.stick_area is not None
    assert truth.stick_radius > 0.0
    assert truth.stick_radius <= size(errors["stick_radius"])
    assert truth.stick_area <= size(errors["stick_area"])


def test_the_error_of_a_pushed_radius_where_bodies_couple_covers_what_is_wrong() -> None:
    """Beside stick near the edge, with a companion that has its edges inside the cells or not."""
    loading = press(), pushed_by(0.24, friction=0.05, increments=3)
    pushed = coupled(*loading, body=bulk(0.26), friction=0.05)
    coarse, middle, fine = (
        solve_discretised(pushed, SurfaceDiscretisation(cells=(cells, cells)))
        for cells in (32, 48, 112)
    )
    for result in (coarse, middle):
        errors, end = stated_errors(result).steps[1], result.steps[1]
        assert end.edge_change is not None
        for name in ("contact_radius", "approach"):
            assert abs(getattr(end, name) - getattr(fine.steps[1], name)) <= size(errors[name])


@pytest.mark.parametrize("cells", [22, 24, 48])
def test_the_error_of_stick_after_a_reversal_covers_what_is_wrong(cells: int) -> None:
    """Seven and more cells over the radius; slip comes in to a (1 - (T₁ - T₂)/2µW)^(1/3)."""
    matter, limit = steel(poisson_ratio=0.0), MU * LOAD
    ways = ({"tangential_force": (part * limit, 0.0)} for part in (0.8, 0.3))
    back = scene(PRESS, *ways, indenter=paraboloid(matter), body=matter)
    result = solve(back, grid(cells), 1e-8)
    errors, end = stated_errors(result).steps[-1], result.steps[-1]
    exact = hertz(poisson_ratio=0.0).contact_radius * np.cbrt(1 - 0.5 * (0.8 - 0.3))
    assert end.stick_radius is not None
    assert abs(end.stick_radius - exact) <= size(errors["stick_radius"])


@pytest.mark.parametrize("per_radius", [8, 10, 20])
def test_the_error_of_the_radius_below_a_cone_covers_what_is_wrong(per_radius: int) -> None:
    slope, matter = 0.02, steel()
    contact = ConeContact(slope, contact_modulus((YOUNG, NU), (YOUNG, NU)), A)
    cone = Cone(slope_angle=float(np.arctan(slope)), material=matter)
    pressed = scene({"normal_force": contact.load}, indenter=cone, friction=None)
    result = solve(pressed, grid(3 * per_radius), 1e-8)
    (errors,), (end,) = stated_errors(result).steps, result.steps
    assert abs(end.contact_radius - A) <= size(errors["contact_radius"]) < 0.3 * A


@pytest.mark.parametrize("solver", ["semi-analytical", "fem-complementarity"])
def test_the_error_of_the_largest_slip_of_a_cycle_covers_what_is_wrong(solver: str) -> None:
    """It is largest at the very edge of the contact, where no cell and no ring is."""
    matter, limit = steel(poisson_ratio=0.0), MU * LOAD
    ways = ({"tangential_force": (way * limit, 0.0)} for way in (0.6, -0.6, 0.6))
    loop = scene({"normal_force": LOAD}, *ways, indenter=paraboloid(matter), body=matter)
    contact_radius = hertz(poisson_ratio=0.0).contact_radius
    result: Any
    if solver == "semi-analytical":
        result = solve(loop, grid(32, radius=contact_radius), 1e-8)
        errors = stated_errors(result)
    else:
        mesh = FiniteElementDiscretisation(elements_per_radius=10)
        result = fem_reference.solve(loop, mesh, fem_reference.Method.COMPLEMENTARITY)
        errors = on_elements.stated_errors(result)
    modulus = tangential_modulus((YOUNG, 0.0), (YOUNG, 0.0))
    exact = PartialSlip(LOAD, contact_radius, MU, modulus, 0.6 * limit).slip(contact_radius)
    (cycle,) = fretting_cycles(result)
    wrong = abs(float(np.max(cycle.slip_amplitude)) - abs(float(exact)))
    assert wrong <= size(errors.steps[-1]["slip_amplitude"])


@pytest.mark.parametrize("cells", [24, 33, 48])
def test_the_error_of_stress_covers_what_is_wrong_at_the_trailing_edge(cells: int) -> None:
    # Hertz's pressure with the shear of full slip along x; Hamilton (1983), eq. for x = -a.
    on = grid(cells, contacts=1.5)
    pressure = hertz().peak_pressure * np.sqrt(
        np.clip(1 - np.hypot(*on.coordinates()) ** 2 / A**2, 0, None)
    )
    mu, body = 0.25, Body(material=steel())
    shear = np.stack([mu * pressure, 0 * pressure])
    state = LoadedBodies(
        "", body, body, 1, {"x": on.x, "y": on.y}, {"pressure": pressure, "shear": shear}, None
    )
    field = stress_on_cells(state, depths=[0.0])
    found = extremes(field, body)
    errors = dict(zip([e.measure for e in found], stress_errors(state, field, found), strict=True))
    (tension,) = (e.value for e in found if e.measure == "max_principal")
    exact = hertz().peak_pressure * ((1 - 2 * NU) / 3 + np.pi * mu * (4 + NU) / 8)
    assert tension < exact
    assert abs(tension - exact) <= size(errors["max_principal"]) < 10 * abs(tension - exact)


def test_wide_cells_carry_the_same_force() -> None:
    on = SurfaceGrid((9, 12), (3.0, 4.0))
    pressure = np.random.default_rng(1).random((9, 12))
    axes = {"x": on.x, "y": on.y}
    body = Body(material=steel())
    wide = on_wide_cells(LoadedBodies("", body, body, 1, axes, {"pressure": pressure}, None))
    assert [len(wide.axes[axis]) for axis in "xy"] == [5, 6]
    assert 4 * np.sum(wide.tractions["pressure"]) == pytest.approx(np.sum(pressure))


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[dict[str, Any], str]]:
    """Summary of a run and what it showed, with errors and without."""
    folder = tmp_path_factory.mktemp("runs")
    (folder / "scene.toml").write_text(FRETTING, encoding="utf-8")
    found = {}
    for option in ("--error", "--no-error"):
        asked = ("run", "scene.toml", "-o", option, "--figures", "none", option)
        ended = outcome(*asked, cwd=folder)
        assert ended.returncode == 0, ended.stderr
        written = (folder / option / "summary.json").read_text(encoding="utf-8")
        found[option] = json.loads(written), ended.stdout
    return found


def test_a_run_writes_the_errors_and_counts_their_solves_apart(runs) -> None:
    with_errors, without = (deepcopy(summary) for summary, _ in runs.values())
    assert {step.pop("errors") is None for step in without["steps"]} == {True}
    assert without.pop("companions") is None
    assert len(with_errors.pop("companions")) == 1
    for step in with_errors["steps"]:
        errors = step.pop("errors")
        numbers = [name for name in (*PHYSICAL, *OF_CYCLES) if step[name] is not None]
        assert sorted(errors) == sorted(numbers)
    assert with_errors == without


def test_the_table_shows_what_is_wrong_beside_the_number(runs) -> None:
    shown, alone = (said for _, said in runs.values())
    assert " ± " in shown
    assert " ± " not in alone
    assert "--no-error left them out" in alone


def test_every_figure_has_a_caption_with_errors(tmp_path: Path) -> None:
    drawn = {name for name in vars(file_names) if name.endswith("_FIGURE")}
    assert {getattr(file_names, name) for name in drawn} == set(SHOWN)
    result = solve(scene({"normal_force": 1e3}), grid(16), 1e-8)
    figure = Figure()
    add_caption(figure, file_names.PRESSURE_FIGURE, result, stated_errors(result).steps[-1])
    assert figure.get_supxlabel().count(" ± ") == 2
    add_caption(figure, file_names.PRESSURE_FIGURE, result, None)
    assert "errors not stated" in figure.get_supxlabel()


@pytest.mark.parametrize("cells", [10, 16, 24, 48])
def test_errors_with_edges_inside_the_cells_cover_what_is_wrong(cells: int) -> None:
    """They are a twentieth of those without where both levels have them there."""
    window = (3 * A, 3 * A)
    plain, edged = (
        solve_discretised(
            scene({"normal_force": 1e3}),
            SurfaceDiscretisation(cells=(cells, cells), window=window, edge=edge),
        )
        for edge in ("off", "last")
    )
    assert edged.steps[0].edge_change is not None
    (of_plain,), (of_edged,) = (stated_errors(result).steps for result in (plain, edged))
    exact = hertz()
    for name in ("peak_pressure", "contact_radius", "approach"):
        missed = abs(getattr(edged.steps[0], name) - getattr(exact, name))
        assert missed <= size(of_edged[name])
    if cells >= 24:
        assert size(of_edged["contact_radius"]) < 0.05 * size(of_plain["contact_radius"])


def test_errors_beside_a_companion_that_has_no_edges_inside_its_cells(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It tells of its own error alone: those of the run are as large as they may be."""

    def on_wide_cells(result: Result, planned: Plan, *more: Any) -> Any:
        return half_the_cells.on_wide_cells(result, replace(planned, edge="off"), *more)

    exact, ball, asked = hertz(poisson_ratio=0.0), steel(poisson_ratio=0.0), grid(32)
    of = scene(PRESS, push(0.6), indenter=paraboloid(ball), body=ball)
    result = solve(of, asked, 1e-8, plan=plan(of, edge="last"))
    beside_one = stated_errors(result).steps[-1]
    monkeypatch.setattr(on_cells, "on_wide_cells", on_wide_cells)
    alone = stated_errors(result).steps[-1]
    radii = {"contact_radius": exact.contact_radius}
    radii["stick_radius"] = 0.4 ** (1 / 3) * exact.contact_radius
    for name, radius in radii.items():
        for errors in (beside_one, alone):
            missed = abs(getattr(result.steps[-1], name) - radius)
            assert missed <= size(errors[name]) < 1e-3 * radius


@pytest.mark.parametrize("cells", [16, 24, 48])
def test_the_error_of_a_tilt_with_edges_inside_the_cells_covers_what_is_wrong(cells: int) -> None:
    """Not by a hundred times: it falls with the third power of the cells, as the tilt does."""
    beside, along = 0.11 * A, -0.07 * A
    asked = SurfaceDiscretisation(cells=(cells, cells), window=(3 * A, 3 * A), edge="last")
    pushed = scene(PRESS | {"moment": (LOAD * beside, LOAD * along)})
    result = solve_discretised(pushed, asked)
    (errors,), (end,) = stated_errors(result).steps, result.steps
    assert end.edge_change is not None
    assert end.tilt is not None
    missed = np.max(np.abs(end.tilt - np.array([beside, along]) / RADIUS))
    assert missed <= size(errors["tilt"]) < 30 * missed


@pytest.mark.parametrize(
    ("cells", "thickness", "converged"), [(13, 1.0, False), (13, 3.0, True), (18, 1.0, True)]
)
def test_five_cells_over_a_layer_do_not_tell_where_the_edge_within_them_is(
    cells: int, thickness: float, converged: bool
) -> None:
    """It was outside its error in five of seven such draws; of plain cells it is stated."""
    film = Layer(thickness=thickness * A, material=steel(young_modulus=1.5 * YOUNG))
    body = Body(material=steel(), layers=(film,))
    load = pressed_coating(surface_of(body), RADIUS, A).load
    pressed = Scene(indenter=paraboloid(RIGID), body=body, loading=({"normal_force": load},))
    for edge in ("last", "off"):
        asked = SurfaceDiscretisation(cells=(cells, cells), window=(2.4 * A, 2.4 * A), edge=edge)
        result = solve_discretised(pressed, asked)
        (errors,), (end,) = stated_errors(result).steps, result.steps
        assert (end.edge_change is not None) is (edge == "last")
        for name in ("approach", "contact_radius", "peak_pressure"):
            assert (errors[name].status is ErrorStatus.ESTIMATED) is (converged or edge == "off")


def on_a_stiff_film(stiffer: float, thickness: float) -> tuple[Scene, LayeredIndentation]:
    """A ball whose contact has the radius A, and what is known of it; thickness over A."""
    base = steel()
    matter = steel(young_modulus=stiffer * base.young_modulus)
    body = Body(material=base, layers=(Layer(thickness=thickness * A, material=matter),))
    contact = pressed_coating(surface_of(body), RADIUS, A)
    loading = ({"normal_force": contact.load},)
    return Scene(indenter=paraboloid(RIGID), body=body, loading=loading), contact


def below_a_stiff_film(cells: int, stiffer: float) -> tuple[Result, LayeredIndentation]:
    """A contact twelve times as wide as the film is thick, and what is known of it."""
    pressed, contact = on_a_stiff_film(stiffer, 0.083)
    return solve(pressed, grid(cells, contacts=1.2), 1e-8), contact


@pytest.mark.parametrize(("cells", "stiffer"), [(48, 20.0), (58, 42.6)])
def test_a_film_that_bends_over_all_of_the_contact_is_told_by_the_error_of_its_edge(
    cells: int, stiffer: float
) -> None:
    """Edges that are fitted on all the cells and on half of them are wrong alike."""
    pressed, _ = on_a_stiff_film(stiffer, 0.5)
    asked = SurfaceDiscretisation(cells=(cells, cells), window=(3 * A, 3 * A), edge="last")
    result = solve_discretised(pressed, asked)
    (errors,), (end,) = stated_errors(result).steps, result.steps
    assert end.edge_change is not None
    wrong = abs(end.contact_radius - A)
    assert 1e-3 * A < wrong <= size(errors["contact_radius"]) < 5 * wrong
    assert 2e-3 * end.contact_area < size(errors["contact_area"])


@pytest.mark.parametrize(("cells", "stiffer"), [(37, 40.0), (56, 30.0)])
def test_the_error_of_a_peak_at_the_rim_of_a_stiff_film_covers_what_is_wrong(
    cells: int, stiffer: float
) -> None:
    """The film bends and stands on the edge of its contact, on a ring as wide as it is thick."""
    result, contact = below_a_stiff_film(cells, stiffer)
    (errors,) = stated_errors(result).steps
    r = np.linspace(0, A, 2001)
    peak = float(np.max(contact.pressure(r)))
    wrong = abs(result.steps[0].peak_pressure - peak)
    assert 0.02 * peak < wrong <= size(errors["peak_pressure"])


def test_the_error_of_the_radius_below_a_stiff_film_covers_what_is_wrong() -> None:
    """Three cells over its thickness leave more wrong than forty over the radius would."""
    result, _ = below_a_stiff_film(100, 30.0)
    (errors,) = stated_errors(result).steps
    wrong = abs(result.steps[0].contact_radius - A)
    assert 0.01 * A < wrong <= size(errors["contact_radius"])


def test_increments_tell_of_tractions_whose_peak_is_infinite() -> None:
    """The pressure below a cone changes no more than they say."""
    cone = Cone(slope_angle=0.05, material=RIGID)
    few, many = (
        solve(
            scene({"normal_force": 1.0, "increments": n}, indenter=cone, friction=0.3),
            grid(24, radius=8e-6),
            1e-8,
        )
        for n in (4, 16)
    )
    told = state_of_result(few, None, stated_errors(few)).by_increments
    changed = np.max(np.abs(few.steps[-1].pressure - many.steps[-1].pressure))
    largest = np.max(many.steps[-1].pressure)
    assert told is not None
    assert 1e-3 * largest < changed <= told * largest < 20 * changed


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


@pytest.mark.parametrize(("friction", "status"), [(0.1, "not converged"), (0.5, "estimated")])
def test_a_peak_above_a_stick_zone_of_less_than_a_cell_has_not_converged(
    friction: float, status: str
) -> None:
    """Friction of a rigid ball gives the pressure a cusp that only the stick zone rounds off."""
    ball = paraboloid().model_copy(update={"material": RIGID})
    pressed = scene({"normal_force": 1e3}, indenter=ball, friction=friction)
    (errors,) = errors_of(pressed, grid(20, radius=0.8 * A))
    assert errors["approach"].status is ErrorStatus.ESTIMATED
    assert errors["peak_pressure"].status == status


def test_components_of_a_vector_share_one_size_unless_they_are_round_off_of_a_zero():
    both, one = ({"tangential_shift": np.array([3.0, y])} for y in (-1.0, 1e-12))
    first, second = estimate.largest_so_far([one, both])
    np.testing.assert_array_equal(first["tangential_shift"], [3.0, 1e-12])
    np.testing.assert_array_equal(second["tangential_shift"], [3.0, 3.0])
    (alone,) = estimate.largest_so_far([{"tangential_shift": np.array([1e-6, 1e-5])}])
    np.testing.assert_array_equal(alone["tangential_shift"], [1e-5, 1e-5])
