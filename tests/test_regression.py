"""Numbers beside the recorded ones: what counts as a change, and who may accept one."""

import json
import os
import re
import sys
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import pytest
from command import slipstick

from slipstick.cli.compare import exit_code_of
from verification.cases.catalogue import CASES, choose
from verification.cases.hertz import hertz_point
from verification.judging.case import Level
from verification.judging.change import ChangeKind
from verification.judging.judgement import judge
from verification.judging.outcome import (
    FOUND_IN_A_RUN,
    CaseOutcome,
    FindingRecord,
    Status,
    Verdict,
)
from verification.judging.refinement import refinement
from verification.judging.verdict_text import failure_line
from verification.regression import baseline_files
from verification.regression.acceptance import accept, baselines_of
from verification.regression.baseline import COUNTERS, key_of, keys_of, recording
from verification.regression.baseline_files import (
    BASELINES,
    REMOVED,
    dump_baseline,
    read_baselines,
)
from verification.regression.comparison import compared
from verification.regression.number_change import NOISE
from verification.regression.refusal import BaselineRefused
from verification.report.changes import change_counts, change_rows
from verification.report.files import RECORD, write_report
from verification.report.junit import render_junit
from verification.report.page import render_page
from verification.report.summary_text import MOST_LINES, render_summary
from verification.running.report_record import Provenance, Report, count, load_report

FULL_REPORT = Path(__file__).resolve().parents[1] / "reports/full/report.json.xz"
COMMIT = "1a2b3c4d5e6f708192a3b4c5d6e7f8091a2b3c4d"
REASON = "first numbers | of <b>this</b> test"
MACHINE: dict[str, str | int | None] = {"processor": "one", "python": "3.11.7"}
ELSEWHERE = {**MACHINE, "processor": "another"}


