"""`slipstick verify` and `slipstick report` from end to end, on one small case."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from verification.report.files import PAGE, RECORD


def slipstick(*arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    root = Path(__file__).resolve().parents[1]
    code = f"import sys; sys.path.insert(0, {str(root)!r}); from slipstick.cli import main; main()"
    return subprocess.run(
        [sys.executable, "-c", code, *arguments],
        cwd=cwd, capture_output=True, text=True, check=False, timeout=120,
    )  # fmt: skip


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("verify")
    outcome = slipstick("verify", "dissimilar_bodies", "--output", "out/put", cwd=directory)
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr
    assert "dissimilar_bodies" in outcome.stderr
    assert f"report: {Path('out/put') / PAGE}" in outcome.stdout
    return directory / "out" / "put"


def test_one_case_is_verified_and_reported(made: Path) -> None:
    record = json.loads((made / RECORD).read_text(encoding="utf-8"))
    assert [case["name"] for case in record["cases"]] == ["dissimilar_bodies"]
    assert record["counts"]["fail"] == 0
    assert record["provenance"]["command"] == "slipstick verify dissimilar_bodies --level quick"


def test_report_is_rendered_again_from_its_record(made: Path) -> None:
    page = (made / PAGE).read_bytes()
    (made / PAGE).unlink()
    outcome = slipstick("report", str(made), cwd=made)
    assert outcome.returncode == 0, outcome.stderr
    assert (made / PAGE).read_bytes() == page


def test_cases_are_listed_without_solving(tmp_path: Path) -> None:
    outcome = slipstick("verify", "--list", cwd=tmp_path)
    assert outcome.returncode == 0
    assert "fretting_loop" in outcome.stdout
    assert list(tmp_path.iterdir()) == []


def test_unknown_case_is_refused_with_the_known_ones(tmp_path: Path) -> None:
    outcome = slipstick("verify", "herz", cwd=tmp_path)
    assert outcome.returncode == 2
    assert "herz" in outcome.stderr
    assert "hertz_point" in outcome.stderr
    assert list(tmp_path.iterdir()) == []


def test_missing_and_foreign_records_are_refused(tmp_path: Path) -> None:
    assert slipstick("report", str(tmp_path), cwd=tmp_path).returncode == 2
    (tmp_path / RECORD).write_text('{"other": 1}', encoding="utf-8")
    outcome = slipstick("report", str(tmp_path), cwd=tmp_path)
    assert outcome.returncode == 2
    assert "not a report that can be used" in outcome.stderr


def test_unwritable_output_is_refused_before_any_work(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    outcome = slipstick("verify", "load_paths", "--output", "file/report", cwd=tmp_path)
    assert outcome.returncode == 2
    assert "cannot write" in outcome.stderr
    assert "load_paths" not in outcome.stderr
