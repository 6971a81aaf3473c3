"""Tests of the stability map: its contacts, its verdicts, and detection of wrong results."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from contact_scene import SceneError
from contact_scene.reading.scene_error import Problem
from contact_scene.solver_errors import GrossSliding, ResourceRefused, UnsupportedScene
from semi_analytical import NotConverged, Result, solve
from verification.exhibits.chart import Look, curve
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.observed.observed_laws import observed
from verification.report.drawing import look_of
from verification.running.case_pool import CaseStore
from verification.running.study import CaseRecord, Settings
from verification.studies.stability import contacts, study
from verification.studies.stability.contacts import (
    CellRecord,
    LoadingPath,
    Posed,
    Refusal,
    SolvedContact,
    Solver,
    StabilityCell,
    Surface,
    Verdict,
    by_superposition,
    judge_contact,
    pose,
    study_cells,
    views,
)
from verification.studies.stability.study import CLASSES, class_of, view_chart

ORDINARY = StabilityCell(cells=16)
HALF_SPACE = replace(ORDINARY, modulus_ratio=1.0)
SOFT_FILM = replace(ORDINARY, modulus_ratio=1e-3, thickness=0.01, poisson_ratio=0.5)
STIFF_FILM = replace(ORDINARY, modulus_ratio=1e3, thickness=0.1, poisson_ratio=0.0)
GOOD = CellRecord(
    verdict=Verdict.CONVERGED,
    tolerance=1e-8,
    residual=2e-9,
    observed=3e-9,
    increments=4,
    rounds=7,
    way="alternation",
    iterations=80,
    convolutions=400,
)


@pytest.mark.parametrize(("level", "least"), [(Level.QUICK, 100), (Level.FULL, 2000)])
def test_a_level_has_enough_cells_with_names_of_their_own(level: Level, least: int) -> None:
    cells = study_cells(level, 32)
    assert len(cells) >= least
    assert len({cell.name for cell in cells}) == len(set(cells)) == len(cells)
    assert {cell.path for cell in cells} == set(LoadingPath)
    assert {cell.surface for cell in cells} == set(Surface)


def test_different_cells_have_different_names_and_files(tmp_path: object) -> None:
    cells = [
        ORDINARY,
        *(
            replace(ORDINARY, **{key: value})
            for key, value in {
                "friction": 0.3,
                "push": 0.3,
                "modulus_ratio": 0.3,
                "thickness": 0.3,
                "load": 0.3,
                "poisson_ratio": 0.2,
                "base_ratio": 0.2,
                "length": 0.3,
                "modulus": 0.3,
                "cells": 24,
                "path": LoadingPath.LOOP,
                "surface": Surface.ROUGH,
                "solver": Solver.PENALTY,
            }.items()
        ),
    ]
    assert len({cell.name for cell in cells}) == len(cells)
    store = CaseStore(tmp_path)
    assert all(store.path(a) != store.path(b) for a, b in combinations(cells, 2))


@pytest.mark.parametrize(
    "cell",
    [
        ORDINARY,
        *(replace(ORDINARY, path=path, push=0.8) for path in LoadingPath),
        *(replace(ORDINARY, surface=surface, push=0.99) for surface in Surface),
        replace(ORDINARY, push=0.99999, poisson_ratio=0.0, base_ratio=0.0, modulus_ratio=1.0),
        replace(ORDINARY, push=1.0),
        replace(ORDINARY, length=1e-9),
        replace(ORDINARY, load=1e-5),
        replace(ORDINARY, friction=1e-6),
        replace(ORDINARY, modulus_ratio=1e3, thickness=0.01, poisson_ratio=0.5),
        replace(ORDINARY, modulus_ratio=1e-3, thickness=10.0),
        # Accepting Newton steps uphill for their residual went round in circles here,
        replace(HALF_SPACE, path=LoadingPath.APPROACH, friction=1.0, push=0.8, cells=32),
        # here cells let go one after the other below a film that lifts them,
        replace(ORDINARY, modulus_ratio=1e6, thickness=0.1, path=LoadingPath.PRESS, cells=32),
        # here it lifted them differently whenever the pressure was not solved for thoroughly,
        pytest.param(
            replace(ORDINARY, modulus_ratio=1e6, thickness=0.03, friction=1.0, push=0.95, cells=24),
            marks=pytest.mark.slow,
        ),
        # here the shear's preconditioner was not positive,
        pytest.param(
            replace(ORDINARY, modulus_ratio=1e3, thickness=0.003, poisson_ratio=0.5, cells=48),
            marks=pytest.mark.slow,
        ),
        # and friction that is strong leaves no way here but on springs: neither parts of Newton's
        # steps nor turns of pressure and shear come near, of whole increments.
        replace(SOFT_FILM, friction=5.0, push=0.5, cells=48),
        replace(STIFF_FILM, friction=5.0, push=0.9, cells=32),
        replace(STIFF_FILM, friction=5.0, push=0.99, thickness=1.0, cells=24),
    ],
    ids=lambda cell: cell.name,
)
def test_hard_cell_converges(cell: StabilityCell) -> None:
    record = judge_contact(cell)
    assert record.verdict is Verdict.CONVERGED, record.reason
    assert record.residual is not None
    assert record.residual <= record.tolerance <= 1e-7
    assert record.halvings == 0


def test_more_than_friction_carries_is_refused() -> None:
    record = judge_contact(replace(ORDINARY, push=1.001))
    assert record.verdict is Verdict.REFUSED
    assert record.refused_for is Refusal.FORCE


@pytest.mark.parametrize(
    ("error", "kind"),
    [
        (GrossSliding("in other words"), Refusal.FORCE),
        (UnsupportedScene("exceeds the friction limit"), Refusal.POSE),
        (ResourceRefused("exceeds the friction limit"), Refusal.OTHER),
        (SceneError([Problem(("loading", 1, "tangential_force"), "in words")]), Refusal.FORCE),
        (SceneError([Problem(("loading", 1, "normal_force"), "in words")]), Refusal.OTHER),
    ],
    ids=repr,
)
def test_what_a_cell_is_refused_for_does_not_hang_on_words(
    error: Exception, kind: Refusal, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(posed: Posed) -> SolvedContact:
        raise error

    monkeypatch.setitem(contacts.SOLVERS, ORDINARY.solver, refuse)
    if isinstance(error, SceneError):
        monkeypatch.setattr("verification.studies.stability.contacts.pose", refuse)
    assert judge_contact(ORDINARY).refused_for is kind


def test_scale_changes_nothing() -> None:
    records = [
        judge_contact(replace(ORDINARY, length=length, modulus=modulus))
        for length, modulus in ((1e-3, 210e9), (1e-9, 1e3), (1.0, 1e12))
    ]
    # Round-off may cost or save an iteration.
    spent = [r.convolutions for r in records]
    assert max(spent) - min(spent) <= 0.02 * max(spent)


def solved_cell() -> Result:
    posed = pose(replace(ORDINARY, path=LoadingPath.LOOP))
    return solve(posed.scene, posed.grid, posed.tolerance)


DEFECTS = {
    "tension": lambda i: {
        "pressure": np.where(i.pressure > 0, i.pressure, -1e-6 * i.peak_pressure)
    },
    "overlap": lambda i: {"gap": i.gap - 1e-6 * i.approach},
    "pressure across a gap": lambda i: {"gap": np.where(i.pressure > 0, 1e-6 * i.approach, i.gap)},
    "another normal force": lambda i: {"pressure": i.pressure * (1 + 1e-6)},
    "more shear than friction allows": lambda i: {"shear": i.shear * (1 + 1e-6)},
    "another tangential force": lambda i: {"tangential_force": i.tangential_force * (1 + 1e-6)},
    "slip along the shear": lambda i: {"slip": -i.slip},
    "slip aside": lambda i: {"slip": np.stack([-i.slip[1], i.slip[0]])},
    "energy won by friction": lambda i: {"dissipated_energy": -i.dissipated_energy},
    "not a number": lambda i: {"pressure": np.where(i.pressure > 0, np.nan, 0.0)},
}


@pytest.mark.parametrize("defect", DEFECTS)
def test_a_wrong_field_is_seen_in_the_fields_alone(defect: str) -> None:
    result = solved_cell()
    *others, last = result.increments
    wrong = replace(last, **DEFECTS[defect](last))
    assert observed(result).violation <= 1e-8
    assert observed(replace(result, increments=(*others, wrong))).violation > 2e-7


def test_an_answer_above_the_tolerance_is_silent_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    def careless(posed: Posed) -> SolvedContact:
        return by_superposition(replace(posed, tolerance=1e-4))

    monkeypatch.setitem(contacts.SOLVERS, ORDINARY.solver, careless)
    assert judge_contact(ORDINARY).verdict is Verdict.SILENT


def test_giving_up_is_recorded_with_its_residual(monkeypatch: pytest.MonkeyPatch) -> None:
    def helpless(posed: Posed) -> SolvedContact:
        raise NotConverged("the shear", 60, 1e-3, 1e-8)

    monkeypatch.setitem(contacts.SOLVERS, ORDINARY.solver, helpless)
    record = judge_contact(ORDINARY)
    assert record.verdict is Verdict.NOT_CONVERGED
    assert record.residual == 1e-3
    assert "NotConverged" in record.reason


def test_the_way_of_the_solver_is_told() -> None:
    ways = [
        judge_contact(replace(ORDINARY, **change)).way
        for change in (
            {},
            {"surface": Surface.ALIKE_BALL},
            {"surface": Surface.ALIKE_BALL, "path": LoadingPath.PRESS},
        )
    ]
    assert ways == ["pressure and shear together", "pressure, then shear", "pressure alone"]


def test_contact_that_outgrows_its_window_gets_a_larger_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    narrow = pose(ORDINARY)
    grid = replace(narrow.grid, window=tuple(0.7 * side for side in narrow.grid.window))
    assert len(by_superposition(replace(narrow, grid=grid)).result.increments) == 4


def kept(found: dict[str, CellRecord]) -> dict[str, CaseRecord]:
    """As runs leave them."""
    cells = {cell.name: cell for cell in study_cells(Level.QUICK, 32)}
    return {name: record.of_cell(cells[name]) for name, record in found.items()}


def test_a_record_comes_back_from_its_row() -> None:
    bad = CellRecord(verdict=Verdict.REFUSED, reason="GrossSliding: …", tolerance=1e-8)
    for record in (GOOD, bad):
        row = CaseRecord.model_validate_json(record.of_cell(ORDINARY).model_dump_json())
        assert CellRecord.of(row) == record
        assert row.parameters["surface"] == "ball"


def records() -> dict[str, CellRecord]:
    """Good records of all cells of the quick level."""
    found = {}
    for cell in study_cells(Level.QUICK, 32):
        kind = Refusal.FORCE if cell.posable else Refusal.POSE
        refused = cell.push > 1 or not cell.posable
        found[cell.name] = refusal(kind) if refused else GOOD
    return found


def refusal(kind: Refusal) -> CellRecord:
    return GOOD.model_copy(
        update={"verdict": Verdict.REFUSED, "refused_for": kind, "reason": "SomeError: too much"}
    )


def outcomes(found: dict[str, CellRecord]) -> list[Status | None]:
    return [s.outcome for s in study.conclude(Settings(Level.QUICK), kept(found)).statements]


EVERYTHING_GOOD = [Status.PASS] * 3 + [None]


@pytest.mark.parametrize("solver", Solver)
@pytest.mark.parametrize(
    ("verdict", "failing"),
    [(Verdict.SILENT, 0), (Verdict.NOT_CONVERGED, 1), (Verdict.REFUSED, 2)],
)
def test_bad_cells_fail_the_statement_of_their_solver_that_names_them(
    solver: Solver, verdict: Verdict, failing: int
) -> None:
    assert outcomes(records()) == EVERYTHING_GOOD * len(Solver)
    bad = GOOD.model_copy(update={"verdict": verdict, "reason": "because"})
    cells = [c for c in study_cells(Level.QUICK, 32) if c.solver is solver]
    names = [cell.name for cell in cells[:2]]
    conclusion = study.conclude(Settings(Level.QUICK), kept(records() | dict.fromkeys(names, bad)))
    judged_as = [s.outcome for s in conclusion.statements]
    failing += 4 * list(Solver).index(solver)
    assert judged_as[failing] is Status.FAIL
    assert judged_as.count(Status.FAIL) == 1
    assert all(name in conclusion.statements[failing].measured for name in names)
    given_up, silent = (2 * (verdict is kind) for kind in (Verdict.NOT_CONVERGED, Verdict.SILENT))
    assert f" {given_up} gave up and {silent} are wrong in silence." in conclusion.answer
    if verdict is not Verdict.REFUSED:
        listed = next(t for t in conclusion.tables if t.title.startswith("Not solved"))
        assert [row[0] for row in listed.rows] == names


@pytest.mark.parametrize(("share", "outcome"), [(1, Status.PASS), (2, Status.FAIL)])
def test_one_cell_in_a_hundred_may_give_up(share: int, outcome: Status) -> None:
    cells = [replace(ORDINARY, friction=0.001 * n) for n in range(100)]
    given_up = GOOD.model_copy(update={"verdict": Verdict.NOT_CONVERGED})
    found = dict.fromkeys(cells, GOOD) | dict.fromkeys(cells[:share], given_up)
    assert study.nearly_everything_converges(found).outcome is outcome


def test_a_refusal_for_another_reason_is_not_due() -> None:
    beyond = replace(ORDINARY, push=1.001)
    for kind in Refusal:
        outcome = Status.PASS if kind is Refusal.FORCE else Status.FAIL
        assert study.refusals_are_due({beyond: refusal(kind)}).outcome is outcome
        assert study.refusals_are_due({ORDINARY: refusal(kind)}).outcome is Status.FAIL


def test_missing_records_make_the_map_inconclusive_not_good() -> None:
    assert outcomes({}) == ([Status.INCONCLUSIVE] * 3 + [None]) * len(Solver)


def test_a_place_shows_the_worst_of_its_cells_and_the_dearest() -> None:
    view = views(Level.STANDARD, 32)[0]
    place = view.at(view.values(view.x)[0], view.values(view.y)[0])
    assert len(place) > 1
    found = {cell.name: GOOD for cell in view.cells}
    found[place[0].name] = GOOD.model_copy(update={"convolutions": 12_345})
    found[place[1].name] = GOOD.model_copy(update={"verdict": Verdict.NOT_CONVERGED})
    panel = view_chart(view, found).rows[0][0]
    at = {(c.label, x, y) for c in panel.curves for x, y in zip(c.x, c.y, strict=True)}
    assert ("not converged", 0.0, 0.0) in at
    assert sum((x, y) == (0.0, 0.0) for _, x, y in at) == 1
    assert (0.0, 0.0, "12k") in panel.notes
    assert {c.look for c in panel.curves} == {Look.TILES}
    assert len({c.series for c in panel.curves}) == len(panel.curves)


@pytest.mark.parametrize(
    ("stated", "seen", "name"),
    [
        (9e-11, 9e-10, "residual ≤ allowed / 100"),
        (9e-10, 0.0, "residual ≤ allowed / 10"),
        (9e-10, 2e-8, "residual ≤ allowed"),  # of the fields ten times as much is allowed
        (9e-9, 0.0, "residual ≤ allowed"),
    ],
)
def test_a_place_shows_the_decade_of_the_residual_over_what_is_allowed(
    stated: float, seen: float, name: str
) -> None:
    record = GOOD.model_copy(update={"residual": stated, "observed": seen})
    assert CLASSES[class_of(record)][0] == name


def test_every_way_to_end_is_worse_than_any_residual_and_looks_of_its_own() -> None:
    ends = (Verdict.CONVERGED, Verdict.REFUSED, Verdict.NOT_CONVERGED, Verdict.SILENT)
    bad = [GOOD.model_copy(update={"verdict": verdict, "residual": 1e-8}) for verdict in ends]
    assert [class_of(record) for record in bad] == [2, 3, 4, 5]
    looks = [look_of(curve("", [0], [0], Look.TILES, series)) for _, series in CLASSES]
    assert len({look["color"] for look in looks}) == len(CLASSES)
    assert len({look["marker"] for look in looks}) == len(CLASSES)
