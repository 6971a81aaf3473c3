"""Stability study: statements, tables and maps of the contacts that the solvers can solve."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from verification.exhibits.chart import (
    NONE,
    Chart,
    Curve,
    Look,
    Panel,
    Table,
    curve,
    plain,
    stacked,
)
from verification.judging.case import OTHER_NORMS, Level
from verification.running.study import (
    Conclusion,
    Records,
    Settings,
    Statement,
    Study,
    found,
    judged,
)
from verification.studies.stability.contacts import (
    CellRecord,
    Refusal,
    Solver,
    StabilityCell,
    Verdict,
    View,
    study_cells,
    views,
)

Found = Mapping[StabilityCell, CellRecord]
Item = tuple[StabilityCell, CellRecord]

MAX_NAMED = 12
MAX_WAYS = 4
LEAST_SHARE = 0.99  # of the cells that are not refused
LARGEST_FORCE = 1.0  # T/µW that friction carries
NAMES = {
    Solver.SEMI_ANALYTICAL: "semi-analytical",
    Solver.COMPLEMENTARITY: "finite elements, complementarity",
    Solver.PENALTY: "finite elements, penalty",
}
WORK = {True: "linear systems", False: "convolutions"}  # by use of finite elements


def statements(found: Found) -> tuple[Statement, ...]:
    """Judge wrong results, convergence and refusals in the stability map, and report the cost.

    Each solver has its own statements.

    found  records by contact of the stability map
    """
    told: list[Statement] = []
    for solver in Solver:
        cells = contacts_of_solver(found, solver)
        about = (nothing_silent, nearly_everything_converges, refusals_are_due, cost)
        told += (
            one.model_copy(update={"claim": f"{NAMES[solver]}: {one.claim}"})
            for one in (state(cells) for state in about)
        )
    return tuple(told)


def contacts_of_solver(found: Found, solver: Solver) -> Found:
    """Select the contacts of the stability map that one solver had to solve, with their records.

    found  records by contact of the stability map
    """
    return {cell: record for cell, record in found.items() if cell.solver is solver}


def contacts_with_verdict(found: Found, *so: Verdict) -> Found:
    """Select the contacts of the stability map that ended with one of the given verdicts.

    found  records by contact of the stability map
    so     verdicts, such as converged or refused
    """
    return {cell: record for cell, record in found.items() if record.verdict in so}


def answer(found: Found) -> str:
    """Return the answer of the stability study: numbers of converged, refused and failed contacts.

    The text is empty without records.

    found  records by contact of the stability map
    """
    if not found:
        return ""
    ends = Counter(record.verdict for record in found.values())
    refused = contacts_with_verdict(found, Verdict.REFUSED)
    asked = Counter(NAMES[cell.solver] for cell in found)
    return (
        f"Of {len(found)} cells ({'; '.join(f'{name}: {n}' for name, n in asked.items())}) "
        f"{ends[Verdict.CONVERGED]} converged, with "
        f"residuals of {_worst_residual_text(found)} at most, and {len(refused)} were refused, "
        f"{len(_duly_refused(refused))} of these for a force above µW or because a section "
        "cannot pose them; "
        f"{ends[Verdict.NOT_CONVERGED]} gave up and {ends[Verdict.SILENT]} are wrong in silence."
    )


def _worst_residual_text(found: Found) -> str:
    """Return the largest residual of all converged contacts of the stability map as text.

    found  records by contact of the stability map
    """
    solved = contacts_with_verdict(found, Verdict.CONVERGED).values()
    return plain(max((r.worst or 0.0 for r in solved), default=0.0), 2)


def nothing_silent(found: Found) -> Statement:
    """Judge the claim that no result that violates the equations was returned as converged.

    found  records by contact of the stability map
    """
    silent = contacts_with_verdict(found, Verdict.SILENT)
    return Statement(
        claim="no cell is wrong in silence",
        outcome=judged(not silent, complete=bool(found)),
        measured=f"{len(silent)} of {len(found)} cells{_names_text(silent)}",
        because="residuals of the solver within its tolerance, and the laws of contact and "
        "friction found again in what it returns",
    )


def nearly_everything_converges(found: Found) -> Statement:
    """Judge the claim that at least 99 % of the contacts that the solver does not refuse converge.

    found  records by contact of the stability map
    """
    given_up, solved = (
        contacts_with_verdict(found, Verdict.NOT_CONVERGED),
        contacts_with_verdict(found, Verdict.CONVERGED),
    )
    asked = len(solved) + len(given_up)
    enough = bool(solved) and len(solved) >= LEAST_SHARE * asked
    return Statement(
        claim=f"at least {LEAST_SHARE:.0%} of the cells that are not refused converge",
        outcome=judged(enough, complete=bool(found)),
        measured=f"{len(solved)} of {asked} converged, largest residual "
        f"{_worst_residual_text(found)}; "
        f"{len(given_up)} not converged{_names_text(given_up)}",
        because="a solver that gives up says so, with its residual; every such cell has a row",
    )


def refusals_are_due(found: Found) -> Statement:
    """Judge the claim that exactly those contacts are refused that have no solution or no model.

    A contact has no solution if its tangential force exceeds µW. Finite elements have no model of
    contacts that are not axisymmetric or whose tangential load turns.

    found  records by contact of the stability map
    """
    refused = contacts_with_verdict(found, Verdict.REFUSED)
    due = {cell: kind for cell in found if (kind := _due_refusal(cell))}
    wrong = sorted((refused.keys() | due) - _duly_refused(refused), key=lambda cell: cell.name)
    beyond = sum(kind is Refusal.FORCE for kind in due.values())
    unposable = len(due) - beyond
    return Statement(
        claim="refused is a force above µW"
        + (", and what is not of revolution" if unposable else "")
        + "; nothing else",
        outcome=judged(not wrong, complete=bool(found)),
        measured=f"{len(refused)} refused, {beyond} ask for more than µW"
        + (f", {unposable} are not of revolution" if unposable else "")
        + _names_text(wrong),
        because="the only cells of the map that have no solution, or none on a section: one "
        "of each kind",
    )


def cost(found: Found) -> Statement:
    """Report the work per increment and the solution methods of the converged contacts of one
    solver.

    The statement is a finding without a verdict.

    found  records by contact of the stability map, of one solver
    """
    solved = contacts_with_verdict(found, Verdict.CONVERGED).values()
    if not solved:
        return Statement(claim="cost", outcome=None, measured="no cell converged")
    by_elements = next(iter(found)).solver.by_elements
    per_increment = [r.work / r.increments for r in solved]
    ways = Counter(r.way for r in solved).most_common(MAX_WAYS)
    halved = sum(r.halvings > 0 for r in solved)
    return Statement(
        claim="cost",
        outcome=None,
        measured=f"{np.median(per_increment):.0f} {WORK[by_elements]} per increment in the median "
        f"cell, {max(per_increment):.0f} in the dearest; {halved} cells halved increments. Most "
        "often: " + ", ".join(f"{way}: {count}" for way, count in ways),
        because="deterministic counts; increments are as large as can be, T comes in one step",
    )


def _due_refusal(cell: StabilityCell) -> Refusal:
    """Return the reason for which a contact of the stability map must be refused; empty for none.

    A tangential force above µW and a scene without model in the solver are such reasons.
    """
    if not cell.posable:
        return Refusal.POSE
    return Refusal.FORCE if cell.push > LARGEST_FORCE else Refusal.NONE


def _duly_refused(refused: Found) -> set[StabilityCell]:
    """Select the refused contacts of the stability map that the solver refused for the expected
    reason.

    refused  records of the refused contacts
    """
    return {
        cell for cell, r in refused.items() if r.refused_for and r.refused_for is _due_refusal(cell)
    }


def _names_text(cells: Iterable[StabilityCell]) -> str:
    """Return the names of the first 12 contacts of the stability map as text.

    The text ends with the number of further contacts. It is empty without contacts.
    """
    names = [cell.name for cell in cells]
    if not names:
        return ""
    more = f" and {len(names) - MAX_NAMED} more" if len(names) > MAX_NAMED else ""
    return ": " + ", ".join(names[:MAX_NAMED]) + more


# Axis labels of the coordinates.
AXES = {
    "friction": "µ",
    "push": "T / µW",
    "modulus_ratio": "E1/E2",
    "thickness": "h/a",
    "poisson_ratio": "ν of the layer",
    "path": "path",
    "surface": "surface",
    "load": "W / W(a)",
    "length": "a (m)",
    "modulus": "E2 (Pa)",
    "solver": "solver",
}

# Classes from best to worst, each with the series whose colour and shape it takes; a place shows
# the worst of its cells. First the decades of the residual over what is allowed.
CLASSES = (
    ("residual ≤ allowed / 100", 4),
    ("residual ≤ allowed / 10", 2),
    ("residual ≤ allowed", 0),
    ("refused", 3),
    ("not converged", 1),
    ("silent", 5),
)
SHAPES = "downward triangle, upward triangle, disc, diamond, square, cross"
DECADES = (0.01, 0.1)  # upper ends of the first two, over what is allowed
ENDS = {Verdict.REFUSED: 3, Verdict.NOT_CONVERGED: 4, Verdict.SILENT: 5}
HALVED = "*"
HEIGHT_PER_ROW = 0.24
HEIGHT_OF_AXES = 0.5
THOUSANDS = 10_000  # from here on the cost is rounded to them


def class_of(record: CellRecord) -> int:
    """Return the legend class of a contact in the stability map: 0 (best) to 5 (worst).

    Classes 0 to 2 are converged contacts, by the ratio of residual to allowed residual. Classes 3
    to 5 are refused contacts, contacts that did not converge, and wrong results returned as
    converged.
    """
    if record.verdict in ENDS:
        return ENDS[record.verdict]
    return sum(_part_of_allowed(record) > decade for decade in DECADES)


def _part_of_allowed(record: CellRecord) -> float:
    """Return the largest ratio of a residual of a contact to the allowed value of the residual.

    The residual that the solver states and the one computed from its fields have different allowed
    values.
    """
    stated, seen = record.residual or 0.0, record.observed or 0.0
    return max(stated, seen / OTHER_NORMS) / record.tolerance


def view_chart(view: View, found: Mapping[str, CellRecord]) -> Chart:
    """Draw one map of contacts over two coordinates, with outcome and work at every point.

    Colour and shape show the worst outcome of the contacts at a point. Points without a record stay
    empty.

    view   map of contacts
    found  records by name of the contact
    """
    x_values, y_values = view.values(view.x), view.values(view.y)
    places: dict[int, list[tuple[int, int]]] = {n: [] for n in range(len(CLASSES))}
    notes = []
    for i, x in enumerate(x_values):
        for j, y in enumerate(y_values):
            records = [found[cell.name] for cell in view.at(x, y) if cell.name in found]
            if records:
                places[max(map(class_of, records))].append((i, j))
                notes.append((float(i), float(j), _work_text(records)))
    return stacked(
        f"stability_{view.name.replace('-', '_')}",
        view.title,
        "Colour and shape: the worst residual of the cells at a place beside what "
        f"is allowed, or how they ended ({'; '.join(_legend_texts())}). Allowed is the tolerance, "
        f"and of what the fields alone show {OTHER_NORMS:g} times that. Number: the most "
        f"{WORK[view.by_elements]} that one of them took"
        f"{' (steps of Newton or of the active set)' if view.by_elements else ''}, with "
        f"{HALVED} where increments were halved.",
        Panel(
            x_label=AXES[view.x],
            y_label=AXES[view.y],
            curves=tuple(_class_tiles(n, where) for n, where in places.items() if where),
            height=HEIGHT_OF_AXES + HEIGHT_PER_ROW * len(y_values),
            notes=tuple(notes),
            x_places=_axis_texts(x_values),
            y_places=_axis_texts(y_values),
        ),
    )


def _class_tiles(number: int, where: list[tuple[int, int]]) -> Curve:
    x, y = zip(*where, strict=True)
    label, series = CLASSES[number]
    return curve(label, map(float, x), map(float, y), Look.TILES, series)


def _legend_texts() -> list[str]:
    return [f"{s}: {label}" for s, (label, _) in zip(SHAPES.split(", "), CLASSES, strict=True)]


def _work_text(records: list[CellRecord]) -> str:
    most = max(record.work for record in records)
    mark = HALVED if any(record.halvings for record in records) else ""
    number = "–" if most == 0 else str(most) if most < THOUSANDS else f"{most / 1000:.0f}k"
    return number + mark


def _axis_texts(values: Iterable[Any]) -> tuple[str, ...]:
    return tuple(str(v) if isinstance(v, str) else plain(v, 6) for v in values)


def tables(found: Found) -> tuple[Table, ...]:
    """Return the tables of the stability study: one of the solvers, and one of contacts that
    failed.

    The second table is absent if all contacts are converged or refused.

    found  records by contact of the stability map
    """
    bad = [*contacts_with_verdict(found, Verdict.NOT_CONVERGED, Verdict.SILENT).items()]
    return (_solver_table(found), *([_unsolved_table(bad)] if bad else []))


def _solver_table(found: Found) -> Table:
    return Table(
        title="The solvers",
        columns=(
            *("solver", "cells", *Verdict),
            *("largest residual", "from the fields", "increments", "work"),
        ),
        rows=tuple(_solver_row(solver, contacts_of_solver(found, solver)) for solver in Solver),
        note="Work: convolutions of the semi-analytical solver, linear systems of the finite "
        "elements.",
        units=NONE,
    )


def _solver_row(solver: Solver, cells: Found) -> tuple[str, ...]:
    solved = contacts_with_verdict(cells, Verdict.CONVERGED).values()
    return (
        NAMES[solver],
        str(len(cells)),
        *(str(len(contacts_with_verdict(cells, verdict))) for verdict in Verdict),
        _largest_text(record.residual for record in solved),
        _largest_text(record.observed for record in solved),
        str(sum(record.increments for record in solved)),
        str(sum(record.work for record in solved)),
    )


def _unsolved_table(bad: list[Item]) -> Table:
    return Table(
        title=f"Not solved: all of these {len(bad)} cells",
        columns=("cell", "verdict", "worst residual", "reason"),
        rows=tuple(
            (cell.name, record.verdict, _number_text(record.worst), record.reason or "–")
            for cell, record in bad
        ),
        units=NONE,
    )


def _largest_text(values: Iterable[float | None]) -> str:
    return _number_text(max((value or 0.0 for value in values), default=None))


def _number_text(value: float | None) -> str:
    return "–" if value is None else plain(value, 2)


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
    "They cannot pose height maps and uneven friction: of each one cell stands for all, and is "
    "refused by name. Of turning loads, too, one cell stands for all.",
)


def cases(settings: Settings) -> tuple[StabilityCell, ...]:
    """Return the cases of the stability study: all contacts of its maps at the level (quick,
    standard or full) of the study.
    """
    return study_cells(settings.level, _cells_per_side(settings))


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Derive the conclusion of the stability study: statements, tables and maps of contacts.

    records  available records of the contacts
    """
    here = {cell: CellRecord.of(r) for cell, r in found(cases(settings), records).items()}
    by_name = {cell.name: record for cell, record in here.items()}
    maps = views(settings.level, _cells_per_side(settings))
    return Conclusion(
        statements=statements(here),
        answer=answer(here),
        tables=tables(here),
        charts=tuple(view_chart(view, by_name) for view in maps if view.wide) if here else (),
        remarks=REMARKS,
    )


def _cells_per_side(settings: Settings) -> int:
    return settings.cells or CELLS[settings.level]


STUDY = Study(
    name="stability",
    title="The stability map: which contacts the solvers master",
    question="Friction, force, coating, Poisson's ratio, loading path, surface, scale and load are "
    "varied far beyond what is usual, one increment as large as can be. Does every contact end "
    "either converged, with its residual, or refused, with a reason?",
    cases=cases,
    conclude=conclude,
)
