"""Coated bodies pressed with and without friction, against CalculiX on the same scenes."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_scene import LoadStep, Scene
from verification.external_codes.recorded import Recorded, recorded
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.ladder import cells_label
from verification.judging.run import Run, SectionRun, per_radius
from verification.observed.end_state import normal_force
from verification.observed.radial_profile import along_radii, outward
from verification.observed.ring_errors import at_radii
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import coated, film, pressed, rigid_ball
from verification.problems.paper_scene import HERTZ
from verification.problems.reference import Reference, ReferenceKind
from verification.quantities import shear_of

Field = NDArray[np.float64]
Reader = Callable[[Any, str, Field], Field]

SOURCE = "references/external_code_calculix.json: CalculiX 2.20"
FIRST = 0.1  # Hertz radii; nearer to the axis are its bore and, with friction, a cusp
EDGE = 3 / 16  # Hertz radii, three elements of the coarser mesh; its edge ripples that far
FORCE, TRACTION = 2e-4, 1e-3
OURS = (
    f"twice the recorded uncertainty and ours in squares: {FORCE:g} of the force, {TRACTION:g} of "
    "p_H and µp_H, as the semi-closed references leave them"
)


NAMES = {
    "coated_frictionless": "coated, no friction",
    "coated_frictional": "coated, µ = 0.1",
}


@dataclass(frozen=True)
class Sizes:
    """Cells per side of three Hertz radii, and elements per radius."""

    cells: int
    elements: int


SIZES = {Level.QUICK: Sizes(128, 32), Level.STANDARD: Sizes(256, 64), Level.FULL: Sizes(512, 64)}


def on_rings(result: Any, traction: str, r: Field) -> Field:
    """Pressure or outward shear (radii, 1) of finite elements."""
    end = result.steps[-1]
    values = end.pressure if traction == "pressure" else end.shear_radial
    return at_radii(end, values, r)[:, None]


def on_cells(result: Any, traction: str, r: Field) -> Field:
    """Pressure or outward shear (radii, directions) of the semi-analytical solver."""
    end = result.steps[-1]
    values = end.pressure if traction == "pressure" else outward(shear_of(end), result.grid)
    return along_radii(values, result.grid, r)


@dataclass(frozen=True, eq=False)
class Beside:
    """A recorded scene, solved by both of our solvers."""

    name: str
    of: Recorded
    sizes: Sizes

    @property
    def friction(self) -> float:
        """µ, 0 without friction."""
        return float(self.of.record["friction"])

    @cached_property
    def scene(self) -> Scene:
        """The paper's ball, moved as far over the Hertz approach, in as many increments."""
        row, step = self.of.record, {}
        if self.friction:
            step["increments"] = row["increments"]
        return pressed(
            f"Rigid ball moved towards a body: {self.name}",
            rigid_ball(),
            coated(film(row["modulus_ratio"], row["thickness"])),
            LoadStep(approach=row["approach"] * HERTZ.approach, **step),
            friction=self.friction,
        )

    @cached_property
    def section(self) -> SectionRun:
        """By finite elements."""
        label = f"{self.name}, {self.sizes.elements} elements per radius"
        return SectionRun(label, self.scene, per_radius(self.sizes.elements), problem=self.name)

    @cached_property
    def surface(self) -> Run:
        """On cells."""
        grid = paper.hertz_grid(self.sizes.cells)
        label = f"{self.name}, {cells_label(self.sizes.cells)}"
        return Run(label, self.scene, grid, problem=self.name)

    def quantities(self) -> tuple[Quantity, ...]:
        """The force and the tractions by both solvers."""
        section, surface = self.section.label, self.surface.label
        return (
            self._force(section), *self._tractions(section, on_rings),
            self._force(surface), *self._tractions(surface, on_cells),
        )  # fmt: skip

    def _force(self, run: str) -> Quantity:
        value, uncertainty = self.of.normal_force
        reference = Reference(
            value * paper.NORMAL_FORCE, ReferenceKind.EXTERNAL_CODE, SOURCE,
            uncertainty * paper.NORMAL_FORCE,
        )  # fmt: skip
        return Quantity(
            "normal_force", "force at this approach", "N", run, normal_force, reference,
            Required(2 * math.hypot(uncertainty / value, FORCE), OURS),
        )  # fmt: skip

    def _tractions(self, run: str, read: Reader) -> tuple[Quantity, ...]:
        pressure = self._traction(run, "pressure", 1.0, "p_H", read)
        if not self.friction:
            return (pressure,)
        return pressure, self._traction(run, "shear", self.friction, "µp_H", read)

    def _traction(self, run: str, name: str, part: float, unit: str, read: Reader) -> Quantity:
        """part  of p_H that errors are relative to; unit names it"""
        last = self.of.edge - EDGE
        known = self.of.profile(name, FIRST, last)
        radii = known.radii * HERTZ.contact_radius
        uncertainty = known.uncertainty / part

        def largest_difference(result: Any) -> float:
            found = read(result, name, radii) / HERTZ.peak_pressure
            return float(np.max(np.abs(found - known.values[:, None]))) / part

        return Quantity(
            name, f"largest difference of the {name} from {FIRST:g} to {last:.2g} a_H, over {unit}",
            "", run, largest_difference,
            Reference(0.0, ReferenceKind.EXTERNAL_CODE, SOURCE, uncertainty),
            Required(2 * math.hypot(uncertainty, TRACTION), OURS), 1.0, unit,
        )  # fmt: skip


def external_codes(level: Level = Level.QUICK) -> Case:
    """The case, on finer discretisations at higher levels."""
    return external_codes_on(SIZES[level])


def external_codes_on(sizes: Sizes) -> Case:
    """The case at one fineness of both solvers."""
    beside = tuple(Beside(name, recorded(key), sizes) for key, name in NAMES.items())
    return Case(
        name="external_codes",
        title="CalculiX on the same scenes",
        problem=(
            "The paper's ball, rigid, moved by a given approach: towards a coating twice as stiff "
            "as its base and as thick as the Hertz radius, without friction and with µ = 0.1. "
            "CalculiX was run on the same scenes before, with its own elements and contact; what "
            "writes its input is in verification/external_codes."
        ),
        runs=tuple(run for one in beside for run in (one.section, one.surface)),
        quantities=tuple(quantity for one in beside for quantity in one.quantities()),
        limits=(
            "CalculiX ran on a ball a hundred times as flat under a hundredth of the force, as it "
            "measures the gap where the surface has moved to, which linear theory does not.",
            "Its springs are removed by extrapolation; near the axis and the edge its nodal "
            "stresses are too coarse to be judged against.",
            "Where shear is judged the whole contact has slipped, so that it is µp; what a stick "
            "disc does to it is judged in frictional_indentation.",
        ),
    )
