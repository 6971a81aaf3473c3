"""Coated contacts for all solvers: their scenes, tractions, and references that none made."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

import fem_reference
import radial
from contact_scene import FiniteElementDiscretisation, Scene
from semi_analytical.grid import SurfaceGrid
from verification.cases.both_solvers.left_out import EVEN, MARGIN, kept_edges
from verification.closed_forms.coated_indentation import LayeredIndentation
from verification.judging.run import SOLVER_TOLERANCE
from verification.observed.radial_profile import outward
from verification.problems import paper_scene as paper
from verification.problems.indentation import COATED, STRONG, WEAK, Indentation
from verification.problems.layered_scene import coated, exact_contact, film, pressed, rigid_ball
from verification.problems.paper_scene import HERTZ, pressing
from verification.quantities import shear_of

if TYPE_CHECKING:
    import semi_analytical

Field = NDArray[np.float64]

RATIOS = (0.25, 0.5, 1.0, 2.0, 4.0, 10.0)
THICKNESSES = (0.25, 1.0, 2.0)
FRICTIONS = (0.0, 0.1, 0.3)

# By µ; the same for all solvers, uniform in contact radius. The more of the contact sticks, the
# longer the shear remembers the edge of every increment: that ripple falls with the increments, and
# finer cells or elements only show it more sharply.
INCREMENTS = {0.0: 1, 0.1: 20, 0.3: 80}
DIRECTIONS = 16
ALIKE = 1.0  # E1/E2 of a coating that is none, whatever its thickness
STANDS_FOR_ALL = 1.0  # its h / a_H

# Pressing with friction: the solution without increments, by modulus ratio, thickness, friction;
# where the moduli are equal the coating is none.
FRICTIONAL = {
    (2.0, 1.0, 0.1): COATED,
    **{(1.0, thickness, one.friction): one for thickness in THICKNESSES for one in (WEAK, STRONG)},
}


@dataclass(frozen=True)
class Profiles:
    """Tractions at some radii, over the largest pressure without friction and µ times it.

    shear  outward; zero without friction
    """

    pressure: Field
    shear: Field


@dataclass(frozen=True)
class CheckedContact:
    """The paper's ball, rigid, pressed on a coated half-space.

    modulus_ratio  E1 / E2, coating over substrate
    thickness      over the Hertz radius without a coating
    friction       µ
    """

    modulus_ratio: float
    thickness: float
    friction: float

    @property
    def name(self) -> str:
        """For people."""
        return f"E1/E2 = {self.modulus_ratio:g}, h = {self.thickness:g} a_H, µ = {self.friction:g}"

    @property
    def file_name(self) -> str:
        """For files."""
        return f"{self.modulus_ratio:g}-{self.thickness:g}-{self.friction:g}".replace(".", "p")

    @property
    def is_coated(self) -> bool:
        """Whether the coating differs from what is below."""
        return self.modulus_ratio != ALIKE

    @property
    def scene(self) -> Scene:
        """What all solvers solve."""
        return pressed(
            f"Rigid ball on a coated half-space, {self.name}",
            rigid_ball(),
            coated(film(self.modulus_ratio, self.thickness)),
            pressing(INCREMENTS[self.friction]),
            friction=self.friction,
        )

    @property
    def frictionless(self) -> LayeredIndentation:
        """Semi-closed, by an integral equation that is of neither solver."""
        return exact_contact(coated(film(self.modulus_ratio, self.thickness)))

    @property
    def contact_radius(self) -> float:
        """Without friction: what lengths are counted in [length]."""
        return self.frictionless.contact_radius

    @property
    def peak_pressure(self) -> float:
        """At the axis, without friction: what pressures are counted in [force/length^2]."""
        return float(self.frictionless.pressure(0.0))

    def grid(self, cells: int) -> SurfaceGrid:
        """A square grid around the contact."""
        return paper.square_grid(cells, MARGIN * self.contact_radius)

    def mesh(self, elements: int) -> FiniteElementDiscretisation:
        """Elements over the contact radius without friction, so that finer meshes keep the rings of
        coarser ones."""
        return FiniteElementDiscretisation(
            elements_per_radius=elements,
            contact_radius=self.contact_radius,
            tolerance=SOLVER_TOLERANCE,
        )

    def stick_edges(
        self,
        result: fem_reference.Result | semi_analytical.Result | radial.Result,
        resolution: float,
    ) -> tuple[float, ...]:
        """Where the shear of a result has kinks, over the contact radius: last the edge of stick,
        before where that turned outward after it had come back; none without friction."""
        radii = [one.stick_radius for one in result.increments if one.stick_radius is not None]
        if not radii:
            return ()
        over = [radius / self.contact_radius for radius in radii]
        return kept_edges(over, resolution)

    def tractions(
        self, result: fem_reference.Result | semi_analytical.Result | radial.Result, radii: Field
    ) -> Profiles:
        """Of any solver at these radii."""
        if isinstance(result, fem_reference.Result):
            return self.on_rings(result, radii)
        if isinstance(result, radial.Result):
            return self.on_radii(result, radii)
        return self.on_grid(result, radii)

    def on_grid(self, result: semi_analytical.Result, radii: Field) -> Profiles:
        """Means over the directions, by cubic splines between the cells."""
        end, r = result.steps[-1], radii * self.contact_radius
        p = _around(end.pressure, result.grid, r) / self.peak_pressure
        if not self.friction:
            return Profiles(p, np.zeros_like(p))
        q = _around(outward(shear_of(end), result.grid), result.grid, r)
        return Profiles(p, q / (self.friction * self.peak_pressure))

    def on_rings(self, result: fem_reference.Result, radii: Field) -> Profiles:
        """Values of the rings."""
        end = result.steps[-1]
        found = np.rint(radii * self.contact_radius / (end.radii[1] - end.radii[0])).astype(int)
        if not np.allclose(end.radii[found], radii * self.contact_radius, rtol=EVEN, atol=0.0):
            raise ValueError("the rings of the result are not at the radii that are asked for")
        p = end.pressure[found] / self.peak_pressure
        if end.shear_radial is None:
            return Profiles(p, np.zeros_like(p))
        return Profiles(p, end.shear_radial[found] / (self.friction * self.peak_pressure))

    def on_radii(self, result: radial.Result, radii: Field) -> Profiles:
        """Linear between the rings, which are many."""
        end, r = result.steps[-1], radii * self.contact_radius
        p = np.interp(r, end.radii, end.pressure) / self.peak_pressure
        if end.shear_radial is None:
            return Profiles(p, np.zeros_like(p))
        q = np.interp(r, end.radii, end.shear_radial)
        return Profiles(p, q / (self.friction * self.peak_pressure))

    def reference(self, radii: Field) -> Profiles | None:
        """Tractions that no solver here made, linear between the points of their table; None where
        there are none."""
        if not self.friction:
            p = np.asarray(self.frictionless.pressure(radii * self.contact_radius))
            return Profiles(p / self.peak_pressure, np.zeros_like(p))
        known = self._frictional
        if known is None:
            return None
        fine = "r_fine_over_aH" in known.row
        r, p, q = (
            np.array(known.row[key])
            for key in (
                ("r_fine_over_aH", "p_fine_over_pH", "q_fine_over_mu_pH")
                if fine
                else ("r_over_a", "p_over_pH", "q_over_mu_pH")
            )
        )
        r = r * HERTZ.contact_radius if fine else r * known.contact_radius
        at, unit = radii * self.contact_radius, HERTZ.peak_pressure / self.peak_pressure
        return Profiles(unit * np.interp(at, r, p), unit * np.interp(at, r, q))

    @property
    def reference_approach(self) -> float | None:
        """Approach of the reference [length]; None where there is none."""
        if not self.friction:
            return self.frictionless.approach
        return None if self._frictional is None else self._frictional.approach

    @property
    def _frictional(self) -> Indentation | None:
        return FRICTIONAL.get((self.modulus_ratio, self.thickness, self.friction))


def is_its_own(ratio: float, thickness: float) -> bool:
    """Whether no other thickness makes the same body."""
    return ratio != ALIKE or thickness == STANDS_FOR_ALL


CONTACTS = tuple(
    CheckedContact(ratio, thickness, friction)
    for ratio, thickness, friction in product(RATIOS, THICKNESSES, FRICTIONS)
    if is_its_own(ratio, thickness)
)


def _around(field: Field, grid: SurfaceGrid, r: Field) -> Field:
    """Means of a field over the directions at distances r from the axis."""
    angle = (np.arange(DIRECTIONS) + 0.5) * 2 * np.pi / DIRECTIONS
    x, y = np.outer(r, np.cos(angle)), np.outer(r, np.sin(angle))
    at = [(x - grid.x[0]) / grid.spacing[0], (y - grid.y[0]) / grid.spacing[1]]
    return np.asarray(map_coordinates(field, at, order=3).mean(axis=1))
