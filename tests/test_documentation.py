"""Tests of README and documentation: named files, commands, options, cases and studies exist."""

import json
import lzma
import re
import resource
import shlex
import subprocess
import sys
from pathlib import Path
from runpy import run_path

import pytest
from command import slipstick, succeeded
from docutils.utils.smartquotes import smartyPants

from slipstick.cli.application import ALL_COMMANDS, MAINTAIN
from verification.cases.catalogue import CASES
from verification.studies.catalogue import STUDIES

ROOT = Path(__file__).resolve().parents[1]
README = ROOT / "README.md"
PAGES = (README, *sorted((ROOT / "docs").rglob("*.md")))
WRITTEN = [page for page in PAGES if "made" not in page.relative_to(ROOT).parts]
REPORT = json.loads(lzma.decompress((ROOT / "reports/full/report.json.xz").read_bytes()))
# Case, quantity, part of the names of the runs and largest error, in a row of a table.
JUDGED = re.compile(r"\| `(\w+)` \| `([\w.]+)` \| ([^|]+) \| (\S+) \|$", re.MULTILINE)
ERRORS = [row for page in PAGES for row in JUDGED.findall(page.read_text(encoding="utf-8"))]
PLACEHOLDER = re.compile(r"SCENE|COMMAND|CASE|NAME|DIR|\$h|^tcp:|…")


def text_of(page: Path) -> str:
    return page.read_text(encoding="utf-8").replace("\\\n", " ")


def calls(page: Path) -> list[list[str]]:
    """Every call of slipstick in an indented block or between backticks, without its remark."""
    text = text_of(page)
    found = re.findall(r"^ {4,}(?:\.venv/bin/)?slipstick +(.+)$", text, re.MULTILINE)
    found += re.findall(r"`slipstick ([a-z][^`]*)`", text)
    return [shlex.split(call, comments=True) for call in found]


CALLS = [(page, words) for page in WRITTEN for words in calls(page)]


@pytest.mark.parametrize(
    ("page", "words"), CALLS, ids=[f"{p.stem}: {' '.join(w)}" for p, w in CALLS]
)
def test_commands_of_the_pages_are_known(page, words):
    name, *rest = words[words[0] == MAINTAIN :]
    command = ALL_COMMANDS[" ".join(words[: len(words) - len(rest)])].load(name)
    options = {o for p in command.params for o in (*p.opts, *p.secondary_opts)} | {"--help", "-h"}
    assert {word for word in rest if word.startswith("-")} <= options
    for word in rest:
        if re.fullmatch(r"[\w/]+\.toml", word):
            assert (ROOT / word).is_file()
    if rest and name == "study" and not rest[0].startswith("-"):
        assert PLACEHOLDER.search(rest[0]) or rest[0] in STUDIES
    if rest and name == "verify" and not rest[0].startswith("-"):
        assert PLACEHOLDER.search(rest[0]) or rest[0] in CASES


def test_the_hyphens_of_an_option_do_not_become_a_dash(monkeypatch):
    monkeypatch.setattr(sys, "path", [*sys.path])  # which the settings extend
    settings = run_path(str(ROOT / "docs" / "conf.py"))
    text = "the option --set"
    assert smartyPants(text, settings.get("smartquotes_action", "qDe")) == text


@pytest.mark.parametrize("name", ALL_COMMANDS)
def test_no_word_of_a_help_is_clipped(name, tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    assert "…" not in succeeded(*name.split(), "--help", cwd=tmp_path).stdout


@pytest.mark.parametrize(("case", "quantity", "run", "error"), ERRORS)
def test_errors_of_the_pages_are_those_of_the_stored_report(case, quantity, run, error):
    verdicts = next(one["verdicts"] for one in REPORT["cases"] if one["name"] == case)
    named = [v for v in verdicts if v["name"] == quantity and run in v["run"]]
    assert f"{max(v['error'] for v in named if 'edge off' not in v['run']):.2g}" == error


def test_the_result_of_the_readme_is_computed(tmp_path):
    number = r"`(\S+) ± (\S+)`"
    stated = rf"`slipstick run (\S+)`.* approach {number} µm, peak pressure {number}\s+GPa"
    scene, *numbers = re.search(stated, text_of(README)).groups()
    assert slipstick("run", ROOT / scene, "-o", tmp_path, "--figures", "none") == 0
    end = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))["steps"][-1]
    for name, unit in (("approach", 1e-6), ("peak_pressure", 1e9)):
        for found in (end[name], end["errors"][name]["error"]):
            assert found / unit == pytest.approx(float(numbers.pop(0)), abs=2e-7)


@pytest.mark.slow
def test_durations_of_the_readme_are_of_their_order_of_magnitude(tmp_path):
    """CPU seconds of a process each, in the order of the page, as later ones read what earlier ones
    wrote."""
    stated = re.findall(
        r"^ {4}\.venv/bin/slipstick +(.+?) +# +(\d+) s ", text_of(README), re.MULTILINE
    )
    assert len(stated) >= 9
    for call, seconds in stated:
        words = [re.sub(r"^out/", f"{tmp_path}/", word) for word in shlex.split(call)]
        before = children_cpu()
        subprocess.run(
            [sys.executable, "-m", "slipstick", *words], cwd=ROOT, check=True, capture_output=True
        )
        spent = children_cpu() - before
        assert int(seconds) / 8 <= spent <= 8 * int(seconds), f"{call}: {spent:.1f} CPU s"


def children_cpu() -> float:
    """CPU seconds of the processes that this one has waited for."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


@pytest.mark.parametrize("page", WRITTEN, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_links_to_files_lead_somewhere(page):
    targets = re.findall(r"\]\(([^)#\s]+)[^)]*\)", text_of(page))
    inside = [target for target in targets if not target.startswith(("http", "mailto"))]
    assert [target for target in inside if not (page.parent / target).exists()] == []


def test_the_picture_is_small():
    assert (ROOT / "docs" / "coated_contact.png").stat().st_size <= 150_000


def test_the_navigation_has_its_colours_at_every_width():
    """The theme moves it to the top, on a dark ground, below the width of its page."""
    found = re.search(r'"page_width": "(\d+px)"', text_of(ROOT / "docs/conf.py"))
    assert found
    assert f"(max-width: {found[1]})" in text_of(ROOT / "docs/_static/custom.css")
