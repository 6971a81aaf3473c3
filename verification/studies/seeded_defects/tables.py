"""Tables, figure and files of the study."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from verification.defects.outputs import PLANTED
from verification.exhibits.chart import Chart, Look, Panel, curve, stacked
from verification.exhibits.numbers import plain
from verification.exhibits.table import Table, table_of
from verification.running.rules import total
from verification.running.study import Records
from verification.studies.seeded_defects.findings import (
    Seen,
    Sighting,
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
    def of_best(text: Callable[[Sighting], str]) -> Callable[[Seen], str]:
        return lambda one: "–" if one.best is None else text(one.best)

    def clearance(best: Sighting) -> str:
        return "–" if best.verdict.clearance is None else plain(best.verdict.clearance, 2)

    return table_of(
        "Seeded defects",
        {
            "defect": lambda one: one.defect.name,
            "what is broken": lambda one: one.defect.broken,
            "caught by": of_best(lambda best: f"{best.case}/{best.verdict.quantity}"),
            "how": of_best(lambda best: best.verdict.how),
            "error / allowed": of_best(clearance),
            "cases": _votes,
        },
        all_seen,
        "The verdict that misses by most; an error in units of what is allowed.",
    )


def _votes(one: Seen) -> str:
    if one.best is None:
        return "missed" if one.complete else "not judged"
    return f"{len(one.by)} of {len(one.cases)}"


def _gates(records: Records) -> Table:
    pairs = [
        (defect.name, case, record)
        for defect in PLANTED
        for case in defect.cases
        if (record := found(records, defect.name, case)) is not None
    ]
    return table_of(
        "Planted errors under a fixed gate and under the harness",
        {
            "error": lambda of: of[0],
            "case": lambda of: of[1],
            "largest error": lambda of: _percent(of[2].measures[ERROR]),
            f"gate of {100 * GATE:g} %": lambda of: "passes" if passes_gate(of[2]) else "fails",
            "harness": lambda of: "{failed} of {verdicts} fail".format(**of[2].counters),
            "verdicts": lambda of: ", ".join(sorted({v.quantity for v in caught(of[2])})) or "–",
        },
        pairs,
        "The largest error of any quantity of the case, relative to its scale.",
    )


def _percent(error: float | None) -> str:
    return "–" if error is None else f"{100 * error:.3f} %"


def _families(records: Records) -> Table:
    families = healthy(records)
    bars = {family: derived(there) for family, there in families.items()}
    return table_of(
        "Healthy contacts",
        {
            "family": str,
            "contacts": lambda of: str(len(families[of])),
            "verdicts": lambda of: str(total(families[of], "verdicts")),
            "false alarms": lambda of: str(total(families[of], "failed")),
            "within U": lambda of: (
                f"{sum(map(covered, bars[of]))} of {len(bars[of])}" if bars[of] else "–"
            ),
            "largest error / U": lambda of: (
                plain(max(_parts(bars[of]), default=0.0), 2) if bars[of] else "–"
            ),
        },
        families,
        "Tolerances of flat punches are not derived: their rim is a staircase of cells.",
    )


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
        stacked(
            "error_bars",
            "True errors in units of their error bars",
            "Share of the healthy samples whose true error is below a part of U = 2u. "
            "What lies right of 1 is not covered.",
            panel,
        ),
    )
