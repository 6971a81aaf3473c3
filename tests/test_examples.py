"""Tests of the scripts in examples/ and in the README: each runs and exits with code 0.

The script of the README runs on few cells and increments. Lines that take long are left out where
other tests run the same on coarse cells.
"""

import json
import re
import subprocess
import sys
from contextlib import chdir
from pathlib import Path
from runpy import run_path
from types import SimpleNamespace

import pytest
from command import outcome

ROOT = Path(__file__).resolve().parents[1]
sys.path.append(str(ROOT / "docs"))

from gallery_claims import SCENES, Claim, Comparison, Verdict  # noqa: E402
from gallery_entries import ENTRIES  # noqa: E402
from made_gallery import UnexpectedVerdict, refuse_unexpected  # noqa: E402
from made_notebooks import notebook  # noqa: E402

EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
LONG = ("granular_path",)
LEFT_OUT = {
    "critical_load": 'report("coated", coated)\n',
    "contact_stiffness": 'report("coated", bare.model_copy(update={"body": film}))\n',
}


def assert_runs(script: Path, folder: Path) -> None:
    with chdir(folder):
        try:
            run_path(str(script), run_name="__main__")
        except SystemExit as end:
            if end.code:
                raise


@pytest.mark.parametrize(
    "script",
    [
        pytest.param(path, id=path.stem, marks=[pytest.mark.slow] * (path.stem in LONG))
        for path in EXAMPLES
    ],
)
def test_example_keeps_its_promise(script, tmp_path, monkeypatch):
    """Commands of a script run in this process: the import of one takes longer than the command."""
    run = subprocess.run

    def run_here(words, **how):
        own = words[1:3] == ["-m", "slipstick"]
        return outcome(*words[3:], cwd=tmp_path) if own else run(words, **how)

    monkeypatch.setattr(subprocess, "run", run_here)
    if left_out := LEFT_OUT.get(script.stem):
        before, _, after = script.read_text(encoding="utf-8").partition(left_out)
        script = tmp_path / script.name
        script.write_text(before + after, encoding="utf-8")
        assert after
    assert_runs(script, tmp_path)


def test_python_in_the_readme_runs(tmp_path):
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"^```python\n(.*?)^```", readme, re.MULTILINE | re.DOTALL)
    for fine, coarse in (
        ("cells=(64, 64)", "cells=(16, 16)"),
        ("increments=6", "increments=1"),
        ("normal_force=50.0", "normal_force=50.0, increments=2"),
    ):
        assert fine in block
        block = block.replace(fine, coarse)
    script = tmp_path / "readme.py"
    script.write_text(block, encoding="utf-8")
    assert_runs(script, tmp_path)


# ---- gallery


def test_every_scene_of_the_gallery_has_its_page():
    assert {path.stem for path in SCENES.glob("*.toml")} == {entry.scene for entry in ENTRIES}
    assert len(ENTRIES) >= 12
    assert all(entry.claims for entry in ENTRIES)


def claim(published: float, reading: float, verdict: Verdict = Verdict.AGREES) -> Claim:
    return Claim(
        "a number", "somebody", published, reading, lambda solved: (1.0, 0.01), "", 1.0, (), verdict
    )


@pytest.mark.parametrize(
    ("published", "reading", "error", "verdict"),
    [
        (1.02, 0.0, 0.019, Verdict.DIFFERS),
        (1.02, 0.002, 0.019, Verdict.AGREES),
        (1.02, 0.0, 0.021, Verdict.AGREES),
        (1.02, 0.0, 0.2, Verdict.INCONCLUSIVE),
        (1.21, 0.0, 0.2, Verdict.DIFFERS),
        (1.02, 0.0, float("inf"), Verdict.INCONCLUSIVE),
    ],
)
def test_numbers_agree_within_what_both_may_be_off(published, reading, error, verdict):
    assert Comparison(claim(published, reading), 1.0, error).verdict is verdict


def test_another_verdict_than_the_page_speaks_of_is_refused():
    one = Comparison(claim(2.0, 0.1), 1.0, 0.01)
    with pytest.raises(
        UnexpectedVerdict, match=r"ours 1 ± 0\.01, somebody 2 .*differs, expected: agrees"
    ):
        refuse_unexpected(ENTRIES[0], [one])


def code_of(entry) -> list[str]:
    contents = json.loads(notebook(entry))
    assert (contents["nbformat"], contents["nbformat_minor"]) == (4, 5)
    assert len({cell["id"] for cell in contents["cells"]}) == len(contents["cells"])
    return ["".join(c["source"]) for c in contents["cells"] if c["cell_type"] == "code"]


@pytest.mark.parametrize("entry", ENTRIES, ids=lambda entry: entry.scene)
def test_every_notebook_holds_its_scene_and_code_that_compiles(entry):
    cells = code_of(entry)
    for cell in cells:
        compile(cell, entry.scene, "exec")
    names = {}
    exec(cells[0], names)
    assert names["SCENE"] == (SCENES / f"{entry.scene}.toml").read_text(encoding="utf-8")


def test_a_notebook_solves_its_scene_and_shows_its_figures(tmp_path, monkeypatch, capsys):
    shown = []
    stub = SimpleNamespace(Image=lambda path: path, display=shown.append)
    monkeypatch.setitem(sys.modules, "IPython.display", stub)
    monkeypatch.chdir(tmp_path)
    names = {}
    for cell in code_of(next(entry for entry in ENTRIES if entry.scene == "paper_ball")):
        exec(cell, names)
    assert {path.name for path in shown} >= {"overview.png", "profiles.png"}
    assert "peak_pressure: 3168" in capsys.readouterr().out
