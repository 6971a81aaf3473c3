"""Tests of `import slipstick`: public names, solved and stored results, and changed scenes."""

from dataclasses import replace

import numpy as np
import pytest
from command import rows
from contact_scenes import PRESS, push, scene, steel

import slipstick
from contact_results.cycles import fretting_cycles
from contact_results.solvers import SolverName
from contact_results.stress.loaded_bodies import state_of_result, state_of_run
from contact_results.surface import surface_of
from contact_scene import HeightMap, SceneError
from contact_scene.quantities.field_metadata import reported
from contact_scene.quantities.increment import SCALARS

STEEL = steel()
# Two cycles of different amplitude.
SCENE = scene(PRESS, *(push(part, increments=2) for part in (0.6, -0.6, 0.6, -0.3, 0.6)))
SCENE = SCENE.model_copy(update={"title": "ball"})
COARSE = {
    solver: slipstick.FiniteElementDiscretisation(elements_per_radius=6)
    if solver.is_fem
    else slipstick.SurfaceDiscretisation(cells=(16, 16))
    for solver in SolverName
} | {SolverName.RADIAL: slipstick.RadialDiscretisation(rings=8)}
SHEARED = [solver for solver in SolverName if solver is not SolverName.RADIAL]


@pytest.mark.parametrize("name", slipstick.__all__)
def test_every_name_is_there_and_says_what_it_is(name):
    assert name in dir(slipstick)
    assert getattr(slipstick, name).__doc__


def solved_and_loaded(folder, posed, solver):
    """Result of a scene, and the run that is read back; the files of the scene are removed."""
    result = slipstick.solve(posed, solver.value, COARSE[solver])
    slipstick.save(result, folder / "out", figures="none")
    for path in folder.glob("*.*"):
        path.unlink()
    return result, slipstick.load(folder / "out")


@pytest.mark.parametrize("solver", SHEARED)
def test_a_result_comes_back_as_it_was_saved(solver, tmp_path):
    """The same bits from the disk, with units and places."""
    result, run = solved_and_loaded(tmp_path, SCENE, solver)
    assert run.scene == SCENE
    axes = surface_of(result).axes
    assert set(run.coordinates) == set(axes)
    for name, places in axes.items():
        assert np.array_equal(run.coordinates[name].array, places)
        assert run.coordinates[name].unit == ("rad" if name == "angles" else "m")
    pressures = np.array([end.pressure for end in result.steps])
    assert np.array_equal(run.increments["pressure"].array, pressures)
    for name in run.increments:
        mark = (SCALARS | reported(type(result.steps[0]))).get(name)
        assert mark is None or run.increments[name].unit == mark.unit
        assert run.increments[name].meaning
    amplitude = fretting_cycles(result)[-1].slip_amplitude
    assert np.array_equal(run.last_cycle["slip_amplitude"].array, amplitude)


@pytest.mark.parametrize("solver", SolverName)
def test_a_result_is_a_table_and_three_lines(solver, tmp_path):
    """The columns are those of increments.csv; NaN stands for an empty cell."""
    result = slipstick.solve(SCENE, solver.value, COARSE[solver])
    slipstick.save(result, tmp_path / "out", figures="none")
    written = rows(tmp_path / "out/increments.csv")
    table = result.table()
    for head in written[0]:
        name = head.partition(" [")[0]
        cells = [float(row[head] or "nan") for row in written]
        if name in table:
            assert np.array_equal(table[name], cells, equal_nan=True)
        else:
            assert np.all(np.isnan(cells)), name
    first, second, third = repr(result).splitlines()
    assert first == f"ball, solved by {result.solver}"
    assert second == f"load steps: 6, increments: {len(result.increments)}"
    assert "normal force 1 kN" in third
    assert "tangential force x 60 N" in third


def test_a_printed_result_leaves_out_what_the_solve_does_not_resolve():
    """A component is left out below the residual times the vector, or the size of the contact."""
    result = slipstick.solve(SCENE, "semi-analytical", COARSE[SolverName.SEMI_ANALYTICAL])
    end = result.increments[-1]
    residual = end.residuals.worst
    assert residual > 1e-12

    def printed(part, least):
        shifted = replace(
            end,
            tangential_shift=(end.tangential_shift[0], part * end.tangential_shift[0]),
            torque=least * end.normal_force * end.contact_radius,
        )
        return repr(replace(result, increments=(*result.increments[:-1], shifted)))

    noise = max(residual, 1e-9)
    small, large = printed(noise / 2, noise / 2), printed(1e-5, 1e-5)
    assert "tangential shift x" in small
    assert not any(name in small for name in ("shift y", "torque"))
    assert all(name in large for name in ("shift y", "torque"))


