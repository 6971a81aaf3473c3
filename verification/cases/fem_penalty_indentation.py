"""A rigid ball pressed with friction, by finite elements with a penalty and return mapping."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from verification.cases.consistent_tangent import consistent_tangent
from verification.cases.fem_indentation import INNERMOST, Pressed
from verification.cases.fem_levels import finest, judged_within
from verification.cases.indentation_reference import COATED, FEW, STRONG, WEAK
from verification.exhibits.chart import Chart
from verification.judging.case import Case, Finding, Level, Quantity, Required
from verification.judging.solver import Method
from verification.observed.end_state import approach, contact_radius

if TYPE_CHECKING:
    from fem_reference import Result
    from verification.judging.run import SectionRun

ASKED = "asked of the finite elements with a penalty, at their default penalty"
SPRINGS = "springs"


@dataclass(frozen=True)
class Penalised:
    """A reference, and the run with a penalty that it judges."""

    pressed: Pressed

    @property
    def run(self) -> SectionRun:
        """The scene of fem_indentation."""
        run = self.pressed.run
        return replace(run, label=f"{run.label}, penalty", method=Method.PENALTY)

    def quantities(self) -> tuple[Quantity, ...]:
        """What is judged."""
        run, one, n = self.run.label, self.pressed.of, self.pressed.elements
        where = f"from {INNERMOST:g} to {judged_within(n):.2g} of the radius"
        return (
            Quantity(
                "approach", "approach of the bodies since first touch", "m", run, approach,
                one.reference(one.approach), Required(1e-3, ASKED),
            ),
            Quantity(
                "contact_radius", "where the pressure ends, by a fit of its square", "m", run,
                contact_radius, one.reference(one.contact_radius),
                Required(0.12 / n, "an eighth of an element: the last points ripple"),
            ),
            Quantity(
                "pressure", f"largest error of the pressure {where}, over p_H", "", run,
                self.pressed.pressure_error, one.no_error, Required(5e-3, ASKED), 1.0,
                "p_H, the peak without friction",
            ),
            Quantity(
                "shear", f"largest error of the shear {where}, over µp_H", "", run,
                self.pressed.shear_error, one.no_error, Required(3e-2, ASKED), 1.0, "µp_H",
            ),
        )  # fmt: skip

    def findings(self) -> tuple[Finding, ...]:
        """How it was solved."""
        run = self.run.label
        return (
            Finding(
                "by_springs", "increments that took springs in series", "", run, by_springs,
                "the first one always does, from no contact; the others are Newton's",
            ),
            Finding(
                "systems", "linear systems per increment", "", run, systems_per_increment,
                "two passes each: springs, and springs beside the forces of the first pass",
            ),
        )  # fmt: skip

    def chart(self, result: Result) -> Chart:
        """The shear over the radius."""
        chart = self.pressed.chart(result)
        name = chart.name.replace("fem_indentation", "fem_penalty_indentation")
        return chart.model_copy(update={"name": name})


def fem_penalty_indentation(level: Level = Level.QUICK) -> Case:
    """The case, on a finer mesh at higher levels."""
    n = finest(level)
    return fem_penalty_indentation_on(
        tuple(Penalised(Pressed(one, n, FEW)) for one in (WEAK, STRONG, COATED))
    )


def fem_penalty_indentation_on(judged: tuple[Penalised, ...]) -> Case:
    """The case on these references."""

    def charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
        return tuple(one.chart(results[one.run.label]) for one in judged)

    return Case(
        name="fem_penalty_indentation",
        title="Finite elements with a penalty: pressing with friction",
        problem=(
            "The scenes of fem_indentation with springs at Gauss points instead of exact contact, "
            "and Coulomb's law by return mapping: a trial shear from what each point remembers, "
            "scaled back to µp where it is beyond. Pressure and shear are found together by "
            "Newton's method with the consistent tangent."
        ),
        runs=tuple(one.run for one in judged),
        quantities=tuple(q for one in judged for q in one.quantities()),
        findings=tuple(f for one in judged for f in one.findings()),
        checks=(consistent_tangent(),),
        charts=charts,
        limits=(
            f"The shear is that of {FEW} increments, whose error is part of what is judged: each "
            "place that the edge of stick has passed keeps a ripple, of 0.02 µp_H for µ = 0.3.",
        ),
    )  # fmt: skip


def by_springs(result: Result) -> float:
    """Increments that Newton's method alone did not solve."""
    return float(sum(increment.path == SPRINGS for increment in result.increments))


def systems_per_increment(result: Result) -> float:
    """Linear systems, in the mean."""
    return sum(i.iterations for i in result.increments) / len(result.increments)
