"""The verdict of the gross-sliding study on histories whose answer is known beforehand."""

from dataclasses import replace

import numpy as np
import pytest

from contact_scene.summary import ContactStatus
from verification.exhibits.chart import Curve, Look
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.report import drawing
from verification.running.row import CaseRecord
from verification.running.study import Settings
from verification.studies.sliding import gross_sliding as study
from verification.studies.sliding import verdicts
from verification.studies.sliding.contacts import AlikeContact, CoatedContact
from verification.studies.sliding.estimate import Estimate, estimate
from verification.studies.sliding.friction_laws import (
    FixedPressure,
    FrictionLaw,
    at_rest,
    shifted,
)
from verification.studies.sliding.full_slip import FullSlip, full_slip
from verification.studies.sliding.law_run import LawRun
from verification.studies.sliding.path import PRESSING, SlidingPath, SlidingPoint, record_of
from verification.studies.sliding.runs import ShiftRun, Steps
from verification.studies.sliding.verdicts import Variant

PER_RADIUS = 1 / 50


def cattaneo(
    vanishing: float = 1.0,
    cell: float = PER_RADIUS,
    largest: float = 1.0,
    angle: float = 1e-6,
    increments: int = 91,
) -> SlidingPath:
    """Stick area falls linearly in the shift to zero at a force, which then grows to `largest`."""
    points = []
    for shift in np.linspace(0, 3, increments):
        part = max(0.0, 1 - shift)
        force = vanishing * (1 - part**1.5)
        if shift > 1:
            force += (largest - vanishing) * (1 - np.exp(-8 * (shift - 1)))
        sticking = round(part * np.pi / cell**2)
        points.append(
            SlidingPoint(
                step=PRESSING + bool(points), shift=float(shift), force=float(force),
                stick_fraction=float(part), stick_cells=sticking, mean_cosine=float(force),
                full_slip=sticking == 0, status=_status(sticking, force), slip_angle=angle,
                largest_slip_angle=angle, largest_residual=1e-9,
            )
        )  # fmt: skip
    return SlidingPath(points=tuple(points), cell_over_radius=cell)


def kept(path: SlidingPath) -> CaseRecord:
    """As a run leaves it."""
    rows = [point.row() for point in path.points]
    run = AlikeContact(0.0)
    return record_of(run, rows, path.cell_over_radius, {"increments": len(rows)})


def _status(sticking: int, force: float) -> ContactStatus:
    if sticking:
        return ContactStatus.PARTIAL_SLIP
    return ContactStatus.GROSS_SLIDING if force > 1 - 1e-6 else ContactStatus.NO_STICK_AREA_LEFT


def changed(path: SlidingPath, number: int, **values: object) -> SlidingPath:
    points = list(path.points)
    points[number] = points[number].model_copy(update=values)
    return path.model_copy(update={"points": tuple(points)})


def found(force: float, bar: float = 0.005) -> Estimate:
    return Estimate(FullSlip(force, 1e-6, bar), 0.0, 0.0, 0.0)


@pytest.mark.parametrize("increments", [85, 91, 97, 110, 128, 160])
def test_coarse_increments_do_not_cut_the_corner_at_full_slip(increments: int) -> None:
    """Identical bodies stick until µW exactly, wherever the increments fall beside that corner."""
    fs = full_slip(cattaneo(increments=increments))
    assert fs is not None
    assert abs(fs.force - 1) <= min(fs.uncertainty, 1e-4)


def line_of(drawn: Curve) -> str:
    """Dashes and marks, as they are drawn."""
    look = drawing.look_of(drawn)
    return f"{look.get('linestyle', '-')} {look.get('marker')}"


@pytest.mark.parametrize("vanishing", [1.0, 0.97, 0.76])
def test_full_slip_is_found_within_its_bar(vanishing: float) -> None:
    fs = full_slip(cattaneo(vanishing))
    assert fs is not None
    assert fs.force == pytest.approx(vanishing, abs=max(fs.uncertainty, 1e-3))
    assert fs.uncertainty < 0.01
    assert fs.shift == pytest.approx(1.0, abs=0.01)


def test_bar_grows_with_the_cells() -> None:
    fine, coarse = full_slip(cattaneo(0.9, cell=0.01)), full_slip(cattaneo(0.9, cell=0.05))
    assert fine is not None
    assert coarse is not None
    assert coarse.uncertainty > 2 * fine.uncertainty


def test_path_that_never_slips_all_over_has_no_full_slip() -> None:
    path = cattaneo()
    assert full_slip(path.model_copy(update={"points": path.points[:20]})) is None