def report_of(
    *cases: CaseOutcome, changed: bool = False, machine: dict[str, str | int | None] = MACHINE
) -> Report:
    return Report(
        level="quick",
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


def with_counts(case: CaseOutcome, **counts: int) -> CaseOutcome:
    first, *others = case.runs
    return case.model_copy(update={"runs": (first.model_copy(update=counts), *others)})


def find(case: CaseOutcome, name: str) -> Verdict:
    return next(verdict for verdict in case.verdicts if verdict.name == name)


def compare(now: CaseOutcome, was: CaseOutcome, *, elsewhere: bool = False) -> CaseOutcome:
    report = report_of(now, machine=ELSEWHERE if elsewhere else MACHINE)
    return compared(report, baselines_of(report_of(was), REASON)).cases[0]


def kind_of(
    now: CaseOutcome, was: CaseOutcome, name: str, *, elsewhere: bool = False
) -> ChangeKind:
    change = find(compare(now, was, elsewhere=elsewhere), name).regression
    assert change is not None
    return change.kind


def shifted(case: CaseOutcome, name: str, part: float, *, of: str = "value") -> CaseOutcome:
    """A quantity moved away from its reference by a part of itself or of what is allowed."""
    verdict = find(case, name)
    assert verdict.value is not None
    size = abs(verdict.value) if of == "value" else verdict.allowed * verdict.scale
    away = 1 if verdict.value >= verdict.reference else -1
    return with_value(case, name, verdict.value + away * part * size)


# ---- what counts as a change -------------------------------------------------------------------


def test_equal_numbers_are_unchanged(healthy: CaseOutcome) -> None:
    report = compared(report_of(healthy), baselines_of(report_of(healthy), REASON))
    judged = len(healthy.verdicts) + len(healthy.findings)
    assert change_counts(report) == {ChangeKind.UNCHANGED: judged}
    assert change_rows(report) == []


@pytest.mark.parametrize(
    ("part", "kind"),
    [
        (1e-12, ChangeKind.UNCHANGED),
        (0.0099, ChangeKind.UNCHANGED),
        (0.03, ChangeKind.DRIFT),
        (3.0, ChangeKind.OUTSIDE),
    ],
)
@pytest.mark.parametrize("elsewhere", [False, True])
def test_a_hundredth_of_what_is_allowed_is_noise_on_every_machine(
    healthy: CaseOutcome, part: float, kind: ChangeKind, *, elsewhere: bool
) -> None:
    moved = shifted(healthy, "approach", part, of="allowed")
    assert kind_of(moved, healthy, "approach", elsewhere=elsewhere) is kind


def test_how_far_below_its_tolerance_a_solve_ends_says_nothing(healthy: CaseOutcome) -> None:
    was, now = (with_value(healthy, "largest_residual", value) for value in (2e-9, 7e-9))
    assert kind_of(now, was, "largest_residual") is ChangeKind.UNCHANGED
    failing = with_value(healthy, "largest_residual", 2e-8)
    assert kind_of(failing, was, "largest_residual") is ChangeKind.OUTSIDE


@pytest.mark.parametrize(
    ("was", "now", "kind"),
    [
        (0.2, 0.29, ChangeKind.DRIFT),
        (0.2, 0.31, ChangeKind.WORSE),
        (-0.2, 0.4, ChangeKind.WORSE),
        (0.4, 0.8, ChangeKind.WORSE),
        (0.01, 0.014, ChangeKind.UNCHANGED),
        (0.01, 0.03, ChangeKind.WORSE),
        (0.2, 1.1, ChangeKind.OUTSIDE),
    ],
)
def test_an_error_that_grows_by_half_is_worse_though_it_is_allowed(
    healthy: CaseOutcome, was: float, now: float, kind: ChangeKind
) -> None:
    verdict = find(healthy, "approach")
    allowed = verdict.allowed * verdict.scale
    then, here = (
        with_value(healthy, "approach", verdict.reference + part * allowed) for part in (was, now)
    )
    assert kind_of(here, then, "approach") is kind
    report = compared(report_of(here), baselines_of(report_of(then), REASON))
    code = {
        ChangeKind.UNCHANGED: 0,
        ChangeKind.DRIFT: 5,
        ChangeKind.WORSE: 7,
        ChangeKind.OUTSIDE: 1,
    }[kind]
    assert exit_code_of(report) == code


def test_an_error_twice_as_large_is_red_whatever_is_allowed() -> None:
    """Of every kept verdict whose error is above the noise of machines."""
    kept = load_report(FULL_REPORT)
    guarded = 0
    for case in kept.cases:
        judged = {
            key_of(v): v for v in case.verdicts
            if v.error is not None and v.error > NOISE and v.tolerance_kind != "order"
            and v.name not in FOUND_IN_A_RUN
        }  # fmt: skip
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


def test_other_machine_is_said_by_what_differs(healthy: CaseOutcome) -> None:
    origin = compare(healthy, healthy, elsewhere=True).baseline
    assert origin is not None
    assert origin.differs == ("processor: another, was one",)
    assert compare(healthy, healthy).baseline == origin.model_copy(update={"differs": ()})


def test_move_is_told_in_units_of_the_tolerance(healthy: CaseOutcome) -> None:
    change = find(compare(shifted(healthy, "approach", 0.25, of="U"), healthy), "approach")
    assert change.regression is not None
    assert change.regression.moved == pytest.approx(0.25)
    assert change.regression.was == find(healthy, "approach").value


def test_verdict_that_begins_to_fail_is_outside(healthy: CaseOutcome) -> None:
    failing = shifted(healthy, "approach", 3.0, of="U")
    assert kind_of(failing, healthy, "approach") is ChangeKind.OUTSIDE
    assert kind_of(failing, failing, "approach") is ChangeKind.UNCHANGED
    assert kind_of(healthy, failing, "approach") is ChangeKind.BETTER


def test_error_that_falls_far_is_suspicious(healthy: CaseOutcome) -> None:
    verdict = find(healthy, "approach")
    allowed = verdict.allowed * verdict.scale
    poor = with_value(healthy, "approach", verdict.reference + 0.8 * allowed)
    for part, kind in ((0.3, ChangeKind.BETTER), (0.6, ChangeKind.DRIFT)):
        now = with_value(healthy, "approach", verdict.reference - part * allowed)
        assert kind_of(now, poor, "approach") is kind


def test_error_that_was_small_is_not_suspicious(healthy: CaseOutcome) -> None:
    verdict = find(healthy, "approach")
    allowed = verdict.allowed * verdict.scale
    now, was = (
        with_value(healthy, "approach", verdict.reference + part * allowed)
        for part in (0.001, 0.03)
    )
    assert kind_of(now, was, "approach") is ChangeKind.DRIFT


@pytest.mark.parametrize(
    ("change", "remark"),
    [
        ({"allowed": 0.5}, "tolerance"),
        ({"reference": 9e-6}, "reference was"),
        ({"status": Status.INCONCLUSIVE}, "pass -> inconclusive"),
        ({"unit": "mm"}, "unit was m"),
    ],
)
def test_judging_otherwise_is_drift_even_of_the_same_value(
    healthy: CaseOutcome, change: dict[str, object], remark: str
) -> None:
    now = find(compare(with_verdict(healthy, "approach", **change), healthy), "approach")
    assert now.regression is not None
    assert now.regression.kind is ChangeKind.DRIFT
    assert remark in now.regression.remark


def test_wider_tolerance_does_not_make_a_move_smaller(healthy: CaseOutcome) -> None:
    moved = shifted(healthy, "approach", 0.5, of="U")
    wide = with_verdict(moved, "approach", allowed=100 * find(healthy, "approach").allowed)
    change = find(compare(wide, healthy), "approach").regression
    assert change is not None
    assert change.moved == pytest.approx(0.5)


@pytest.mark.parametrize(("part", "kind"), [(3.0, ChangeKind.OUTSIDE), (0.5, ChangeKind.DRIFT)])
def test_order_that_is_lost_is_held_to_the_tolerance_it_had(
    healthy: CaseOutcome, part: float, kind: ChangeKind
) -> None:
    """A bad solver scatters its levels, which widens the interval that it would be judged by."""
    order = {"value": 2.03, "allowed": 0.2, "interval": 0.2, "status": Status.PASS}
    passed = with_verdict(healthy, "order_of_peak_pressure", **order)
    lost = {"value": 2 - part * 0.2, "allowed": 1.0, "interval": 1.0}
    now = with_verdict(passed, "order_of_peak_pressure", status=Status.INCONCLUSIVE, **lost)
    verdict = find(compare(now, passed), "order_of_peak_pressure")
    assert verdict.regression is not None
    assert verdict.regression.kind is kind
    assert "pass -> inconclusive, held to the recorded tolerance" in verdict.regression.remark
    line = failure_line(now.name, verdict, "quick")
    assert line.startswith("MOVED hertz_point/order_of_peak_pressure")
    assert "pass -> inconclusive" in line


def test_order_that_was_inconclusive_may_move(healthy: CaseOutcome) -> None:
    was = find(healthy, "order_of_peak_pressure")
    wide = with_verdict(healthy, was.name, allowed=1.0, status=Status.INCONCLUSIVE)
    now = with_verdict(wide, was.name, value=was.reference - 1.5)
    assert kind_of(now, wide, was.name) is ChangeKind.DRIFT


def test_number_that_is_not_finite_is_a_change(healthy: CaseOutcome) -> None:
    broken = with_verdict(healthy, "order_of_pressure", value=None, status=Status.INCONCLUSIVE)
    assert kind_of(broken, healthy, "order_of_pressure") is ChangeKind.DRIFT
    assert kind_of(broken, broken, "order_of_pressure") is ChangeKind.UNCHANGED


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
    """Of each verdict of each case of the kept report, and of each case."""
    kept, deleted = load_report(FULL_REPORT), 0
    for case in kept.cases:
        recorded = baselines_of(report_of(case), REASON)
        assert len({key_of(verdict) for verdict in case.verdicts}) == len(case.verdicts)
        for verdict in case.verdicts:
            others = tuple(v for v in case.verdicts if v is not verdict)
            fewer = case.model_copy(update={"verdicts": others, "findings": ()})
            assert exit_code_of(compared(report_of(fewer), recorded)) == 7, verdict.name
            deleted += 1
        assert exit_code_of(compared(report_of(), recorded)) == 7, case.name
    assert deleted == sum(kept.counts.values()) > 800


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


def test_case_without_baseline_is_a_state_of_its_own(healthy: CaseOutcome) -> None:
    report = compared(report_of(healthy), {})
    assert report.cases[0].baseline is None
    assert change_rows(report) == []
    assert "no baseline yet of level quick" in render_summary(report)
    assert "no baseline yet" in render_junit(report)
    assert "There is no baseline yet of level quick" in render_page(report)


def test_largest_residual_may_be_found_in_another_run(healthy: CaseOutcome) -> None:
    moved = with_verdict(healthy, "largest_residual", run="16x16")
    assert key_of(find(moved, "largest_residual")) == key_of(find(healthy, "largest_residual"))
    assert compare(moved, healthy).gone == ()


@pytest.mark.parametrize("level", Level)
def test_numbers_of_a_case_have_keys_of_their_own(level: Level) -> None:
    assert choose(level)
    for case in choose(level):
        keys = [(q.name, q.run, type(q.tolerance)) for q in case.quantities]
        keys += [(c.name, c.subject, type(c.tolerance)) for c in case.checks]
        keys += [(c.name, " and ".join(c.runs), object) for c in case.comparisons]
        assert len(set(keys)) == len(keys), case.name
        found = [(finding.name, finding.run) for finding in case.findings]
        assert len(set(found)) == len(found), case.name


# ---- files -------------------------------------------------------------------------------------


def test_baseline_returns_every_bit_and_equal_reports_give_equal_bytes(
    healthy: CaseOutcome, tmp_path: Path
) -> None:
    (file,) = accept(report_of(healthy), REASON, tmp_path)
    once = file.read_bytes()
    baseline = read_baselines(tmp_path)[healthy.name]
    assert dump_baseline(baseline).encode() == once
    values = [quantity.value for quantity in baseline.levels["quick"].quantities]
    assert values == [verdict.value for verdict in healthy.verdicts]
    accept(compared(report_of(healthy), read_baselines(tmp_path)), REASON, tmp_path)
    assert file.read_bytes() == once


def test_recording_says_who_made_it_and_why(healthy: CaseOutcome, tmp_path: Path) -> None:
    accept(report_of(healthy), f"  {REASON}\n", tmp_path)
    by = read_baselines(tmp_path)[healthy.name].levels["quick"].by
    assert (by.reason, by.commit, by.processor) == (REASON, COMMIT, "one")
    assert by.command == "slipstick verify --level quick"
    assert by.libraries == {"numpy": "2.4.6"}


def test_levels_are_recorded_side_by_side(healthy: CaseOutcome, tmp_path: Path) -> None:
    for level in ("full", "quick"):
        accept(report_of(healthy).model_copy(update={"level": level}), REASON, tmp_path)
    assert list(read_baselines(tmp_path)[healthy.name].levels) == ["quick", "full"]


def test_missing_folder_holds_no_baseline(tmp_path: Path) -> None:
    assert read_baselines(tmp_path / "absent") == {}


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


def test_failures_and_changes_are_accepted_on_demand(healthy: CaseOutcome, tmp_path: Path) -> None:
    failing = report_of(shifted(healthy, "approach", 3.0, of="U"), changed=True)
    accept(failing, REASON, tmp_path, with_failures=True, with_changes=True)
    recorded = read_baselines(tmp_path)[healthy.name].levels["quick"]
    assert recorded.status is Status.FAIL
    assert recorded.by.changed


def test_only_the_named_cases_are_accepted(healthy: CaseOutcome, tmp_path: Path) -> None:
    other = healthy.model_copy(update={"name": "other"})
    (file,) = accept(report_of(healthy, other), REASON, tmp_path, ["other"])
    assert file.name == "other.json"


# ---- the report --------------------------------------------------------------------------------


def test_failure_line_says_since_when(healthy: CaseOutcome) -> None:
    case = compare(shifted(healthy, "approach", 3.0, of="U"), healthy)
    line = failure_line(case.name, find(case, "approach"), "quick")
    assert re.fullmatch(
        r"FAIL hertz_point/approach \[128x128, edge off\]: [\d.]+ µm, expected [\d.]+ µm ± "
        r"[\d.]+ µm "
        r"\([\d.]+ U\); was [\d.]+ µm at 1a2b3c4; "
        r"reproduce: slipstick verify hertz_point --level quick",
        line,
    )


def test_every_form_of_the_report_shows_what_changed(healthy: CaseOutcome) -> None:
    moved = with_counts(shifted(healthy, "approach", 3e-6), iterations=9999)
    report = compared(report_of(moved), baselines_of(report_of(healthy), REASON))
    total = sum(run.iterations for run in moved.runs)
    (counts, shift) = change_rows(report)
    assert (shift.name, shift.kind) == ("approach", ChangeKind.DRIFT)
    assert (counts.name, counts.now) == ("iterations", str(total))
    page, summary, junit = render_page(report), render_summary(report), render_junit(report)
    for text in (page, summary, junit):
        assert shift.was in text
        assert shift.now in text
        assert str(total) in text
    assert "1a2b3c4" in page
    assert "<b>this" not in page
    assert page.index("since the baseline") < page.index("<h2>Cases")
    suites = ElementTree.fromstring(junit.partition("\n")[2])
    assert suites.get("tests") == str(len(healthy.verdicts))
    assert suites.findall(".//failure") == []


def test_summary_stays_short_however_much_changed(healthy: CaseOutcome) -> None:
    many = [
        find(healthy, "approach").model_copy(update={"name": f"quantity_{n}", "run": "r" * 200})
        for n in range(500)
    ]
    case = healthy.model_copy(update={"verdicts": tuple(many)})
    report = compared(report_of(case), baselines_of(report_of(healthy), REASON))
    summary = render_summary(report)
    assert len(change_rows(report)) > 500
    assert len(summary.encode()) < 60_000
    assert f"and {len(change_rows(report)) - MOST_LINES} more" in summary


# ---- commands ----------------------------------------------------------------------------------


@pytest.mark.parametrize("level", [level.name.lower() for level in Level])
def test_report_is_compared_with_the_baseline_of_its_level(
    healthy: CaseOutcome, tmp_path: Path, capsys: pytest.CaptureFixture[str], level: str
) -> None:
    """Each level has numbers of its own, side by side in one file."""
    numbers = {"quick": 0.0, "standard": 1e-5, "full": 2e-5}
    report, baselines = tmp_path / "report", tmp_path / "baselines"
    report.mkdir()
    compare = ("maintain", "compare", report, "--baseline", baselines)
    for name, part in numbers.items():
        if name != level:
            write_report(at_level(name, shifted(healthy, "approach", part)), report)
            words = ("--because", REASON, "--from", report, "--to", baselines)
            assert slipstick("maintain", "baseline", "--accept", *words) == 0
    write_report(at_level(level, shifted(healthy, "approach", numbers[level])), report)
    capsys.readouterr()
    assert slipstick(*compare) == 5
    assert f"at level {level}; to record it" in capsys.readouterr().err
    assert slipstick("maintain", "baseline", "--accept", "--because", REASON, "--from", report,
                     "--to", baselines) == 0  # fmt: skip
    assert f"1 baselines of level {level}" in capsys.readouterr().out
    assert slipstick(*compare) == 0
    write_report(at_level(level, shifted(healthy, "approach", numbers[level] + 3e-6)), report)
    assert slipstick(*compare) == 5
    assert f"reproduce: slipstick verify hertz_point --level {level}" in capsys.readouterr().out
    assert list(read_baselines(baselines)[healthy.name].levels) == list(numbers)


def at_level(level: str, *cases: CaseOutcome) -> Report:
    return report_of(*cases).model_copy(update={"level": level})


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
    write_report(report_of(shifted(healthy, "approach", part)), report)
    assert slipstick("maintain", "compare", report, "--baseline", baselines) == code
    output = capsys.readouterr().out
    assert said in output
    assert ("reproduce: slipstick verify hertz_point" in output) == (code > 0)


def test_reports_are_compared_with_each_other(
    healthy: CaseOutcome, places: tuple[Path, Path], tmp_path: Path
) -> None:
    now = tmp_path / "now"
    now.mkdir()
    write_report(report_of(with_counts(healthy, iterations=9999)), now)
    assert slipstick("maintain", "compare", now, "--baseline", places[0] / RECORD) == 7
    assert slipstick("maintain", "compare", places[0] / RECORD, "--baseline", places[0]) == 0


def test_comparison_without_baseline_says_so_and_does_not_pass(
    places: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "none").mkdir()
    assert slipstick("maintain", "compare", places[0], "--baseline", tmp_path / "none") == 5
    captured = capsys.readouterr()
    assert "no baseline yet of level quick" in captured.out
    assert "nothing is recorded of these cases at level quick; to record it" in captured.err


@pytest.mark.skipif(sys.platform == "win32", reason="has no such queues")
def test_a_baseline_that_never_ends_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "hertz_point.json")
    with pytest.raises(BaselineRefused, match="is not a regular file"):
        read_baselines(tmp_path)


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


