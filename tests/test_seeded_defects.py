"""The harness sees what is broken, passes what is whole, and leaves no defect behind."""

from types import FunctionType
from typing import Any

import pytest

from semi_analytical.influence.layered_response import Components
from verification.cases.catalogue import CASES
from verification.defects.defect import planted, product_modules
from verification.defects.healthy_contacts import FAMILIES, THIN
from verification.defects.outputs import PLANTED
from verification.defects.registry import DEFECTS
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.running import case_pool as case_store
from verification.running.study import CaseRecord, Settings
from verification.studies.seeded_defects.runs import (
    ERROR,
    HEALTHY,
    Caught,
    DefectRun,
    HealthyRun,
    Sample,
    caught,
    samples,
)
from verification.studies.seeded_defects.study import (
    STUDY,
    caught_by_reference,
    defect_runs,
    healthy_runs,
    passes_gate,
    seen,
)

QUICK = Settings(Level.QUICK)
# Cases that take a fraction of a second.
FAST = (
    "dissimilar_bodies",
    "exchanged_bodies",
    "fem_far_field",
    "hertz_approach_control",
    "layered_reference",
    "led_histories",
    "near_sliding",
    "subsurface_stress",
    "tilted_punch",
    "worked_examples",
    "written_files",
)
FAST_RUNS = [
    DefectRun(defect.name, case)
    for defect in DEFECTS.values()
    if (case := next((case for case in defect.cases if case in FAST), None))
]
Runs = dict[str, CaseRecord]


def namespaces() -> dict[tuple[str, str], Any]:
    """What every name of the product stands for: of its modules, and of their classes."""
    found: dict[tuple[str, str], Any] = {}
    for module in (*product_modules(), case_store):
        for name, value in vars(module).items():
            if isinstance(value, type) and value.__module__ == module.__name__:
                place = f"{module.__name__}.{name}"
                found |= {(place, inner): held for inner, held in vars(value).items()}
            if isinstance(value, type | FunctionType | Components):
                found[module.__name__, name] = value
    return found


def different(one: dict[tuple[str, str], Any], other: dict[tuple[str, str], Any]) -> set[Any]:
    return {key for key in one | other if one.get(key) is not other.get(key)}


def test_defects_are_many_and_name_cases_of_the_catalogue() -> None:
    known = set(CASES)
    assert len(DEFECTS) >= 22
    for defect in DEFECTS.values():
        assert defect.cases
        assert set(defect.cases) <= known
        assert defect.broken.endswith(".")


@pytest.fixture(scope="module")
def left() -> list[dict[tuple[str, str], Any]]:
    """What names stood for when the last defect had been taken out."""
    return [namespaces()]


@pytest.mark.parametrize("name", DEFECTS)
def test_defect_changes_something_and_leaves_nothing_behind(
    name: str, left: list[dict[tuple[str, str], Any]]
) -> None:
    with planted(DEFECTS[name]):
        during = namespaces()
    after, before = namespaces(), left.pop()
    left.append(after)
    assert different(before, during)
    assert not different(before, {key: after[key] for key in before})


def test_defect_is_taken_out_when_something_goes_wrong_under_it() -> None:
    before = namespaces()
    with pytest.raises(ArithmeticError), planted(DEFECTS["normal-bias"]):
        raise ArithmeticError
    assert not different(before, namespaces())


@pytest.mark.parametrize("case", FAST)
def test_healthy_solvers_pass(case: str) -> None:
    assert caught(DefectRun(HEALTHY, case).compute()) == ()


@pytest.mark.parametrize("run", FAST_RUNS, ids=lambda run: run.name)
def test_defect_is_caught(run: DefectRun) -> None:
    assert caught(run.compute())


@pytest.mark.parametrize("defect", PLANTED, ids=lambda defect: defect.name)
def test_planted_error_fails_where_a_fixed_gate_passes_it(defect: Any) -> None:
    record = DefectRun(defect.name, "hertz_point").compute()
    assert caught_by_reference(record)
    assert passes_gate(record)


