"""Every command that writes, into places that take nothing: an exit code and one error that says
why, and nothing half-written."""

import json
import os
import resource
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from command import outcome, succeeded
from report_examples import case, report_by, run_record
from scene_texts import STEEL_ON_STEEL

from verification.running.report_record import dump_report

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="limits and queues of Linux")

SCENE = f"""{STEEL_ON_STEEL}
[[loading]]
normal_force = 100
[semi_analytical]
cells = [16, 16]
edge = "off"
"""
QUICK = ("--figures", "none", "--no-error")
COMMANDS = {
    "run": ("run", "scene.toml", *QUICK, "-o"),
    "run, elements": ("run", "scene.toml", *QUICK, "--solver", "fem", "-o"),
    "run, radial": ("run", "scene.toml", *QUICK, "--solver", "radial", "-o"),
    "stress": ("stress", "scene.toml", "--figures", "none", "--no-error", "-o"),
    "limit": ("limit", "scene.toml", "--set", "body.material.yield_strength=1e9", "-o"),
    "challenge": ("challenge", "export", "hertz_point", "-o"),
    "judge": ("judge", "answered", "--page"),
    "export": ("export", "run", "-o"),
}
# These look where they write before they compute, and keep what is done where they are cut off.
LONG = {
    "verify": ("verify", "layered_identities", "--workers", "1", "-o"),
    "convergence": ("convergence", "scene.toml", "--levels", "4", "--workers", "1", "-o"),
    "baseline": (
        *("maintain", "baseline", "--accept", "--because", "so"),
        *("--from", "report.json", "--to"),
    ),
}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A scene, a run of it, a challenge that is answered, and a report."""
    folder = tmp_path_factory.mktemp("made")
    (folder / "scene.toml").write_text(SCENE, encoding="utf-8")
    succeeded("run", "scene.toml", *QUICK, "-o", "run", cwd=folder)
    export = ("challenge", "export", "hertz_point", "-o", "answered")
    succeeded(*export, cwd=folder)
    answers = folder / "answered" / "answers.json"
    content = json.loads(answers.read_text(encoding="utf-8"))
    content["solver"]["name"] = "theirs"
    content["levels"][0]["h"] = 1e-5
    content["levels"][0]["numbers"][0]["value"] = 1.0
    answers.write_text(json.dumps(content), encoding="utf-8")
    report = report_by(case("hertz_point", {"approach": (1.0, 1.0)}, run_record(32, None)))
    (folder / "report.json").write_text(dump_report(report), encoding="utf-8")
    return folder


@pytest.fixture
def place(made, tmp_path, monkeypatch):
    """A directory of one's own with links to all that; its output is to be `out`."""
    monkeypatch.setenv("SLIPSTICK_CACHE_DIR", str(tmp_path / "cache"))
    inside = tmp_path / "inside"
    inside.mkdir()
    for path in made.iterdir():
        (inside / path.name).symlink_to(path)
    return inside


def everything(folder: Path) -> dict[Path, bytes | None]:
    """Names and contents of what is there, plain files' contents only."""
    return {
        path: path.read_bytes() if path.is_file() and not path.is_symlink() else None
        for path in sorted(folder.rglob("*"))
    }


@contextmanager
def files_of_at_most(size: int) -> Iterator[None]:
    """As on a disk that has no more room."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


def in_the_way(kind: str, place: Path) -> str:
    """Put something where the output should go; its name for the command."""
    out = place / "out"
    if kind == "queue":
        os.mkfifo(out)
    elif kind == "loop":
        out.symlink_to("out")
    elif kind == "inside a loop":
        out.symlink_to("out")
        return "out/inside"
    elif kind == "below a file":
        out.write_text("mine", encoding="utf-8")
        return "out/inside"
    elif kind == "no name":
        return "a\0b"
    elif kind == "long":
        return 300 * "a"
    return "out"


@pytest.mark.parametrize(
    "kind", ["queue", "loop", "inside a loop", "below a file", "no name", "long"]
)
@pytest.mark.parametrize("words", (COMMANDS | LONG).values(), ids=COMMANDS | LONG)
def test_what_is_in_the_way_is_named_and_left_alone(words, kind, place):
    name = in_the_way(kind, place)
    before = everything(place)
    ended = outcome(*words, name, cwd=place)
    assert ended.returncode == 2, ended.stderr
    assert "No such option" not in ended.stderr
    assert everything(place) == before


@pytest.mark.parametrize("words", COMMANDS.values(), ids=COMMANDS)
def test_a_full_disk_ends_the_command_and_leaves_nothing(words, place):
    before = everything(place)
    with files_of_at_most(60):
        ended = outcome(*words, "out", cwd=place)
    assert ended.returncode == 4, ended.stderr
    assert "File too large" in ended.stderr
    assert everything(place) == before
