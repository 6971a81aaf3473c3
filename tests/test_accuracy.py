"""Tests of requested accuracies: results meet them, or the program states the reason for a miss."""

import re
import signal
import tracemalloc
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np
import pytest
from command import slipstick
from contact_scenes import (
    APPROACH,
    LOAD,
    MU,
    NU,
    PRESS,
    RIGID_BALL,
    YOUNG,
    A,
    hertz,
    paraboloid,
    push,
    scene,
    steel,
)
from hypothesis import given
from hypothesis import strategies as st

import radial
import semi_analytical
from contact_errors import adaptive_refinement
from contact_errors.adaptive_refinement import (
    Levels,
    Refined,
    RefinementLevel,
    largest_allowed_part,
    limit_factors,
    refine,
    targets_of,
)
from contact_errors.error_formula import SolvedRun
from contact_errors.stress_errors import largest_stresses
from contact_results import result_files
from contact_results.directory import checkpoint
from contact_scene import (
    RIGID,
    Body,
    FiniteElementDiscretisation,
    HeightMap,
    Layer,
    RadialDiscretisation,
    Scene,
    SurfaceDiscretisation,
)
from contact_scene.contact_features import Features
from contact_scene.discretised import Fineness
from contact_scene.quantities.stated_error import (
    ErrorStatus,
    StatedError,
    StatedErrors,
)
from contact_scene.reading.scene_file import (
    read_accuracy,
    read_scene_file,
)
from contact_scene.solver_errors import AccuracyOutOfReach
from fem_reference import Method
from fem_reference.discretised import ElementSolver
from radial.discretised import RingSolver
from semi_analytical import solve
from semi_analytical.discretised import CellSolver, scale_cells
from semi_analytical.memory import LIBRARIES, SCIPY
from semi_analytical.stress.field import bytes_below_contact
from slipstick import solve as solve_file
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.hertz import tangential_modulus

SCENE = """
[indenter]
shape = "paraboloid"
radius = "18 mm"
material = { young_modulus = "420 GPa", poisson_ratio = 0.3 }
[body]
material = { young_modulus = "420 GPa", poisson_ratio = 0.3 }
[[loading]]
normal_force = "1 kN"
"""
TENSION = "max_principal 40%"
FINER = "0.005%"  # than the first rung is
LAYER = Layer(thickness=A, material=steel(young_modulus=2 * YOUNG))


def request(text: str):
    return read_accuracy(text, "--accuracy", paraboloid())


def on_cells(of: Scene, stress_at: int | None = None, **asked: str) -> Levels:
    return Levels(CellSolver(of, SurfaceDiscretisation(**asked)), stress_at)


def climbed(of: Scene, asked: str, **limits: float) -> Refined:
    return refine(on_cells(of), request(asked), **limits)


def test_a_name_counts_more_than_the_share_of_all_in_the_order_of_the_results():
    """Equal requests give equal summaries: no order of a set, which changes from run to run."""
    shares = request("1%, torque: 2e-3, approach=0.1 %").shares()
    assert (shares["approach"], shares["torque"], shares["twist"]) == (1e-3, 2e-3, 1e-2)
    assert [*shares] == [*request("approach 0.1%, 1%, torque 2e-3").shares()]
    assert len(shares) == 7


HERTZ = {"approach": APPROACH, "contact_radius": A, "peak_pressure": hertz().peak_pressure}
SLIP, BACK = (
    PartialSlip(LOAD, A, MU, tangential_modulus((YOUNG, NU), (YOUNG, NU)), force)
    for force in (60.0, 30.0)
)
LOOP = scene(PRESS, push(0.6), push(0))
LEFT = SLIP.shift - 2 * BACK.shift
COATED = scene(
    PRESS, friction=None, indenter=RIGID_BALL, body=Body(material=steel(), layers=(LAYER,))
)


def by_elements(method: Method) -> Levels:
    return Levels(ElementSolver(scene(PRESS), FiniteElementDiscretisation(), method=method))


def by_rings(*loading):
    return Levels(RingSolver(scene(*loading, indenter=paraboloid()), RadialDiscretisation()))


def finer_end(level: RefinementLevel) -> dict[str, Any]:
    """Numbers on cells a third as wide, or by half as many rings again."""
    posed, space = level.result.scene, level.fineness.space
    if isinstance(space, float):
        finer = radial.solve(posed, plan=replace(radial.plan(posed), fineness=1.5))
    else:
        finer = solve(posed, space.refined(3), 1e-8)
    return {name: getattr(finer.steps[-1], name) for name in level.values[-1]}


