"""Run the peers beside our own method on the same machine, and write down what comes out.

    python -m verification.peers.measure NAME.json

makes the environment if need be (see `environment`); one thread, about a minute of CPU.
"""

from __future__ import annotations

import json
import math
import os
import platform
import subprocess
import sys
from collections.abc import Iterator
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np

from contact_results.one_thread import VARIABLES, one_thread
from semi_analytical import solve
from verification.closed_forms.hertz import PointContact
from verification.norms import relative_l2, shear_error
from verification.peers.environment import (
    PEERS,
    Installed,
    Peer,
    Run,
    made_environment,
    peers_directory,
)
from verification.problems.hertz import BALL
from verification.problems.paper_scene import HERTZ, hertz_grid
from verification.problems.sheared import sheared
from verification.running.cold_cache import timed
from verification.running.provenance import provenance

CELLS = (32, 64, 128, 256, 512)
FRICTION, PART = 0.1, 0.9  # µ, and the tangential force over µW
TOLERANCE = 1e-8
SECONDS_ALLOWED = 120
SOURCES = Path(__file__).parents[2]  # what the drivers are found in
# Dimensionless: contact radius, modulus and radius of the ball are one. tamaas is sensitive to it.
UNIT = PointContact.under_load(4 / 3, 1.0, 1.0)
WINDOW = 3.0


def request_of(contact: str, cells: int) -> dict[str, Any]:
    """What a driver is asked."""
    friction = FRICTION if contact == "cattaneo" else 0.0
    return {
        "cells": cells,
        "window": WINDOW * UNIT.contact_radius,
        "radius": 1.0,
        "modulus": 1.0,
        "force": 4 / 3,
        "friction": friction,
        "tangential_force": PART * friction * 4 / 3,
        "tolerance": TOLERANCE,
    }


def errors_of(contact: str, request: dict[str, Any], found: dict[str, Any]) -> dict[str, float]:
    """Errors of an answer, by the norms of the study; ValueError if it is not one."""
    n, side = request["cells"], request["window"]
    pressure = np.array(found["pressure"])
    if pressure.shape != (n, n) or not np.all(np.isfinite(pressure)):
        raise ValueError(f"a pressure of shape {pressure.shape} is no finite field of {n} x {n}")
    x = (np.arange(n) + 0.5) * side / n - side / 2
    r = np.hypot(x[:, None], x[None, :])
    if contact == "hertz":
        errors = {
            "pressure": relative_l2(pressure, UNIT.pressure(r)),
            "peak": float(np.max(pressure)) / UNIT.peak_pressure - 1,
        }
        if found["approach"] is not None:
            errors["approach"] = abs(found["approach"]) / UNIT.approach - 1
        return errors
    shear = np.array(found["shear"])
    if shear.shape != (2, n, n) or not np.all(np.isfinite(shear)):
        raise ValueError(f"a shear of shape {shear.shape} is no finite field of 2 x {n} x {n}")
    part = math.cbrt(1 - PART)  # stick radius over contact radius
    exact = FRICTION * (UNIT.pressure(r) - part * UNIT.pressure(r / part))
    return {"shear": shear_error(shear, exact, FRICTION * pressure)}


def peer_run(
    python: Path, peer: Peer, contact: str, cells: int, run: Run = subprocess.run
) -> dict[str, Any]:
    """One peer on one grid: its record, or `lost` with the reason."""
    request = request_of(contact, cells)
    named = {"code": peer.module, "contact": contact, "cells": cells}
    try:
        done = run(
            [str(python), "-m", peer.driver], input=json.dumps(request), capture_output=True,
            text=True, check=False, timeout=SECONDS_ALLOWED,
            env={**os.environ, **dict.fromkeys(VARIABLES, "1"), "PYTHONPATH": str(SOURCES)},
        )  # fmt: skip
        if done.returncode:
            lines = done.stderr.strip().splitlines()
            return {**named, "lost": lines[-1] if lines else f"exit code {done.returncode}"}
        found = json.loads(done.stdout)
        if "cannot" in found:
            return {**named, "lost": found["cannot"]}
        kept = ("version", "iterations", "converged", "seconds", "repeats")
        values = {name: found[name] for name in kept}
        return {**named, **values, "errors": errors_of(contact, request, found)}
    except (subprocess.TimeoutExpired, ValueError, KeyError, TypeError) as error:
        return {**named, "lost": f"{type(error).__name__}: {error}"}


def own_run(contact: str, cells: int) -> dict[str, Any]:
    """Our own method on the same grid and machine, its answer in the units of a request."""
    problem = BALL if contact == "hertz" else sheared("Cattaneo-Mindlin, ν = 0", (PART,))
    grid = hertz_grid(cells)
    result, seconds, repeats = timed(lambda: solve(problem.scene, grid, TOLERANCE))
    end, pressure = result.steps[-1], UNIT.peak_pressure / HERTZ.peak_pressure
    found = {
        "pressure": end.pressure * pressure,
        "approach": end.approach * UNIT.approach / HERTZ.approach,
        "shear": None if end.shear is None else end.shear * pressure,
    }
    return {
        "code": "slipstick", "contact": contact, "cells": cells,
        "iterations": sum(increment.convolutions for increment in result.increments),
        "converged": True, "seconds": seconds, "repeats": repeats,
        "errors": errors_of(contact, request_of(contact, cells), found),
    }  # fmt: skip


def all_runs(installed: Installed) -> Iterator[dict[str, Any]]:
    """Ours and theirs, in turn on every grid, so that all feel the same load of the machine."""
    for contact in ("hertz", "cattaneo"):
        for cells in CELLS:
            yield own_run(contact, cells)
            for peer in installed.peers():
                if contact == "hertz" or peer.friction:
                    yield peer_run(installed.python, peer, contact, cells)


def main(path: Path) -> None:
    """Make the environment, run all and write the record."""
    one_thread()
    installed = made_environment(peers_directory())
    for distribution, reason in installed.missing.items():
        print(f"left out: {distribution}: {reason}")
    runs = list(all_runs(installed))
    made = provenance("python -m verification.peers.measure", {})
    record = {
        "problem": "paraboloid on a half-space on a window of three contact radii, without "
        "friction and sheared to 0.9 µW with ν = 0; CPU seconds of one thread, set-up included, "
        "imports not",
        "date": date.today().isoformat(),
        "python": platform.python_version(),
        "machine": made.machine,
        "asked": [peer.distribution for peer in PEERS],
        "missing": installed.missing,
        "runs": runs,
    }
    path.write_text(json.dumps(record, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
