"""What other codes are recorded to have found and spent, beside our own method."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf
from typing import Any

from verification.exhibits.chart import Chart
from verification.exhibits.log_chart import drawable, log_chart, point_curves
from verification.exhibits.numbers import plain
from verification.exhibits.table import Table
from verification.peers.costs import cost_table, growth
from verification.peers.environment import OURS
from verification.peers.profile import profile_table
from verification.references import load_reference
from verification.studies.work_precision.contacts import CATTANEO, HERTZIAN
from verification.studies.work_precision.point import Point, cheapest, dependable, seconds

NAME = "peers"
OTHERS = "other codes, recorded"
BESIDE = "semi-analytical, in their turn"  # our own runs of the record
TOLD = (0.01, 0.001)  # errors that costs are told for
# The first quantity of the contacts that they were asked for.
JUDGED = {
    c.name: (next(iter(c.errors)), c.meaning(next(iter(c.errors)))) for c in (HERTZIAN, CATTANEO)
}

Record = Mapping[str, Any]
Points = Mapping[tuple[str, str], tuple[Point, ...]]


def recorded_peers() -> Record:
    """The record that `slipstick maintain bench` wrote."""
    return load_reference(NAME)


def peer_charts(record: Record) -> tuple[Chart, ...]:
    """Error against CPU seconds, one curve for every code."""
    return tuple(
        log_chart(
            f"peers_{contact}",
            f"Other codes, {meaning}",
            "Error against CPU seconds of one thread, set-up included, on grids of "
            f"{_cells(record)} cells a side; all codes in turn on one machine. They share cells of "
            "constant traction, and so the error of a grid.",
            "CPU seconds",
            "relative error",
            point_curves(
                (code, drawable((run["seconds"], run["errors"][quantity]) for run in runs))
                for code, runs in _converged(record, contact).items()
            ),
        )
        for contact, (quantity, meaning) in JUDGED.items()
    )


def peer_points(record: Record) -> Points:
    """By contact and quantity, of every converged run: errors and seconds, no counted work. A code
    is a curve of the method OTHERS, and our own runs between them are the method BESIDE."""
    found: dict[tuple[str, str], list[Point]] = {}
    for run in record["runs"]:
        if not run.get("converged"):
            continue
        method = BESIDE if run["code"] in OURS else OTHERS
        n = run["cells"]
        for quantity, error in run["errors"].items():
            point = Point(method, run["code"], f"{n} x {n}", n, abs(error), run["seconds"], inf)
            found.setdefault((run["contact"], quantity), []).append(point)
    # What no other code was asked for compares nothing.
    return {key: tuple(p) for key, p in found.items() if any(q.method == OTHERS for q in p)}


def peer_answer(record: Record) -> str:
    """What an accuracy costs with every code, cheapest first, all in turn on one machine."""
    points, parts, first = peer_points(record), [], []
    for contact, (quantity, meaning) in JUDGED.items():
        steady = dependable(points.get((contact, quantity), ()))
        for target in TOLD:
            if ranked := _ranked(steady, target):
                costs = ", ".join(f"{p.curve} {plain(p.seconds, 2)} s" for p in ranked)
                parts.append(f"{meaning} to {100 * target:g} %: {costs}")
                first.append(ranked[0].curve)
    if not parts:
        return ""
    won = sum(code in OURS for code in first)
    return (
        f"Other codes in turn with ours, recorded on {record['date']}: ours is the cheapest in "
        f"{won} of {len(first)}; cheapest first, {'; '.join(parts)}."
    )


def _ranked(points: Sequence[Point], target: float) -> list[Point]:
    """What every code that reaches it pays, cheapest first."""
    codes = dict.fromkeys(point.curve for point in points)
    best = [cheapest([p for p in points if p.curve == code], target, seconds) for code in codes]
    return sorted((p for p in best if p is not None), key=seconds)


def peer_tables(record: Record) -> tuple[Table, ...]:
    """Every run of all codes, what ours costs beside the cheapest, and where its time goes."""
    return _runs(record), cost_table(record), profile_table(record)


def _runs(record: Record) -> Table:
    rows = []
    for run in (run for run in record["runs"] if run["contact"] in JUDGED):
        words = f"{run['code']} {run.get('version', '')}".strip()
        grid = f"{run['contact']}, {run['cells']} x {run['cells']}"
        if "lost" in run:
            rows.append((words, grid, "–", "–", run["lost"]))
            continue
        error = run["errors"][JUDGED[run["contact"]][0]]
        state = "converged" if run["converged"] else "not converged"
        rows.append((words, grid, plain(error, 2), plain(run["seconds"], 2), state))
    return Table(
        title="Other codes, run by run",
        columns=("code", "problem", "error", "CPU time", "end"),
        rows=tuple(rows),
        note=f"Recorded on {record['date']}, Python {record['python']}.",
        units={"CPU time": "s"},
    )


def peer_remarks(record: Record) -> tuple[str, ...]:
    """What the comparison rests on, and who is missing."""
    missing = [f"{name} could not be installed: {why}." for name, why in record["missing"].items()]
    return (f"Other codes: {record['problem']}.", growth(record), *missing)


def _cells(record: Record) -> str:
    cells = [run["cells"] for run in record["runs"]]
    return f"{min(cells)} to {max(cells)}"


def _converged(record: Record, contact: str) -> dict[str, list[Record]]:
    """Converged runs on a contact, by code."""
    found: dict[str, list[Record]] = {run["code"]: [] for run in record["runs"]}
    for run in record["runs"]:
        if run["contact"] == contact and run.get("converged"):
            found[run["code"]].append(run)
    return found
