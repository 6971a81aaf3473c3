"""Tests of the comparison of results with baselines: kinds of changes, and acceptance."""

import pytest
from report_examples import report_by

from contact_results.directory.json_record import record_text
from slipstick.cli.commands.compare import exit_code_of
from verification.cases.catalogue import CASES
from verification.cases.indenters import hertz_point
from verification.judging.declared_case import (
    refinement,
)
from verification.judging.judgement import judge
from verification.judging.outcome import (
    CaseOutcome,
    ChangeKind,
    Status,
    Verdict,
)
from verification.regression.baseline import (
    BASELINES,
    COUNTERS,
    accept,
    baselines_of,
    key_of,
    read_baselines,
)
from verification.regression.comparison import compared

REASON = "first numbers | of <b>this</b> test"


@pytest.fixture(scope="module")
def healthy():
    """A case that passes, without figures and with one verdict of each name."""
    measured = judge(hertz_point(cells=refinement(32, 128)))
    nothing_stated = {"stated_error": None, "covered": None}
    verdicts = {v.name: v.model_copy(update=nothing_stated) for v in reversed(measured.verdicts)}
    return measured.model_copy(
        update={
            "verdicts": tuple(reversed(verdicts.values())),
            "charts": (),
        }
    )


def with_verdict(case, name, **changes):
    verdicts = [v.model_copy(update=changes) if v.name == name else v for v in case.verdicts]
    return case.model_copy(update={"verdicts": tuple(verdicts)})


def with_value(case: CaseOutcome, name: str, value: float) -> CaseOutcome:
    """The case as it is judged if the quantity had this value."""
    verdict = find(case, name)
    error = abs(value - verdict.reference) / verdict.scale
    status = Status.PASS if error <= verdict.allowed else Status.FAIL
    return with_verdict(case, name, value=value, error=error, status=status)


def find(case: CaseOutcome, name: str) -> Verdict:
    return next(verdict for verdict in case.verdicts if verdict.name == name)


def compare(now: CaseOutcome, was: CaseOutcome) -> CaseOutcome:
    return compared(report_by(now), baselines_of(report_by(was), REASON)).cases[0]


def posed(case, name, part, **changes):
    """The case with an error of this part of what is allowed, and judged otherwise."""
    if part is not None:
        verdict = find(case, name)
        case = with_value(case, name, verdict.reference + part * verdict.allowed * verdict.scale)
    return with_verdict(case, name, **changes)


SAME = ChangeKind.UNCHANGED
DRIFT = ChangeKind.DRIFT
WORSE = ChangeKind.WORSE
BETTER = ChangeKind.BETTER
OUTSIDE = ChangeKind.OUTSIDE
ORDER = "order_of_peak_pressure"
PASSED = {"value": 2.03, "reference": 2.0, "allowed": 0.2, "interval": 0.2}
LOST = {"allowed": 1.0, "interval": 1.0, "status": Status.INCONCLUSIVE}
FAILED = {"value": 1.0, "error": 0.5, "allowed": 0.2, "interval": 0.2, "status": Status.FAIL}
STATED = {"stated_error": 1e-8, "covered": True}
CHANGES = [
    # verdict, part of what is allowed (before, now) or how it is judged, kind, exit code, remark
    *(
        ("approach", 0.2, now, kind, code, "")
        for now, kind, code in (
            (0.2, SAME, 0),
            (0.2 + 1e-12, SAME, 0),
            (0.2099, SAME, 0),
            (0.29, DRIFT, 5),
            (0.31, WORSE, 7),
            (1.1, OUTSIDE, 1),
        )
    ),
    *(
        ("approach", was, now, kind, code, "")
        for was, now, kind, code in (
            (-0.2, 0.4, WORSE, 7),
            (0.4, 0.8, WORSE, 7),
            (0.01, 0.014, SAME, 0),
            (0.01, 0.03, WORSE, 7),
            (3.0, 3.0, SAME, 0),
            (3.0, 0.2, BETTER, 5),
            # To the other side of the reference, by less than is allowed, and what failed already.
            (-0.8, 0.95, OUTSIDE, 1),
            (0.95, -0.8, DRIFT, 5),
            (0.2, 0.95, WORSE, 7),
            (2.0, 20.0, OUTSIDE, 1),
            (2.0, 2.1, DRIFT, 5),
            # An error that falls far is suspicious, unless it was small.
            (0.8, -0.3, BETTER, 5),
            (0.8, -0.6, DRIFT, 5),
            (0.03, 0.001, DRIFT, 5),
        )
    ),
    # How far below its tolerance a solve ends says nothing.
    ("largest_residual", 0.2, 0.7, SAME, 0, ""),
    ("largest_residual", 0.2, 2.0, OUTSIDE, 1, ""),
    # A bad solver scatters its levels, which widens the interval that it would be judged by.
    (ORDER, PASSED, {**LOST, "value": 1.4}, OUTSIDE, 1, "held to the recorded tolerance"),
    (ORDER, PASSED, {**LOST, "value": 1.9}, WORSE, 7, "held to the recorded tolerance"),
    (ORDER, LOST, {**LOST, "value": 0.5}, DRIFT, 5, ""),
    (ORDER, LOST, PASSED, DRIFT, 5, ""),
    (ORDER, FAILED, {**LOST, "value": 1.0, "error": 0.5}, BETTER, 5, "fail -> inconclusive"),
    (ORDER, LOST, FAILED, OUTSIDE, 1, ""),
    (ORDER, PASSED, {**PASSED, "allowed": 0.5, "interval": 0.5}, DRIFT, 5, ""),
    (ORDER, PASSED, FAILED, OUTSIDE, 1, ""),
    ("approach", STATED, {**STATED, "stated_error": 1.4e-8}, SAME, 0, ""),
    ("approach", STATED, {**STATED, "stated_error": 1.6e-8}, DRIFT, 5, "stated error"),
]