MET = {
    "hertz, 1 %": (on_cells(scene(PRESS)), "1%", HERTZ),
    "hertz, 0.1 %": (on_cells(scene(PRESS)), "0.1%", HERTZ),
    **{f"elements, {law}": (by_elements(law), "0.5%", HERTZ) for law in Method},
    "rings, pressed": (by_rings(PRESS), "1%", None),
    "rings, pushed": (by_rings(PRESS, push(0.6)), "2%", None),
    "partial slip": (on_cells(LOOP), "3%, dissipated_energy 3%", {"tangential_shift": LEFT}),
    "coated": (on_cells(COATED), "1%", None),
}


@pytest.mark.parametrize(("levels", "text", "exact"), MET.values(), ids=MET)
def test_numbers_are_as_accurate_as_requested(levels, text, exact):
    made = refine(levels, request(text))
    assert made.accuracy.met
    for name, known in (exact or finer_end(made.level)).items():
        if (share := made.accuracy.asked.get(name)) is not None:
            assert (made.accuracy.reached[name] or 0.0) < share
            found = np.ravel(made.level.values[-1][name])[0]
            assert found == pytest.approx(np.ravel(known)[0], rel=share), name
    assert made.accuracy.asked.keys() >= {*(exact or ())}


def test_other_parameters_of_a_mesh_are_refined_by_their_factors():
    asked = FiniteElementDiscretisation()
    solver = ElementSolver(scene(PRESS), asked, method=Method.PENALTY)
    assert solver.refine_space(asked, {}) == asked
    box = solver.refine_space(asked, {"section": 1.0}).box
    finer = solver.refine_space(asked, {"section": 2.0, "penalty": 10.0, "harmonics": 1.5})
    assert finer.box == pytest.approx(2 * box)
    assert finer.overlap == pytest.approx(asked.overlap / 10)
    assert finer.harmonics == 1.5 * asked.harmonics
    assert finer.elements_per_radius == asked.elements_per_radius


def test_levels_with_a_largest_stress_take_the_memory_that_is_estimated():
    pressed = scene(PRESS, friction=None)
    grid = semi_analytical.discretise(pressed, SurfaceDiscretisation(cells=(64, 64)))
    result = solve(pressed, grid, 1e-6)
    expected = bytes_below_contact(grid)
    tracemalloc.start()
    largest_stresses(result, StatedErrors(({},), (), (None,)), ["max_principal@body"])
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert 0.5 * expected < peak < expected
    finer = Fineness(grid.refined().refined().refined(), (1,), 1e-6)
    with_stress, without = (on_cells(pressed, at).memory(finer) for at in (1, None))
    assert without < with_stress == LIBRARIES + SCIPY + bytes_below_contact(finer.space)


FRICTIONLESS = scene(PRESS, friction=None)
SOLVERS = {
    "cells": CellSolver(FRICTIONLESS, SurfaceDiscretisation()),
    "rings": RingSolver(FRICTIONLESS, RadialDiscretisation()),
    "elements": ElementSolver(FRICTIONLESS, FiniteElementDiscretisation()),
}


@pytest.mark.parametrize("solver", SOLVERS.values(), ids=SOLVERS)
def test_the_largest_tension_is_as_accurate_as_was_asked(solver):
    made = refine(Levels(solver, 1), request(TENSION))
    exact = (1 - 2 * NU) / 3 * hertz().peak_pressure  # at the edge of the contact
    assert made.accuracy.met
    assert set(made.accuracy.asked) == {"max_principal"}
    assert made.level.largest("max_principal") == pytest.approx(exact, rel=0.4)


def test_a_tension_that_nobody_has_is_refused():
    rigid = scene(PRESS, friction=None, body=Body(material=RIGID))
    with pytest.raises(AccuracyOutOfReach, match="max_principal"):
        refine(on_cells(rigid, 1), request(TENSION))


def test_an_error_that_no_grid_reduces_ends_the_refinement():
    at = 0.01 * A / 3 * np.abs(np.arange(13) - 6)
    heights = at[:, None] + at
    rough = HeightMap(file=heights, spacing=A / 3, material=RIGID)
    made = climbed(scene(PRESS, friction=None, indenter=rough), "approach 0.01%")
    assert not made.accuracy.met
    assert "the points of the indenter leave an error of" in made.accuracy.stopped
    assert made.accuracy.rounds == 1