def test_verification_warns_of_drift_and_passes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    output, baselines = tmp_path / "out", tmp_path / "baselines"
    monkeypatch.setattr(baseline_files, "BASELINES", baselines)
    verify = ("verify", "dissimilar_bodies", "--output", output, "--studies", tmp_path)
    assert slipstick(*verify) == 0
    assert "no baseline yet" in capsys.readouterr().out
    accepted = (
        "maintain",
        "baseline",
        "--accept",
        "--with-changes",
        "--from",
        output,
        "--to",
        baselines,
    )
    assert slipstick(*accepted, "--because", "as computed") == 0
    file = baselines / "dissimilar_bodies.json"
    content = json.loads(file.read_text(encoding="utf-8"))
    for quantity in content["levels"]["quick"]["quantities"][:2]:
        quantity["allowed"] *= 1.05
    file.write_text(json.dumps(content), encoding="utf-8")
    capsys.readouterr()
    assert slipstick(*verify) == 0
    printed = capsys.readouterr().out
    assert len(re.findall(r"^WARN drift dissimilar_bodies/", printed, re.MULTILINE)) == 2
    assert slipstick("maintain", "compare", output) == 5


def test_acceptance_needs_its_reason(
    places: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    new = tmp_path / "new"
    assert slipstick("maintain", "baseline", "--accept", "--from", places[0], "--to", new) == 2
    assert "needs a reason" in capsys.readouterr().err
    assert (
        slipstick("maintain", "baseline", "--because=it is", "--from", places[0], "--to", new) == 2
    )
    assert not new.exists()
    words = ("--because", "it is right", "--from", places[0], "--to", new)
    assert slipstick("maintain", "baseline", "--accept", *words) == 0
    assert slipstick("maintain", "baseline", "--to", new) == 0
    listed = capsys.readouterr().out
    assert "it is right" in listed
    assert "1a2b3c4" in listed
