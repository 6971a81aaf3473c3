"""`slipstick verify` and `slipstick maintain report` from end to end, on one small case."""

import json
from pathlib import Path

import pytest
from command import outcome

from verification.report.files import PAGE, RECORD


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("verify")
    ended = outcome("verify", "dissimilar_bodies", "--output", "out/put", cwd=directory)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert "dissimilar_bodies" in ended.stderr
    assert f"report: {Path('out/put') / PAGE}" in ended.stdout
    return directory / "out" / "put"


def test_one_case_is_verified_and_reported(made: Path) -> None:
    record = json.loads((made / RECORD).read_text(encoding="utf-8"))
    assert [case["name"] for case in record["cases"]] == ["dissimilar_bodies"]
    assert record["counts"]["fail"] == 0
    assert record["provenance"]["command"] == "slipstick verify dissimilar_bodies --level quick"


def test_report_is_rendered_again_from_its_record(made: Path) -> None:
    page = (made / PAGE).read_bytes()
    (made / PAGE).unlink()
    ended = outcome("maintain", "report", str(made), cwd=made)
    assert ended.returncode == 0, ended.stderr
    assert (made / PAGE).read_bytes() == page


def test_cases_are_listed_without_solving(tmp_path: Path) -> None:
    ended = outcome("verify", "--list", cwd=tmp_path)
    assert ended.returncode == 0
    assert "fretting_loop" in ended.stdout
    assert list(tmp_path.iterdir()) == []


def test_unknown_case_is_refused_with_the_known_ones(tmp_path: Path) -> None:
    ended = outcome("verify", "herz", cwd=tmp_path)
    assert ended.returncode == 2
    assert "herz" in ended.stderr
    assert "hertz_point" in ended.stderr
    assert list(tmp_path.iterdir()) == []
