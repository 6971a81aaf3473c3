"""What a record of runs says of cost: ratios in turn, counts, memory, and growth with the grid."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from verification.exhibits.numbers import plain
from verification.exhibits.table import Table
from verification.peers.environment import OURS

Record = Mapping[str, Any]
COLUMNS = (
    "code", "contact", "cells", "CPU time", "convolutions", "memory", "best other", "its CPU time",
    "ours / best",
)  # fmt: skip
UNITS = {"CPU time": "s", "memory": "MB", "its CPU time": "s"}
FEWEST = 3  # grids that show how a cost grows


def cost_table(record: Record) -> Table:
    """Ours on every contact and grid, beside the best of the others on the same."""
    rows = []
    for run in record["runs"]:
        if run["code"] not in OURS:
            continue
        named = (run["code"], run["contact"], f"{run['cells']} x {run['cells']}")
        if "lost" in run:
            rows.append((*named, run["lost"], *("–",) * (len(COLUMNS) - len(named) - 1)))
            continue
        best = _best_other(record, run)
        beside = ("–", "–", "–")
        if best is not None:
            ratio = plain(run["seconds"] / best["seconds"], 2)
            beside = (best["code"], plain(best["seconds"], 2), ratio)
        counts = (plain(run["iterations"], 3), plain(run.get("memory"), 2))
        rows.append((*named, plain(run["seconds"], 2), *counts, *beside))
    return Table(
        title="What ours costs, beside the cheapest other code in turn",
        columns=COLUMNS,
        rows=tuple(rows),
        note="CPU seconds of one thread with set-up; convolutions of all increments; memory on "
        "top of what imports take. All solve to the same tolerance, each by its own measure.",
        units=UNITS,
    )


def exponents(record: Record) -> dict[str, float]:
    """By contact: how the CPU seconds of ours grow with the number of cells, as a power of it,
    from the finest half of the grids and at least three: coarse ones show what does not grow."""
    found: dict[str, list[tuple[int, float]]] = {}
    for run in record["runs"]:
        if run["code"] in OURS and "lost" not in run:
            name = ", ".join(filter(None, (run["contact"], run["code"].partition(", ")[2])))
            found.setdefault(name, []).append((run["cells"] ** 2, run["seconds"]))
    powers = {}
    for contact, points in found.items():
        fine = sorted(points)[-max(FEWEST, (len(points) + 1) // 2) :]
        if len(fine) >= FEWEST:
            cells, seconds = np.log(np.array(fine)).T
            powers[contact] = float(np.polyfit(cells, seconds, 1)[0])
    return powers


def growth(record: Record) -> str:
    """The exponents in words."""
    told = [f"{contact} {plain(power, 3)}" for contact, power in exponents(record).items()]
    if not told:
        return ""
    return f"CPU seconds of ours grow with the number of cells to the power: {', '.join(told)}."


def _best_other(record: Record, ours: Record) -> Record | None:
    """The cheapest that converged on the same contact and grid."""
    others = (
        run for run in record["runs"]
        if run["code"] not in OURS and run.get("converged")
        and (run["contact"], run["cells"]) == (ours["contact"], ours["cells"])
    )  # fmt: skip
    return min(others, key=lambda run: float(run["seconds"]), default=None)
