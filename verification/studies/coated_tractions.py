"""The study of the paper's figures 3 and 4: pressure and shear of four coated contacts."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping

import numpy as np

from verification.exhibits.numbers import plain
from verification.exhibits.table import Table
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.judging.run import SOLVER_TOLERANCE
from verification.problems.paper_scene import HERTZ
from verification.running.study import (
    Conclusion,
    Records,
    Settings,
    Statement,
    Study,
    StudyCase,
)
from verification.studies.coated_traction_figures import figures
from verification.studies.sliding_runs.contacts import CoatedContact
from verification.studies.sliding_runs.traction_run import TractionRecord, TractionRun

RATIOS = (0.5, 1.0, 2.0, 4.0)
CELLS = {Level.QUICK: 64, Level.STANDARD: 128, Level.FULL: 256}
NORMAL_INCREMENTS = 15
TANGENTIAL_INCREMENTS = (6, 7, 7)  # to 0.3, 0.6 and 0.9 µW
SELF_EQUILIBRIUM = 1e-8

REMARKS = (
    "Assumed, because the paper does not say: substrate E2 = 210 GPa (from its contact radius and "
    "peak pressure), ν = 0.3 of coating and substrate, a rigid ball, a paraboloid for the sphere, "
    "15 normal increments uniform in contact radius and 20 tangential ones, and the forces shown.",
    "The paper's curves are not digitised: they are shown nowhere here, and no difference from "
    "them is claimed.",
)


def cases(settings: Settings) -> tuple[StudyCase, ...]:
    """One case per ratio of moduli."""
    return tuple(_run(ratio, settings) for ratio in RATIOS)


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Figures, table and the statements of the paper that can be judged without its curves."""
    found = _found(settings, records)
    return Conclusion(
        statements=(_shear_without_force(found), _sticks_beyond(found), _converged(found)),
        tables=(_table(found),),
        charts=figures(found) if found else (),
        remarks=REMARKS,
    )


def exports(settings: Settings, records: Records) -> Mapping[str, str]:
    """`profiles.csv` with the curves and `summary.json` with the numbers."""
    found = _found(settings, records)
    summary = {f"{ratio:g}": _summary(record) for ratio, record in found.items()}
    return {
        "profiles.csv": _profiles(found),
        "summary.json": json.dumps({"E1_over_E2": summary}, indent=1) + "\n",
    }


def _run(ratio: float, settings: Settings) -> TractionRun:
    cells = settings.cells or CELLS[settings.level]
    return TractionRun(CoatedContact(ratio), cells, NORMAL_INCREMENTS, TANGENTIAL_INCREMENTS)


def _found(settings: Settings, records: Records) -> dict[float, TractionRecord]:
    found = {ratio: records.get(_run(ratio, settings).name) for ratio in RATIOS}
    return {ratio: r for ratio, r in found.items() if isinstance(r, TractionRecord)}


def _shear_without_force(found: Mapping[float, TractionRecord]) -> Statement:
    worst = max((r.self_equilibrium for r in found.values()), default=0.0)
    least = min((max(map(abs, r.profiles[0].shear)) for r in found.values()), default=0.0)
    return Statement(
        claim="the paper: self-equilibrating shear at T = 0",
        outcome=_judged(found, worst <= SELF_EQUILIBRIUM and least > 0),
        measured=f"|Σq| / Σ|q| ≤ {plain(worst, 2)}; largest |q_x| on y = 0 at least "
        f"{least:.2f} µp_H",
        because="bodies of different moduli move past each other under pressure alone",
    )


def _sticks_beyond(found: Mapping[float, TractionRecord]) -> Statement:
    parts = {ratio: _stick_part(record, -1) for ratio, record in found.items()}
    return Statement(
        claim="the paper: no stick area past 0.76 µW for E1/E2 = 2",
        outcome=None,
        measured="stick area at 0.9 µW over contact area: "
        + (", ".join(f"E1/E2 = {r:g}: {100 * part:.1f} %" for r, part in parts.items()) or "–"),
        because="a finding; the study gross-sliding looks into it",
    )


def _converged(found: Mapping[float, TractionRecord]) -> Statement:
    worst = max((r.largest_residual for r in found.values()), default=0.0)
    count = sum(len(r.history) for r in found.values())
    return Statement(
        claim="every increment converged",
        outcome=_judged(found, worst <= SOLVER_TOLERANCE),
        measured=f"largest residual {plain(worst, 2)} in {count} increments",
        because=f"allowed {SOLVER_TOLERANCE:g}",
    )


def _judged(found: Mapping[float, TractionRecord], good: bool) -> Status:
    if len(found) < len(RATIOS):
        return Status.INCONCLUSIVE
    return Status.PASS if good else Status.FAIL


def _stick_part(record: TractionRecord, index: int) -> float:
    point = record.history[index]
    return point.stick_area / (np.pi * point.contact_radius**2)


def _summary(record: TractionRecord) -> dict[str, object]:
    states = [
        record.history[n].model_dump()
        for n, point in enumerate(record.history)
        if n + 1 == len(record.history) or record.history[n + 1].step != point.step
    ]
    return {
        "states": states,
        "increments": len(record.history),
        "halvings": record.halvings,
        "convolutions": record.convolutions,
        "largest_residual": record.largest_residual,
    }


def _table(found: Mapping[float, TractionRecord]) -> Table:
    rows = []
    for ratio, record in found.items():
        pressed = next(p for p in reversed(record.history) if p.step == 1)
        end = record.history[-1]
        rows.append((
            f"{ratio:g}",
            f"{pressed.approach / HERTZ.approach:.4f}",
            f"{pressed.contact_radius / HERTZ.contact_radius:.4f}",
            f"{pressed.peak_pressure / HERTZ.peak_pressure:.4f}",
            f"{100 * pressed.stick_area / (np.pi * pressed.contact_radius**2):.2f} %",
            f"{100 * _stick_part(record, -1):.2f} %",
            f"{end.shift * 1e6:.4f}",
            plain(record.largest_residual, 2),
            str(len(record.history)),
            str(record.convolutions),
        ))  # fmt: skip
    return Table(
        title="The four contacts in numbers",
        columns=(
            "E1/E2", "approach / δ_H", "a / a_H", "p₀ / p_H", "stick, T = 0", "stick, T = 0.9 µW",
            "shift at 0.9 µW (µm)", "largest residual", "increments", "convolutions",
        ),
        rows=tuple(rows),
        note="Approach, radius and peak pressure after the normal loading; normalised by Hertz's "
        "values for E1 = E2.",
    )  # fmt: skip


def _profiles(found: Mapping[float, TractionRecord]) -> str:
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(("E1_over_E2", "T_over_muW", "x_over_aH", "p_over_pH", "qx_over_mu_pH"))
    for ratio, record in found.items():
        for profile in record.profiles:
            rows = zip(record.x, profile.pressure, profile.shear, strict=True)
            table.writerows((ratio, profile.force, *row) for row in rows)
    return text.getvalue()


STUDY = Study(
    name="coated-tractions",
    title="The paper's figures 3 and 4: tractions of coated contacts",
    question="A rigid ball is pressed on a coated half-space and pushed sideways, for four ratios "
    "of coating to substrate modulus: the scenes of the paper's figures 3 and 4, done again.",
    cases=cases,
    conclude=conclude,
    exports=exports,
)
