"""The usual way to the influence coefficients, sampling the FRF, beside the exact one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import TYPE_CHECKING

from semi_analytical.frf.stack import Stack
from verification.cases.layered_reference import COEFFICIENT_SOURCE
from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.exhibits.numbers import percent
from verification.exhibits.table import NONE, Table
from verification.judging.case import Case, Check, Level, Required
from verification.laws.sampling_route import SamplingErrors, sampling_errors
from verification.problems.reference import identity

if TYPE_CHECKING:
    from semi_analytical import Result

# The first configuration of the reference rows: cells of an eighth of the layer's thickness.
BODY = Stack([(2.0, 0.3, 1.0)], (1.0, 0.25))
SPACING, CELLS = 0.125, 32
REFINEMENTS = (1, 2, 4, 8, 16)
EXTENSIONS = (2, 4, 8, 16)
EXTENSION, REFINEMENT = 4, 4  # held while the other one varies
OURS = 1e-12
MEASURES: dict[str, Callable[[SamplingErrors], float]] = {
    "loaded cell": lambda errors: errors.own,
    "next cell": lambda errors: errors.neighbour,
    "last cell, shape": lambda errors: errors.far_shape,
    "coupling": lambda errors: errors.coupling,
}


def sampling_route(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    return Case(
        name="sampling_route",
        title="Sampling the frequency response, as is usual",
        problem=(
            "Influence coefficients are usually had by multiplying the frequency response with "
            "the transform of one loaded cell, sampling the product and transforming back, as in "
            "the paper. Two parameters have to be chosen: refinement (samples per cell side) "
            "against aliasing, extension (period over window) against periodic images. Here that "
            "is measured against the exact coefficients, which have no parameter and are right to "
            "1e-12: a layer twice as stiff as its substrate, cells of an eighth of its thickness, "
            f"{CELLS} x {CELLS} of them."
        ),
        runs=(),
        quantities=(),
        checks=(
            Check(
                "sampled_tends_to_exact", "error of the loaded cell at the finest sampling", "",
                f"refinement {REFINEMENTS[-1]}, extension {EXTENSION}",
                lambda: _at(REFINEMENTS[-1], EXTENSION).own,
                identity(0.0, "both are the same integral, once sampled and once not"),
                Required(5e-3, "what sampling leaves; the exact coefficients share no step with "
                         "it"), 1.0, "the coefficient",
            ),
        ),
        charts=_charts,
        tables=_tables,
        limits=(
            f"The exact coefficients themselves are judged in layered_reference "
            f"({COEFFICIENT_SOURCE}).",
        ),
    )  # fmt: skip


@cache
def _at(refinement: int, extension: int) -> SamplingErrors:
    return sampling_errors(BODY, SPACING, CELLS, refinement, extension)


def _tables(results: Mapping[str, Result]) -> tuple[Table, ...]:
    settings = [(r, EXTENSION) for r in REFINEMENTS] + [
        (REFINEMENT, e) for e in EXTENSIONS if e != EXTENSION
    ]
    rows = tuple(
        (
            f"refinement {r}, extension {e}",
            str((CELLS * r * e) ** 2),
            *(percent(of(_at(r, e))) for of in MEASURES.values()),
            percent(_at(r, e).far),
        )
        for r, e in settings
    )
    exact = ("exact coefficients, no parameter", "0", *["< 1e-10 %"] * 5)
    return (
        Table(
            title="Error of sampled coefficients, relative to the coefficient",
            columns=("setting", "samples", *MEASURES, "last cell, absolute"),
            rows=(*rows, exact),
            note="The shape at the last cell of the window is what is left after a constant is "
            "taken off, as a free approach would do. The last row is what layered_reference "
            "bounds.", units=NONE
        ),
    )  # fmt: skip


def _charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
    ours = (OURS, OURS)
    by_refinement = Panel(
        x_label="samples per cell side", y_label="relative error", logarithmic=True, height=1.6,
        title=f"extension {EXTENSION}",
        curves=(
            *(
                curve(name, REFINEMENTS, [abs(of(_at(r, EXTENSION))) for r in REFINEMENTS],
                      Look.POINTS, n)
                for n, (name, of) in enumerate(MEASURES.items())
            ),
            curve("exact coefficients", REFINEMENTS[:: len(REFINEMENTS) - 1], ours, Look.BOUND),
        ),
    )  # fmt: skip
    by_extension = Panel(
        x_label="period / window", y_label="relative error", logarithmic=True, height=1.6,
        title=f"refinement {REFINEMENT}",
        curves=(
            *(
                curve(name, EXTENSIONS, [abs(of(_at(REFINEMENT, e))) for e in EXTENSIONS],
                      Look.POINTS, n)
                for n, (name, of) in enumerate(MEASURES.items())
            ),
            curve("exact coefficients", (EXTENSIONS[0], EXTENSIONS[-1]), ours, Look.BOUND),
        ),
    )  # fmt: skip
    return (
        Chart(
            name="sampling_by_refinement",
            title="Sampled coefficients against refinement",
            caption="Refinement removes the error of the loaded and the next cell slowly, and "
            "leaves that of the far ones, which periodic images make. Thin black dashes at the "
            "bottom: the exact route.",
            rows=((by_refinement,),),
        ),
        Chart(
            name="sampling_by_extension",
            title="Sampled coefficients against extension",
            caption="A longer period removes the images from the far cells, and does nothing for "
            "the loaded one. Thin black dashes at the bottom: the exact route.",
            rows=((by_extension,),),
        ),
    )
