"""Profiles of a report: both solvers with their reference, and strips of what is judged."""

from collections.abc import Mapping
from functools import cache

import numpy as np
import pytest
from report_examples import case, report_of, run_record

from verification.cases.coatings import coated_paraboloid, fem_coated
from verification.cases.fretting import fem_partial_slip
from verification.cases.hertz import fem_hertz, hertz_point
from verification.cases.partial_slip import cattaneo_mindlin
from verification.exhibits.chart import Chart, Curve, Look
from verification.judging.case import Case
from verification.references import load_reference
from verification.report.profiles_together import NEAR, SAME, profiles_together
from verification.running.report_record import Report

CELLS, ELEMENTS = 32, 8


def profiles_of(one: Case) -> tuple[Chart, ...]:
    """The charts that a case makes, without its verdicts."""
    assert one.charts is not None
    return one.charts({run.label: run.solve() for run in one.runs})


@cache
def solved() -> Mapping[str, tuple[Chart, ...]]:
    """Charts of the cases that SAME names, on coarse grids."""
    coated = [
        row for row in load_reference("coated_frictionless_paraboloid")["rows"]
        if (row["E1_over_E2"], row["h_over_aH"]) == (2, 1)
    ]  # fmt: skip
    cases = (
        hertz_point(cells=(CELLS,)), fem_hertz(elements=(ELEMENTS,)),
        coated_paraboloid(cells=(CELLS,), required=()),
        fem_coated(rows=coated, elements=(ELEMENTS,)),
        cattaneo_mindlin(cells=(CELLS,)), fem_partial_slip(elements=ELEMENTS, studied=()),
    )  # fmt: skip
    return {one.name: profiles_of(one) for one in cases}


def report(*left_out: str) -> Report:
    cases = [
        case(name, {}, run_record(CELLS, None)).model_copy(update={"charts": charts})
        for name, charts in solved().items()
        if name not in left_out
    ]
    return report_of(tuple(cases))


def look(chart: Chart, row: int, look: Look = Look.COMPUTED) -> list[Curve]:
    return [one for one in chart.rows[row][0].curves if one.look is look]


def test_every_profile_is_drawn_by_both_solvers_over_one_reference() -> None:
    charts = profiles_together(report())
    assert [chart.name for chart in charts] == [f"together_{same.name}" for same in SAME]
    for chart in charts:
        (reference,) = look(chart, 0, Look.REFERENCE)
        assert [one.label for one in look(chart, 0)] == ["cells (SAM)", "finite elements"]
        for one in look(chart, 0):
            inside = np.array(one.x) < 1 - 2 * NEAR
            known = np.interp(one.x, reference.x, reference.y)
            # Coarse as they are, both are on the reference that is drawn.
            assert np.max(np.abs(np.array(one.y) - known)[inside]) < 0.1 * max(reference.y)


def test_strips_are_the_differences_of_the_cases_and_leave_edges_to_the_first() -> None:
    for chart, same in zip(profiles_together(report()), SAME, strict=True):
        for series in (0, 1):
            (whole,) = (one for one in look(chart, 1) if one.series == series)
            parts = [one for one in look(chart, 2) if one.series == series]
            assert len(parts) == len(same.edges)
            all_of_it = dict(zip(whole.x, whole.y, strict=True))
            for part in parts:
                away = min(abs(x - edge) for x in part.x for edge in same.edges)
                assert away >= NEAR - 1e-9
                assert part.y == pytest.approx([1e3 * all_of_it[x] for x in part.x], rel=1e-5)


@pytest.mark.parametrize("missing", ["fem_hertz", "hertz_point"])
def test_a_profile_of_one_solver_alone_is_not_shown_together(missing: str) -> None:
    names = [chart.name for chart in profiles_together(report(missing))]
    assert names == ["together_coated", "together_cattaneo_mindlin"]