def test_a_limit_of_time_holds_for_all_rounds_together(monkeypatch):
    """Each round takes one second and needs another of the same length."""
    solve_level, rounds = Levels.solve_level, []

    def solved(self, fineness):
        rounds.append(fineness)
        began = process_time()
        level = solve_level(self, fineness)
        assert level.solve_seconds + level.error_seconds <= process_time() - began
        return replace(level, seconds=1.0, solve_seconds=1.0, error_seconds=0.0)

    monkeypatch.setattr(Levels, "solve_level", solved)
    monkeypatch.setattr(Levels, "estimated_seconds", lambda *_: 1.0)
    made = refine(on_cells(scene(PRESS), edge="off"), request("approach 0.001%"), most_seconds=2.5)
    assert not made.accuracy.met
    assert len(rounds) == 2


def test_rounds_that_do_not_reduce_the_error_end_the_refinement_at_the_best_level(
    monkeypatch,
):
    sizes, reached = iter([0.02, 0.01, 0.03, 0.04]), {}

    def scripted(self, name):
        cells = self.fineness.space.cells
        if cells not in reached:
            reached[cells] = next(sizes)
        return reached[cells]

    monkeypatch.setattr(RefinementLevel, "reached_error", scripted)
    made = climbed(scene(PRESS), "approach 0.1%")
    assert made.accuracy.reached == {"approach": 0.01}
    assert reached[made.level.result.grid.cells] == reached[made.accuracy.settings.cells] == 0.01
    assert "have not reduced the error" in made.accuracy.stopped


@pytest.mark.parametrize(
    "judge", [refine, lambda levels, asked: targets_of(asked, levels.solve_first_level(), levels)]
)
def test_a_last_level_beyond_the_memory_is_refused_by_run_and_plan(judge, monkeypatch):
    """The last level needs little more memory than the first, and one byte less is available."""
    levels, asked = on_cells(scene(PRESS), edge="off"), request("approach 0.05%")
    *_, last = targets_of(asked, first := levels.solve_first_level(), levels)
    assert first.fineness.space.cells < last.space.cells
    needed = levels.solver.memory(last)
    monkeypatch.setattr(adaptive_refinement, "available_bytes", lambda: needed - 1)
    with pytest.raises(AccuracyOutOfReach, match=r"no grid can meet the request.*GiB"):
        judge(levels, asked)
    monkeypatch.setattr(adaptive_refinement, "available_bytes", lambda: needed)
    judge(levels, asked)


SIZES = "approach", "normal_force", "contact_radius", "contact_area", "peak_pressure"


def level_of(parts: dict[str, float], status=ErrorStatus.ESTIMATED) -> RefinementLevel:
    """A level whose approach is 2 and has an error of these parts."""
    error = StatedError(error=sum(parts.values()), parts=parts, status=status)
    values = [dict.fromkeys(SIZES, np.array([2.0]))]
    run = SolvedRun(scene(PRESS), values, [1e-8], [Features(10)], [], {"cells": [True]}, {})
    stated = StatedErrors(({"approach": error},), (), (None,))
    return RefinementLevel(None, None, values, stated, run, 1.0, 0.5, 0.5)


def test_a_worked_example_of_refinement():
    """Of 2: cells 4 %, increments 2 %, section 0.5 %; each is allowed 1/1.15/3 % = 0.2899 %:
    (4/0.2899)^(1/2) = 3.715, 2/0.2899 = 6.9, (0.5/0.2899)^(1/2) = 1.313."""
    parts = {"cells": 0.08, "increments": 0.04, "section": 0.01}
    by = level_of(parts).needed_factors({"approach": 0.01})
    assert by == pytest.approx({"cells": 3.715, "increments": 6.9, "section": 1.313}, rel=1e-3)
    assert limit_factors(by, "cells") == by | {"increments": 4.0}


@given(st.lists(st.floats(0, 1), min_size=1, max_size=5), st.floats(1e-6, 1.0))
def test_reduced_parts_use_up_what_was_asked(sizes, limit):
    allowed = largest_allowed_part(sizes, limit)
    reduced = sum(min(size, allowed) for size in sizes)
    assert reduced == pytest.approx(min(limit, sum(sizes)), abs=1e-12)


