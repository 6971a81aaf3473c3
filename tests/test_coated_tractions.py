"""Tests of the study of figures 3 and 4 of the paper: agreement of two solvers within their
errors."""

import numpy as np
import pytest

from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.running.study import CaseRecord, Conclusion, Row, Settings
from verification.studies.coated_tractions import (
    CELLS,
    FORCES,
    SHOWN,
    cases,
    conclude,
    runs,
)

SETTINGS = Settings(Level.QUICK)


def planted(off: float) -> dict[str, CaseRecord]:
    """Records with coarse solves 1e-3 off, and all solves of the cells off by a part."""
    records = {}
    for (_, solver, kind), run in runs(SETTINGS).items():
        factor = (1.0 if kind == "fine" else 1.001) * (1 + off * (solver == CELLS))
        p, q = np.maximum(1 - SHOWN**2, 0), SHOWN * np.maximum(1 - SHOWN**2, 0)
        records[run.name] = CaseRecord(
            measures={"largest_residual": 1e-10, "stick_fraction": 0.05},
            parts=tuple(
                Row(
                    parameters={"T_over_muW": force, "x_over_aH": x},
                    measures={"p": factor * p_, "q": factor * q_},
                )
                for force in FORCES
                for x, p_, q_ in zip(SHOWN.tolist(), p.tolist(), q.tolist(), strict=True)
            ),
        )
    return records


def outcome(concluded: Conclusion, claim: str) -> Status | None:
    (found,) = (one.outcome for one in concluded.statements if claim in one.claim)
    return found


@pytest.mark.parametrize(("off", "status"), [(1e-4, Status.PASS), (0.1, Status.FAIL)])
def test_a_difference_beyond_the_errors_fails(off: float, status: Status) -> None:
    concluded = conclude(SETTINGS, planted(off))
    assert outcome(concluded, "agree within the stated errors") is status
    assert outcome(concluded, "self-equilibrating") is Status.PASS
    assert [chart.name for chart in concluded.charts] == ["figure_3_pressure", "figure_4_shear"]
    assert len(concluded.rows) == 8


def test_the_legend_names_the_forces_and_the_second_solver_once() -> None:
    for chart in conclude(SETTINGS, planted(0.0)).charts:
        (_, second), *_ = chart.rows
        names = [curve.label for curve in second.curves if curve.label]
        assert names == ["radial solver", "T = 0", "T = 0.3 µW", "T = 0.6 µW", "T = 0.9 µW"]


def test_a_missing_contact_leaves_the_verdicts_open() -> None:
    records = planted(0.0)
    lost = {name: one for name, one in records.items() if f"{CELLS}-4-" not in name}
    concluded = conclude(SETTINGS, lost)
    assert outcome(concluded, "agree within the stated errors") is Status.INCONCLUSIVE
    assert outcome(concluded, "every contact is solved") is Status.FAIL


def test_shear_with_a_resultant_is_seen() -> None:
    records = planted(0.0)
    for run in cases(SETTINGS):
        one = records[run.name]
        parts = [
            row.model_copy(update={"measures": {**row.measures, "q": 0.1}}) for row in one.parts
        ]
        records[run.name] = one.model_copy(update={"parts": tuple(parts)})
    assert outcome(conclude(SETTINGS, records), "self-equilibrating") is Status.FAIL


@pytest.mark.parametrize(
    ("residual", "status"),
    [(1e-8, Status.PASS), (2e-8, Status.FAIL), (None, Status.FAIL)],  # None: not finite
)
def test_the_worst_residual_decides(residual: float | None, status: Status) -> None:
    records = planted(0.0)
    name = runs(SETTINGS)[2.0, CELLS, "fine"].name
    measures = {**records[name].measures, "largest_residual": residual}
    records[name] = records[name].model_copy(update={"measures": measures})
    assert outcome(conclude(SETTINGS, records), "every increment converged") is status
