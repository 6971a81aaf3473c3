"""The cross-check of all solvers: what it measures, and that it can fail."""

from dataclasses import replace
from itertools import combinations, product
from math import nan

import numpy as np
import pytest

import fem_reference
import semi_analytical
from contact_scene import IsotropicMaterial
from verification.cases.both_solvers.contacts import (
    FRICTIONS,
    RATIOS,
    THICKNESSES,
    CheckedContact,
)
from verification.cases.both_solvers.differences import Difference, differences
from verification.cases.both_solvers.left_out import (
    away_from_kinks,
    clear_of_axis,
    radii,
    width,
)
from verification.cases.both_solvers.sides import SIDES, Sides
from verification.cases.both_solvers.stress import stress_difference
from verification.cases.cross_check import CHOSEN, cross_check_on
from verification.judging.case import Level
from verification.judging.judgement import judge
from verification.judging.outcome import Status
from verification.judging.run import SectionRun
from verification.running.row import CaseRecord
from verification.running.row_files import row_files
from verification.running.study import Settings
from verification.studies.cross_check import STUDY, CrossCheckRun, PushedRun, timed

SMOOTH = CheckedContact(2.0, 1.0, 0.0)
ROUGH = CheckedContact(0.5, 1.0, 0.1)
QUICK = Settings(Level.QUICK)
NAME = CrossCheckRun(Sides(SMOOTH, 128, 64)).name


def changed(record: CaseRecord, **values: float) -> CaseRecord:
    """With some of its measures multiplied, in the row and over the radius."""

    def of(measures: dict[str, float | None]) -> dict[str, float | None]:
        return {name: value * values.get(name, 1.0) for name, value in measures.items()}

    parts = tuple(part.model_copy(update={"measures": of(part.measures)}) for part in record.parts)
    return record.model_copy(update={"measures": of(record.measures), "parts": parts})


@pytest.fixture(scope="module")
def record() -> CaseRecord:
    return CrossCheckRun(Sides(SMOOTH, 64, 32)).compute()


def test_all_solvers_agree_and_say_what_they_leave(record: CaseRecord) -> None:
    found = differences(record)
    assert set(found) == {"pressure", "approach"}
    for one in found.values():
        assert one.status is Status.PASS
        assert set(one.apart) == set(combinations(SIDES, 2))
        assert one.joint > 0
        assert one.to_reference is not None
        assert max(one.to_reference.values()) < one.required
        assert one.nearer == "radial"
        assert one.to_reference["radial"] < 1e-5


def test_a_record_comes_back_from_its_text(record: CaseRecord) -> None:
    assert CaseRecord.model_validate_json(record.model_dump_json()) == record


def test_the_matrix_has_every_contact_once() -> None:
    """A coating like its body is none, whatever its thickness."""
    cases = STUDY.cases(QUICK)
    asked = product(RATIOS, THICKNESSES, FRICTIONS)
    bodies = {(ratio, 0.0 if ratio == 1 else h, mu) for ratio, h, mu in asked}
    contacts = [c.sides.contact for c in cases if isinstance(c, CrossCheckRun)]
    assert [type(case) for case in cases[len(contacts) :]] == [PushedRun]
    solved = {(c.modulus_ratio, c.thickness if c.is_coated else 0.0, c.friction) for c in contacts}
    assert len({case.name for case in cases}) == len(cases) == 1 + len(bodies) == 49
    assert solved == bodies
    assert "48 scenes, 45 of them" in STUDY.question
    assert {contact for chosen in CHOSEN.values() for contact in chosen} <= set(contacts)


def test_an_agreement_within_poorer_own_errors_is_told(record: CaseRecord) -> None:
    own = ("own_pressure_cells", "own_pressure_elements")
    known = [record.measures[name] for name in own]
    for elements, told in ((1e-6, False), (0.5, True)):
        factors = dict(zip(own, (1e-6 / known[0], elements / known[1]), strict=True))
        conclusion = STUDY.conclude(QUICK, {NAME: changed(record, **factors)})
        (statement,) = (s for s in conclusion.statements if "agree: pressure" in s.claim)
        assert ("1 of them with own errors beyond it" in statement.measured) is told


def test_own_errors_decide_between_fail_and_inconclusive() -> None:
    small, large = 1e-4, 1e-2
    for apart, elements, status in (
        (0.9e-3, small, Status.PASS),
        (5e-3, large, Status.INCONCLUSIVE),
        (5e-3, small, Status.FAIL),
        (nan, large, Status.FAIL),
    ):
        own = {"cells": small, "elements": elements, "radial": small}
        beside = {("cells", "radial"): 0.0, ("elements", "radial"): 0.0}
        one = Difference({("cells", "elements"): apart, **beside}, 1e-3, own, None)
        assert one.status is status


