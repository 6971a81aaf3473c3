"""Regression of accuracy for a scene and a solver of one's own, as in continuous integration.

Each command ends with code 0, or with code 7 if a number is worse than the saved one.
"""

import subprocess
import sys
from pathlib import Path

SOLVER = """
from verification import Answer

ERROR = 1e-3

def solve(problem, level):
    error = ERROR / 4**level
    # The numbers stand for a computation.
    values = {("approach", 1): 8.372042e-6 * (1 + error),
              ("contact_radius", 1): 3.881968e-4 * (1 - error)}
    return Answer(1e-5 / 2**level, values, unknowns=100 * 4**level)
"""


def slipstick(*arguments: str) -> int:
    """Run a command and return its exit code."""
    return subprocess.run([sys.executable, "-m", "slipstick", *arguments], check=False).returncode


if __name__ == "__main__":
    scene = Path("ball.toml")
    example = subprocess.run(
        [sys.executable, "-m", "slipstick", "example", "coated_ball"],
        capture_output=True,
        text=True,
        check=True,
    )
    scene.write_text(example.stdout, encoding="utf-8")
    run = ("run", str(scene), "--output", "out", "--figures", "none")
    assert slipstick(*run, "--save-expected", "ball.json") == 0
    assert slipstick(*run, "--expect", "ball.json") == 0
    coarser = ("--set", "semi_analytical.cells=[24,24]")
    assert slipstick(*run, "--expect", "ball.json", *coarser) == 7

    solver = Path("mine.py")
    solver.write_text(SOLVER, encoding="utf-8")
    judge = ("judge", "mine.py:solve", "--case", "hertz_point", "--levels", "2")
    assert slipstick(*judge, "--save", "solver.json") == 0
    assert slipstick(*judge, "--against", "solver.json") == 0
    solver.write_text(SOLVER.replace("ERROR = 1e-3", "ERROR = 1.6e-3"), encoding="utf-8")
    assert slipstick(*judge, "--against", "solver.json") == 7
