"""Where SLIPSTICK_NO_SKIP=1, a skipped test fails the run: CI has every package installed."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

CONFTEST = Path(__file__).with_name("conftest.py")

SKIPPED = {
    "in the test": "def test_it(): pytest.importorskip('no_such_package')",
    "by a mark": "@pytest.mark.skip(reason='tired')\ndef test_it(): pass",
    "with its module": "pytest.importorskip('no_such_package')\ndef test_it(): pass",
}
EXPECTED_FAILURE = "@pytest.mark.xfail\ndef test_it(): assert 0"


def run_pytest(folder: Path, source: str, no_skip: str) -> subprocess.CompletedProcess[str]:
    (folder / "conftest.py").write_text(CONFTEST.read_text(encoding="utf-8"), encoding="utf-8")
    (folder / "test_planted.py").write_text(f"import pytest\n{source}\n", encoding="utf-8")
    return subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "--rootdir", folder, folder],
        env=os.environ | {"SLIPSTICK_NO_SKIP": no_skip},
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize("source", SKIPPED.values(), ids=SKIPPED)
def test_skip_fails_where_forbidden(tmp_path: Path, source: str) -> None:
    outcome = run_pytest(tmp_path, source, no_skip="1")
    assert outcome.returncode != 0
    assert "skipped although SLIPSTICK_NO_SKIP=1" in outcome.stdout


def test_skip_is_harmless_elsewhere(tmp_path: Path) -> None:
    outcome = run_pytest(tmp_path, SKIPPED["by a mark"], no_skip="")
    assert outcome.returncode == 0, outcome.stdout


def test_expected_failure_is_no_skip(tmp_path: Path) -> None:
    outcome = run_pytest(tmp_path, EXPECTED_FAILURE, no_skip="1")
    assert outcome.returncode == 0, outcome.stdout
