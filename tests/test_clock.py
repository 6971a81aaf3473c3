"""Clocks that jump, and files of 1970 or of the next century: no number and no file depends on
what time it is."""

import itertools
import os
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from command import outcome

PUSHED = """[[loading]]
tangential_force = ["60 N", 0]
increments = 2
"""
SCENE = f"""
[indenter]
shape = "sphere"
radius = "18 mm"
material = "rigid"
[body]
material = {{ young_modulus = "210 GPa", poisson_ratio = 0.3 }}
[friction]
coefficient = 0.1
[[loading]]
normal_force = "1 kN"
{PUSHED}[semi_analytical]
cells = [16, 16]
edge = "off"
"""
YEAR = 3.15e7
AGES = {"1970": 1.0, "before 1970": -YEAR, "the next century": 4.2e9, "far ahead": 3e10}


def jumping(*jumps: float) -> Callable[[], float]:
    """A clock that is set by so much, again and again, whenever it is looked at."""
    steps, now = itertools.cycle(jumps), [1e9]

    def clock() -> float:
        now[0] += next(steps)
        return now[0]

    return clock


CLOCKS = {
    "forward by years": jumping(YEAR),
    "back by years": jumping(-YEAR),
    "to and fro": jumping(-3 * YEAR, 0.0, 5 * YEAR, -YEAR, 1e-3),
    "standing still": jumping(0.0),
}


def set_clocks(monkeypatch: pytest.MonkeyPatch, clock: Callable[[], float]) -> None:
    for name in ("time", "monotonic", "perf_counter", "process_time"):
        monkeypatch.setattr(time, name, clock)


def files(directory: Path) -> dict[str, bytes]:
    paths = (path for path in directory.rglob("*") if path.is_file())
    return {path.name: path.read_bytes() for path in paths if path.name != "timing.json"}


@pytest.fixture(scope="module")
def expected(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    return run(tmp_path_factory.mktemp("expected"), "--figures", "none")


def run(directory: Path, *options: str, scene: str = SCENE) -> dict[str, bytes]:
    (directory / "scene.toml").write_text(scene, encoding="utf-8")
    ended = outcome("run", "scene.toml", "-o", "out", "--no-error", *options, cwd=directory)
    assert ended.returncode == 0, ended.stderr
    assert {path.name for path in directory.iterdir()} == {"scene.toml", "out"}
    return files(directory / "out")


@pytest.fixture(autouse=True)
def _no_cache(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its hits are counted in the results."""
    monkeypatch.setenv("SLIPSTICK_CACHE_DIR", os.devnull)


@pytest.mark.parametrize("name", CLOCKS)
def test_a_run_writes_the_same_bytes_whatever_the_clocks_do(
    name: str, expected: dict[str, bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    set_clocks(monkeypatch, CLOCKS[name])
    assert run(tmp_path, "--figures", "none") == expected


@pytest.mark.parametrize("age", AGES)
def test_what_a_run_finds_may_be_of_any_time(
    age: str, expected: dict[str, bytes], tmp_path: Path
) -> None:
    """Results of before, a lock that nobody holds, and what a killed run has left."""
    run(tmp_path, "--figures", "none")
    (tmp_path / ".out.in-use").write_text("process 1 on nowhere", encoding="utf-8")
    (tmp_path / "out" / ".out.partial-0").mkdir()
    for path in (tmp_path, *tmp_path.rglob("*")):
        os.utime(path, (AGES[age], AGES[age]))
    assert run(tmp_path, "--figures", "none") == expected
