"""The stability map as a study: its question, its tables and its files."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping

from verification.cases.case import Level
from verification.cases.table import Table
from verification.report.numbers import plain
from verification.studies.running.study import Conclusion, Records, Settings, Study
from verification.studies.stability import verdicts
from verification.studies.stability.cell import StabilityCell
from verification.studies.stability.charts import class_of, view_chart
from verification.studies.stability.record import CellRecord
from verification.studies.stability.views import study_cells, views

CELLS = {Level.QUICK: 32, Level.STANDARD: 32, Level.FULL: 48}
MOST_ROWS = 150

REMARKS = (
    "Unless a cell says otherwise: a rigid ball on a body with a coating as thick as the contact "
    "radius and twice as stiff, ν = 0.3 throughout, µ = 0.1, T = 0.6 µW, pressed in three "
    "increments. Increments are as large as can be on purpose: the map is about convergence, not "
    "about accuracy, and its coarse grids are for speed.",
    "The force is chosen so that the contact radius is known without friction; a contact that "
    "friction or T makes larger than the window gets a wider one.",
    "Residuals are judged twice: as the solver states them, and from the returned fields alone "
    "(tension, overlap, pressure at a gap, forces carried, friction limit, slip against shear, "
    "dissipation), where ten times the tolerance is allowed, because their norms differ.",
    "Where the contact is so light that gaps are rounded to more than 1e-9 of the approach, the "
    "tolerance is ten times that rounding.",
    "On greased and patchy surfaces T is a part of what friction can carry there, roughly.",
)


def cases(settings: Settings) -> tuple[StabilityCell, ...]:
    """Every cell of the level."""
    return study_cells(settings.level, _cells(settings))


def conclude(settings: Settings, records: Records) -> Conclusion:
    """The verdicts, a row per cell, and the map."""
    found = _found(settings, records)
    by_name = {cell.name: record for cell, record in found.items()}
    maps = views(settings.level, _cells(settings))
    return Conclusion(
        statements=(
            verdicts.nothing_silent(found),
            verdicts.everything_converges(found),
            verdicts.refusals_are_due(found),
            verdicts.cost(found),
        ),
        tables=(_table(found),),
        charts=tuple(view_chart(view, by_name) for view in maps) if found else (),
        remarks=REMARKS,
    )


def exports(settings: Settings, records: Records) -> Mapping[str, str]:
    """`cells.csv`: all coordinates and results, a line per cell."""
    found = _found(settings, records)
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    results = [name for name in CellRecord.model_fields if name != "seconds"]
    table.writerow(["cell", *StabilityCell().coordinates, *results])
    for cell, record in found.items():
        values = record.model_dump(mode="json")
        table.writerow([cell.name, *cell.coordinates.values(), *(values[name] for name in results)])
    return {"cells.csv": text.getvalue()}


def _cells(settings: Settings) -> int:
    return settings.cells or CELLS[settings.level]


def _found(settings: Settings, records: Records) -> dict[StabilityCell, CellRecord]:
    found = {cell: records.get(cell.name) for cell in cases(settings)}
    return {cell: r for cell, r in found.items() if isinstance(r, CellRecord)}


def _table(found: Mapping[StabilityCell, CellRecord]) -> Table:
    shown = _hardest(found.items())
    left_out = len(found) - len(shown)
    return Table(
        title="The cells" if not left_out else f"The {len(shown)} hardest of {len(found)} cells",
        columns=(
            "cell", "verdict", "worst residual", "from the fields", "increments", "halved", "way",
            "rounds", "iterations", "convolutions",
        ),
        rows=tuple(_row(cell, record) for cell, record in shown),
        note="A cell is named by the coordinates that differ from the ordinary ones; `cells.csv` "
        "has all of them. Rounds: the most that pressure and shear took to agree in an increment.",
    )  # fmt: skip


def _hardest(
    items: Iterable[tuple[StabilityCell, CellRecord]],
) -> list[tuple[StabilityCell, CellRecord]]:
    """The worst classes first, then the dearest."""
    ranked = sorted(items, key=lambda item: (-class_of(item[1]), -item[1].convolutions))
    return ranked[:MOST_ROWS]


def _row(cell: StabilityCell, record: CellRecord) -> tuple[str, ...]:
    return (
        cell.name,
        f"{record.verdict}: {record.reason}" if record.reason else str(record.verdict),
        "–" if record.residual is None else plain(record.residual, 2),
        "–" if record.observed is None else plain(record.observed, 2),
        str(record.increments),
        str(record.halvings),
        record.way or "–",
        str(record.rounds),
        str(record.iterations),
        str(record.convolutions),
    )


STUDY = Study(
    name="stability",
    title="The stability map: which contacts the solver masters",
    question="Friction, force, coating, Poisson's ratio, loading path, surface, scale and load are "
    "varied far beyond what is usual, one increment as large as can be. Does every contact end "
    "either converged, with its residual, or refused, with a reason?",
    cases=cases,
    conclude=conclude,
    exports=exports,
)
