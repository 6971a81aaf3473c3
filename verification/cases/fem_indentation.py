"""A rigid ball pressed on bodies that slip away below it, by finite elements."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from contact_scene import LoadStep
from verification.cases.fem_levels import allowed, because, finest, judged_within
from verification.cases.indentation_reference import COATED, FEW, STRONG, WEAK, Indentation
from verification.exhibits.chart import Chart
from verification.exhibits.profile_chart import ProfileLabels
from verification.judging.case import Case, Finding, Level, Quantity, Required
from verification.judging.radial_chart import radial_chart
from verification.judging.run import SectionRun, per_radius
from verification.observed.end_state import approach, contact_radius, stick_radius
from verification.observed.ring_errors import at_radii
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import HERTZ

if TYPE_CHECKING:
    from fem_reference import Result

Field = NDArray[np.float64]

INNERMOST = 0.1  # contact radii
MANY = 60


@dataclass(frozen=True)
class Pressed:
    """One reference, and the run that it judges."""

    of: Indentation
    elements: int
    increments: int

    @property
    def run(self) -> SectionRun:
        """The same scene as for the semi-analytical solver, but for its increments."""
        scene = self.of.scene[FEW]
        step = LoadStep(normal_force=paper.NORMAL_FORCE, increments=self.increments)
        return SectionRun(
            f"{self.of.name}, {self.increments} increments",
            scene.model_copy(update={"loading": (step,)}),
            per_radius(self.elements, 0.97 * self.of.contact_radius),
        )

    def _profile(self, key: str) -> tuple[Field, Field]:
        r, values = np.array(self.of.row["r_over_a"]), np.array(self.of.row[key])
        judged = (r >= INNERMOST - 1e-9) & (r <= judged_within(self.elements) + 1e-9)
        return r[judged] * self.of.contact_radius, values[judged]

    def pressure_error(self, result: Result) -> float:
        """Largest error of the pressure at the radii of the reference, over p_H."""
        r, exact = self._profile("p_over_pH")
        end = result.steps[-1]
        found = at_radii(end, end.pressure, r) / HERTZ.peak_pressure
        return float(np.max(np.abs(found - exact)))

    def shear_error(self, result: Result) -> float:
        """Largest error of the outward shear at the radii of the reference, over µp_H."""
        r, exact = self._profile("q_over_mu_pH")
        end = result.steps[-1]
        assert end.shear_radial is not None
        found = at_radii(end, end.shear_radial, r) / (self.of.friction * HERTZ.peak_pressure)
        return float(np.max(np.abs(found - exact)))

    def stick_part(self, result: Result) -> float:
        """Stick radius over contact radius."""
        return stick_radius(result) / contact_radius(result)

    def quantities(self) -> tuple[Quantity, ...]:
        """What is judged."""
        run, n, one = self.run.label, self.elements, self.of
        where = f"from {INNERMOST:g} to {judged_within(n):.2g} of the radius"
        return (
            Quantity(
                "approach", "approach of the bodies since first touch", "m", run, approach,
                one.reference(one.approach), Required(2e-4, "asked of the finite elements"),
            ),
            Quantity(
                "contact_radius", "where the pressure ends, from its last two values", "m", run,
                contact_radius, one.reference(one.contact_radius),
                Required(2e-3, "asked of the finite elements at 64 per radius"),
            ),
            Quantity(
                "pressure", f"largest error of the pressure {where}, over p_H", "", run,
                self.pressure_error, one.no_error,
                Required(allowed(2e-3, n, 1), because(1)), 1.0, "p_H, the peak without friction",
            ),
            Quantity(
                "shear", f"largest error of the shear {where}, over µp_H", "", run,
                self.shear_error, one.no_error, Required(1e-2, "asked of the finite elements"),
                1.0, "µp_H",
            ),
        )  # fmt: skip

    def finding(self) -> Finding:
        """What is too coarse to be judged."""
        return Finding(
            "stick_radius", "stick radius over contact radius", "", self.run.label, self.stick_part,
            f"the reference has {self.of.stick_part:.4f}; one element is {1 / self.elements:.4f}",
        )  # fmt: skip

    def chart(self, result: Result) -> Chart:
        """The shear over the radius."""
        end, row = result.steps[-1], self.of.row
        assert end.shear_radial is not None
        r, q = (np.array(row[key]) for key in ("r_over_a", "q_over_mu_pH"))
        scale = self.of.friction * HERTZ.peak_pressure
        labels = ProfileLabels(
            f"fem_indentation_{self.of.file_name}", f"Shear over the radius, {self.of.name}",
            f"Outward shear by finite elements after {self.increments} increments over the "
            "reference, and their difference: it remembers the whole way.", "q / µp_H", "r / a",
        )  # fmt: skip
        a = self.of.contact_radius
        return radial_chart(labels, a, scale, end, end.shear_radial, (r * a, q * scale))


def fem_indentation(level: Level = Level.QUICK) -> Case:
    """The case, on finer meshes at higher levels."""
    n = finest(level)
    return fem_indentation_on(
        (Pressed(WEAK, n, FEW), Pressed(STRONG, n, MANY), Pressed(COATED, n, FEW))
    )


def fem_indentation_on(judged: tuple[Pressed, ...]) -> Case:
    """The case on these references."""

    def charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
        return tuple(one.chart(results[one.run.label]) for one in judged)

    return Case(
        name="fem_indentation",
        title="Finite elements: pressing with friction",
        problem=(
            "The scenes of frictional_indentation by finite elements: pressure as a linear "
            "complementarity problem and radial shear as a quadratic program within the friction "
            "limit, one after the other until they agree. No penalty: contact and stick are exact "
            "over the hat functions of the tractions."
        ),
        runs=tuple(one.run for one in judged),
        quantities=tuple(quantity for one in judged for quantity in one.quantities()),
        findings=tuple(one.finding() for one in judged),
        charts=charts,
        limits=(
            f"The shear is judged where the increments allow: {FEW} for µ = 0.1, {MANY} for "
            "µ = 0.3.",
        ),
    )
