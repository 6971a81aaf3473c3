"""Other half-space codes on the challenges: aspher in double and in single precision, tamaas and
ContactMechanics.

The codes have pinned versions in a virtual environment of their own, which is created once. A code
whose installation fails is left out with the reason. Each code is run there by the drivers in
`verification.peers.drivers`.
"""

from __future__ import annotations

import fcntl
import json
import os
import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from math import pi, sqrt, tan
from pathlib import Path
from typing import Any

import numpy as np

from contact_results.blas_threads import VARIABLES
from contact_results.directory.atomic_file import atomic_file
from contact_scene.disk_cache import cache_directory
from verification.adapters.own_solvers import numbers_of_pressure
from verification.challenge.requested_quantities import Answer, Field, Key
from verification.challenge.solver_process import CannotDo, Posed

FOLDER = "peers"
# Why peers could not be installed: a build that waits for what it may not download would take
# minutes of every run.
FAILED = "failed.json"
# A build of aspher takes three minutes on two cores, and several builds may share the cores.
SECONDS_TO_INSTALL = 600
# First words of the reason of a time-out, which says nothing about the next installation.
TIMED_OUT = "not installed within"
EIGEN = Path("/usr/include/eigen3")  # of the package libeigen3-dev: else the build downloads it


@dataclass(frozen=True)
class Peer:
    """Another contact code that solves the challenges, with the data of its installation.

    distribution  name and version of the package that is installed
    module        module that is imported, and name of its driver
    friction      True if problems with friction are requested from the code
    settings      environment variables for the build
    single        True if the code computes in single precision
    """

    distribution: str
    module: str
    friction: bool = False
    settings: tuple[tuple[str, str], ...] = ()
    single: bool = False

    @property
    def name(self) -> str:
        """Name of the code in tables."""
        return f"{self.module}, single precision" if self.single else self.module


ASPHER = Peer(
    "aspher==0.1.3.post1",
    "aspher",
    friction=True,
    settings=(("CMAKE_ARGS", f"-DFETCHCONTENT_SOURCE_DIR_EIGEN3_SRC={EIGEN}"),),
)
PEERS = (
    ASPHER,
    replace(ASPHER, friction=False, single=True),  # with friction in double precision only
    Peer("tamaas==2.9.0", "tamaas"),
    Peer("ContactMechanics==1.8.3", "ContactMechanics"),
)

Run = Callable[..., "subprocess.CompletedProcess[str]"]


@dataclass(frozen=True)
class Installed:
    """Python environment in which the other contact codes are installed.

    python   path of the Python interpreter
    missing  reasons for codes that could not be installed, by distribution
    """

    python: Path
    missing: dict[str, str]


def peers_directory() -> Path:
    """Return the directory of the Python environment in which the other contact codes are
    installed.

    The directory is part of the directory of the disk cache. Raises RuntimeError without one.
    """
    directory = cache_directory()
    if directory is None:
        raise RuntimeError("the user has no home directory. Set SLIPSTICK_CACHE_DIR")
    return directory / FOLDER


@cache
def peers_environment() -> Installed:
    """Return the Python environment of the other contact codes; complete it once in this process.

    Other processes wait meanwhile: builds at one time would exceed their time limit.
    """
    directory = peers_directory()
    directory.parent.mkdir(parents=True, exist_ok=True)
    with directory.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        return made_environment(directory)


def made_environment(directory: Path, run: Run = subprocess.run) -> Installed:
    """Create or complete the Python environment of the other contact codes, and return it.

    A failed installation is not repeated until the file `failed.json` in the directory is removed;
    one that exceeded the time limit is repeated.

    directory  directory of the environment
    run        replacement of `subprocess.run`, for tests
    """
    python = directory / "bin" / "python"
    if not python.exists():
        run([sys.executable, "-m", "venv", str(directory)], check=True)
    failed = directory / FAILED
    stored = json.loads(failed.read_text(encoding="utf-8")) if failed.exists() else {}
    known = _without_time_outs(stored)
    missing = {}
    for peer in PEERS:
        reason = _install_peer(python, peer, run, known.get(peer.distribution, ""))
        if reason:
            missing[peer.distribution] = reason
    if (remembered := _without_time_outs(missing)) != stored:
        with atomic_file(failed) as unfinished:
            text = json.dumps(remembered, indent=1, ensure_ascii=False)
            unfinished.write_text(text, encoding="utf-8")
    return Installed(python, missing)


def _without_time_outs(reasons: Mapping[str, str]) -> dict[str, str]:
    return {name: text for name, text in reasons.items() if not text.startswith(TIMED_OUT)}


def _install_peer(python: Path, peer: Peer, run: Run, failed: str) -> str:
    """Install another contact code unless it is present or its installation has failed before.

    Returns the reason of a failure; empty if the code is installed.

    python  interpreter of the environment
    run     replacement of `subprocess.run`, for tests
    failed  reason of an earlier failure; empty if there was none
    """
    probe = [str(python), "-c", f"import {peer.module}"]
    if run(probe, capture_output=True, text=True, check=False).returncode == 0:
        return ""
    if failed:
        return failed
    settings = {name: value for name, value in peer.settings if EIGEN.exists()}
    install = [str(python), "-m", "pip", "install", "--quiet", peer.distribution]
    try:
        done = run(
            install,
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ, **settings},
            timeout=SECONDS_TO_INSTALL,
        )
    except subprocess.TimeoutExpired:
        return f"{TIMED_OUT} {SECONDS_TO_INSTALL} s"
    if done.returncode == 0:
        done = run(probe, capture_output=True, text=True, check=False)
    if done.returncode == 0:
        return ""
    lines = [line.strip() for line in done.stderr.splitlines() if line.strip()]
    return lines[-1] if lines else f"exit code {done.returncode}"


