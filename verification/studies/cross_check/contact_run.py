"""One contact by both solvers, each on two finenesses."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

import fem_reference
import semi_analytical
from contact_results.quantities import largest_residual
from contact_scene.description import Description
from verification.cases.cross_check_contacts import (
    JUDGED_WITHIN,
    CheckedContact,
    Profiles,
    numbers,
)
from verification.cases.fem_levels import judged_within
from verification.judging.run import SOLVER_TOLERANCE

Field = NDArray[np.float64]


class Side(Description):
    """What one solver says on its finer discretisation, and by how much the coarser one with half
    as many cells or elements differs: the solver's own error, were its order 1."""

    pressure: tuple[float, ...]
    """p over the largest pressure without friction, at the radii of the record."""

    shear: tuple[float, ...]
    """Outward, over µ times that."""

    numbers: dict[str, float]
    """By the names of `summary.json`, SI."""

    own_pressure: float
    """Largest change at the rings of the coarser mesh; for elements only where its ripple at the
    edge does not reach."""

    own_shear: float
    """The same, away from the kinks of the shear."""

    own_approach: float
    """Relative."""

    residual: float


class CrossCheckRecord(Description):
    """Both solvers at the same radii, and what neither of them made."""

    radii: tuple[float, ...]
    """Over the contact radius without friction."""

    stick_edges: tuple[float, ...]
    """Where the shear has kinks, over the same radius: the edge of stick comes last."""

    shear_judged: tuple[bool, ...]
    """Whether a radius is away from those."""

    semi_analytical: Side
    finite_elements: Side
    reference_pressure: tuple[float, ...] | None
    reference_shear: tuple[float, ...] | None
    reference_approach: float | None
    seconds: float


@dataclass(frozen=True)
class CrossCheckRun:
    """A contact with the finer discretisations of both solvers; numbers even.

    cells     along each side of the window
    elements  over the contact radius
    """

    record_type: ClassVar[type[Description]] = CrossCheckRecord
    modulus_ratio: float
    thickness: float
    friction: float
    cells: int
    elements: int

    @property
    def contact(self) -> CheckedContact:
        """What is pressed."""
        return CheckedContact(self.modulus_ratio, self.thickness, self.friction)

    @property
    def name(self) -> str:
        return f"{self.contact.file_name}-{self.cells}-{self.elements}"

    def compute(self) -> CrossCheckRecord:
        started = time.perf_counter()
        contact, scene = self.contact, self.contact.scene
        grids = [contact.grid(n) for n in (self.cells // 2, self.cells)]
        meshes = [contact.mesh(n) for n in (self.elements // 2, self.elements)]
        on_cells = [semi_analytical.solve(scene, grid, SOLVER_TOLERANCE) for grid in grids]
        on_elements = [fem_reference.solve(scene, mesh) for mesh in meshes]
        edges = contact.stick_edges(on_elements[1], self.cells, self.elements)
        half = self.elements // 2
        radii, coarse, smooth = (
            contact.clear_of_axis(contact.radii(n, self.cells, within), edges, self.cells, n)
            for n, within in (
                (self.elements, JUDGED_WITHIN),
                (half, JUDGED_WITHIN),
                (half, judged_within(half)),
            )
        )
        judged = contact.away_from_stick_edges(radii, edges, self.cells, self.elements)
        known = contact.reference(radii)
        return CrossCheckRecord(
            radii=tuple(radii.tolist()),
            stick_edges=edges,
            shear_judged=tuple(judged.tolist()),
            semi_analytical=_side(
                on_cells,
                contact.on_grid(on_cells[1], radii),
                [contact.on_grid(result, coarse) for result in on_cells],
                contact.away_from_stick_edges(coarse, edges, self.cells, self.elements),
            ),
            finite_elements=_side(
                on_elements,
                contact.on_rings(on_elements[1], radii),
                [contact.on_rings(result, smooth) for result in on_elements],
                contact.away_from_stick_edges(smooth, edges, self.cells, self.elements),
            ),
            reference_pressure=None if known is None else tuple(known.pressure.tolist()),
            reference_shear=None if known is None else tuple(known.shear.tolist()),
            reference_approach=contact.reference_approach,
            seconds=time.perf_counter() - started,
        )


def _side(
    results: list[Any], finer: Profiles, both: list[Profiles], judged: NDArray[np.bool_]
) -> Side:
    """Of two results, coarse and fine."""
    coarse, fine = both
    before, end = (numbers(result.steps[-1]) for result in results)
    change = np.abs(fine.shear - coarse.shear)
    return Side(
        pressure=tuple(finer.pressure.tolist()),
        shear=tuple(finer.shear.tolist()),
        numbers=dict(end),
        own_pressure=float(np.max(np.abs(fine.pressure - coarse.pressure))),
        own_shear=float(np.max(change, where=judged, initial=0.0)),
        own_approach=abs(before["approach"] / end["approach"] - 1),
        residual=largest_residual(results[1]),
    )