@pytest.mark.parametrize("family", FAMILIES)
def test_healthy_contact_raises_no_alarm(family: str) -> None:
    record = HealthyRun(family, 0).compute()
    assert caught(record) == ()
    assert samples(record)


def test_a_drawn_contact_is_the_same_at_every_call() -> None:
    first, again, other = (HealthyRun("hertz", number).compute() for number in (0, 0, 1))
    assert first.parts == again.parts
    assert first.parts != other.parts


def test_truncated_file_is_named() -> None:
    (one,) = caught(DefectRun("record-truncated", "dissimilar_bodies").compute())
    assert one.how == "named error"
    assert "DamagedRecord" in one.reason


A_FAILURE = Caught(quantity="approach", run="128x128", how="reference", clearance=3.0)


def record(*parts: Caught | Sample) -> CaseRecord:
    failed = sum(isinstance(part, Caught) for part in parts)
    return CaseRecord(
        measures={ERROR: 1e-5},
        counters={"verdicts": 3, "failed": failed, "inconclusive": 0},
        parts=tuple(part.row() for part in parts),
    )


def test_what_failed_and_what_was_measured_come_back_from_their_rows() -> None:
    by_law = Caught(
        quantity="largest_residual", run="", how="residual", clearance=None, reason="why"
    )
    sample = Sample(quantity="approach", error=None, allowed=1e-4, uncertainty=2e-5)
    kept = CaseRecord.model_validate_json(record(A_FAILURE, sample, by_law).model_dump_json())
    assert caught(kept) == (A_FAILURE, by_law)
    assert samples(kept) == (sample,)


def whole_study() -> Runs:
    """Records of a study in which all is as it should be."""
    sample = Sample(quantity="approach", error=1e-5, allowed=1e-4, uncertainty=2e-5)
    runs = {r.name: record(A_FAILURE) if r.defect else record() for r in defect_runs(QUICK)}
    return runs | {run.name: record(sample, sample) for run in healthy_runs()}


def outcomes(records: Runs) -> list[Status | None]:
    return [statement.outcome for statement in STUDY.conclude(QUICK, records).statements]


def test_study_passes_when_all_is_caught_and_nothing_else() -> None:
    assert outcomes(whole_study()) == [Status.PASS] * 6


def test_study_without_records_is_inconclusive() -> None:
    assert set(outcomes({})) == {Status.INCONCLUSIVE}


def test_missed_defect_fails_the_study() -> None:
    records = whole_study()
    for run in defect_runs(QUICK):
        if run.defect == "bias":
            records[run.name] = records[DefectRun(HEALTHY, run.case).name]
    assert outcomes(records)[0] is Status.FAIL
    assert outcomes(records)[2] is Status.FAIL


def test_verdict_that_fails_without_the_defect_catches_nothing() -> None:
    records = whole_study()
    defect = DEFECTS["fe-weight"]
    for case in defect.cases:
        records[DefectRun(HEALTHY, case).name] = records[DefectRun(defect.name, case).name]
    assert not seen(QUICK, records, defect).sightings
    assert outcomes(records)[1] is Status.FAIL


def test_false_alarm_fails_the_study() -> None:
    records = whole_study()
    records[healthy_runs()[0].name] = record(A_FAILURE)
    assert outcomes(records)[3] is Status.FAIL


def test_error_bars_that_are_too_short_fail_the_study() -> None:
    records = whole_study()
    short = Sample(quantity="approach", error=1e-4, allowed=1e-3, uncertainty=2e-5)
    for run in healthy_runs()[::10]:
        records[run.name] = record(short, short)
    assert outcomes(records)[4] is Status.FAIL
    assert outcomes(records)[5] is Status.FAIL


def test_error_bars_that_are_too_short_on_thin_layers_alone_fail_the_study() -> None:
    records = whole_study()
    short = Sample(quantity="approach", error=1e-4, allowed=1e-3, uncertainty=2e-5)
    for run in [run for run in healthy_runs() if run.family == THIN][:2]:
        records[run.name] = record(short, short)
    assert outcomes(records)[4:] == [Status.PASS, Status.FAIL]
