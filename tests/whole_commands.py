"""Whole commands of scenes drawn from the stability map, its edges and the friction limit.

Every scene is planned and run by all solvers, and every result is exported. A command must end with
a documented exit code, without a traceback, an internal error or a RuntimeWarning. All solvers that
solve a scene must give it the same outcome: solved, gross slip at the limit, or refused above it.
"""

import json
import re
import signal
import warnings
from collections.abc import Iterator
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import numpy as np
from pydantic import BaseModel, ValidationError
from strategies import as_toml

from contact_scene import RIGID, Scene, SceneError
from contact_scene.reading.array_file import ArrayFile
from slipstick.cli.application import main
from slipstick.cli.errors import ExitCode
from verification.studies.stability.contacts import LoadingPath, StabilityCell, Surface, pose

SOLVERS = ("semi-analytical", "radial", "fem", "fem-complementarity")
STOPPED = 128 + signal.SIGPROF
# Processor seconds after which a command is stopped and counted: several times the longest one.
LONGEST = 60.0
ALLOWED = {
    STOPPED,
    ExitCode.PASS,
    ExitCode.INVALID,
    ExitCode.NOT_CONVERGED,
    ExitCode.RESOURCES_REFUSED,
}
COARSE = (
    "[semi_analytical]\ncells = [12, 12]\n"
    "[fem_reference]\nelements_per_radius = 4\nharmonics = 3\noverlap = 0.1\n"
)
ABOVE_LIMIT = "exceeds the friction limit"
UNWANTED = re.compile(r"Traceback|RuntimeWarning|\bnan\b")
# Ends and middle of the axes of the stability map, and forces at the friction limit.
AXES = {
    "friction": (0.0, 1e-6, 0.1, 0.3, 1.0, 5.0),
    "push": (0.0, 0.3, 0.9, 0.99, 0.99999, 1 - 1e-10, 1 - 2**-52, 1.0, 1.0, 1 + 2**-52, 1.001),
    "modulus_ratio": (1e-3, 0.05, 1.0, 2.0, 20.0, 1e3),
    "thickness": (0.01, 0.1, 1.0, 10.0),
    "poisson_ratio": (0.0, 0.3, 0.5),
    "base_ratio": (0.0, 0.3, 0.5),
    "path": tuple(LoadingPath),
    "surface": (*Surface, Surface.ALIKE_BALL, Surface.BALL),
    "load": (1e-5, 1.0, 1.0),
    "length": (1e-9, 1e-3, 1e-3, 1.0),
    "modulus": (1e3, 210e9, 210e9, 1e12),
}


class Outcome(NamedTuple):
    """Outcome of a command in this process: its exit code and all text that it printed."""

    code: int
    text: str


def run_command(*arguments: str | Path) -> Outcome:
    """Run a command of slipstick in this process; a RuntimeWarning becomes an exception.

    A command that takes longer than `LONGEST` is stopped; its exit code is then `STOPPED`.
    """
    printed, code = StringIO(), 0
    signal.signal(signal.SIGPROF, _stop)
    signal.setitimer(signal.ITIMER_PROF, LONGEST)
    with warnings.catch_warnings(), redirect_stdout(printed), redirect_stderr(printed):
        warnings.simplefilter("error", RuntimeWarning)
        try:
            main([*map(str, arguments)])
        except SystemExit as ended:
            code = int(ended.code or 0)
        except _Stopped:
            code = STOPPED
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)
    return Outcome(code, printed.getvalue())


class _Stopped(BaseException):
    """End of a command after its longest time; no handler of errors catches it."""


def _stop(*_):
    raise _Stopped


def draw_cell(rng: np.random.Generator) -> StabilityCell:
    """Draw a contact of the stability map, each value independent of the others.

    Half of the contacts have two equal bodies without coatings, whose solves are short.
    """
    values = {name: axis[int(rng.integers(len(axis)))] for name, axis in AXES.items()}
    if rng.random() < 0.5:
        alike = {"surface": Surface.ALIKE_BALL, "modulus_ratio": 1.0}
        values |= alike | {"base_ratio": values["poisson_ratio"]}
    return StabilityCell(cells=12, **values)


def write_scene(scene: Scene, file: Path) -> None:
    """Write a scene file and the files of its arrays."""

    def document(value, name=""):
        if isinstance(value, BaseModel):
            return {key: document(part, key) for key, part in value if part is not None}
        if isinstance(value, ArrayFile):
            np.save(file.with_name(f"{name}.npy"), value.values)
            return f"{name}.npy"
        if isinstance(value, list | tuple):
            return [document(part, name) for part in value]
        return value.value if value is RIGID else value

    file.write_text(as_toml(document(scene)) + COARSE, encoding="utf-8")


def _failures_of(scene: Path) -> Iterator[str]:
    """Plan, run and export a scene by all solvers; yield the failures, and unequal outcomes."""
    found = {}
    for solver in SOLVERS:
        output = scene.parent / solver
        plan = ("plan", scene, "--solver", solver)
        options = ("--solver", solver, "--figures", "none", "--overwrite", "--output", output)
        ends = {"plan": run_command(*plan), "run": run_command("run", scene, *options)}
        found[solver] = _class_of(ends["run"], output)
        if ends["run"].code == ExitCode.PASS:
            ends["export"] = run_command("export", output, "--output", output / "surface")
        for name, end in ends.items():
            if end.code not in ALLOWED or UNWANTED.search(end.text):
                yield f"{solver}: {name} ends with {end.code}: {end.text.strip()[-300:]}"
    if len(set(found.values()) - {None}) > 1:
        yield f"outcomes differ: {found}"


def _class_of(ran: Outcome, output: Path) -> str | None:
    """Return the outcome of a run; None if the solver has no model or no solution of the scene."""
    if ran.code != ExitCode.PASS:
        return "above the limit" if ABOVE_LIMIT in ran.text else None
    end = json.loads((output / "summary.json").read_text(encoding="utf-8"))
    last = end["steps"][-1]
    if last["tangential_force"] is None or last["tangential_shift"] is not None:
        return "solved"
    warned = sum("prescribe tangential_shift" in warning for warning in end["warnings"])
    slides = last["status"] == "gross sliding" and last["stick_radius"] == 0 and warned == 1
    return "gross slip" if slides else f"undefined shift with {last['status']}, {warned} warnings"


def draw_scenes(count: int, seed: int) -> Iterator[tuple[str, Scene]]:
    """Draw scenes of the stability map; contacts that no scene can express are left out."""
    rng = np.random.default_rng(seed)
    while count:
        cell = draw_cell(rng)
        try:
            scene = pose(cell).scene
        except (SceneError, ValidationError):
            continue
        count -= 1
        yield cell.name, scene


def failures_of_drawn_scenes(count: int, seed: int) -> list[str]:
    """Run all commands of drawn scenes by all solvers; return the failures in words.

    count  number of scenes
    seed   seed of the random numbers
    """
    failures = []
    for name, scene in draw_scenes(count, seed):
        with TemporaryDirectory() as folder:
            file = Path(folder) / "scene.toml"
            write_scene(scene, file)
            failures += [f"{name}: {failure}" for failure in _failures_of(file)]
    return failures