def test_of_three_the_one_that_two_leave_alone_is_odd() -> None:
    own = dict.fromkeys(SIDES, 0.1)
    apart = dict(zip(combinations(SIDES, 2), (0.5, 0.2, 0.4), strict=True))
    one = Difference(apart, 1.0, own, {"cells": 2.0, "elements": 1.0, "radial": 3.0})
    assert (one.odd, one.nearer, one.furthest) == ("elements", "elements", ("cells", "elements"))
    assert not one.is_explained
    assert one.explains(("cells", "radial"))


def test_study_concludes_from_the_records_there_are(record: CaseRecord) -> None:
    conclusion = STUDY.conclude(QUICK, {NAME: record})
    by_claim = {statement.claim: statement for statement in conclusion.statements}
    agree = by_claim["the solvers agree: pressure, r < 0.9 a, over p₀"]
    assert agree.outcome is Status.PASS
    assert "1 of 1 contacts" in agree.measured
    # One of 48 is no verdict on all.
    assert by_claim["every increment converged"].outcome is Status.INCONCLUSIVE
    assert {chart.name for chart in conclusion.charts} == {
        f"{name}_{side}_differences"
        for name in ("pressure", "shear")
        for side in ("cells", "elements")
    }
    assert all(len(chart.rows) == len(RATIOS) for chart in conclusion.charts)
    assert len(row_files({NAME: record})["parts.csv"].splitlines()) == 1 + len(record.parts)


def test_the_answer_has_differences_and_both_distances_to_the_reference(
    record: CaseRecord,
) -> None:
    found = differences(record)["approach"]
    answer = STUDY.conclude(QUICK, {NAME: record}).answer
    assert "On 1 contacts" in answer
    assert f"{100 * found.value:.2g} % in approach (E1/E2 = 2, h = 1 a_H, µ = 0" in answer
    assert found.to_reference is not None
    for side in ("cells", "elements"):
        assert f"{side} at most {100 * found.to_reference[side]:.2g} % off" in answer
    assert answer.endswith("elements on 0, radial on 1).")
    assert "everywhere within what is asked" in answer
    assert "with 56 cells and 64 elements per contact radius" in answer
    assert STUDY.conclude(QUICK, {}).answer == ""


def test_contacts_beyond_what_is_required_are_named(record: CaseRecord) -> None:
    conclusion = STUDY.conclude(QUICK, {NAME: changed(record, approach_cells=1.002)})
    (statement,) = (s for s in conclusion.statements if "agree: approach" in s.claim)
    assert "beyond it: E1/E2 = 2, h = 1 a_H, µ = 0: 0.00" in statement.measured
    assert "beyond what is asked in 1 of 2 comparisons" in conclusion.answer


def test_what_is_left_out_of_the_shear_is_told(record: CaseRecord) -> None:
    shear = [0.0] * len(record.parts)
    shear[3], shear[5] = 0.7, 0.2
    parts = tuple(
        part.model_copy(
            update={
                "parameters": part.parameters | {"shear_judged": n not in (3, 4)},
                "measures": part.measures
                | {"shear_cells": shear[n], "shear_elements": 0.0, "shear_radial": 0.0},
            }
        )
        for n, part in enumerate(record.parts)
    )
    rubbed = CrossCheckRun(Sides(replace(SMOOTH, friction=0.1), 128, 64)).name
    parameters = record.parameters | {"friction": 0.1}
    conclusion = STUDY.conclude(
        QUICK, {rubbed: record.model_copy(update={"parts": parts, "parameters": parameters})}
    )
    (told,) = (s for s in conclusion.statements if "where it is not judged" in s.claim)
    assert told.measured.startswith("at most 0.7 of µp₀ (E1/E2 = 2")
    assert "cells and elements" in told.measured
    assert "away from the axis and from the kinks of the shear" in conclusion.answer


@pytest.mark.parametrize("wrong", ["pressure", "shear", "approach"])
def test_a_side_that_is_wrong_fails(record: CaseRecord, wrong: str) -> None:
    if wrong == "shear":
        parts = tuple(
            part.model_copy(update={"measures": part.measures | {"shear_cells": 1.0}})
            for part in record.parts
        )
        parameters = record.parameters | {"friction": 0.1}
        off = record.model_copy(update={"parts": parts, "parameters": parameters})
    else:
        off = changed(record, pressure_cells=1.03, approach_cells=1.002)
    conclusion = STUDY.conclude(QUICK, {NAME: off})
    (statement,) = (s for s in conclusion.statements if f"agree: {wrong}" in s.claim)
    assert statement.outcome is Status.FAIL


def test_what_every_solver_took_is_told_over_the_radial_one(record: CaseRecord) -> None:
    found = {
        NAME: record.model_copy(update={"clock": {"cells": 3.0, "elements": 8.0, "radial": 2.0}})
    }
    conclusion = timed(QUICK, found)
    ((*_, ratio),) = conclusion.tables[0].rows
    assert ratio == "1 : 1.5 : 4"
    assert "1 : 1.5 : 4 (µ = 0, 2 s)" in conclusion.answer
    assert set(record.clock) == set(SIDES)
    assert min(record.clock.values()) > 0


