"""How studies run: records are kept, nothing is computed twice, a lost case costs only itself."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from study_cases import Dying, Number, Refusing, Square

from verification.studies.running.case_pool import CaseEnd, run_cases
from verification.studies.running.case_store import CaseStore, content_hash

ROOT = Path(__file__).resolve().parents[1]
STUDY = ("study", "coated-tractions", "--cells", "16", "--output", "out")


def command(*arguments: str) -> list[str]:
    code = (
        f"import sys; sys.path.insert(0, {str(ROOT)!r}); from verification.cli import main; main()"
    )
    return [sys.executable, "-c", code, *arguments]


def slipstick(*arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command(*arguments), cwd=cwd, capture_output=True, text=True, check=False, timeout=120
    )


def test_record_is_read_back_and_a_broken_one_is_not(tmp_path: Path) -> None:
    store, case = CaseStore(tmp_path), Square(3.0)
    assert store.load(case) is None
    store.save(case, Number(value=9.0, process=1))
    assert store.load(case) == Number(value=9.0, process=1)
    whole = store.path(case).read_text(encoding="utf-8")
    store.path(case).write_text(whole[: len(whole) // 2], encoding="utf-8")
    assert store.load(case) is None


def test_other_values_and_other_kinds_have_other_files() -> None:
    cases = Square(2.0), Square(3.0), Refusing(2.0)
    assert len({content_hash(case) for case in cases}) == 3
    assert content_hash(Square(2.0)) == content_hash(Square(2.0))


def test_failing_and_dying_cases_are_named_and_the_others_finish(tmp_path: Path) -> None:
    seen: list[CaseEnd] = []
    cases = (Square(1.0), Dying(10.0), Square(2.0), Refusing(20.0), Square(3.0), Square(4.0))
    ends = run_cases(cases, CaseStore(tmp_path), 2, seen.append)
    assert [end.case for end in ends] == list(cases)
    assert {end.case.name for end in seen} == {case.name for case in cases}
    values = {end.case.name: end.record.value for end in ends if isinstance(end.record, Number)}
    assert values == {"square-1": 1.0, "square-2": 4.0, "square-3": 9.0, "square-4": 16.0}
    lost = {end.lost.name: end.lost.reason for end in ends if end.lost is not None}
    assert lost == {
        "square-10": "its process died", "square-20": "ArithmeticError: no square today"
    }  # fmt: skip

    again = run_cases(cases[:1] + cases[2:3], CaseStore(tmp_path), 2, seen.append)
    assert all(end.stored for end in again)
    assert [end.record for end in again] == [ends[0].record, ends[2].record]


def test_cases_are_computed_elsewhere(tmp_path: Path) -> None:
    (end,) = run_cases([Square(5.0)], CaseStore(tmp_path), 1, lambda end: None)
    assert isinstance(end.record, Number)
    assert end.record.process != os.getpid()


@pytest.fixture(scope="module")
def killed_and_resumed(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, int]]:
    """A study that was killed after its first record, then run again; the records it had."""
    directory = tmp_path_factory.mktemp("study")
    cases = directory / "out" / "cases"
    process = subprocess.Popen(
        command(*STUDY, "--workers", "1"), cwd=directory, stderr=subprocess.DEVNULL
    )
    deadline = time.monotonic() + 60
    while not list(cases.glob("coated*.json")) and time.monotonic() < deadline:
        time.sleep(0.02)
    process.send_signal(signal.SIGKILL)
    process.wait()
    time.sleep(0.2)
    kept = {path.name: path.stat().st_mtime_ns for path in cases.glob("coated*.json")}
    assert 0 < len(kept) < 4
    assert not (directory / "out" / "study.json").exists()
    outcome = slipstick(*STUDY, cwd=directory)
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr
    assert outcome.stderr.count("already there") == len(kept)
    return directory / "out", kept


def test_killed_study_goes_on_where_it_stopped(
    killed_and_resumed: tuple[Path, dict[str, int]],
) -> None:
    out, kept = killed_and_resumed
    now = {path.name: path.stat().st_mtime_ns for path in (out / "cases").glob("coated*.json")}
    assert len(now) == 4
    assert now | kept == now


def test_study_leaves_page_record_figures_and_tables(
    killed_and_resumed: tuple[Path, dict[str, int]],
) -> None:
    out, _ = killed_and_resumed
    page = (out / "index.html").read_text(encoding="utf-8")
    assert "self-equilibrating shear" in page
    assert "<script" not in page
    assert 'http-equiv="Content-Security-Policy"' in page
    names = {path.name for path in (out / "figures").iterdir()}
    assert names == {
        f"{figure}.{kind}"
        for figure in ("figure_3_pressure", "figure_4_shear") for kind in ("png", "svg")
    }  # fmt: skip
    table = (out / "profiles.csv").read_text(encoding="utf-8").splitlines()
    assert table[0] == "E1_over_E2,T_over_muW,x_over_aH,p_over_pH,qx_over_mu_pH"
    assert len(table) == 1 + 4 * 4 * 16


def test_studies_are_listed_and_mistakes_are_refused(tmp_path: Path) -> None:
    listed = slipstick("study", "--list", cwd=tmp_path)
    assert listed.returncode == 0
    assert "gross-sliding" in listed.stdout
    unknown = slipstick("study", "gross-slidin", cwd=tmp_path)
    assert unknown.returncode == 2
    assert "coated-tractions" in unknown.stderr
    assert slipstick("study", "gross-sliding", "--cells", "33", cwd=tmp_path).returncode == 2
    assert list(tmp_path.iterdir()) == []
