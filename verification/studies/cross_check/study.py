"""The study of both solvers on the same contacts: moduli, thicknesses and friction."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping
from itertools import product

import numpy as np

from verification.cases.case import SOLVER_TOLERANCE, Level
from verification.cases.chart import Chart, Curve, Panel, curve
from verification.cases.cross_check_contacts import FRICTIONS, RATIOS, THICKNESSES
from verification.cases.outcome import Status
from verification.cases.paper_scene import NORMAL_FORCE
from verification.cases.table import Table
from verification.report.numbers import plain
from verification.report.page import SYMBOLS
from verification.studies.cross_check.contact_run import CrossCheckRecord, CrossCheckRun
from verification.studies.cross_check.difference import (
    COVERAGE,
    REQUIRED,
    Difference,
    differences,
)
from verification.studies.running.study import (
    Conclusion,
    Records,
    Settings,
    Statement,
    Study,
    StudyCase,
)

CELLS = {Level.QUICK: 128, Level.STANDARD: 256, Level.FULL: 256}
ELEMENTS = {Level.QUICK: 64, Level.STANDARD: 64, Level.FULL: 128}
MEANINGS = {
    "pressure": "pressure, r < 0.9 a, over p₀",
    "shear": "shear, r < 0.9 a and away from the edge of stick, over µp₀",
    "approach": "approach, relative",
}
PER_MILLE = 1e3

Found = Mapping[tuple[float, float, float], CrossCheckRecord]


def cases(settings: Settings) -> tuple[StudyCase, ...]:
    """One case per contact."""
    return tuple(_run(key, settings) for key in product(RATIOS, THICKNESSES, FRICTIONS))


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Differences with the error of each side, page of difference curves, and the verdict."""
    found = _found(settings, records)
    apart = {key: differences(record) for key, record in found.items()}
    return Conclusion(
        statements=(
            *(_statement(name, apart) for name in REQUIRED),
            _explained(apart),
            _nearer(apart),
            _converged(found),
        ),
        tables=(_difference_table(apart), _number_table(found)) if found else (),
        charts=(_chart(found, "pressure"), _chart(found, "shear")) if found else (),
        remarks=REMARKS,
    )


REMARKS = (
    "The own error of a side is the change from half as many cells or elements: what is left on "
    "the finer one, were the order 1. The joint uncertainty is the root of the sum of both "
    "squares. A difference beyond what is required is inconclusive as long as twice the joint "
    "uncertainty covers it. That of the elements is taken where the ripple of the coarser mesh's "
    "last five elements does not reach.",
    "Nothing is judged nearer to the axis than two cells or two elements, and no shear nearer to "
    "the edge of stick: there it has a kink.",
    "Both solvers take the same increments: what finite increments cost is not seen here.",
    "The cells' tractions are means over 16 directions by cubic splines; those of the elements are "
    "values at their rings.",
    "References: without friction an integral equation for every coating; with friction the "
    "self-similar solution of the homogeneous body and one coated body, neither with increments.",
)