def test_a_wrong_name_or_discretisation_is_told_with_what_was_expected():
    with pytest.raises(ValueError, match="no solver 'fea'; expected one of semi-analytical, fem"):
        slipstick.solve(SCENE, "fea")
    with pytest.raises(ValueError, match="takes a FiniteElementDiscretisation, got Surface"):
        slipstick.solve(SCENE, "fem", COARSE["semi-analytical"])
    for ask in (slipstick.solve, slipstick.plan):
        with pytest.raises(TypeError, match="got a str, expected a Scene; load_scene reads one"):
            ask("scenes/hertz.toml")


def test_a_stored_run_needs_none_of_the_files_of_its_scene(tmp_path):
    """Heights and coefficients of friction are read from the result."""
    x = np.linspace(-1e-4, 1e-4, 32)
    np.save(tmp_path / "ball.npy", (x[:, None] ** 2 + x**2) / 2 / 18e-3)
    mu = np.broadcast_to(0.1 + x, (32, 32))
    mapped = scene(
        {"normal_force": 5.0},
        {"tangential_force": (0.2, 0.0)},
        indenter=HeightMap(file=str(tmp_path / "ball.npy"), spacing=x[1] - x[0], material=STEEL),
        friction={"map": mu, "spacing": x[1] - x[0]},
    )
    result, run = solved_and_loaded(tmp_path, mapped, SolverName.SEMI_ANALYTICAL)
    assert run.scene == mapped
    assert run.scene.indenter.initial_gap(0.0, 0.0) == mapped.indenter.initial_gap(0.0, 0.0)
    expected, found = state_of_result(result, None), state_of_run(tmp_path / "out", None)
    assert np.array_equal(found.tractions["shear"], expected.tractions["shear"])
    assert found.no_root == expected.no_root
    assert found.no_root


def test_a_stored_profile_is_that_of_the_scene(tmp_path):
    """As a column of text, in its units."""
    text = "r (um),z (nm)\n" + "".join(f"{r},{r * r / 36}\n" for r in range(0, 1000, 90))
    (tmp_path / "tip.csv").write_text(text, encoding="utf-8")
    indenter = slipstick.RevolvedProfile(
        file=str(tmp_path / "tip.csv"), radius_unit="um", height_unit="nm", material=STEEL
    )
    pressed = SCENE.model_copy(update={"indenter": indenter, "loading": SCENE.loading[:1]})
    _, run = solved_and_loaded(tmp_path, pressed, SolverName.RADIAL)
    assert run.scene == pressed


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"indenter.raduis": 1.0}, "indenter.raduis"),
        ({"friction": None}, "loading[2].tangential_force"),
        ({"loading[7].increments": 2}, "loading[7].increments"),
        ({"semi_analytical.cells": [64, 64]}, "semi_analytical"),
        ({"": 1}, ""),
    ],
)
def test_a_change_of_a_scene_is_checked(change, key):
    with pytest.raises(SceneError) as caught:
        SCENE.replace(change)
    assert key in {problem.key for problem in caught.value.problems}


def test_a_changed_scene_is_the_one_with_these_values_and_the_first_stays():
    film = slipstick.Layer(thickness=2e-5, material=STEEL)
    changed = SCENE.replace(
        {
            "indenter.radius": "12 mm",
            "body.layers": (film,),
            "loading[2].increments": 5,
            "body.layers[1].thickness": "10 um",
            "indenter.material.poisson_ratio": 0.2,
            "title": "other",
        }
    )
    assert (changed.indenter.radius, changed.title) == (12e-3, "other")
    assert changed.body.layers[0].thickness == 1e-5
    assert film.thickness == 2e-5
    assert changed.indenter.material.poisson_ratio == 0.2
    assert changed.loading[1].increments == 5
    assert SCENE.indenter.material == STEEL
    assert SCENE.replace({}) == SCENE
    rough = slipstick.HeightMap(file=np.eye(9), spacing=1e-6, material=STEEL)
    mapped = SCENE.replace({"indenter": rough}).replace({"indenter.spacing": "2 um"})
    assert mapped.indenter == slipstick.HeightMap(file=np.eye(9), spacing=2e-6, material=STEEL)