def test_zone_that_leaves_as_a_whole_is_bracketed() -> None:
    path = cattaneo(0.9)
    points = [
        p.model_copy(update={"stick_fraction": 0.002 if p.shift < 0.95 else 0.0,
                             "full_slip": p.shift >= 0.95})
        for p in path.points
    ]  # fmt: skip
    fs = full_slip(path.model_copy(update={"points": tuple(points)}))
    assert fs is not None
    assert 28 / 30 < fs.shift < 29 / 30
    ends = [p.force for p in points[28:30]]
    assert fs.uncertainty == pytest.approx((ends[1] - ends[0]) / 2)


def test_estimate_adds_what_refinement_changed() -> None:
    base = cattaneo(0.97)
    same = estimate(base, base, base, base)
    other = estimate(base, cattaneo(0.95), base, base)
    assert same is not None
    assert other is not None
    assert same.uncertainty == pytest.approx(same.full_slip.uncertainty)
    assert other.uncertainty >= 0.015


def test_limit_that_is_reached_passes_and_a_lower_one_fails() -> None:
    assert verdicts.limit_is_reached({"a": cattaneo(0.97)}).outcome is Status.PASS
    short = {"a": cattaneo(0.97), "b": cattaneo(0.7, largest=0.76)}
    assert verdicts.limit_is_reached(short).outcome is Status.FAIL
    above = changed(cattaneo(0.97), 60, force=1.001)
    assert verdicts.limit_is_reached({"a": above}).outcome is Status.FAIL
    assert verdicts.limit_is_reached({}).outcome is Status.INCONCLUSIVE


def test_identity_and_direction_are_judged_in_every_increment() -> None:
    path = cattaneo(0.97)
    assert verdicts.force_is_mean_cosine({"a": path}).outcome is Status.PASS
    assert verdicts.slip_opposes_shear({"a": path}).outcome is Status.PASS
    off = changed(path, 50, mean_cosine=path.points[50].force - 1e-6)
    assert verdicts.force_is_mean_cosine({"a": off}).outcome is Status.FAIL
    turned = changed(path, 10, slip_angle=5.0)
    assert verdicts.slip_opposes_shear({"a": turned}).outcome is Status.FAIL
    loose = changed(path, 10, largest_residual=1e-6)
    assert verdicts.all_converged([kept(path), kept(loose)]).outcome is Status.FAIL


def test_null_test_fails_if_identical_bodies_slide_early() -> None:
    exact, early = full_slip(cattaneo(1.0)), full_slip(cattaneo(0.9))
    assert exact is not None
    assert verdicts.null_tests(exact, exact).outcome is Status.PASS
    assert verdicts.null_tests(early, exact).outcome is Status.FAIL
    assert verdicts.null_tests(exact, early).outcome is Status.FAIL
    assert verdicts.null_tests(None, exact).outcome is Status.INCONCLUSIVE


def test_coated_contact_must_stick_until_the_limit_without_coupling() -> None:
    def left_out(vanishing: FullSlip | None) -> Variant:
        return Variant("coupling left out", "coupling left out", 64, vanishing, 1.0)

    near, early = full_slip(cattaneo(0.999)), full_slip(cattaneo(0.9))
    assert verdicts.uncoupled_sticks({"a": left_out(near)}).outcome is Status.PASS
    assert verdicts.uncoupled_sticks({"a": left_out(early)}).outcome is Status.FAIL
    assert verdicts.uncoupled_sticks({"a": left_out(None)}).outcome is Status.INCONCLUSIVE
    assert verdicts.uncoupled_sticks({}).outcome is Status.INCONCLUSIVE


def test_answer_follows_the_largest_force() -> None:
    assert verdicts.answer(cattaneo(0.97), found(0.97)).startswith("No:")
    assert not verdicts.answer(cattaneo(0.7, largest=0.76), found(0.7)).startswith("No")
    assert verdicts.answer(None, None) == ""


def test_coarse_numerics_fail_rather_than_decide() -> None:
    assert verdicts.refinement_agrees({"a": found(0.97)}).outcome is Status.PASS
    assert verdicts.refinement_agrees({"a": found(0.97, bar=0.1)}).outcome is Status.FAIL


def test_finding_names_the_variants_near_the_papers_number() -> None:
    near = Variant("spot", "spot", 64, FullSlip(0.78, 1e-6, 0.005), 0.99)
    finer = replace(near, name="spot, fine", cells=128, vanishing=FullSlip(0.84, 1e-6, 0.005))
    far = Variant("frozen", "frozen", 64, FullSlip(0.66, 1e-6, 0.005), 0.66)
    statement = verdicts.paper_number(found(0.975), [near, far])
    assert statement.outcome is None
    assert "0.975 ± 0.005" in statement.measured
    assert "come near 0.76: spot" in statement.measured
    assert "frozen" not in statement.measured
    assert "not confirmed" not in statement.measured
    assert "not confirmed" in verdicts.paper_number(found(0.975), [near, finer]).measured
    assert "none of 1 variants" in verdicts.paper_number(found(0.975), [far]).measured
    capped = replace(far, vanishing=None, largest=0.77)
    assert "frozen" in verdicts.paper_number(found(0.975), [capped]).measured


