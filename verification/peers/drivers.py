"""Drivers of other contact codes, run in their environment: `python -m verification.peers.drivers
CODE`.

A driver reads a contact problem as JSON from standard input, and writes the solution with the CPU
time as JSON to standard output.
"""

from __future__ import annotations

import json
import os
import statistics
import sys
import time
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

Request = Mapping[str, Any]
Answer = dict[str, Any]
Array = NDArray[np.float64]

ENOUGH_SECONDS = 1.0
MAX_REPEATS = 5
COARSEST = 16  # cells per side of the coarsest of the nested grids of aspher
ABOVE = 1.0  # the gap beside a punch: far above any approach of small strains


class CannotDo(Exception):
    """Exception of a driver for a problem that the other contact code cannot solve, with the
    reason."""


def gap_of(request: Request) -> Array:
    """Compute the gap below the undeformed indenter at the cell centres (n, n) before loading
    [length].

    The indenter is a flat punch if the request has a `rim`, a cone if it has a `slope`, else a
    paraboloid. The tilt of the indenter (slopes along y and x) closes the gap.

    request  problem as read by the driver
    """
    n, side = request["cells"], request["window"]
    x = (np.arange(n) + 0.5) * side / n - side / 2
    x, y = x[:, None], x[None, :]
    r = np.hypot(x, y)
    along_y, along_x = request.get("tilt", (0.0, 0.0))
    return _level_gap(request, x, y, r) - along_y * y - along_x * x


def _level_gap(request: Request, x: Array, y: Array, r: Array) -> Array:
    if request.get("rim"):
        return np.where(r <= request["rim"], 0.0, ABOVE)
    if request.get("slope"):
        return np.asarray(request["slope"] * r)
    radius = request["radius"]
    along, across = radius if isinstance(radius, list) else (radius, radius)
    return np.asarray(x**2 / (2 * along) + y**2 / (2 * across))


def approach_of(gap: Array, displacement: Array, pressure: Array) -> float:
    """Compute the rigid approach from the solution of another code, which does not return the
    approach.

    The approach is the mean of gap plus displacement, weighted by the pressure [length].

    gap           gap of the undeformed surfaces at the cells [length]
    displacement  normal surface displacement at the cells [length]
    pressure      pressure at the cells
    """
    return float(np.sum(pressure * (displacement + gap)) / np.sum(pressure))


def solve_by_aspher(request: Request) -> Answer:
    """Solve a contact problem with the code aspher: nested grids with FFT, or load steps with
    friction.

    Returns pressure, approach, convergence and, with friction, the shear of each load step. In
    single precision the tolerance is that which the code can reach, 2e-6.

    request  problem as read by the driver
    """
    aspher = import_module("aspher")
    n, side = request["cells"], request["window"]
    load = request["force"] / side**2
    gap = gap_of(request).ravel()
    if not request["friction"]:
        found = aspher.solve_nested(
            grid_size=n,
            gap=gap,
            p_nominal=load,
            domain_size=side,
            E_star=request["modulus"],
            coarsest=min(COARSEST, n // 2),
            backend="fft",
            precond_engine="fft",
            tol=request["tolerance"],
            single_precision=request["single"],
            allow_tolerance_relaxation=request["single"],
        )
        return {
            "pressure": found.pressure.reshape(n, n),
            "shear": None,
            "approach": float(found.approach),
            "converged": found.status == "converged" or bool(getattr(found, "converged", False)),
        }
    solver = aspher.FrictionSolver(
        grid_size=n,
        domain_size=side,
        E_star=request["modulus"],
        nu=0.0,
        model=aspher.CoulombFriction(request["friction"]),
        precond=True,
    )
    solver.set_gap(gap)
    pressed = solver.step(p_bar=load)
    shears = []
    for force in request["tangential_forces"]:
        step = solver.step(q_bar=(force / side**2, 0.0), dt=1.0)
        shears.append([step.qx.reshape(n, n), step.qy.reshape(n, n)])
        if not step.converged:
            break
    return {
        "pressure": solver.pressure.reshape(n, n),
        "shear": shears,
        "approach": float(pressed.approach),
        "converged": bool(step.converged),
    }


def solve_by_tamaas(request: Request) -> Answer:
    """Solve a frictionless contact problem with the code tamaas: method of Polonsky and Keer.

    The kernel is not periodic. Returns pressure, approach and convergence. Raises CannotDo for
    friction, which in tamaas is periodic and follows another law.

    request  problem as read by the driver
    """
    if request["friction"]:
        raise CannotDo("friction on a periodic surface only, with another law")
    tamaas = import_module("tamaas")
    tamaas.set_log_level(tamaas.LogLevel.error)
    n, side = request["cells"], request["window"]
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [side, side], [n, n])
    model.E, model.nu = request["modulus"], 0.0
    tamaas.ModelFactory.registerNonPeriodic(model, "free")
    gap = gap_of(request)
    solver = tamaas.PolonskyKeerRey(model, np.ascontiguousarray(-gap), request["tolerance"])
    solver.setIntegralOperator("free")
    solver.max_iter = 10000
    error = solver.solve(request["force"] / side**2)
    pressure = np.array(model.traction).reshape(n, n)
    # The solver leaves a displacement that is off by a constant.
    model.operators["free"](model.traction, model.displacement)
    return {
        "pressure": pressure,
        "shear": None,
        "approach": approach_of(gap, np.array(model.displacement).reshape(n, n), pressure),
        "converged": bool(error <= request["tolerance"]),
    }


