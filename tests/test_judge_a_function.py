"""Tests of `slipstick judge FILE.py:FUNCTION --case CASE`: exit codes and refusals."""

import signal
import sys
import time
from pathlib import Path

import pytest
from command import slipstick
from processes import begun, ended, has_ended

from contact_results.directory.atomic_file import Refused
from verification import Answer, SolverFailed
from verification import judge as judge_function
from verification.challenge.python_api import posed
from verification.challenge.solver_process import named_solver
from verification.problems.problem import HERTZ

# A solver function that imports the problem would import all solvers, in each child process.
CONSTANTS = f"""
APPROACH = {HERTZ.approach!r}
RADIUS = {HERTZ.contact_radius!r}
PEAK = {HERTZ.peak_pressure!r}
"""


def judge(*arguments):
    return slipstick("judge", *arguments)


# ---- functions that leave, hang or change what they are given -----------------------------------

HOSTILE = (
    CONSTANTS
    + """
import os, signal, subprocess, sys, threading, time
from pathlib import Path
import numpy as np
from verification import Answer, Field

def right(level, **more):
    values = {("approach", 1): APPROACH, ("contact_radius", 1): RADIUS}
    return Answer(1e-5 / 2**level, values, **more)

def leaves(problem, level):
    print("diverged", flush=False)
    os._exit(0)

def leaves_late(problem, level):
    return right(level) if level < 1 else os._exit(7)

def exits(problem, level):
    sys.exit(0)

def interrupts(problem, level):
    raise KeyboardInterrupt

def killed(problem, level):
    os.kill(os.getpid(), signal.SIGKILL)

def is_ended(problem, level):
    os.kill(os.getpid(), signal.SIGXCPU)

def has_no_memory(problem, level):
    raise MemoryError("grid")

def is_endless(problem, level):
    while True:
        pass

def waits_for_its_child(problem, level):
    child = subprocess.Popen(["sleep", "1000"])
    Path("child").write_text(str(child.pid))
    child.wait()

def leaves_its_child(problem, level):
    if os.fork() == 0:
        Path("child").write_text(str(os.getpid()))
        time.sleep(1000)
    while not (Path("child").exists() and Path("child").read_text()):
        time.sleep(0.01)
    os._exit(0)

def cannot_be_sent(problem, level):
    return right(level, unknowns=lambda: 3)

def closes_all(problem, level):
    os.closerange(3, 1000)
    time.sleep(0.1)
    return right(level)

def complex_number(problem, level):
    return Answer(1e-5, {("approach", 1): np.complex128(APPROACH)})

def yields(problem, level):
    yield right(level)

def iterates(problem, level):
    return Answer(1e-5, ((("approach", 1), APPROACH) for _ in range(1)))

def bare_field(problem, level):
    return right(level, fields={("pressure", 1): np.zeros(3)})

def changes_the_problem(problem, level):
    material = problem.scene["body"]["material"]
    material["young_modulus"] *= 2
    problem.asked.clear()
    expected = 2 * YOUNG
    return right(level) if material["young_modulus"] == expected else None

def changes_its_answer(problem, level, kept=[Answer(1e-5, {})]):
    kept[0].scalars.update(right(level).scalars)
    if level:
        kept[0].scalars["approach", 1] *= 2
    return kept[0]

def keeps_a_thread(problem, level):
    threading.Thread(target=time.sleep, args=(1000,)).start()
    return right(level)

def doubles_itself(problem, level):
    os.fork()
    return right(level)

class Own(Answer):
    pass

def own_type(problem, level):
    return Own(1e-5 / 2**level, right(level).scalars, seconds=np.float32(1))

def is_huge(problem, level):
    n = 1500
    x, y = np.meshgrid(*2 * [np.linspace(-1, 1, n) * 2 * RADIUS])
    pressure = PEAK * np.sqrt(np.maximum(1 - (x**2 + y**2) / RADIUS**2, 0))
    area = np.full(n * n, (x[0, 1] - x[0, 0]) ** 2)
    return right(level, fields={("pressure", 1): Field(x, y, pressure, area)})
"""
)
FAILED = {
    "leaves": "ended without an answer on level 0: exit code 0",
    "leaves_late": "ended without an answer on level 1: exit code 7",
    "exits": "raised an exception on level 0:.*SystemExit: 0",
    "interrupts": "raised an exception on level 0:.*KeyboardInterrupt",
    "killed": "level 0: SIGKILL, which the system sends for lack of memory",
    "is_ended": "level 0: SIGXCPU",
    "has_no_memory": "MemoryError: grid",
    "waits_for_its_child": "gave no answer on level 0 within 1 s",
    "leaves_its_child": "ended without an answer on level 0: exit code 0",
    "cannot_be_sent": "raised an exception on level 0:.*pickle",
    "closes_all": "ended without an answer on level 0",
}
REFUSED = {
    "complex_number": "expected a number",
    "yields": "generator came back, expected an Answer",
    "iterates": "scalars is .*, expected a mapping",
    "bare_field": "is ndarray, expected a Field",
}
JUDGED = ("changes_the_problem", "keeps_a_thread", "doubles_itself", "own_type", "is_huge")