SECONDS_ALLOWED = 240
SOURCES = Path(__file__).parents[2]


def run_driver(python: Path, peer: Peer, request: Mapping[str, Any]) -> dict[str, Any]:
    """Run the driver of another contact code in a process with one thread, and return its solution.

    Raises CannotDo if the driver refuses the problem, and RuntimeError with the last line of the
    error output if the driver fails.

    python   interpreter of the environment in which the code is installed
    peer     other contact code
    request  problem, as `_driver_request` returns it
    """
    done = subprocess.run(
        [str(python), "-m", "verification.peers.drivers", peer.module],
        input=json.dumps(request),
        capture_output=True,
        text=True,
        check=False,
        timeout=SECONDS_ALLOWED,
        env={**os.environ, **dict.fromkeys(VARIABLES, "1"), "PYTHONPATH": str(SOURCES)},
    )
    if done.returncode:
        raise RuntimeError(f"{peer.module}: {done.stderr.strip().splitlines()[-1:]}")
    found: dict[str, Any] = json.loads(done.stdout)
    if "cannot" in found:
        raise CannotDo(found["cannot"])
    return found


COARSEST = 32
TOLERANCE = 1e-8


def make_answer_function(python: Path, peer: Peer) -> Callable[[Posed, int], Answer]:
    """Return a function that solves a challenge with another code on a given refinement level.

    The grid has 32 cells per side on level 0, and twice as many on each further level.

    python  interpreter of the environment in which the code is installed
    peer    other contact code
    """

    def solve(posed: Posed, level: int) -> Answer:
        request, length, stress = _driver_request(posed, COARSEST * 2**level, peer)
        found = run_driver(python, peer, request)
        return _answer_from_driver(posed, request, found, length, stress)

    return solve


def _driver_request(posed: Posed, cells: int, peer: Peer) -> tuple[dict[str, Any], float, float]:
    """Convert a challenge to a dimensionless problem for the driver of another contact code.

    Returns the problem, and the units of length and stress. The problem is dimensionless, because
    tamaas is sensitive to the units. Raises CannotDo for problems outside the scope of the code.

    posed  challenge without its reference
    cells  cells per side of the window
    peer   other contact code
    """
    scene = posed.scene
    if "indenter" not in scene:
        raise CannotDo("contacts only, no given tractions")
    named = {name for step in scene["loading"] for name, end in step.items() if end is not None}
    if others := sorted(named - {"normal_force", "tangential_force", "tilt", "increments"}):
        raise CannotDo(f"forces and tilts only, no {', '.join(others)}")
    bodies = [scene["indenter"], scene["body"]]
    if any(body.get("layers") or body["material"] == "rigid" for body in bodies):
        raise CannotDo("homogeneous elastic bodies only")
    friction = (scene.get("friction") or {}).get("coefficient", 0.0)
    if friction and not peer.friction:
        raise CannotDo("no friction")
    pair = [body["material"] for body in bodies]
    modulus = 1 / sum((1 - m["poisson_ratio"] ** 2) / m["young_modulus"] for m in pair)
    length = posed.window / 3
    force, shape = modulus * length**2, scene["indenter"]
    asked: dict[str, Any] = {"radius": 1.0}
    if shape["shape"] == "cone":
        asked["slope"] = tan(shape["slope_angle"])
    elif "radii" in shape:
        asked["radius"] = [radius / length for radius in shape["radii"]]
    elif shape["shape"] in ("paraboloid", "flat_punch"):
        asked["radius" if shape["shape"] == "paraboloid" else "rim"] = shape["radius"] / length
    else:
        raise CannotDo(f"no {shape['shape']}")
    asked["tilt"] = scene["loading"][0]["tilt"] or (0.0, 0.0)
    rubbed = {"tangential_forces": [t[0] / force for _, t in posed.loads[1:]]} if friction else {}
    request = {
        "cells": cells,
        "window": 3.0,
        "modulus": 1.0,
        **asked,
        **rubbed,
        "force": posed.loads[0][0] / force,
        "friction": friction,
        "tolerance": TOLERANCE,
        "single": peer.single,
    }
    return request, length, modulus


def _answer_from_driver(
    posed: Posed, request: dict[str, Any], found: dict[str, Any], length: float, stress: float
) -> Answer:
    n = request["cells"]
    h = 3 * length / n
    x = (np.arange(n) + 0.5) * h - 1.5 * length
    x, y = np.meshgrid(x, x, indexing="ij")
    pressure = np.array(found["pressure"]) * stress
    contact = pressure > 0
    area = np.full(int(np.sum(contact)), h**2)
    own: dict[str, float | None] = {
        "approach": None if found["approach"] is None else abs(found["approach"]) * length,
        "contact_radius": sqrt(np.sum(contact) * h**2 / pi),
        "moment_x": float(np.sum(pressure * y)) * h**2,
        "moment_y": float(np.sum(pressure * x)) * h**2,
        **numbers_of_pressure(pressure, x, y),
    }
    scalars: dict[Key, float] = {
        (q, s): value for q, s in posed.asked if s == 1 and (value := own.get(q)) is not None
    }
    shears = [np.array(one)[0] * stress for one in found["shear"] or ()]
    fields, gave_up = {}, {}
    for quantity, step in posed.fields:
        if quantity == "shear_x" and step - 2 >= len(shears):
            gave_up[step] = "did not get there"
            continue
        traction = pressure if quantity == "pressure" else shears[step - 2]
        fields[quantity, step] = Field(x[contact], y[contact], traction[contact], area)
    if not found["converged"]:
        gave_up[len(posed.loads)] = "did not converge"
    return Answer(h, scalars, fields, gave_up, unknowns=n * n, seconds=float(found["seconds"]))