def solve_by_contactmechanics(request: Request) -> Answer:
    """Solve a frictionless contact problem with the code ContactMechanics: minimisation, free-space
    kernel.

    Returns pressure, approach and convergence. Raises CannotDo for friction.

    request  problem as read by the driver
    """
    if request["friction"]:
        raise CannotDo("no friction")
    contact, surfaces = import_module("ContactMechanics"), import_module("SurfaceTopography")
    n, side = request["cells"], request["window"]
    substrate = contact.FreeFFTElasticHalfSpace((n, n), request["modulus"], (side, side))
    topography = surfaces.Topography(-gap_of(request), (side, side))
    system = contact.Systems.NonSmoothContactSystem(substrate, topography)
    found = system.minimize_proxy(
        external_force=request["force"],
        forcetol=request["tolerance"],
        pentol=request["tolerance"] * side,
    )
    area = (side / n) ** 2
    return {
        "pressure": np.array(substrate.force)[:n, :n] / area,
        "shear": None,
        "approach": float(np.squeeze(found.offset)) if hasattr(found, "offset") else None,
        "converged": bool(found.success),
    }


# Solution function of each code, by the module that is imported before the time is measured.
DRIVERS: dict[str, Callable[[Request], Answer]] = {
    "aspher": solve_by_aspher,
    "tamaas": solve_by_tamaas,
    "ContactMechanics": solve_by_contactmechanics,
}


def answer(code: str) -> None:
    """Read a contact problem as JSON, solve it repeatedly by another code, and write the solution
    as JSON.

    The solution contains the median CPU time [s].

    code  name of the other code in DRIVERS
    """
    request = json.load(sys.stdin)
    with os.fdopen(os.dup(sys.stdout.fileno()), "w") as out:
        os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # prints of a code go to stderr
        import_module(code)
        json.dump(_timed_answer(DRIVERS[code], request), out)


def _timed_answer(solve: Callable[[Request], Answer], request: Request) -> Answer:
    seconds: list[float] = []
    try:
        while len(seconds) < MAX_REPEATS and sum(seconds) < ENOUGH_SECONDS:
            started = time.process_time()
            found = solve(request)
            seconds.append(time.process_time() - started)
    except CannotDo as error:
        return {"cannot": str(error)}
    tractions = {
        name: np.asarray(found[name], dtype=float).tolist()
        for name in ("pressure", "shear")
        if found[name] is not None
    }
    return {**found, **tractions, "seconds": statistics.median(seconds)}


if __name__ == "__main__":
    answer(sys.argv[1])
