"""The stability map as a study: its question, its tables and its files."""

from __future__ import annotations

from verification.judging.case import Level
from verification.running.row import found
from verification.running.study import Conclusion, Records, Settings, Study
from verification.studies.stability.cell import StabilityCell
from verification.studies.stability.charts import view_chart
from verification.studies.stability.judged import StabilityRun
from verification.studies.stability.record import CellRecord
from verification.studies.stability.tables import tables
from verification.studies.stability.verdicts import answer, statements
from verification.studies.stability.views import study_cells, views

CELLS = {Level.QUICK: 32, Level.STANDARD: 32, Level.FULL: 48}

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
    "Finite elements: a quarter as many elements per contact radius as the surface grid has cells "
    "along a side, half as many harmonics. What they return as gap has no overlap, so gap and slip "
    "are worked out anew from the returned tractions and the compliance of the section. Springs at "
    "Gauss points, corrected once, are held to what any correction allows: no overlap beyond p/ε, "
    "no slip that the motion lacks.",
    "They cannot pose height maps, uneven friction and turning loads: of each one cell stands for "
    "all, and is refused by name.",
)


def cases(settings: Settings) -> tuple[StabilityRun, ...]:
    """Every cell of the level."""
    return tuple(map(StabilityRun, study_cells(settings.level, _cells(settings))))


def conclude(settings: Settings, records: Records) -> Conclusion:
    """The verdicts, the tables and the map."""
    here = _found(settings, records)
    by_name = {cell.name: record for cell, record in here.items()}
    maps = views(settings.level, _cells(settings))
    return Conclusion(
        statements=statements(here),
        answer=answer(here),
        tables=tables(here),
        charts=tuple(view_chart(view, by_name) for view in maps if view.wide) if here else (),
        remarks=REMARKS,
    )


def _cells(settings: Settings) -> int:
    return settings.cells or CELLS[settings.level]


def _found(settings: Settings, records: Records) -> dict[StabilityCell, CellRecord]:
    return {run.cell: CellRecord.of(r) for run, r in found(cases(settings), records).items()}


STUDY = Study(
    name="stability",
    title="The stability map: which contacts the solvers master",
    question="Friction, force, coating, Poisson's ratio, loading path, surface, scale and load are "
    "varied far beyond what is usual, one increment as large as can be. Does every contact end "
    "either converged, with its residual, or refused, with a reason?",
    cases=cases,
    conclude=conclude,
)