@pytest.mark.parametrize(("name", "was", "now", "kind", "code", "remark"), CHANGES)
def test_what_changes_and_what_it_ends_with(
    healthy,
    name,
    was,
    now,
    kind,
    code,
    remark,
):
    then, here = (
        posed(healthy, name, None, **one) if isinstance(one, dict) else posed(healthy, name, one)
        for one in (was, now)
    )
    report = compared(report_by(here), baselines_of(report_by(then), REASON))
    change = find(report.cases[0], name).regression
    assert (change.kind, exit_code_of(report)) == (kind, code)
    assert remark in change.remark


@pytest.mark.parametrize("name", COUNTERS)
@pytest.mark.parametrize(
    ("now", "kind"),
    [(100, None), (105, None), (106, ChangeKind.DEARER), (95, None), (94, ChangeKind.DRIFT)],
)
def test_counts_of_a_case_are_kept_to_a_twentieth(healthy, name, now, kind):
    """Of all its solves together: one may take more where another takes less."""
    first, second, *others = (run.model_copy(update={name: 0}) for run in healthy.runs)

    def counted(one, other):
        runs = (first.model_copy(update={name: one}), second.model_copy(update={name: other}))
        return healthy.model_copy(update={"runs": (*runs, *others)})

    changes = compare(counted(now - 80, 80), counted(20, 80)).counts
    assert [change.kind for change in changes if change.name == name] == [kind] * bool(kind)
    assert compare(counted(40, 60), counted(20, 80)).counts == ()


def test_largest_residual_may_be_found_in_another_run(healthy):
    moved = with_verdict(healthy, "largest_residual", run="16x16")
    assert key_of(find(moved, "largest_residual")) == key_of(find(healthy, "largest_residual"))
    assert compare(moved, healthy).gone == ()


def test_baseline_returns_every_bit_and_equal_reports_give_equal_bytes(healthy, tmp_path):
    (file,) = accept(report_by(healthy), REASON, tmp_path)
    once = file.read_bytes()
    baseline = read_baselines(tmp_path)[healthy.name]
    assert record_text(baseline).encode() == once
    values = [quantity.value for quantity in baseline.levels["quick"].quantities]
    assert values == [verdict.value for verdict in healthy.verdicts]
    accept(compared(report_by(healthy), read_baselines(tmp_path)), REASON, tmp_path)
    assert file.read_bytes() == once


def test_every_baseline_belongs_to_a_case():
    for case, baseline in read_baselines().items():
        for level in baseline.levels:
            assert case in CASES, (case, level)
    assert {path.suffix for path in BASELINES.glob("*.*")} <= {".json", ".md", ".py"}


def test_only_the_named_cases_are_accepted(healthy, tmp_path):
    other = healthy.model_copy(update={"name": "other"})
    (file,) = accept(report_by(healthy, other), REASON, tmp_path, ["other"])
    assert file.name == "other.json"