def test_a_number_that_has_not_converged_doubles_the_cells():
    level = level_of({"cells": 1e-9}, ErrorStatus.NOT_CONVERGED)
    assert not level.meets({"approach": 0.1})
    assert level.needed_factors({"approach": 0.1}) == {"cells": 2}
    assert limit_factors({}, "cells")["cells"] > 1


def test_a_request_is_met_where_every_number_of_every_step_meets_it():
    fine, rough = (level_of({"cells": error}) for error in (1e-4, 0.5))
    steps = (*fine.stated.steps, *rough.stated.steps)
    for order in (steps, steps[::-1]):
        level = replace(
            fine, values=[*fine.values] * 2, stated=StatedErrors(order, (), (None,) * 2)
        )
        assert level.reached_error("approach") == 0.25
        assert not level.meets({"approach": 0.1})
    both = {"approach": steps[0]["approach"], "twist": steps[1]["approach"]}
    values = [dict.fromkeys((*SIZES, *both), np.array([2.0]))]
    assert not replace(fine, values=values, stated=StatedErrors((both,), (), (None,))).meets(
        dict.fromkeys(both, 0.1)
    )


@given(st.floats(1, 16000))
def test_cells_are_even_and_smooth(least):
    number, _ = scale_cells((1, 1), least)
    assert number % 2 == 0
    assert least - 1e-6 <= number <= 1.2 * least + 2
    for prime in (2, 3, 5, 7):
        while number % prime == 0:
            number //= prime
    assert number == 1


def written(tmp_path: Path, more: str = "") -> Path:
    path = tmp_path / "scene.toml"
    path.write_text(SCENE + more, encoding="utf-8")
    return path


def test_python_solves_as_accurately_as_the_file_asks(tmp_path, monkeypatch):
    result = solve_file(read_scene_file(written(tmp_path, "[accuracy]\napproach = '0.2 %'\n")))
    assert result.steps[-1].approach == pytest.approx(APPROACH, rel=2e-3)
    assert result.grid.cells < (64, 64)
    asked = read_scene_file(written(tmp_path, "[accuracy]\ncontact_radius = 1e-12\n"))
    with pytest.raises(AccuracyOutOfReach, match="--solver radial can solve this"):
        solve_file(asked)
    monkeypatch.setattr(adaptive_refinement, "MAX_ROUNDS", 1)
    asked = read_scene_file(written(tmp_path, "[accuracy]\napproach = '0.0001 %'\n"))
    with pytest.raises(AccuracyOutOfReach, match="1 rounds have not met it"):
        solve_file(asked)


@pytest.mark.parametrize("stop", [signal.SIGTERM, signal.SIGKILL])
def test_a_killed_run_resumes_the_solve_of_its_last_level(
    tmp_path,
    monkeypatch,
    capfd,
    stop,
):
    path, out = written(tmp_path), tmp_path / "out"
    asked = ("--figures", "none", "--accuracy", FINER)

    def killed(*given, **more):
        signal.raise_signal(stop)

    monkeypatch.setattr(checkpoint, "SECONDS_BETWEEN", 0.0)
    with monkeypatch.context() as writing:
        writing.setattr(result_files, "write_computed", killed)
        run = get_context("fork").Process(target=slipstick, args=("run", path, "-o", out, *asked))
        run.start()
        run.join()
    assert run.exitcode in (128 + stop, -stop)
    assert len([*tmp_path.glob(".out.checkpoint-*")]) == 1
    capfd.readouterr()
    assert slipstick("run", path, "-o", out, *asked) == 0
    increments = len((out / "increments.csv").read_text(encoding="utf-8").splitlines()) - 1
    assert f"going on after increment {increments} " in " ".join(capfd.readouterr().err.split())
    assert sorted(p.name for p in tmp_path.iterdir()) == ["out", "scene.toml"]


def test_a_plan_prints_the_memory_of_the_libraries_at_least(tmp_path, capsys):
    """Transcripts leave out sizes of memory."""
    assert slipstick("plan", written(tmp_path), "--accuracy", "1%") == 0
    memory = re.findall(r"about (\d+) MiB", capsys.readouterr().out)
    assert memory
    assert min(map(int, memory)) >= LIBRARIES // 2**20
