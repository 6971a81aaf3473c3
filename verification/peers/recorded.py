"""What other codes are recorded to have found and spent, beside our own method."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from verification.cases.chart import Chart, Look, Panel, curve
from verification.cases.table import Table
from verification.references import load_reference
from verification.report.numbers import plain

NAME = "peers"
HEIGHT = 2.4
JUDGED = {"hertz": ("pressure", "Hertz: pressure, L2"), "cattaneo": (
    "shear", "Cattaneo-Mindlin, ν = 0: shear at 0.9 µW, Σ|q - q_exact| / Σµp")}  # fmt: skip

Record = Mapping[str, Any]


def recorded_peers() -> Record:
    """The record that `measure` wrote."""
    return load_reference(NAME)


def peer_charts(record: Record) -> tuple[Chart, ...]:
    """Error against CPU seconds, one curve for every code."""
    codes = _codes(record)
    charts = []
    for contact, (quantity, meaning) in JUDGED.items():
        curves = [
            curve(
                code,
                [run["seconds"] for run in runs],
                [abs(run["errors"][quantity]) for run in runs],
                Look.POINTS,
                series,
            )
            for series, code in enumerate(codes)
            if (runs := _converged(record, contact, code))
        ]
        panel = Panel(
            x_label="CPU seconds", y_label="relative error", curves=tuple(curves),
            logarithmic=True, height=HEIGHT,
        )  # fmt: skip
        charts.append(
            Chart(
                name=f"peers_{contact}",
                title=f"Other codes, {meaning}",
                caption="Error against CPU seconds of one thread, set-up included, on grids of "
                "32 to 256 cells a side; all codes in turn on one machine. They share cells of "
                "constant traction, and so the error of a grid.",
                rows=((panel,),),
            )
        )
    return tuple(charts)


def peer_table(record: Record) -> Table:
    """Every run."""
    rows = []
    for run in record["runs"]:
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
        columns=("code", "problem", "error", "CPU seconds", "end"),
        rows=tuple(rows),
        note=f"Recorded on {record['date']}, Python {record['python']}.",
    )


def peer_remarks(record: Record) -> tuple[str, ...]:
    """What the comparison rests on, and who is missing."""
    missing = [f"{name} could not be installed: {why}." for name, why in record["missing"].items()]
    return (f"Other codes: {record['problem']}.", *missing)


def _codes(record: Record) -> list[str]:
    return list(dict.fromkeys(run["code"] for run in record["runs"]))


def _converged(record: Record, contact: str, code: str) -> list[Record]:
    return [
        run
        for run in record["runs"]
        if (run["contact"], run["code"]) == (contact, code) and run.get("converged")
    ]
