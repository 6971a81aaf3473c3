"""One process at a time makes the results of a directory, and nothing dead stands in its way."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from command import slipstick
from scene_texts import STEEL_ON_STEEL

from contact_results.directory.refusal import OutputRefused
from contact_results.directory.run_directory import run_directory
from contact_results.directory.sole_use import in_sole_use

ROOT = Path(__file__).resolve().parents[1]
SCENE = f"""{STEEL_ON_STEEL}
[[loading]]
normal_force = 100
[semi_analytical]
cells = [16, 16]
"""
HOLD = """
import sys, time
from pathlib import Path
from contact_results.directory.sole_use import in_sole_use

with in_sole_use(Path(sys.argv[1])):
    print("held", flush=True)
    time.sleep(100)
"""


def entered(target: Path) -> bool:
    try:
        with run_directory(target):
            return True
    except OutputRefused:
        return False


@pytest.fixture(params=[True, False], ids=["there", "not there yet"])
def target(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    target = tmp_path / "out"
    if request.param:
        target.mkdir()
    return target


def test_second_run_is_refused_and_told_of_the_first(target: Path) -> None:
    with run_directory(target):
        with pytest.raises(OutputRefused, match=f"in use by process {os.getpid()} on"):
            run_directory(target).__enter__()
        target.mkdir(exist_ok=True)  # by somebody else: the first one's lock is beside it
        assert not entered(target)
    assert entered(target)
    assert [path.name for path in target.parent.rglob("*")] == ["out"]


def test_lock_of_a_dead_process_stops_nobody(target: Path) -> None:
    holder = subprocess.Popen(
        [sys.executable, "-c", HOLD, target], cwd=ROOT, stdout=subprocess.PIPE, text=True
    )
    assert holder.stdout is not None
    assert holder.stdout.readline() == "held\n"
    assert not entered(target)
    holder.send_signal(signal.SIGKILL)
    holder.communicate()
    assert list(target.parent.rglob(".out.in-use"))
    target.mkdir(exist_ok=True)
    assert entered(target)
    assert [path.name for path in target.parent.rglob("*")] == ["out"]


def test_of_many_at_a_time_one_is_let_in(tmp_path: Path) -> None:
    inside, most, done = 0, 0, 0

    def try_again_and_again() -> None:
        nonlocal inside, most, done
        for _ in range(100):
            try:
                with in_sole_use(tmp_path):
                    inside += 1
                    time.sleep(0)
                    most = max(most, inside)
                    inside -= 1
                    done += 1
            except OutputRefused:
                pass

    threads = [threading.Thread(target=try_again_and_again) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert most == 1
    assert done > 0
    assert [*tmp_path.iterdir()] == []


@pytest.mark.parametrize(
    "command",
    [("run", "scene.toml"), ("run", "scene.toml", "--solver=fem"), ("verify", "layered_identities"),
     ("maintain", "study", "sampling", "scene.toml"), ("maintain", "study", "stability")],
    ids=" ".join,
)  # fmt: skip
def test_commands_leave_a_directory_in_use_alone(
    command: tuple[str, ...],
    target: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(target.parent)
    Path("scene.toml").write_text(SCENE, encoding="utf-8")
    with in_sole_use(target):
        assert slipstick(*command, "--output", target) == 2
    errors = capsys.readouterr().err
    assert errors.count("error: ") == errors.count("\n") == 1
    assert f"{target} is in use by process {os.getpid()} on" in errors
    assert not target.exists() or [*target.iterdir()] == []