def test_a_number_that_is_none_is_not_passed_over(record: CaseRecord) -> None:
    for lost in ("approach_cells", "own_pressure_cells"):
        bad = record.model_copy(update={"measures": record.measures | {lost: None}})
        (name,) = (name for name in differences(record) if name in lost)
        assert not differences(bad)[name].is_explained
    part = record.parts[2].model_copy(
        update={"measures": record.parts[2].measures | {"pressure_cells": None}}
    )
    bad = record.model_copy(update={"parts": (*record.parts[:2], part, *record.parts[3:])})
    assert differences(bad)["pressure"].status is Status.FAIL


def test_profiles_of_both_solvers_are_at_the_same_radii() -> None:
    at = radii(8, 32)
    on_cells = ROUGH.on_grid(semi_analytical.solve(ROUGH.scene, ROUGH.grid(32), 1e-8), at)
    on_rings = ROUGH.on_rings(fem_reference.solve(ROUGH.scene, ROUGH.mesh(16)), at)
    np.testing.assert_allclose(on_cells.pressure, on_rings.pressure, atol=0.05)
    np.testing.assert_allclose(on_cells.shear, on_rings.shear, atol=0.1)
    with pytest.raises(ValueError, match="rings"):
        ROUGH.on_rings(fem_reference.solve(ROUGH.scene, ROUGH.mesh(16)), at + 0.01)


def test_the_edges_of_stick_are_not_judged() -> None:
    at = radii(32, 64)
    kept = away_from_kinks(at, (0.25, 0.5), width(64, 32))
    for edge in (0.25, 0.5):
        assert not kept[np.argmin(np.abs(at - edge))]
    assert kept[0]
    assert kept[-1]


@pytest.mark.parametrize("edges", [(0.0, 0.3), (1 / 64, 0.3), (1 / 64,)])
def test_two_elements_are_left_out_where_stick_ends_at_the_axis(edges: tuple[float, ...]) -> None:
    rings = np.arange(2, 58) / 64
    np.testing.assert_array_equal(clear_of_axis(rings, edges, width(256, 64)), rings[1:])


def test_all_is_judged_where_stick_ends_off_the_axis() -> None:
    rings = np.arange(2, 58) / 64
    for edges in ((), (0.3,), (1.1 / 64, 0.3)):
        np.testing.assert_array_equal(clear_of_axis(rings, edges, width(256, 64)), rings)


@pytest.mark.slow
def test_where_stick_came_back_to_the_axis_two_elements_off_it_errs_alike_on_every_mesh() -> None:
    contact = CheckedContact(10.0, 0.25, 0.3)
    ends = {n: fem_reference.solve(contact.scene, contact.mesh(n)).steps[-1] for n in (16, 32, 64)}
    fine = ends.pop(64)
    for end in ends.values():
        two, three = (end.pressure - np.interp(end.radii, fine.radii, fine.pressure))[2:4]
        assert abs(two / contact.peak_pressure) == pytest.approx(4.5e-3, rel=0.15)
        assert abs(three / contact.peak_pressure) < 5e-4


def stiffer_film(run: object) -> object:
    """The run of elements with a coating of 1.02 times the modulus; that of cells as it is."""
    if not isinstance(run, SectionRun):
        return run.solve()  # type: ignore[arg-type]
    body = run.scene.body
    (layer,) = body.layers
    E, nu = layer.material.young_modulus, layer.material.poisson_ratio
    material = IsotropicMaterial(young_modulus=1.02 * E, poisson_ratio=nu)
    other = body.model_copy(update={"layers": (layer.model_copy(update={"material": material}),)})
    return replace(run, scene=run.scene.model_copy(update={"body": other})).solve()


@pytest.mark.slow
@pytest.mark.parametrize("broken", [False, True], ids=["same bodies", "another coating"])
def test_case_tells_bodies_apart(broken: bool) -> None:
    case = cross_check_on((Sides(SMOOTH, 96, 64),))
    outcome = judge(case, stiffer_film) if broken else judge(case)
    failed = {verdict.name for verdict in outcome.verdicts if verdict.status is Status.FAIL}
    expected = {"approach_difference", "pressure_difference", "stress_difference"}
    assert failed == (expected if broken else set())
    assert {chart.name for chart in outcome.charts} == {
        "cross_check_profiles",
        "cross_check_stress",
    }


@pytest.mark.slow
def test_stress_of_other_tractions_differs() -> None:
    one = semi_analytical.solve(SMOOTH.scene, SMOOTH.grid(48), 1e-8)
    other = fem_reference.solve(SMOOTH.scene, SMOOTH.mesh(16))
    assert stress_difference(SMOOTH, one, other) < 0.02
    weaker = replace(
        other,
        increments=tuple(replace(i, pressure=0.9 * i.pressure) for i in other.increments),
    )
    assert stress_difference(SMOOTH, one, weaker) > 0.05
