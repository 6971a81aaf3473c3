"""Where SLIPSTICK_NO_SKIP=1, a skipped test fails the run: CI has every package installed."""

import os
import re
import subprocess
import sys
from pathlib import Path

CONFTEST = Path(__file__).with_name("conftest.py")

SKIPPED = {
    "in_the_test": "def test_it(): pytest.importorskip('no_such_package')",
    "by_a_mark": "@pytest.mark.skip(reason='tired')\ndef test_it(): pass",
    "with_its_module": "pytest.importorskip('no_such_package')\ndef test_it(): pass",
}
EXPECTED_FAILURE = {"expected": "@pytest.mark.xfail\ndef test_it(): assert 0"}


def run_pytest(folder: Path, sources: dict[str, str], no_skip: str) -> str:
    """What it says at its end, test by test, of a module of each source."""
    (folder / "conftest.py").write_text(CONFTEST.read_text(encoding="utf-8"), encoding="utf-8")
    for name, source in sources.items():
        (folder / f"test_{name}.py").write_text(f"import pytest\n{source}\n", encoding="utf-8")
    return subprocess.run(
        [sys.executable, "-m", "pytest", "-rA", "--continue-on-collection-errors",
         "-p", "no:cacheprovider", "--rootdir", folder, folder],
        env=os.environ | {"SLIPSTICK_NO_SKIP": no_skip},
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    ).stdout  # fmt: skip


def test_skip_fails_where_forbidden_and_an_expected_failure_is_none(tmp_path: Path) -> None:
    said = run_pytest(tmp_path, SKIPPED | EXPECTED_FAILURE, no_skip="1")
    for name in SKIPPED:
        assert re.search(rf"^(FAILED|ERROR) test_{name}\.py", said, re.MULTILINE), said
    assert said.count("skipped although SLIPSTICK_NO_SKIP=1") >= len(SKIPPED)
    assert "XFAIL test_expected.py" in said
    assert re.search(r"^=+ 1 failed, 1 xfailed, 2 errors in", said, re.MULTILINE), said
