"""A contact by both solvers, each coarse and fine, and what is compared of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from verification.cases.cross_check_contacts import CheckedContact, Profiles
from verification.cases.fem_levels import judged_within
from verification.judging.case import Comparison
from verification.judging.run import Run, SectionRun
from verification.problems.reference import ReferenceKind

Field = NDArray[np.float64]

PRESSURE, SHEAR, APPROACH = 5e-3, 2e-2, 1e-3
ASKED = "asked of two solvers that share nothing but the scene"
OWN = "what is asked of the difference means something only if each side's own error is below it"
SOURCE = "the other solver, on the same increments"
# Contacts grow uniformly in radius. While they are a few elements wide the shear is locked as
# coarsely as these are: an error that goes with the number of elements to the axis, is the same on
# every mesh, and at a given radius falls.
FEW = 8  # elements of the coarser mesh
# Without friction the edge of the contact is on a ring, from where its ripple reaches one further.
EDGE_ON_RING = 1  # element
HALF = "the same solver on half as many cells or elements"


@dataclass(frozen=True)
class Sides:
    """A contact by both solvers, each coarse and fine.

    cells, elements  of the finer ones, even
    """

    contact: CheckedContact
    cells: int
    elements: int

    @property
    def on_cells(self) -> tuple[Run, Run]:
        """Coarse and fine."""
        coarse, fine = (
            Run(f"{self.contact.name}, {n} x {n} cells", self.contact.scene, self.contact.grid(n))
            for n in (self.cells // 2, self.cells)
        )
        return coarse, fine

    @property
    def on_elements(self) -> tuple[SectionRun, SectionRun]:
        """Coarse and fine."""
        coarse, fine = (
            SectionRun(
                f"{self.contact.name}, {n} elements", self.contact.scene, self.contact.mesh(n)
            )
            for n in (self.elements // 2, self.elements)
        )
        return coarse, fine

    def radii(self, one: Any, other: Any) -> Field:
        """Where two results are compared: the rings of the coarser mesh; two meshes only away from
        the axis, and where the ripple of the coarser one at the edge does not reach."""
        half = self.elements // 2
        if hasattr(one, "grid") or hasattr(other, "grid"):
            return self.contact.radii(half, self.cells)
        radii = self.contact.radii(half, self.cells, judged_within(half) - EDGE_ON_RING / half)
        return radii[radii >= FEW / half]

    def profiles(self, result: Any, radii: Field) -> Profiles:
        """Of either solver."""
        if hasattr(result, "grid"):
            return self.contact.on_grid(result, radii)
        return self.contact.on_rings(result, radii)

    def pressure_difference(self, one: Any, other: Any) -> float:
        """Largest difference of the pressure over the peak without friction."""
        radii = self.radii(one, other)
        apart = self.profiles(one, radii).pressure - self.profiles(other, radii).pressure
        return float(np.max(np.abs(apart)))

    def shear_difference(self, one: Any, other: Any) -> float:
        """The same of the shear over µ times it, away from its kinks."""
        radii = self.radii(one, other)
        edges = self.contact.stick_edges(other, self.cells, self.elements)
        judged = self.contact.away_from_stick_edges(radii, edges, self.cells, self.elements)
        apart = np.abs(self.profiles(one, radii).shear - self.profiles(other, radii).shear)
        return float(np.max(apart, where=judged, initial=0.0))

    def comparisons(self) -> tuple[Comparison, ...]:
        """Own errors first, then the difference."""
        cells, elements = self.on_cells, self.on_elements
        pairs = (
            ("own_error_of_cells", "change from half the cells", cells, HALF),
            ("own_error_of_elements", "change from half the elements", elements, HALF),
            ("difference", "between the solvers", (cells[1], elements[1]), SOURCE),
        )
        measures: list[tuple[str, str, Callable[[Any, Any], float], float]] = [
            ("pressure", "pressure within 0.9 a over p₀", self.pressure_difference, PRESSURE),
            ("approach", "approach, relative", approach_difference, APPROACH),
        ]
        if self.contact.friction:
            meaning = "shear within 0.9 a, away from the edge of stick, over µp₀"
            measures.append(("shear", meaning, self.shear_difference, SHEAR))
        return tuple(
            Comparison(
                f"{quantity}_{name}", f"{meaning}: {which}", (first.label, second.label),
                measure, allowed, ASKED if source is SOURCE else OWN, source,
                ReferenceKind.OTHER_SOLVER if source is SOURCE else ReferenceKind.OWN_REFINEMENT,
            )
            for quantity, meaning, measure, allowed in measures
            for name, which, (first, second), source in pairs
        )  # fmt: skip


def approach_difference(one: Any, other: Any) -> float:
    """Relative."""
    return abs(float(one.steps[-1].approach / other.steps[-1].approach) - 1)