@pytest.mark.parametrize("vanishing", [1.0, 0.9])
def test_a_path_comes_back_from_its_record(vanishing: float) -> None:
    path = cattaneo(vanishing)
    record = CaseRecord.model_validate_json(kept(path).model_dump_json())
    assert SlidingPath.of(record) == path


def test_a_residual_of_the_pressing_counts_too() -> None:
    pressing = cattaneo().points[0].model_copy(update={"largest_residual": 1e-6}).row()
    record = kept(cattaneo())
    rows = (pressing, *record.parts)
    whole = record_of(AlikeContact(0.0), rows, PER_RADIUS, record.counters)
    assert SlidingPath.of(whole) == cattaneo()
    assert verdicts.all_converged([whole]).outcome is Status.FAIL


def test_missing_records_make_the_study_inconclusive_not_wrong() -> None:
    conclusion = study.conclude(Settings(Level.QUICK), {})
    outcomes = {s.outcome for s in conclusion.statements if s.outcome is not None}
    assert outcomes == {Status.INCONCLUSIVE}
    assert conclusion.charts == ()


@pytest.mark.parametrize("level", list(Level))
def test_no_two_curves_of_a_panel_look_alike(level: Level) -> None:
    """A reader without colours tells every reading of the law by its dashes, none of which is that
    of the paper's number."""
    settings = Settings(level)
    records = {case.name: kept(cattaneo(0.97)) for case in study.cases(settings)}
    charts = {chart.name: chart for chart in study.conclude(settings, records).charts}
    for name in ("friction_law_variants", "force_against_shift"):
        for (panel,) in charts[name].rows:
            drawn = [line_of(curve) for curve in panel.curves if curve.look is not Look.MARKS]
            assert len(set(drawn)) == len(drawn) > 2


def test_cases_of_a_level_have_names_of_their_own() -> None:
    for level in Level:
        names = [case.name for case in study.cases(Settings(level))]
        assert len(set(names)) == len(names)


def test_projected_gradients_agree_with_the_product_where_pressure_stays() -> None:
    contact, steps = AlikeContact(0.3), Steps(1, 6, 2)
    product = SlidingPath.of(ShiftRun(contact, 24, steps).compute())
    other = SlidingPath.of(LawRun(contact, 24, steps, FrictionLaw.VECTOR).compute())
    assert [p.shift for p in other.points] == pytest.approx([p.shift for p in product.points])
    forces = [p.force for p in product.points]
    assert [p.force for p in other.points] == pytest.approx(forces, abs=1e-6)


def test_coated_contact_slides_at_the_limit_with_slip_against_shear() -> None:
    path = SlidingPath.of(ShiftRun(CoatedContact(2.0), 24, Steps(5, 6, 2)).compute())
    assert verdicts.limit_is_reached({"a": path}).outcome is Status.PASS
    assert verdicts.force_is_mean_cosine({"a": path}).outcome is Status.PASS
    assert verdicts.slip_opposes_shear({"a": path}).outcome is Status.PASS


# One cell whose displacement is its own shear: every reading of the law can be done by hand.
def single(q_x: float, q_y: float, bound: float) -> tuple[FixedPressure, np.ndarray]:
    problem = FixedPressure.of(lambda q: q, np.full((1, 1), bound), 1.0)
    return problem, np.array([q_x, q_y]).reshape(2, 1, 1)


EXPECTED = {
    FrictionLaw.VECTOR: np.array([1.5, 0.8]) / np.hypot(1.5, 0.8),
    FrictionLaw.COMPONENT_WISE: np.array([1.0, 0.8]),
    FrictionLaw.FROZEN_TRANSVERSE: np.array([0.6, 0.8]),
}


@pytest.mark.parametrize("law", EXPECTED)
def test_reading_of_the_law_on_one_cell(law: FrictionLaw) -> None:
    problem, q = single(0.5, 0.8, 1.0)
    after = shifted(problem, law, at_rest(problem, q), 1.0)
    assert after.shear.ravel() == pytest.approx(EXPECTED[law], abs=1e-6)
    assert not after.in_stick.any()
    small = shifted(problem, law, at_rest(problem, q), 0.01)
    assert small.in_stick.all()


def test_frozen_direction_stays_until_the_slip_would_turn_back() -> None:
    problem, q = single(0.6, 0.8, 1.0)
    slipped = at_rest(problem, q)
    on = shifted(problem, FrictionLaw.FROZEN_DIRECTIONS, slipped, 0.5)
    assert on.shear.ravel() == pytest.approx([0.6, 0.8])
    back = shifted(problem, FrictionLaw.FROZEN_DIRECTIONS, slipped, -0.5)
    assert back.shear.ravel() == pytest.approx([0.1, 0.8], abs=1e-6)
    assert back.in_stick.all()
