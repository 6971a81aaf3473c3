"""A rigid ball pressed on bodies that slip away below it: friction before anything pushes."""

from __future__ import annotations

from collections.abc import Sequence

from verification.cases.indentation_charts import indentation_chart, indentation_table
from verification.cases.indentation_reference import (
    COATED,
    FEW,
    MANY,
    NU_ZERO,
    STRONG,
    WEAK,
    Indentation,
)
from verification.judging.case import Case, Comparison, Finding, Level, Quantity, Required
from verification.observed.end_state import approach, contact_radius
from verification.problems.reference import ReferenceKind

ASKED = "asked of the coupled solver on 256 x 256 cells"


def frictional_indentation(level: Level = Level.QUICK) -> Case:
    """The case: a coarse grid at the quick level, the one that figures are asked on above."""
    if level is Level.QUICK:
        return frictional_indentation_on(96, (WEAK, STRONG, COATED), extrapolated=())
    return frictional_indentation_on(256, (WEAK, STRONG, NU_ZERO, COATED), (WEAK, STRONG))


def frictional_indentation_on(
    cells: int, judged: Sequence[Indentation], extrapolated: Sequence[Indentation]
) -> Case:
    """The case on a square grid: these are judged, the stick radius of those is extrapolated."""
    runs = {
        one: {
            n: one.run(cells, n) for n in (FEW, MANY) if n == one.increments or one in extrapolated
        }
        for one in judged
    }
    return Case(
        name="frictional_indentation",
        title="Pressing with friction",
        problem=(
            "The paper's ball, rigid, pressed by 1 kN on bodies of the paper's E* and on its "
            "coated one. Their surfaces move towards the axis below the ball; friction resists, "
            "and all but a central disc slips. Pressure and shear act on each other, and the shear "
            "of the disc remembers the whole way. The references come from integral equations over "
            "the radius."
        ),
        runs=tuple(run for each in runs.values() for run in each.values()),
        quantities=tuple(
            quantity
            for one in judged
            for quantity in _quantities(one, runs[one][one.increments].label)
        ),
        comparisons=tuple(
            Comparison(
                f"stick_radius_{one.file_name}", f"{one.name}: relative error of the stick radius, "
                f"extrapolated from {FEW} and {MANY} increments",
                (runs[one][FEW].label, runs[one][MANY].label), one.stick_error, 2e-2, ASKED,
                one.source, ReferenceKind.SEMI_CLOSED,
            )
            for one in extrapolated
        ),
        findings=tuple(
            Finding(
                "shear", "largest error of the shear, over µp_H", "", run.label, one.shear_error,
                f"not judged: {one.increments} increments are",
            )
            for one, each in runs.items() for n, run in each.items() if n < one.increments
        ),
        charts=lambda results: tuple(
            indentation_chart(one, results[runs[one][one.increments].label]) for one in judged
        ),
        tables=lambda results: (
            indentation_table(
                [(one, results[run.label]) for one in judged for run in runs[one].values()]
            ),
        ),
        limits=(
            f"{STRONG.name} takes {MANY} increments to come within 1e-2 of the shear; with {FEW} "
            "the steps of the stick edge leave ripples of up to 2e-2 in the stick zone.",
            "The stick disc of the coated body is a few cells wide; its radius is not judged.",
        ),
    )  # fmt: skip


def _quantities(one: Indentation, run: str) -> tuple[Quantity, ...]:
    return (
        Quantity(
            "approach", "approach of the bodies since first touch", "m", run, approach,
            one.reference(one.approach), Required(2e-4, ASKED),
        ),
        Quantity(
            "contact_radius", "√(contact area / π), cells at the edge counted in part", "m", run,
            contact_radius, one.reference(one.contact_radius),
            Required(3e-3, ASKED),
        ),
        Quantity(
            "pressure", "largest error of the pressure from 0.1 to 0.95 of the radius, over p_H",
            "", run, one.pressure_error, one.no_error, Required(5e-3, ASKED), 1.0,
            "p_H, the peak pressure without friction",
        ),
        Quantity(
            "shear", "largest error of the shear from 0.1 to 0.95 of the radius, two cells around "
            "the stick edge apart, over µp_H",
            "", run, one.shear_error, one.no_error, Required(1e-2, ASKED), 1.0, "µp_H",
        ),
        Quantity(
            "shear_at_stick_edge", "the same within two cells of the stick edge", "", run,
            one.edge_error, one.no_error, Required(3e-2, ASKED), 1.0, "µp_H",
        ),
    )  # fmt: skip
