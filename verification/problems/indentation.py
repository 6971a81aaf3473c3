"""Problems of a rigid ball that is pressed on a body with friction, with tabulated solutions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from contact_scene import Body
from verification.problems.cattaneo_mindlin import OVER_LIMIT
from verification.problems.paper_scene import (
    HERTZ,
    coated,
    film,
    half_space,
    pressed,
    pressing,
    rigid_ball,
)
from verification.problems.problem import OVER_PEAK, Problem, ReferenceKind, TabulatedContact
from verification.references import load_reference

OVER_HERTZ_RADIUS = "a_H"
FEW, MANY = 20, 40  # numbers of increments, uniform in contact radius
REFERENCE_ERROR = 1e-7  # relative, of radii and approach


@dataclass(frozen=True, eq=False)
class Indentation(TabulatedContact):
    """Hold the tabulated contact of a rigid ball that is pressed on a body with friction.

    name        description of the contact
    file_name   description for use in file names
    body        body below the ball
    source      source of the table
    increments  number of increments that the accuracy target of the shear requires
    """

    name: str
    file_name: str
    body: Body
    source: str
    increments: int = FEW

    @property
    def stick_part(self) -> float:
        """Radius of the stick zone over the contact radius, from the reference table [1]."""
        return float(self.row["c_over_a"])

    def problem(self, increments: int) -> Problem:
        """Create the verification problem of the rigid ball on the body with this tabulated answer.

        increments  number of increments of the normal loading
        """
        title = f"Rigid ball pressed with friction: {self.name}"
        return Problem(
            pressed(title, rigid_ball(), self.body, pressing(increments), friction=self.friction),
            (self,),
            self.contact_radius,
            self.source,
            ReferenceKind.SEMI_CLOSED,
            REFERENCE_ERROR,
            {
                OVER_PEAK: HERTZ.peak_pressure,
                OVER_HERTZ_RADIUS: HERTZ.contact_radius,
                OVER_LIMIT: self.friction * HERTZ.peak_pressure,
            },
            equations=(
                r"q = \mu p\ (c < r < a),\quad \frac{\partial}{\partial a} u_r(r; a) = 0\ (r < c),"
                r"\quad "
                r"u_z = \delta - \frac{r^2}{2R}",
            ),
        )


def _bare_body(file_name: str, row: Mapping[str, Any], increments: int) -> Indentation:
    nu = float(row["nu"])
    source = "references/frictional_indentation_homogeneous.json: self-similar (Spence 1975)"
    return Indentation(
        row, f"ν = {nu:g}, µ = {row['mu']:g}", file_name, half_space(nu), source, increments
    )


_ROWS = load_reference("frictional_indentation_homogeneous")["rows"]
WEAK = _bare_body("weak", _ROWS[0], FEW)
STRONG = _bare_body("strong", _ROWS[1], MANY)
NU_ZERO = _bare_body("nu_zero", _ROWS[2], FEW)
_ROW = load_reference("frictional_indentation_coated")
COATED = Indentation(
    _ROW, "coated, µ = 0.1", "coated", coated(film(_ROW["E1_over_E2"], _ROW["h_over_aH"])),
    "references/frictional_indentation_coated.json: Volterra equation along the load path",
)  # fmt: skip
