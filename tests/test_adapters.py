"""Tests of the adapters by which our solvers and other codes answer the challenges."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np
import pytest

from contact_results.directory.machine import program_version
from contact_scene import Scene
from contact_scene.solver_errors import NotConverged
from verification import Answer, CannotDo, Solver, judge
from verification.adapters import own_solvers as own
from verification.challenge.cases import challenges
from verification.challenge.python_api import Judgement, posed
from verification.challenge.solver_process import Posed
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.peers import environment
from verification.peers.drivers import approach_of, gap_of
from verification.peers.environment import PEERS
from verification.running.study import Settings
from verification.studies import scoreboard

Solve = Callable[[Posed, int], Answer]
CELLS = (own.answer_on_cells, own.ON_CELLS)
ELEMENTS = (own.answer_on_elements, own.ON_ELEMENTS)
RADII = (own.answer_on_radii, own.ON_RADII)


def failed(found: Judgement) -> set[str]:
    return {row.quantity for row in found.rows if row.status is Status.FAIL}


@pytest.mark.parametrize(
    ("name", "code", "levels", "grade"),
    [
        ("torsion_loop", CELLS, 2, "B"),
        ("torsion_loop", ELEMENTS, 1, "C"),
        ("sliding_stress", CELLS, 3, "B"),
        ("layered_patch/G1_over_G2=0.5", CELLS, 1, "A"),
        ("frictional_indentation/weak", ELEMENTS, 3, "C"),
        ("coated_paraboloid/E1_over_E2=4", ELEMENTS, 3, "C"),
        ("coated_paraboloid/E1_over_E2=4", RADII, 3, "A"),
        ("cone_contact", RADII, 2, "A"),
        # Finer levels take finer increments, or they stall at the error of the path.
        ("frictional_indentation/nu_zero", RADII, 3, "C"),
    ],
)
def test_each_solver_reaches_its_class(
    name: str, code: tuple[Solve, Solver], levels: int, grade: str
) -> None:
    answer, solver = code
    found = judge(name, answer, levels, solver=solver)
    assert found.grade <= grade, found.rows
    assert not found.omitted


def test_paths_of_changing_loads_are_followed() -> None:
    assert not failed(judge("changing_loads/nu=0.3", own.answer_on_cells, 2))


@pytest.mark.parametrize(
    ("answer", "name", "said"),
    [
        (own.answer_on_radii, "hertz_elliptical", "not axisymmetric"),
        (own.answer_on_radii, "sliding_stress", "stress below the surface"),
        (own.answer_on_elements, "hertz_elliptical", "not axisymmetric"),
        (own.answer_on_elements, "layered_patch/G1_over_G2=2", "contacts only"),
    ],
)
def test_who_cannot_says_why(answer: Solve, name: str, said: str) -> None:
    with pytest.raises(CannotDo, match=said):
        judge(name, answer, 1)


@pytest.mark.parametrize(
    ("module", "solve", "answer"),
    [
        (own, "solve_discretised", own.answer_on_cells),
        (own.fem_reference, "solve", own.answer_on_elements),
        (own.radial, "solve", own.answer_on_radii),
    ],
)
def test_a_level_that_does_not_converge_is_given_up_and_others_are_judged(
    monkeypatch: pytest.MonkeyPatch, module: Any, solve: str, answer: Solve
) -> None:
    right, calls = getattr(module, solve), []

    def stops_at_the_first(*posed: Any) -> Any:
        calls.append(posed)
        if len(calls) == 1:
            raise NotConverged("the increment", 40, 1e-3, 1e-8)
        return right(*posed)

    monkeypatch.setattr(module, solve, stops_at_the_first)
    found = judge("hertz_point", answer, 3, at_least="C")
    (told,) = (row for row in found.rows if row.quantity == "solved")
    assert "the increment did not converge" in told.because
    assert failed(found) == {"solved"}, found.rows
    assert found.exit_code() == 3
    coarse, fine, _ = found.answers
    assert fine.scalars
    assert fine.h < coarse.h


def test_shear_between_rings_is_what_pulls() -> None:
    found = judge("cattaneo_mindlin", own.answer_on_elements, 1, solver=own.ON_ELEMENTS)
    assert {"shear_x", "shear_x: load carried", "shift_x"} <= {row.quantity for row in found.rows}
    assert "shear_x: load carried" not in failed(found)


def test_codes_for_half_spaces_are_asked_for_what_they_have_alone() -> None:
    aspher = next(peer for peer in PEERS if peer.friction)
    asked = set()
    for name in challenges():
        with suppress(CannotDo):
            environment._driver_request(posed(name), 32, aspher)
            asked.add(name)
    assert asked == {
        "hertz_point",
        "hertz_elliptical",
        "cone_contact",
        "flat_punch",
        "cattaneo_mindlin",
        "fretting_loop",
        "tilted_punch",
        "tilted_ball",
    }


def test_a_code_has_the_version_of_its_interpreter_or_is_left_out() -> None:
    assert environment.installed_version("numpy") == np.__version__
    with pytest.raises(CannotDo, match="no_such_code is not installed for "):
        environment.installed_version("no_such_code")


def test_a_tilt_closes_the_gap_of_other_codes_at_positive_y_and_x() -> None:
    """A tilted paraboloid is a shifted one, in their units too."""
    posed_ball = posed("tilted_ball")
    request, length, _ = environment._driver_request(posed_ball, 64, PEERS[0])
    along_y, along_x = posed_ball.scene["loading"][0]["tilt"]
    i, j = np.unravel_index(np.argmin(gap_of(request)), (64, 64))
    x = ((np.arange(64) + 0.5) * request["window"] / 64 - request["window"] / 2) * length
    radius = posed_ball.scene["indenter"]["radius"]
    assert (x[i], x[j]) == pytest.approx((radius * along_x, radius * along_y), abs=x[1] - x[0])


def test_approach_is_what_overlaps_where_codes_find_pressure() -> None:
    request = environment._driver_request(posed("flat_punch"), 32, PEERS[0])[0]
    gap = gap_of(request)
    pressure = np.where(gap == 0, 2.0, 0.0)
    assert np.sum(pressure > 0) == pytest.approx(np.pi * (request["rim"] * 32 / 3) ** 2, rel=0.05)
    displacement = np.where(gap == 0, 3e-2, 1e-2)
    assert approach_of(gap, displacement, pressure) == pytest.approx(3e-2)
    ball = gap_of({"cells": 32, "window": 3.0, "radius": 1.0})
    assert approach_of(ball, 0.5 - ball, np.maximum(0.5 - ball, 0)) == pytest.approx(0.5)


def test_increments_are_refined_with_the_cells_where_the_way_matters(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Or shifts of the paper's figure would stall at the error of the path, some 0.3 %."""
    taken: list[list[int | None]] = []

    def solve(scene: Scene, on: object) -> None:
        taken.append([step.increments for step in scene.loading])
        raise CannotDo("enough")

    monkeypatch.setattr(own, "solve_discretised", solve)
    for name, level in (("paper_figure_4", 0), ("paper_figure_4", 2), ("torsion", 2)):
        with pytest.raises(CannotDo, match="enough"):
            own.answer_on_cells(posed(name), level)
    assert taken == [[10] * 4, [40] * 4, [1] * 4]


def test_the_scoreboard_names_the_version_and_the_price_of_a_code() -> None:
    run = scoreboard.ScoredRun(own.ON_RADII.name, "hertz_point", 2)
    refused = scoreboard.ScoredRun(own.ON_RADII.name, "tilted_ball", 2)
    records = {one.name: one.compute() for one in (run, refused)}
    found = scoreboard.conclude(Settings(level=Level.QUICK, levels=2), records)
    (line,) = found.statements
    assert line.claim == f"slipstick, radial {program_version()} answers"
    assert line.measured == f"1 of {len(challenges())} challenges"
    priced = {row[0]: row[1] for row in found.tables[1].rows}
    assert float(priced["hertz_point"]) == pytest.approx(records[run.name].seconds, rel=0.05)
    assert priced["tilted_ball"] == scoreboard.NO_ANSWER
