"""Run our own method and the peers in turn on the same machine, and write down what comes out."""

from __future__ import annotations

import json
import math
import os
import platform
import subprocess
import sys
from collections.abc import Iterator, Sequence
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_results.one_thread import VARIABLES
from verification.cell_means import round_means
from verification.norms import relative_l2, shear_error
from verification.peers.asked import ASKED, UNIT, AskedContact
from verification.peers.environment import OURSELVES, PEERS, WITH_EDGES, Installed, Peer, Run
from verification.running.provenance import provenance

SECONDS_ALLOWED = 240
SOURCES = Path(__file__).parents[2]  # what the drivers are found in


def errors_of(
    contact: AskedContact, request: dict[str, Any], found: dict[str, Any]
) -> dict[str, float]:
    """Errors of an answer, by the norms of the study; ValueError if it is not one. Only what other
    codes are asked for has an exact answer here."""
    n, side = request["cells"], request["window"]
    pressure = np.array(found["pressure"])
    if pressure.shape != (n, n) or not np.all(np.isfinite(pressure)):
        raise ValueError(f"a pressure of shape {pressure.shape} is no finite field of {n} x {n}")
    if not contact.others:
        return {}
    x = (np.arange(n) + 0.5) * side / n - side / 2
    X, Y = np.meshgrid(x, x, indexing="ij")
    sides = side / n, side / n
    if not contact.friction:
        errors = {
            "pressure": relative_l2(pressure, round_means(UNIT.pressure, X, Y, sides)),
            "peak": float(np.max(pressure)) / UNIT.peak_pressure - 1,
        }
        if found["approach"] is not None:
            errors["approach"] = abs(found["approach"]) / UNIT.approach - 1
        return errors
    shear = np.array(found["shear"])
    if shear.shape != (2, n, n) or not np.all(np.isfinite(shear)):
        raise ValueError(f"a shear of shape {shear.shape} is no finite field of 2 x {n} x {n}")
    part = math.cbrt(1 - contact.part)  # stick radius over contact radius

    def exact(r: NDArray[np.float64]) -> NDArray[np.float64]:
        return contact.friction * (UNIT.pressure(r) - part * UNIT.pressure(r / part))

    known = round_means(exact, X, Y, sides)
    return {"shear": shear_error(shear, known, contact.friction * pressure)}


def one_run(
    python: Path, code: Peer, contact: AskedContact, cells: int, run: Run = subprocess.run
) -> dict[str, Any]:
    """One code on one grid, in a process of its own: its record, or `lost` with the reason."""
    request = {**contact.request(cells), "edges": code.edges}
    named = {"code": code.name, "contact": contact.name, "cells": cells}
    try:
        done = run(
            [str(python), "-m", code.driver], input=json.dumps(request), capture_output=True,
            text=True, check=False, timeout=SECONDS_ALLOWED,
            env={**os.environ, **dict.fromkeys(VARIABLES, "1"), "PYTHONPATH": str(SOURCES)},
        )  # fmt: skip
        if done.returncode:
            lines = done.stderr.strip().splitlines()
            return {**named, "lost": lines[-1] if lines else f"exit code {done.returncode}"}
        found = json.loads(done.stdout)
        if "cannot" in found:
            return {**named, "lost": found["cannot"]}
        kept = ("version", "iterations", "converged", "seconds", "repeats", "memory")
        values = {name: found[name] for name in kept if found[name] is not None}
        return {**named, **values, "errors": errors_of(contact, request, found)}
    except (subprocess.TimeoutExpired, ValueError, KeyError, TypeError) as error:
        return {**named, "lost": f"{type(error).__name__}: {error}"}


def all_runs(
    installed: Installed | None, most_cells: int, contacts: Sequence[AskedContact]
) -> Iterator[dict[str, Any]]:
    """Ours and theirs, in turn on every grid, so that all feel the same load of the machine.

    installed  None asks ours alone
    """
    for contact in contacts:
        for cells in (n for n in contact.cells if n <= most_cells):
            yield one_run(Path(sys.executable), OURSELVES, contact, cells)
            if contact.others:
                yield one_run(Path(sys.executable), WITH_EDGES, contact, cells)
            if installed is None or not contact.others:
                continue
            for peer in installed.peers():
                if peer.friction or not contact.friction:
                    yield one_run(installed.python, peer, contact, cells)


def record_of(
    runs: Sequence[dict[str, Any]],
    installed: Installed | None,
    profiles: Sequence[dict[str, Any]],
) -> dict[str, Any]:
    """What is kept of all runs and profiles."""
    return {
        "problem": "paraboloid on a half-space on a window of three contact radii; every code in a "
        "process of its own, CPU seconds of one thread, set-up included, imports not",
        "date": date.today().isoformat(),
        "python": platform.python_version(),
        "machine": provenance("slipstick maintain bench", {}).machine,
        "contacts": {name: contact.title for name, contact in ASKED.items()},
        "asked": [peer.distribution for peer in PEERS] if installed else [],
        "missing": installed.missing if installed else {},
        "runs": list(runs),
        "profiles": list(profiles),
    }
