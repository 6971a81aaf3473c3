"""Fields beyond what memory holds go into a file of TMPDIR: what happens where it cannot grow, or
there is no such folder, or the run is killed."""

import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from command import outcome

from contact_scene import stored_fields

resource = pytest.importorskip("resource")

SCENE = """
[indenter]
shape = "sphere"
radius = "18 mm"
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[body]
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[friction]
coefficient = 0.1
[[loading]]
normal_force = "1 kN"
[[loading]]
tangential_force = ["60 N", 0]
increments = 4
[semi_analytical]
cells = [32, 32]
"""
RUNS = {
    "run": ("run", "scene.toml", "-o", "out", "--figures", "none"),
    "to an accuracy": ("run", "scene.toml", "-o", "out", "--figures", "none", "--accuracy", "20%"),
    "stress": ("stress", "scene.toml", "-o", "out", "--figures", "none"),
}


@pytest.fixture(autouse=True)
def _everything_is_spilled(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[None]:
    monkeypatch.setattr(stored_fields, "MOST_HELD", 0)
    monkeypatch.setenv("SLIPSTICK_CACHE_DIR", "")
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))
    (tmp_path / "temporary").mkdir()
    (tmp_path / "scene.toml").write_text(SCENE, encoding="utf-8")
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, limits)


def left(folder: Path) -> list[str]:
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


@pytest.mark.parametrize("words", RUNS.values(), ids=RUNS)
def test_a_file_that_cannot_grow_is_told_and_nothing_is_left(
    words: tuple[str, ...], tmp_path: Path
) -> None:
    _, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, hard))  # five fields
    ended = outcome(*words, cwd=tmp_path)
    assert ended.returncode == 4
    (told,) = (line for line in ended.stderr.splitlines() if line.startswith("error"))
    assert f"{tmp_path / 'temporary'} (TMPDIR), for the fields of increments: " in told
    assert left(tmp_path) == ["scene.toml", "temporary"]