@pytest.fixture
def hostile(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", list(sys.path))
    young = posed("hertz_point").scene["body"]["material"]["young_modulus"]
    Path("hostile.py").write_text(f"{HOSTILE}\nYOUNG = {young!r}\n")
    return Path("hostile.py")


on_linux = pytest.mark.skipif(sys.platform != "linux", reason="functions in memory need fork")


@on_linux
@pytest.mark.parametrize("name", [*FAILED, *REFUSED])
def test_function_without_an_answer_fails_by_name(hostile, name):
    solve = named_solver(f"{hostile}:{name}")
    error, said = (SolverFailed, FAILED) if name in FAILED else (Refused, REFUSED)
    seconds = 1.0 if "within" in said[name] else 60.0
    with pytest.raises(error, match=f"(?s){said[name]}"):
        judge_function("hertz_point", solve, 2, seconds=seconds)
    if Path("child").exists():
        assert has_ended(int(Path("child").read_text()))


@on_linux
@pytest.mark.parametrize("name", JUDGED)
def test_function_cannot_change_what_is_judged(hostile, name):
    found = judge_function("hertz_point", named_solver(f"{hostile}:{name}"), 2, "A")
    assert found.exit_code() == 0, found.rows
    assert all(type(answer) is Answer for answer in found.answers)


@pytest.mark.parametrize("seconds", [None, 60.0])
def test_answer_changed_on_a_later_level_is_judged_as_it_was(hostile, seconds):
    solve = named_solver(f"{hostile}:changes_its_answer")
    found = judge_function("hertz_point", solve, 2, seconds=seconds)
    values = [answer.value(("approach", 1)) for answer in found.answers]
    assert values == [HERTZ.approach, 2 * HERTZ.approach]


@pytest.mark.parametrize(
    ("name", "seconds", "code", "said"),
    [
        ("leaves", 60, 3, "diverged"),
        ("is_endless", 1, 3, "gave no answer on level 0 within 1 s"),
        ("changes_the_problem", 60, 0, "hertz_point"),
    ],
)
def test_command_survives_the_function(hostile, capfd, name, seconds, code, said):
    """And what the function has printed before its end is shown."""
    case = ("--case", "hertz_point", "--levels", "2", "--seconds", seconds)
    assert judge(f"{hostile}:{name}", *case) == code
    told = capfd.readouterr()
    assert said in told.out + told.err


def test_file_that_leaves_while_it_is_imported_fails(hostile, capfd):
    hostile.write_text("import os\nos._exit(0)\n")
    assert judge(f"{hostile}:right", "--case", "hertz_point") == 3
    assert "ended without an answer on level 0: exit code 0" in capfd.readouterr().err


@on_linux
@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGKILL, -9)])
def test_function_ends_with_the_command(hostile, number, code):
    with hostile.open("a") as file:
        file.write(
            "def endless(problem, level):\n"
            "    Path('child').write_text(str(os.getpid()))\n"
            "    while True:\n"
            "        pass\n"
        )
    command = begun(Path(), "judge", f"{hostile}:endless", "--case", "hertz_point")
    until = time.monotonic() + 60
    while not (Path("child").exists() and Path("child").read_text()):
        assert time.monotonic() < until
        assert command.poll() is None
        time.sleep(0.05)
    command.send_signal(number)
    end = ended(command)
    assert end.code == code
    assert "Traceback" not in end.said
    assert has_ended(int(Path("child").read_text()))
