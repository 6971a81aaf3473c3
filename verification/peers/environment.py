"""Other half-space codes on the challenges: aspher in double and in single precision, tamaas and
ContactMechanics.

The codes run in their own Python interpreter, which the variable SLIPSTICK_PEERS names; by default
it is that of this program. `requirements.txt` pins their versions. A code that is not installed
there is left out. Each code is run by the drivers in `verification.peers.drivers`.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from math import pi, sqrt, tan
from pathlib import Path
from typing import Any

import numpy as np

from contact_results.blas_threads import VARIABLES
from verification.adapters.own_solvers import numbers_of_pressure
from verification.challenge.requested_quantities import Answer, Field, Key
from verification.challenge.solver_process import CannotDo, Posed

INTERPRETER = "SLIPSTICK_PEERS"


@dataclass(frozen=True)
class Peer:
    """Another contact code that solves the challenges.

    module    name of the package, of the module that is imported, and of its driver
    friction  True if problems with friction are requested from the code
    single    True if the code computes in single precision
    """

    module: str
    friction: bool = False
    single: bool = False

    @property
    def name(self) -> str:
        """Name of the code in tables."""
        return f"{self.module}, single precision" if self.single else self.module


PEERS = (
    Peer("aspher", friction=True),
    Peer("aspher", single=True),  # with friction in double precision only
    Peer("tamaas"),
    Peer("ContactMechanics"),
)


@cache
def installed_version(module: str) -> str:
    """Return the version of another contact code in its interpreter.

    Raises CannotDo if the code is not installed there.

    module  name of the package of the code
    """
    probe = f"import {module}; from importlib.metadata import version; print(version({module!r}))"
    done = subprocess.run([_python(), "-c", probe], capture_output=True, text=True, check=False)
    if done.returncode:
        raise CannotDo(f"{module} is not installed for {_python()}; set {INTERPRETER}")
    return done.stdout.split()[-1]


def _python() -> str:
    return os.environ.get(INTERPRETER, sys.executable)


SECONDS_ALLOWED = 240
SOURCES = Path(__file__).parents[2]


def run_driver(peer: Peer, request: Mapping[str, Any]) -> dict[str, Any]:
    """Run the driver of another contact code in a process with one thread, and return its solution.

    Raises CannotDo if the driver refuses the problem, and RuntimeError with the last line of the
    error output if the driver fails.

    peer     other contact code
    request  problem, as `_driver_request` returns it
    """
    done = subprocess.run(
        [_python(), "-m", "verification.peers.drivers", peer.module],
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


def make_answer_function(peer: Peer) -> Callable[[Posed, int], Answer]:
    """Return a function that solves a challenge with another code on a given refinement level.

    The grid has 32 cells per side on level 0, and twice as many on each further level.
    """

    def solve(posed: Posed, level: int) -> Answer:
        request, length, stress = _driver_request(posed, COARSEST * 2**level, peer)
        found = run_driver(peer, request)
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
