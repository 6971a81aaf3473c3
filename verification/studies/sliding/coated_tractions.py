"""The study of the paper's figures 3 and 4: pressure and shear of four coated contacts."""

from __future__ import annotations

from collections.abc import Mapping

from verification.exhibits.numbers import plain
from verification.exhibits.table import Table
from verification.judging.run import SOLVER_TOLERANCE
from verification.problems.paper_scene import HERTZ
from verification.running.row import CaseRecord, Row, found
from verification.running.rules import RESIDUAL, converged, judged, largest, total
from verification.running.study import Conclusion, Records, Settings, Statement, Study, StudyCase
from verification.studies.sliding.path import PRESSING, increments
from verification.studies.sliding.selection import ASSUMED, RATIOS, traction_runs
from verification.studies.sliding.traction_charts import figures, profiles

SELF_EQUILIBRIUM = 1e-8

REMARKS = (
    f"{ASSUMED}15 normal increments uniform in contact radius and 20 tangential ones, and the "
    "forces shown.",
    "The paper's curves are not digitised: they are shown nowhere here, and no difference from "
    "them is claimed.",
)


Found = Mapping[float, CaseRecord]


def cases(settings: Settings) -> tuple[StudyCase, ...]:
    """One case per ratio of moduli."""
    return tuple(traction_runs(settings).values())


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Figures, table and the statements of the paper that can be judged without its curves."""
    runs = traction_runs(settings)
    known = found(runs.values(), records)
    here = {ratio: known[run] for ratio, run in runs.items() if run in known}
    done = total(here.values(), "increments")
    return Conclusion(
        statements=(
            _shear_without_force(here),
            _sticks_beyond(here),
            converged(
                tuple(here.values()),
                SOLVER_TOLERANCE,
                f"in {done} increments",
                asked=len(RATIOS),
            ),
        ),
        tables=(_table(here),),
        charts=figures(here) if here else (),
        remarks=REMARKS,
    )


def _shear_without_force(here: Found) -> Statement:
    worst = largest(here.values(), "self_equilibrium")
    least = min((max(abs(profiles(r)[0].shear)) for r in here.values()), default=0.0)
    return Statement(
        claim="the paper: self-equilibrating shear at T = 0",
        outcome=judged(worst <= SELF_EQUILIBRIUM and least > 0, complete=len(here) == len(RATIOS)),
        measured=f"|Σq| / Σ|q| ≤ {plain(worst, 2)}; largest |q_x| on y = 0 at least "
        f"{least:.2f} µp_H",
        because="bodies of different moduli move past each other under pressure alone",
    )


def _sticks_beyond(here: Found) -> Statement:
    parts = {ratio: increments(r)[-1].measures["stick_fraction"] for ratio, r in here.items()}
    return Statement(
        claim="the paper: no stick area past 0.76 µW for E1/E2 = 2",
        outcome=None,
        measured="stick area at 0.9 µW over contact area: "
        + (", ".join(f"E1/E2 = {r:g}: {100 * (p or 0.0):.1f} %" for r, p in parts.items()) or "–"),
        because="a finding; the study gross-sliding looks into it",
    )


def _table(here: Found) -> Table:
    rows = []
    for ratio, record in here.items():
        ends = increments(record)
        pressed = [end for end in ends if end.parameters["step"] == PRESSING][-1]
        rows.append((
            f"{ratio:g}",
            f"{_of(pressed, 'approach') / HERTZ.approach:.4f}",
            f"{_of(pressed, 'contact_radius') / HERTZ.contact_radius:.4f}",
            f"{_of(pressed, 'peak_pressure') / HERTZ.peak_pressure:.4f}",
            f"{100 * _of(pressed, 'stick_fraction'):.2f} %",
            f"{100 * _of(ends[-1], 'stick_fraction'):.2f} %",
            f"{_of(ends[-1], 'shift') * 1e6:.4f}",
            plain(_of(record, RESIDUAL), 2),
            str(record.counters["increments"]),
            str(record.counters["convolutions"]),
        ))  # fmt: skip
    return Table(
        title="The four contacts in numbers",
        columns=(
            "E1/E2", "approach / δ_H", "a / a_H", "p₀ / p_H", "stick, T = 0", "stick, T = 0.9 µW",
            "shift at 0.9 µW", "largest residual", "increments", "convolutions",
        ),
        rows=tuple(rows),
        note="Approach, radius and peak pressure after the normal loading; normalised by Hertz's "
        "values for E1 = E2.", units={"shift at 0.9 µW": "µm"}
    )  # fmt: skip


def _of(row: Row, name: str) -> float:
    value = row.measures[name]
    return float("nan") if value is None else value


STUDY = Study(
    name="coated-tractions",
    title="The paper's figures 3 and 4: tractions of coated contacts",
    question="A rigid ball is pressed on a coated half-space and pushed sideways, for four ratios "
    "of coating to substrate modulus: the scenes of the paper's figures 3 and 4, done again.",
    cases=cases,
    conclude=conclude,
)
