"""The paper's coatings under a rigid paraboloid, without friction, by finite elements."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from verification.cases.fem_levels import allowed, because, judged_within, label, levels
from verification.cases.fem_profiles import at_radii, radial_chart
from verification.exhibits.chart import Chart
from verification.exhibits.profile_chart import ProfileLabels
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.run import SectionRun, per_radius
from verification.observed.end_state import approach, contact_radius
from verification.problems.layered_scene import coated, film, pressed, rigid_ball
from verification.problems.paper_scene import HERTZ
from verification.problems.reference import Reference, ReferenceKind
from verification.references import load_reference

if TYPE_CHECKING:
    from fem_reference import Result

SOURCE = "references/coated_frictionless_paraboloid.json: Fredholm equation, two settings agree"
# At the full level every second mesh: all of them for every coating would say no more.
FOLLOWED = {level: levels(level)[:: 2 if level is Level.FULL else 1] for level in Level}


def central_pressure(result: Result) -> float:
    """On the axis; below a stiff thin coating it is not the largest [force/length²]."""
    return float(result.steps[-1].pressure[0])


@dataclass(frozen=True)
class Row:
    """One row of the reference, and the run that it judges; on coarser meshes errors are followed
    and not judged."""

    values: Mapping[str, Any]
    elements: int
    coarser: tuple[int, ...] = ()

    @property
    def name(self) -> str:
        """For labels."""
        return f"E1/E2 = {self.values['E1_over_E2']:g}, h = {self.values['h_over_aH']:g} a_H"

    @property
    def contact_radius(self) -> float:
        """Reference contact radius [length]."""
        return float(self.values["a_over_aH"]) * HERTZ.contact_radius

    @property
    def runs(self) -> tuple[SectionRun, ...]:
        """The judged one first. The mesh is fitted to the contact by the solver itself."""
        body = coated(film(self.values["E1_over_E2"], self.values["h_over_aH"]))
        scene = pressed(
            f"Rigid ball on a coating, {self.name}, by finite elements", rigid_ball(), body
        )
        return (
            SectionRun(self.name, scene, per_radius(self.elements)),
            *(SectionRun(f"{self.name}, {label(n)}", scene, per_radius(n)) for n in self.coarser),
        )

    def reference(self, key: str, unit: float) -> Reference:
        """A number of the row, which is relative to the homogeneous substrate's."""
        value = float(self.values[key]) * unit
        uncertainty = self.values["est_rel_error"] * value
        return Reference(value, ReferenceKind.SEMI_CLOSED, SOURCE, uncertainty)

    def pressure_error(self, result: Result) -> float:
        """Largest error of the pressure away from the edge, over p_H."""
        end = result.steps[-1]
        r, exact = (np.array(self.values[key]) for key in ("r_over_a", "p_over_pH"))
        found = at_radii(end, end.pressure, r * self.contact_radius) / HERTZ.peak_pressure
        return float(np.max(np.abs(found - exact)[r <= judged_within(self.elements)]))

    def quantities(self) -> tuple[Quantity, ...]:
        """What is judged."""
        figures: tuple[tuple[str, str, str, Callable[[Result], float], str, float, float], ...] = (
            ("approach", "approach since first touch", "m", approach, "delta_over_deltaH",
             HERTZ.approach, 1e-4),
            ("central_pressure", "pressure on the axis", "Pa", central_pressure, "p0_over_pH",
             HERTZ.peak_pressure, 1e-4),
        )  # fmt: skip
        n = self.elements
        return (
            *(
                Quantity(
                    name, meaning, unit, self.name, measure, self.reference(key, scale),
                    Required(allowed(figure, n, 2), because(2)),
                )
                for name, meaning, unit, measure, key, scale, figure in figures
            ),
            Quantity(
                "contact_radius", "where the pressure ends, from its last two values", "m",
                self.name, contact_radius, self.reference("a_over_aH", HERTZ.contact_radius),
                Required(2e-3, "asked of the finite elements at 64 per radius"),
            ),
            Quantity(
                "pressure", f"largest error of the pressure within "
                f"{judged_within(n):.2g} of the radius, over p_H", "",
                self.name, self.pressure_error,
                Reference(0.0, ReferenceKind.SEMI_CLOSED, SOURCE, self.values["est_rel_error"]),
                Required(allowed(2e-3, n, 2), because(2)), 1.0, "p_H",
            ),
        )  # fmt: skip

    def chart(self, number: int, result: Result) -> Chart:
        """The pressure over the radius."""
        end = result.steps[-1]
        r, exact = (np.array(self.values[key]) for key in ("r_over_a", "p_over_pH"))
        labels = ProfileLabels(
            f"fem_coated_{number}", f"Pressure over the radius, {self.name}",
            "Pressure by finite elements over the semi-closed solution, and their difference.",
            "p / p_H", "r / a",
        )  # fmt: skip
        exact_profile = (r * self.contact_radius, exact * HERTZ.peak_pressure)
        return radial_chart(
            labels, self.contact_radius, HERTZ.peak_pressure, end, end.pressure, exact_profile
        )


def fem_coated(level: Level = Level.QUICK) -> Case:
    """The case: the paper's soft and stiff coatings, all of the reference above the quick level."""
    rows = load_reference("coated_frictionless_paraboloid")["rows"]
    if level is Level.QUICK:
        rows = [row for row in rows if row["h_over_aH"] == 1 and row["E1_over_E2"] in (0.5, 2)]
    *coarser, finest = FOLLOWED[level]
    return fem_coated_on([Row(row, finest, tuple(coarser)) for row in rows])


def fem_coated_on(rows: list[Row]) -> Case:
    """The case on these rows."""
    return Case(
        name="fem_coated",
        title="Finite elements: coated bodies without friction",
        problem=(
            "The paper's ball, rigid, on coated half-spaces under 1 kN, as in coated_paraboloid, "
            "by finite elements. The interface is a line of the mesh; beyond the section the "
            "substrate alone answers, which costs the approach up to 1e-4 below stiff coatings."
        ),
        runs=tuple(run for row in rows for run in row.runs),
        quantities=tuple(quantity for row in rows for quantity in row.quantities()),
        charts=lambda results: tuple(
            row.chart(number, results[row.name]) for number, row in enumerate(rows, 1)
        ),
    )
