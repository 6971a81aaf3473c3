"""Tables, figure and files of the study."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from verification.defects.outputs import PLANTED
from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.exhibits.numbers import plain
from verification.exhibits.table import Table
from verification.running.rules import total
from verification.running.study import Records
from verification.studies.seeded_defects.findings import (
    Seen,
    covered,
    derived,
    found,
    healthy,
    passes_gate,
)
from verification.studies.seeded_defects.runs import ERROR, GATE, Sample, caught


def tables(records: Records, all_seen: Sequence[Seen]) -> tuple[Table, ...]:
    """Of defects, of planted errors, and of healthy contacts."""
    return (_defects(all_seen), _gates(records), _families(records))


def _defects(all_seen: Sequence[Seen]) -> Table:
    rows = []
    for one in all_seen:
        best = one.best
        if best is None:
            how = ("–", "–", "–", "missed" if one.complete else "not judged")
        else:
            verdict = best.verdict
            units = "–" if verdict.clearance is None else plain(verdict.clearance, 2)
            how = (f"{best.case}/{verdict.quantity}", verdict.how, units, _votes(one))
        rows.append((one.defect.name, one.defect.broken, *how))
    return Table(
        title="Seeded defects",
        columns=("defect", "what is broken", "caught by", "how", "error / allowed", "cases"),
        rows=tuple(rows),
        note="The verdict that misses by most; an error in units of what is allowed.",
    )


def _votes(one: Seen) -> str:
    return f"{len(one.by)} of {len(one.cases)}"


def _gates(records: Records) -> Table:
    rows = []
    for defect in PLANTED:
        for case in defect.cases:
            record = found(records, defect.name, case)
            if record is None:
                continue
            largest = record.measures[ERROR]
            error = "–" if largest is None else f"{100 * largest:.3f} %"
            rows.append((
                defect.name, case, error, "passes" if passes_gate(record) else "fails",
                f"{record.counters['failed']} of {record.counters['verdicts']} fail",
                ", ".join(sorted({verdict.quantity for verdict in caught(record)})) or "–",
            ))  # fmt: skip
    return Table(
        title="Planted errors under a fixed gate and under the harness",
        columns=(
            "error", "case", "largest error", f"gate of {100 * GATE:g} %", "harness", "verdicts",
        ),
        rows=tuple(rows),
        note="The largest error of any quantity of the case, relative to its scale.",
    )  # fmt: skip


def _families(records: Records) -> Table:
    rows = []
    for family, there in healthy(records).items():
        samples = derived(there)
        inside = sum(map(covered, samples))
        rows.append((
            family,
            str(len(there)),
            str(total(there, "verdicts")),
            str(total(there, "failed")),
            f"{inside} of {len(samples)}" if samples else "–",
            plain(max(_parts(samples), default=0.0), 2) if samples else "–",
        ))  # fmt: skip
    return Table(
        title="Healthy contacts",
        columns=(
            "family", "contacts", "verdicts", "false alarms", "within U", "largest error / U",
        ),
        rows=tuple(rows),
        note="Tolerances of flat punches are not derived: their rim is a staircase of cells.",
    )  # fmt: skip


def _parts(samples: Iterable[Sample]) -> list[float]:
    """Errors in units of U, of the samples that have both."""
    return [s.error / s.uncertainty for s in samples if s.error is not None and s.uncertainty]


def charts(records: Records) -> tuple[Chart, ...]:
    """How the true errors are spread over their error bars; none without samples."""
    curves = []
    for number, (family, there) in enumerate(healthy(records).items()):
        parts = sorted(_parts(derived(there)))
        if parts:
            shares = [(k + 1) / len(parts) for k in range(len(parts))]
            curves.append(curve(family, parts, shares, series=number))
    if not curves:
        return ()
    bound = curve("U", [1.0, 1.0], [0.0, 1.0], Look.BOUND)
    panel = Panel(
        x_label="error / U", y_label="share of samples below", curves=(*curves, bound), height=2.2
    )
    return (
        Chart(
            name="error_bars",
            title="True errors in units of their error bars",
            caption="Share of the healthy samples whose true error is below a part of U = 2u. "
            "What lies right of 1 is not covered.",
            rows=((panel,),),
        ),
    )
