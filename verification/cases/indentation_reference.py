"""References of pressing with friction, each with its body, and the errors against them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from contact_results.quantities import shear_of
from contact_scene import Body, CoulombFriction, IsotropicMaterial, LoadStep, Scene
from verification.judging.ladder import cells_label
from verification.judging.run import Run
from verification.observed.end_state import stick_radius
from verification.observed.radial_profile import along_radii, outward
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import coated, film, rigid_ball
from verification.problems.paper_scene import HERTZ
from verification.problems.reference import Reference, ReferenceKind
from verification.references import load_reference

if TYPE_CHECKING:
    from semi_analytical import Result

Field = NDArray[np.float64]

FEW, MANY = 20, 40  # increments, uniform in contact radius
JUDGED = (0.1, 0.95)  # part of the radius where tractions are judged
EDGE_CELLS = 2  # to each side of the stick edge, where the shear has a kink
REFERENCE_ERROR = 1e-7  # of radii and approach, relative


@dataclass(frozen=True, eq=False)
class Indentation:
    """One row of a reference, and the body it is about.

    name        for people; file_name for files
    increments  how many make the shear as accurate as is asked
    """

    name: str
    file_name: str
    row: Mapping[str, Any]
    body: Body
    source: str
    increments: int = FEW

    @property
    def friction(self) -> float:
        """µ."""
        return float(self.row["mu"])

    @property
    def contact_radius(self) -> float:
        """Reference contact radius [length]."""
        return float(self.row["a_over_aH"]) * HERTZ.contact_radius

    @property
    def approach(self) -> float:
        """Reference approach [length]."""
        return float(self.row["delta_over_deltaH"]) * HERTZ.approach

    @property
    def no_error(self) -> Reference:
        """What an error norm is compared with."""
        return Reference(0.0, ReferenceKind.SEMI_CLOSED, self.source)

    @property
    def stick_part(self) -> float:
        """Reference stick radius over contact radius."""
        return float(self.row["c_over_a"])

    @cached_property
    def scene(self) -> dict[int, Scene]:
        """By the number of increments."""
        return {
            count: Scene(
                title=f"Rigid ball pressed with friction: {self.name}",
                indenter=rigid_ball(),
                body=self.body,
                friction=CoulombFriction(coefficient=self.friction),
                loading=(LoadStep(normal_force=paper.NORMAL_FORCE, increments=count),),
            )
            for count in (FEW, MANY)
        }

    def run(self, cells: int, increments: int) -> Run:
        """On a window of three contact radii."""
        half_width = paper.WINDOW_PER_RADIUS / 2 * self.contact_radius
        return Run(
            f"{self.name}, {cells_label(cells)}, {increments} increments",
            self.scene[increments],
            paper.square_grid(cells, half_width),
        )

    def reference(self, value: float) -> Reference:
        """A number of the row."""
        return Reference(value, ReferenceKind.SEMI_CLOSED, self.source, REFERENCE_ERROR * value)

    def judged_profile(self, key: str) -> tuple[Field, Field]:
        """Radii over that of the contact, away from axis and edge, and a column at these."""
        radii, values = np.array(self.row["r_over_a"]), np.array(self.row[key])
        judged = (radii > JUDGED[0] - 1e-9) & (radii < JUDGED[1] + 1e-9)
        return radii[judged], values[judged]

    def pressure_error(self, result: Result) -> float:
        """Largest error of the pressure at the radii of the reference, over p_H."""
        radii, exact = self.judged_profile("p_over_pH")
        found = along_radii(result.steps[-1].pressure, result.grid, radii * self.contact_radius)
        return float(np.max(np.abs(found / HERTZ.peak_pressure - exact[:, None])))

    def _shear_errors(self, result: Result) -> tuple[Field, NDArray[np.bool_]]:
        """Errors over µp_H at the radii of the reference, and which of these are at the edge of
        the stick zone."""
        radii, exact = self.judged_profile("q_over_mu_pH")
        q = outward(shear_of(result.steps[-1]), result.grid)
        found = along_radii(q, result.grid, radii * self.contact_radius)
        error = np.abs(found / (self.friction * HERTZ.peak_pressure) - exact[:, None])
        width = EDGE_CELLS * result.grid.spacing[0] / self.contact_radius
        return np.max(error, axis=1), np.abs(radii - self.stick_part) < width

    def shear_error(self, result: Result) -> float:
        """Largest error of the outward shear away from the edge of the stick zone."""
        error, at_edge = self._shear_errors(result)
        return float(np.max(error[~at_edge]))

    def edge_error(self, result: Result) -> float:
        """Largest error of the outward shear at the edge of the stick zone; zero if the reference
        has no point there."""
        error, at_edge = self._shear_errors(result)
        return float(np.max(error, where=at_edge, initial=0.0))

    def stick_error(self, few: Result, many: Result) -> float:
        """Relative error of the stick radius, extrapolated in the increments."""
        radius = 2 * stick_radius(many) - stick_radius(few)
        return abs(radius / (self.stick_part * self.contact_radius) - 1)


def _bare(file_name: str, row: Mapping[str, Any], increments: int) -> Indentation:
    nu = float(row["nu"])
    modulus = paper.CONTACT_MODULUS * (1 - nu**2)
    body = Body(material=IsotropicMaterial(young_modulus=modulus, poisson_ratio=nu))
    source = "references/frictional_indentation_homogeneous.json: self-similar (Spence 1975)"
    name = f"ν = {nu:g}, µ = {row['mu']:g}"
    return Indentation(name, file_name, row, body, source, increments)


_ROWS = load_reference("frictional_indentation_homogeneous")["rows"]
WEAK = _bare("weak", _ROWS[0], FEW)
STRONG = _bare("strong", _ROWS[1], MANY)
NU_ZERO = _bare("nu_zero", _ROWS[2], FEW)
_ROW = load_reference("frictional_indentation_coated")
COATED = Indentation(
    "coated, µ = 0.1", "coated", _ROW, coated(film(_ROW["E1_over_E2"], _ROW["h_over_aH"])),
    "references/frictional_indentation_coated.json: Volterra equation along the load path",
)  # fmt: skip
