"""Tests of the comparison of results with baselines: kinds of changes, and acceptance."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from command import slipstick

from contact_results.directory.json_record import record_text
from slipstick.cli.commands.compare import exit_code_of
from verification.cases.catalogue import CASES
from verification.cases.indenters import hertz_point
from verification.judging.case import SOLVER_TOLERANCE, Level
from verification.judging.declared_case import (
    APPROACH,
    CONTACT_RADIUS,
    PEAK_PRESSURE,
    RefinementLevels,
    Within,
    judged,
    on_cells,
    on_elements,
    on_radii,
    refinement,
)
from verification.judging.declared_case import case as declared
from verification.judging.judgement import judge
from verification.judging.outcome import (
    FOUND_IN_A_RUN,
    CaseOutcome,
    ChangeKind,
    FindingRecord,
    Status,
    Verdict,
)
from verification.problems.indentation import BALL
from verification.regression import baseline as baseline_files
from verification.regression.baseline import (
    BASELINES,
    COUNTERS,
    LEAST,
    MOVED,
    NOISE,
    REMOVED,
    Acceptance,
    BaselineRefused,
    Tolerance,
    Tolerances,
    accept,
    accept_tolerances,
    baselines_of,
    compared,
    held_to,
    key_of,
    keys_of,
    proposed,
    read_baselines,
    read_tolerances,
    recording,
    text_of,
)
from verification.report.file_names import RECORD
from verification.report.files import write_report
from verification.report.summary_text import counts_text, uncovered_lines
from verification.running.provenance import Provenance
from verification.running.report_record import Report, count, load_report

FULL_REPORT = Path(__file__).resolve().parents[1] / "reports/full/report.json.xz"
COMMIT = "1a2b3c4d5e6f708192a3b4c5d6e7f8091a2b3c4d"
REASON = "first numbers | of <b>this</b> test"
MACHINE: dict[str, str | int | None] = {
    "processor": "one",
    "python": "3.11.7",
    "arithmetic": "Haswell",
}
ELSEWHERE = {**MACHINE, "processor": "another"}


def report_of(
    *cases: CaseOutcome,
    changed: bool = False,
    machine: dict[str, str | int | None] = MACHINE,
    level: str = "quick",
) -> Report:
    return Report(
        level=level,
        counts=count(cases),
        cases=cases,
        omissions=(),
        provenance=Provenance(
            program_version="0.1.0",
            commit=COMMIT,
            changed=changed,
            command="slipstick verify --level quick",
            date="2026-11-21T12:00:00+00:00",
            machine=machine,
            libraries={"numpy": "2.4.6"},
            seconds={},
        ),
    )


@pytest.fixture(scope="module")
def healthy() -> CaseOutcome:
    """A case that passes, without figures and with one verdict of each name."""
    measured = judge(hertz_point(cells=refinement(32, 128)))
    nothing_stated = {"stated_error": None, "covered": None}
    verdicts = {v.name: v.model_copy(update=nothing_stated) for v in reversed(measured.verdicts)}
    finding = FindingRecord(
        name="cells", run="32x32", meaning="cells in contact", unit="", value=0.25, remark=""
    )
    return measured.model_copy(
        update={
            "verdicts": tuple(reversed(verdicts.values())),
            "findings": (finding,),
            "charts": (),
        }
    )


def with_verdict(case: CaseOutcome, name: str, **changes: object) -> CaseOutcome:
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


def compare(now: CaseOutcome, was: CaseOutcome, *, elsewhere: bool = False) -> CaseOutcome:
    report = report_of(now, machine=ELSEWHERE if elsewhere else MACHINE)
    return compared(report, baselines_of(report_of(was), REASON)).cases[0]


def shifted(case: CaseOutcome, name: str, part: float, *, of: str = "value") -> CaseOutcome:
    """A quantity moved away from its reference by a part of itself or of what is allowed."""
    verdict = find(case, name)
    assert verdict.value is not None
    size = abs(verdict.value) if of == "value" else verdict.allowed * verdict.scale
    away = 1 if verdict.value >= verdict.reference else -1
    return with_value(case, name, verdict.value + away * part * size)


# ---- what counts as a change -------------------------------------------------------------------


def posed(case: CaseOutcome, name: str, part: float | None, **changes: object) -> CaseOutcome:
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
NAN = {"value": None, "status": Status.INCONCLUSIVE}
CHANGES: list[tuple[str, Any, Any, ChangeKind, int, str]] = [
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
    ("approach", {}, {"allowed": 0.5}, WORSE, 7, "tolerance"),
    ("approach", {}, {"reference": 9e-6}, DRIFT, 5, "reference was"),
    ("approach", {}, {"status": Status.INCONCLUSIVE}, WORSE, 7, "pass -> inconclusive"),
    ("approach", {}, {"unit": "mm"}, DRIFT, 5, "unit was m"),
    # A bad solver scatters its levels, which widens the interval that it would be judged by.
    (ORDER, PASSED, {**LOST, "value": 1.4}, OUTSIDE, 1, "held to the recorded tolerance"),
    (ORDER, PASSED, {**LOST, "value": 1.9}, WORSE, 7, "held to the recorded tolerance"),
    (ORDER, LOST, {**LOST, "value": 0.5}, DRIFT, 5, ""),
    (ORDER, LOST, PASSED, DRIFT, 5, ""),
    (ORDER, FAILED, {**LOST, "value": 1.0, "error": 0.5}, BETTER, 5, "fail -> inconclusive"),
    (ORDER, LOST, FAILED, OUTSIDE, 1, ""),
    (ORDER, PASSED, FAILED, OUTSIDE, 1, ""),
    ("order_of_pressure", {}, NAN, DRIFT, 5, ""),
    ("order_of_pressure", NAN, NAN, SAME, 0, ""),
]


@pytest.mark.parametrize(("name", "was", "now", "kind", "code", "remark"), CHANGES)
@pytest.mark.parametrize("machine", [MACHINE, ELSEWHERE], ids=["here", "elsewhere"])
def test_what_changes_and_what_it_ends_with(
    healthy: CaseOutcome,
    name: str,
    was: Any,
    now: Any,
    kind: ChangeKind,
    code: int,
    remark: str,
    machine: Any,
) -> None:
    then, here = (
        posed(healthy, name, None, **one) if isinstance(one, dict) else posed(healthy, name, one)
        for one in (was, now)
    )
    report = compared(report_of(here, machine=machine), baselines_of(report_of(then), REASON))
    change = find(report.cases[0], name).regression
    assert change is not None
    assert (change.kind, exit_code_of(report)) == (kind, code)
    assert remark in change.remark


def test_wider_tolerance_does_not_make_a_move_smaller(healthy: CaseOutcome) -> None:
    moved = shifted(healthy, "approach", 0.5, of="U")
    wide = with_verdict(moved, "approach", allowed=100 * find(healthy, "approach").allowed)
    change = find(compare(wide, healthy), "approach").regression
    assert change is not None
    assert change.moved == pytest.approx(0.5)


def test_an_error_twice_as_large_is_red_whatever_is_allowed() -> None:
    """Of every kept verdict whose error is above the noise of machines."""
    kept = load_report(FULL_REPORT)
    guarded = 0
    for case in kept.cases:
        judged = {
            key_of(v): v
            for v in case.verdicts
            if v.error is not None
            and v.error > NOISE
            and v.tolerance_kind != "order"
            and v.name not in FOUND_IN_A_RUN
        }
        twice = tuple(doubled(v) if key_of(v) in judged else v for v in case.verdicts)
        now = compare(case.model_copy(update={"verdicts": twice}), case)
        kinds = {key_of(v): v.regression.kind for v in now.verdicts if v.regression is not None}
        missed = [key for key in judged if kinds[key] not in (ChangeKind.WORSE, ChangeKind.OUTSIDE)]
        assert not missed, case.name
        guarded += len(judged)
    assert guarded > 300


def doubled(verdict: Verdict) -> Verdict:
    """As it is judged with twice the error; derived tolerances grow with it."""
    assert verdict.value is not None
    assert verdict.error is not None
    allowed = (2 if verdict.tolerance_kind == "derived" else 1) * verdict.allowed
    error = 2 * verdict.error
    return verdict.model_copy(
        update={
            "value": 2 * verdict.value - verdict.reference,
            "error": error,
            "allowed": allowed,
            "status": Status.PASS if error <= allowed else Status.FAIL,
        }
    )


@pytest.mark.parametrize(
    ("was", "now", "kind"),
    [
        (0.25, 0.25 * (1 + 9e-7), "unchanged"),
        (0.25, 0.25 * (1 + 2e-6), "drift"),
        (940.0, 939.0, "unchanged"),
        (20.0, 22.0, "drift"),
    ],
)
def test_a_finding_keeps_six_digits_and_a_count_its_twentieth_on_every_machine(
    healthy: CaseOutcome, was: float, now: float, kind: str
) -> None:
    (finding,) = healthy.findings
    then, here = (
        healthy.model_copy(update={"findings": (finding.model_copy(update={"value": value}),)})
        for value in (was, now)
    )
    for elsewhere in (False, True):
        change = compare(here, then, elsewhere=elsewhere).findings[0].regression
        assert change is not None
        assert change.kind == kind


@pytest.mark.parametrize("name", COUNTERS)
@pytest.mark.parametrize(
    ("now", "kind"),
    [(100, None), (105, None), (106, ChangeKind.DEARER), (95, None), (94, ChangeKind.DRIFT)],
)
def test_counts_of_a_case_are_kept_to_a_twentieth(
    healthy: CaseOutcome, name: str, now: int, kind: ChangeKind | None
) -> None:
    """Of all its solves together: one may take more where another takes less."""
    first, second, *others = (run.model_copy(update={name: 0}) for run in healthy.runs)

    def counted(one: int, other: int) -> CaseOutcome:
        runs = (first.model_copy(update={name: one}), second.model_copy(update={name: other}))
        return healthy.model_copy(update={"runs": (*runs, *others)})

    for elsewhere in (False, True):
        changes = compare(counted(now - 80, 80), counted(20, 80), elsewhere=elsewhere).counts
        assert [change.kind for change in changes if change.name == name] == [kind] * bool(kind)
    assert compare(counted(40, 60), counted(20, 80)).counts == ()


def test_what_appears_is_new_and_what_disappears_is_gone(healthy: CaseOutcome) -> None:
    verdicts = [verdict.model_copy(update={"runs": ()}) for verdict in healthy.verdicts[1:]]
    fewer = healthy.model_copy(
        update={"verdicts": tuple(verdicts), "findings": (), "runs": healthy.runs[1:]}
    )
    grown, shrunk = compare(healthy, fewer), compare(fewer, healthy)
    appeared = grown.verdicts[0].regression
    assert appeared is not None
    assert appeared.kind is ChangeKind.NEW
    assert {gone.name for gone in shrunk.gone} == {healthy.verdicts[0].name, "cells", "run"}
    assert grown.gone == ()


def test_every_deletion_is_red() -> None:
    """Of every fourth verdict of each case of the kept report, and of each case."""
    kept, deleted = load_report(FULL_REPORT), 0
    for case in kept.cases:
        recorded = baselines_of(report_of(case), REASON)
        assert len({key_of(verdict) for verdict in case.verdicts}) == len(case.verdicts)
        for verdict in case.verdicts[::4]:
            others = tuple(v for v in case.verdicts if v is not verdict)
            fewer = case.model_copy(update={"verdicts": others, "findings": ()})
            assert exit_code_of(compared(report_of(fewer), recorded)) == 7, verdict.name
            deleted += 1
        assert exit_code_of(compared(report_of(), recorded)) == 7, case.name
    assert deleted > 200


def test_an_accepted_deletion_is_listed_with_its_reason(
    healthy: CaseOutcome, tmp_path: Path
) -> None:
    other = healthy.model_copy(update={"name": "other"})
    accept(report_of(healthy, other), REASON, tmp_path)
    fewer = healthy.model_copy(update={"verdicts": healthy.verdicts[1:]})
    for names, code in (([healthy.name], 7), ((), 0)):
        accept(report_of(fewer), "a better | successor", tmp_path, names)
        assert exit_code_of(compared(report_of(fewer), read_baselines(tmp_path))) == code
    assert read_baselines(tmp_path).keys() == {healthy.name}
    rows = [line for line in (tmp_path / REMOVED).read_text().splitlines() if "better" in line]
    gone = healthy.verdicts[0]
    key = f"{gone.name} [{gone.run}]"
    assert rows[0] == f"| {healthy.name} | {key} | quick: a better / successor |"
    whole = keys_of(recording(other, report_of().provenance, ""))
    assert rows[1] == f"| other | {', '.join(sorted(whole))} | quick: a better / successor |"


def test_largest_residual_may_be_found_in_another_run(healthy: CaseOutcome) -> None:
    moved = with_verdict(healthy, "largest_residual", run="16x16")
    assert key_of(find(moved, "largest_residual")) == key_of(find(healthy, "largest_residual"))
    assert compare(moved, healthy).gone == ()


# ---- files -------------------------------------------------------------------------------------


def test_baseline_returns_every_bit_and_equal_reports_give_equal_bytes(
    healthy: CaseOutcome, tmp_path: Path
) -> None:
    (file,) = accept(report_of(healthy), REASON, tmp_path)
    once = file.read_bytes()
    baseline = read_baselines(tmp_path)[healthy.name]
    assert record_text(baseline).encode() == once
    values = [quantity.value for quantity in baseline.levels["quick"].quantities]
    assert values == [verdict.value for verdict in healthy.verdicts]
    accept(compared(report_of(healthy), read_baselines(tmp_path)), REASON, tmp_path)
    assert file.read_bytes() == once


def test_levels_are_recorded_side_by_side(healthy: CaseOutcome, tmp_path: Path) -> None:
    for level in ("full", "quick"):
        accept(report_of(healthy).model_copy(update={"level": level}), REASON, tmp_path)
    assert list(read_baselines(tmp_path)[healthy.name].levels) == ["quick", "full"]


DAMAGE: dict[str, Callable[[str], str]] = {
    "truncated": lambda text: text[: len(text) // 2],
    "empty": lambda text: "",
    "foreign": lambda text: '{"other": 1}',
    "other case": lambda text: text.replace('"hertz_point"', '"hertz_line"'),
    "other level": lambda text: text.replace('"quick"', '"quickest"'),
    "other version": lambda text: text.replace('"schema_version": 1', '"schema_version": 9'),
    "not finite": lambda text: re.sub(r'"allowed": [^,]*', '"allowed": NaN', text),
    "no finite error": lambda text: re.sub(r'"value": [^,]*', '"value": 1e308', text),
    "less than nothing allowed": lambda text: re.sub(r'"allowed": [^,]*', '"allowed": -1.0', text),
    "less than no work": lambda text: re.sub(r'"iterations": \d+', '"iterations": -1', text),
    "work beyond doubles": lambda text: re.sub(
        r'"iterations": \d+', f'"iterations": {10**400}', text
    ),
    "words for numbers": lambda text: re.sub(r'"value": [^,]*', '"value": "small"', text),
}


@pytest.mark.parametrize("damage", DAMAGE.values(), ids=DAMAGE)
def test_damaged_baseline_is_named(
    healthy: CaseOutcome, tmp_path: Path, damage: Callable[[str], str]
) -> None:
    (file,) = accept(report_of(healthy), REASON, tmp_path)
    file.write_text(damage(file.read_text(encoding="utf-8")), encoding="utf-8")
    with pytest.raises(BaselineRefused, match=r"hertz_point\.json .*accept it anew"):
        read_baselines(tmp_path)
    before = file.read_bytes()
    with pytest.raises(BaselineRefused):
        accept(report_of(healthy), REASON, tmp_path)
    assert file.read_bytes() == before


def test_every_baseline_belongs_to_a_case() -> None:
    for case, baseline in read_baselines().items():
        for level in baseline.levels:
            assert case in CASES, (case, level)
    assert {path.suffix for path in BASELINES.glob("*.*")} <= {".json", ".md", ".py"}


# ---- accepting ---------------------------------------------------------------------------------


def test_unacceptable_reports_are_refused_and_nothing_is_written(
    healthy: CaseOutcome, tmp_path: Path
) -> None:
    failing = shifted(healthy, "approach", 3.0, of="U")
    for report, reason, names, said in (
        (report_of(healthy), "", (), "needs a reason"),
        (report_of(healthy), " \n\t", (), "needs a reason"),
        (report_of(failing), REASON, (), "1 failed, the first is hertz_point/approach"),
        (report_of(healthy, changed=True), REASON, (), "no commit holds"),
        (report_of(healthy), REASON, ("herz",), "no case herz"),
    ):
        with pytest.raises(BaselineRefused, match=said):
            accept(report, reason, tmp_path, names)
    assert list(tmp_path.iterdir()) == []


def test_only_the_named_cases_are_accepted(healthy: CaseOutcome, tmp_path: Path) -> None:
    other = healthy.model_copy(update={"name": "other"})
    (file,) = accept(report_of(healthy, other), REASON, tmp_path, ["other"])
    assert file.name == "other.json"


# ---- the report --------------------------------------------------------------------------------


# ---- commands ----------------------------------------------------------------------------------


@pytest.fixture
def places(healthy: CaseOutcome, tmp_path: Path) -> tuple[Path, Path]:
    """A report and its baselines."""
    report, baselines = tmp_path / "report", tmp_path / "baselines"
    report.mkdir()
    write_report(report_of(healthy), report)
    accept(report_of(healthy), REASON, baselines)
    return report, baselines


@pytest.mark.parametrize(
    ("part", "code", "said"),
    [
        (0.0, 0, "unchanged"),
        (1e-12, 0, "unchanged"),
        (3e-6, 5, "1 drift"),
        (0.1, 1, "FAIL hertz_point/approach"),
    ],
)
def test_comparison_ends_by_what_changed(
    healthy: CaseOutcome,
    places: tuple[Path, Path],
    capsys: pytest.CaptureFixture[str],
    part: float,
    code: int,
    said: str,
) -> None:
    report, baselines = places
    recorded = (report / RECORD).rename(report.parent / "recorded.json")
    write_report(report_of(shifted(healthy, "approach", part)), report)
    assert slipstick("maintain", "compare", report, "--baseline", recorded) == code
    capsys.readouterr()
    assert slipstick("maintain", "compare", report, "--baseline", baselines) == code
    output = capsys.readouterr().out
    assert said in output
    assert ("reproduce: slipstick verify hertz_point" in output) == (code > 0)
    moved = shifted(healthy, "approach", part)
    less = moved.model_copy(update={"verdicts": moved.verdicts[:-1]})
    write_report(report_of(less), report)
    both = slipstick("maintain", "compare", report, "--baseline", baselines)
    assert both == (code if code == 1 else 7)


def test_damaged_baseline_ends_the_commands_before_any_work(
    places: tuple[Path, Path],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    report, baselines = places
    (baselines / "hertz_point.json").write_text("{", encoding="utf-8")
    assert slipstick("maintain", "compare", report, "--baseline", baselines) == 2
    monkeypatch.setattr(baseline_files, "BASELINES", baselines)
    assert slipstick("verify", "hertz_point", "--output", tmp_path / "out") == 2
    assert capsys.readouterr().err.count("is damaged") == 2
    assert list((tmp_path / "out").iterdir()) == []


# ---- Errors that solvers state are judged, and tolerances follow the errors.


LADDERS = {
    "cells": on_cells(BALL, (32,)),
    "elements": on_elements(BALL, (12,)),
    "radii": on_radii(BALL, "ball"),
}


@pytest.fixture(scope="module")
def outcome() -> CaseOutcome:
    return settled(judge(hertz_point(cells=(32, 48, 64))).model_copy(update={"charts": ()}), 0.0)


def settled(outcome: CaseOutcome, change: float) -> CaseOutcome:
    """The case with this last change of the edge correction in all runs."""
    runs = tuple(run.model_copy(update={"edge_change": change}) for run in outcome.runs)
    return outcome.model_copy(update={"runs": runs})


def changed(
    outcome: CaseOutcome, *, times: float = 1.0, covered: bool | None = None
) -> CaseOutcome:
    """The case with errors so many times as large, or with stated errors that (do not) cover."""

    def one(v: Verdict) -> Verdict:
        if covered is not None:
            return v if v.covered is None else v.model_copy(update={"covered": covered})
        if v.error is None or v.value is None or v.tolerance_kind == "order":
            return v
        error = times * v.error
        status = Status.PASS if error <= v.allowed else Status.FAIL
        value = v.reference + times * (v.value - v.reference)
        return v.model_copy(update={"error": error, "value": value, "status": status})

    return outcome.model_copy(update={"verdicts": tuple(map(one, outcome.verdicts))})


# ---- stated errors -----------------------------------------------------------------------------


@pytest.mark.parametrize("ladder", LADDERS.values(), ids=LADDERS)
def test_each_solver_states_the_errors_of_judged_scalars(ladder: RefinementLevels) -> None:
    rows = [Within(what, 1.0, "why") for what in (APPROACH, CONTACT_RADIUS, PEAK_PRESSURE)]
    planted = declared("planted", "title", "problem", judged(ladder, rows))
    found = judge(planted).verdicts
    stated = [verdict for verdict in found if verdict.stated_error is not None]
    assert [verdict.name for verdict in stated] == [row.what.name for row in rows]
    assert all(verdict.covered for verdict in stated)


def test_a_stated_error_that_is_too_small_is_named_and_red(outcome: CaseOutcome) -> None:
    good, poor = report_of(outcome), report_of(changed(outcome, covered=False))
    assert uncovered_lines(good) == []
    lines = uncovered_lines(poor)
    assert lines[0].startswith("UNCOVERED hertz_point/")
    assert f"0 of {len(lines)} stated errors cover" in counts_text(poor)
    report = compared(poor, baselines_of(good, "why"))
    kinds = [
        v.regression.kind for v in report.cases[0].verdicts if v.regression and v.covered is False
    ]
    assert set(kinds) == {ChangeKind.WORSE}
    assert exit_code_of(report) == 7
    assert exit_code_of(compared(good, baselines_of(good, "why"))) == 0


@pytest.mark.parametrize(("times", "kind"), [(1.6, ChangeKind.DRIFT), (1.4, ChangeKind.UNCHANGED)])
def test_a_stated_error_that_grew_by_half_is_a_change(outcome, times, kind) -> None:
    was, now = (
        outcome.model_copy(
            update={
                "verdicts": tuple(
                    v.model_copy(update={"stated_error": v.stated_error and part * v.scale})
                    for v in outcome.verdicts
                )
            }
        )
        for part in (1e-3, 1e-3 * times)
    )
    changes = [v.regression for v in compare(now, was).verdicts if v.stated_error]
    assert {change.kind for change in changes} == {kind}
    assert all("stated error" in change.remark for change in changes) == (times > 1.5)


@pytest.mark.parametrize(("uncovered", "status"), [(1, Status.PASS), (2, Status.FAIL)])
def test_a_full_report_needs_95_percent(
    outcome: CaseOutcome, uncovered: int, status: Status
) -> None:
    one = next(verdict for verdict in outcome.verdicts if verdict.covered)
    verdicts = [
        one.model_copy(update={"name": f"number {n}", "covered": n >= uncovered}) for n in range(20)
    ]
    case = outcome.model_copy(update={"verdicts": tuple(verdicts)})
    assert report_of(case, level="full").status is status
    assert report_of(case).status is Status.PASS


# ---- tolerances --------------------------------------------------------------------------------

FLOOR = LEAST * SOLVER_TOLERANCE  # of errors of a run without edge correction


def test_accepted_tolerances_are_twice_the_largest_error_over_kernels(
    outcome: CaseOutcome, tmp_path: Path
) -> None:
    reports = [
        report_of(outcome),
        report_of(changed(outcome, times=1.2), machine={"arithmetic": "SkylakeX"}),
    ]
    count = accept_tolerances(reports, "as  derived", tmp_path)
    known = read_tolerances("quick", tmp_path)
    assert [(one.because, one.kernels) for one in known.accepted] == [
        ("as derived", ("Haswell", "SkylakeX"))
    ]
    (held,) = held_to([outcome], known)
    assert count == sum(verdict.bound is not None for verdict in held.verdicts) > 1
    for verdict, was in zip(held.verdicts, outcome.verdicts, strict=True):
        assert verdict.status is was.status
        if verdict.bound is None:
            slack = was.error is not None and was.allowed > 3 * max(1.2 * was.error, FLOOR)
            assert was.tolerance_kind == "order" or not slack
            continue
        assert was.error is not None
        assert verdict.bound == was.allowed
        assert verdict.allowed == pytest.approx(2.4 * was.error + FLOOR, rel=0.05)
    (worse,) = held_to([changed(outcome, times=3)], known)
    failed = [v for v in worse.verdicts if v.bound is not None and v.error > 4 * FLOOR]
    assert failed
    assert all(verdict.status is Status.FAIL for verdict in failed)
    assert proposed([report_of(held)]) == {}
    # No less is accepted than the uncertainty of the reference.
    assert [
        v.allowed
        for v in held_to(
            [
                outcome.model_copy(
                    update={
                        "verdicts": [
                            v.model_copy(
                                update={"reference_uncertainty": 0.6 * v.allowed * v.scale}
                            )
                            for v in outcome.verdicts
                        ]
                    }
                )
            ],
            known,
        )[0].verdicts
    ] == [
        0.6 * v.allowed if w.bound else v.allowed
        for v, w in zip(outcome.verdicts, held.verdicts, strict=True)
    ]


def test_a_tolerance_allows_for_the_last_change_of_the_edge_correction(
    outcome: CaseOutcome,
) -> None:
    settled_at = [proposed([report_of(settled(outcome, change))]) for change in (0.0, 1e-6, 1.0)]
    exact, loose, unsettled = (found.get(outcome.name, {}) for found in settled_at)
    assert unsettled == {}
    assert loose
    for key, tolerance in loose.items():
        assert tolerance.allowed == pytest.approx(
            2 * tolerance.error + FLOOR + MOVED * 1e-6, rel=0.05
        )
        assert tolerance.allowed >= exact[key].allowed


def test_a_tolerance_never_exceeds_the_bound_of_its_case(outcome: CaseOutcome) -> None:
    reports = [report_of(changed(outcome, times=1e6))]
    assert proposed(reports) == {}
    one = outcome.verdicts[0]
    wide = {"allowed": 2 * one.allowed, "error": one.allowed}
    known = Tolerances.model_validate(
        {
            "level": "quick",
            "accepted": [
                {
                    "because": "why",
                    "commit": None,
                    "kernels": [],
                    "tolerances": {outcome.name: {text_of(one): wide}},
                }
            ],
        }
    )
    assert held_to([outcome], known) == (outcome,)


def test_tolerances_need_a_reason_and_one_level(outcome: CaseOutcome, tmp_path: Path) -> None:
    with pytest.raises(BaselineRefused, match="reason"):
        accept_tolerances([report_of(outcome)], " ", tmp_path)
    with pytest.raises(BaselineRefused, match="name one level"):
        proposed([report_of(outcome), report_of(outcome, level="full")])
    (tmp_path / "quick.json").write_text("{")
    with pytest.raises(BaselineRefused, match=r"quick\.json is damaged: got no JSON"):
        read_tolerances("quick", tmp_path)


@pytest.mark.parametrize("level", [level.name.lower() for level in Level])
def test_every_accepted_tolerance_belongs_to_a_recorded_number(level: str) -> None:
    """A number that gets another name loses its tolerance, unless that is accepted anew."""
    recorded = {
        (case, f"{quantity.name} [{quantity.key[2]}] {quantity.tolerance_kind}")
        for case, baseline in read_baselines().items()
        if level in baseline.levels
        for quantity in baseline.levels[level].quantities
    }
    accepted = read_tolerances(level).accepted
    assert all(one.because for one in accepted)
    named = [pair for one in accepted for pair in one.tolerances.items()]
    assert {(case, key) for case, keys in named for key in keys} <= recorded


@pytest.mark.usefixtures("one_process")
def test_verify_judges_by_the_accepted_tolerances(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Below each error, so that every number fails that passes by the bound of its case."""
    verify = ("verify", "dissimilar_bodies", "--output", tmp_path)
    assert slipstick(*verify) == 0
    measured = load_report(tmp_path / "report.json").cases[0]
    tight = {
        text_of(v): Tolerance(allowed=0.9 * v.error, error=0.45 * v.error)
        for v in measured.verdicts
        if v.error and v.error > FLOOR
    }
    accepted = Acceptance(because="why", commit=None, kernels=(), tolerances={measured.name: tight})
    known = Tolerances(level="quick", accepted=(accepted,))
    monkeypatch.setattr("slipstick.cli.commands.verify.read_tolerances", lambda level: known)
    assert slipstick(*verify) == 1
    failed = capsys.readouterr().out.count("\nFAIL dissimilar_bodies/")
    assert failed >= len(tight) - 1 > 1