def exports(settings: Settings, records: Records) -> Mapping[str, str]:
    """`differences.csv`: both solvers' tractions at all radii."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(
        ("E1_over_E2", "h_over_aH", "mu", "r_over_a", "p_cells", "p_elements", "q_cells",
         "q_elements", "shear_judged")
    )  # fmt: skip
    for key, record in _found(settings, records).items():
        one, other = record.semi_analytical, record.finite_elements
        columns = (one.pressure, other.pressure, one.shear, other.shear)
        judged = map(int, record.shear_judged)
        rows = zip(record.radii, *columns, judged, strict=True)
        table.writerows((*key, *row) for row in rows)
    return {"differences.csv": text.getvalue()}


def _run(key: tuple[float, float, float], settings: Settings) -> CrossCheckRun:
    cells = settings.cells or CELLS[settings.level]
    return CrossCheckRun(*key, cells, ELEMENTS[settings.level])


def _found(settings: Settings, records: Records) -> Found:
    keys = tuple(product(RATIOS, THICKNESSES, FRICTIONS))
    found = {key: records.get(_run(key, settings).name) for key in keys}
    return {key: r for key, r in found.items() if isinstance(r, CrossCheckRecord)}


Apart = Mapping[tuple[float, float, float], Mapping[str, Difference]]


def _statement(name: str, apart: Apart) -> Statement:
    every = [of[name] for of in apart.values() if name in of]
    worst = max(every, key=lambda one: one.value, default=None)
    statuses = [one.status for one in every]
    counts = {status: statuses.count(status) for status in Status}
    return Statement(
        claim=f"both solvers agree: {MEANINGS[name]}",
        outcome=_worst(statuses),
        measured=f"{counts[Status.PASS]} of {len(every)} contacts within {REQUIRED[name]:g}, "
        f"{counts[Status.INCONCLUSIVE]} beyond it but within their own errors; largest difference "
        + ("–" if worst is None else f"{plain(worst.value, 2)} ± {plain(worst.joint, 2)}"),
        because=f"required {REQUIRED[name]:g}",
    )


def _explained(apart: Apart) -> Statement:
    every = [one for of in apart.values() for one in of.values()]
    explained = sum(one.is_explained for one in every)
    return Statement(
        claim="the errors that both sides own up to explain the differences",
        outcome=None,
        measured=f"{explained} of {len(every)} differences within {COVERAGE:g} joint uncertainties",
        because="a finding: where they do not, an error does not fall with refinement, or the "
        "coarse and the fine answer agree by chance",
    )


def _nearer(apart: Apart) -> Statement:
    parts = []
    for name in REQUIRED:
        judged = [of[name] for of in apart.values() if name in of]
        judged = [one for one in judged if one.to_reference is not None]
        cells = sum(one.nearer == "cells" for one in judged)
        parts.append(f"{name}: cells {cells}, elements {len(judged) - cells}")
    return Statement(
        claim="which side is nearer to a reference that neither made",
        outcome=None,
        measured="; ".join(parts),
        because="a finding, at these finenesses",
    )


def _converged(found: Found) -> Statement:
    worst = max(
        (s.residual for r in found.values() for s in (r.semi_analytical, r.finite_elements)),
        default=0.0,
    )
    expected = len(RATIOS) * len(THICKNESSES) * len(FRICTIONS)
    complete = len(found) == expected
    good = Status.PASS if worst <= SOLVER_TOLERANCE else Status.FAIL
    return Statement(
        claim="every increment converged",
        outcome=good if complete else Status.INCONCLUSIVE,
        measured=f"largest residual {plain(worst, 2)}; {len(found)} of {expected} contacts",
        because=f"allowed {SOLVER_TOLERANCE:g}",
    )


def _worst(statuses: list[Status]) -> Status:
    for status in (Status.FAIL, Status.INCONCLUSIVE):
        if status in statuses:
            return status
    return Status.PASS if statuses else Status.INCONCLUSIVE


def _difference_table(apart: Apart) -> Table:
    names = {"pressure": "p", "shear": "q", "approach": "δ"}
    columns = ["E1/E2", "h / a_H", "µ"]
    for symbol in names.values():
        columns += [f"Δ{symbol}", f"{symbol}: cells", f"{symbol}: elements", f"{symbol}: nearer"]
    rows = []
    for key, of in apart.items():
        row = [f"{value:g}" for value in key]
        for name in names:
            one = of.get(name)
            row += ["–"] * 4 if one is None else _cells_of(one)
        rows.append(tuple(row))
    return Table(
        title="Differences, with the own error of each side",
        columns=tuple(columns),
        rows=tuple(rows),
        note="Δp over p₀, Δq over µp₀, Δδ relative; behind each the change of that side from half "
        "as many cells or elements, and which side is nearer to the reference.",
    )


def _cells_of(one: Difference) -> list[str]:
    return [
        f"{SYMBOLS[one.status]} {plain(one.value, 2)}",
        plain(one.semi_analytical, 2),
        plain(one.finite_elements, 2),
        one.nearer,
    ]


def _number_table(found: Found) -> Table:
    rows = []
    for key, record in found.items():
        one, other = record.semi_analytical.numbers, record.finite_elements.numbers
        a, b = one["contact_radius"], other["contact_radius"]
        row = [*(f"{value:g}" for value in key), plain(a / b - 1, 2)]
        if "stick_radius" in one and "stick_radius" in other:
            row += [f"{one['stick_radius'] / a:.4f}", f"{other['stick_radius'] / b:.4f}"]
            scale = NORMAL_FORCE * other["approach"]
            row += [
                plain(side["dissipated_energy"] / scale, 3) if "dissipated_energy" in side else "–"
                for side in (one, other)
            ]
        else:
            row += ["–"] * 4
        rows.append(tuple(row))
    return Table(
        title="Radii and energy",
        columns=("E1/E2", "h / a_H", "µ", "a, relative difference", "c/a: cells", "c/a: elements",
                 "energy: cells", "energy: elements"),
        rows=tuple(rows),
        note="c the stick radius; energy lost to friction over W δ. Findings, not judged.",
    )  # fmt: skip


def _chart(found: Found, name: str) -> Chart:
    """A panel per coating, a curve per friction coefficient."""
    symbol, scale = {"pressure": ("Δp", "p₀"), "shear": ("Δq", "µp₀")}[name]
    rows = []
    for ratio in RATIOS:
        row = []
        for column, thickness in enumerate(THICKNESSES):
            first = ratio == RATIOS[0] and column == len(THICKNESSES) - 1
            row.append(
                Panel(
                    x_label="r / a" if ratio == RATIOS[-1] else "",
                    y_label=f"10³ {symbol} / {scale}" if column == 0 else "",
                    curves=tuple(
                        _difference_curve(found, (ratio, thickness, mu), name, n, first)
                        for n, mu in enumerate(FRICTIONS)
                        if (ratio, thickness, mu) in found and (mu > 0 or name == "pressure")
                    ),
                    title=f"E1/E2 = {ratio:g}, h = {thickness:g} a_H",
                    height=0.9,
                )
            )
        rows.append(tuple(row))
    return Chart(
        name=f"{name}_differences",
        title=f"{name.capitalize()} by cells less that by elements, {symbol} / {scale}",
        caption=f"Difference of the {name} over the radius for six ratios of moduli and three "
        f"thicknesses, in thousandths of {scale}; required is {PER_MILLE * REQUIRED[name]:g}. "
        + ("The shear is left out at the edge of stick." if name == "shear" else ""),
        rows=tuple(rows),
    )


def _difference_curve(
    found: Found, key: tuple[float, float, float], name: str, number: int, legend: bool
) -> Curve:
    record = found[key]
    one, other = (
        np.array(getattr(side, name)) for side in (record.semi_analytical, record.finite_elements)
    )
    shown = np.array(record.shear_judged) if name == "shear" else np.ones(len(one), dtype=bool)
    r = np.array(record.radii)[shown]
    label = f"µ = {key[2]:g}" if legend else ""
    return curve(label, r, PER_MILLE * (one - other)[shown], series=number)


STUDY = Study(
    name="cross-check",
    title="Both solvers on the same coated contacts",
    question="A rigid ball is pressed on coated half-spaces with and without friction: 54 scenes, "
    "solved by cells with Fourier transforms and by axisymmetric finite elements, which share "
    "nothing but the scene. How far are they apart, and does each side's own error explain it?",
    cases=cases,
    conclude=conclude,
    exports=exports,
)
