"""Problems of a body pressed by 1 kN: ball, cone, flat punch, barrel, and balls with friction.

Some bodies are coated. The pressure is infinite at the apex of the cone and at the rim of the
punch. Solutions with friction are tabulated.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import pi, radians
from typing import Any

from contact_scene import Body, Cone, Ellipsoid, FlatPunch, LoadStep, Scene
from verification.closed_forms.flat_punch import ConeContact, FlatPunchContact
from verification.closed_forms.hertz import EllipticalContact
from verification.problems.cattaneo_mindlin import OVER_LIMIT
from verification.problems.problem import (
    CONTACT_MODULUS,
    FREDHOLM,
    FREDHOLM_EQUATION,
    HERTZ,
    NORMAL_FORCE,
    OVER_PEAK,
    SEMI_CLOSED_ERROR,
    STEEL,
    Problem,
    ReferenceKind,
    TabulatedContact,
    coated,
    exact_contact,
    film,
    half_space,
    paraboloid,
    pressed,
    pressing,
    rigid_ball,
)
from verification.references import load_reference

SOURCE = "Hertz 1882; Johnson 1985, ch. 4"


def hertzian(scene: Scene) -> Problem:
    """Create the problem of a scene whose contact is the Hertz contact of the standard ball.

    The only load step must end at a normal force of 1 kN or the corresponding approach, for a
    radius of 18 mm and the standard contact modulus.

    scene  scene with any bodies of this contact modulus
    """
    return Problem(
        scene,
        (HERTZ,),
        HERTZ.contact_radius,
        SOURCE,
        scales={OVER_PEAK: HERTZ.peak_pressure},
        equations=(
            r"a^3 = \frac{3 W R}{4 E^*},\quad \delta = \frac{a^2}{R},\quad "
            r"p = \frac{3 W}{2 \pi a^2} \sqrt{1 - r^2/a^2}",
        ),
    )


def _pressed_ball(title: str, load: LoadStep) -> Problem:
    return hertzian(pressed(title, paraboloid(STEEL), STEEL, load))


BALL = _pressed_ball("Ball on a half-space (paper's data, paraboloid)", pressing())
LED_BALL = _pressed_ball(
    "Ball on a half-space, approach prescribed", LoadStep(approach=HERTZ.approach)
)


SLOPE = radians(1.0)  # angle of the cone's flank to the surface
PUNCH_RADIUS = 0.4e-3
PUNCH_WINDOW = 2.2  # side of the window over the punch radius
PRESS = pressing()

UNDER_CONE = ConeContact.under_load(NORMAL_FORCE, SLOPE, CONTACT_MODULUS)
CONE = Problem(
    pressed(
        "Cone on a half-space (flank at 1°)", Cone(slope_angle=SLOPE, material=STEEL), STEEL, PRESS
    ),
    (UNDER_CONE,),
    UNDER_CONE.contact_radius,
    "Love 1939; Sneddon 1965",
    equations=(
        r"W = \tfrac{\pi}{2} E^* a^2 \tan\beta,\quad \delta = \tfrac{\pi}{2} a \tan\beta,\quad "
        r"p = \tfrac{1}{2} E^* \tan\beta \, \mathrm{arcosh}(a/r)",
    ),
)
PUNCH = Problem(
    pressed(
        "Flat punch on a half-space", FlatPunch(radius=PUNCH_RADIUS, material=STEEL), STEEL, PRESS
    ),
    (FlatPunchContact(PUNCH_RADIUS, CONTACT_MODULUS, NORMAL_FORCE),),
    PUNCH_RADIUS,
    "Boussinesq 1885; Johnson 1985, ch. 3.4",
    equations=(r"W = 2 E^* a \delta,\quad p = \frac{W}{2 \pi a^2} \frac{1}{\sqrt{1 - r^2/a^2}}",),
)


def mean_pressure(of: Problem) -> float:
    """Compute the mean pressure of a round contact under a force of 1 kN [force/length²].

    of  problem with the contact radius
    """
    return NORMAL_FORCE / (pi * of.radius**2)


RADII = (90e-3, 18e-3)
EXACT = EllipticalContact.under_load(NORMAL_FORCE, RADII, CONTACT_MODULUS)
BARREL = Problem(
    pressed(
        "Barrel on a half-space (radii 90 mm and 18 mm)",
        Ellipsoid(radii=RADII, material=STEEL),
        STEEL,
        pressing(),
    ),
    (EXACT,),
    EXACT.semi_axes[0],
    "Hertz 1882, by Carlson's elliptic integrals",
    across=EXACT.semi_axes[1],
    equations=(
        r"\frac{R_x}{R_y} = \frac{(a/b)^2 \mathbf{E}(e) - \mathbf{K}(e)}"
        r"{\mathbf{K}(e) - \mathbf{E}(e)},\quad "
        r"p = \frac{3 W}{2 \pi a b} \sqrt{1 - x^2/a^2 - y^2/b^2}",
    ),
)


TABLE_SOURCE = (
    "references/coated_frictionless_paraboloid.json: Fredholm equation, two settings agree"
)
ROWS = load_reference("coated_frictionless_paraboloid")["rows"]
BARE = hertzian(pressed("Rigid ball on the uncoated half-space", rigid_ball(), coated()))


def coated_ball(row: Mapping[str, Any]) -> Problem:
    """Create the problem of a rigid ball on a coated body, with a tabulated solution.

    row  row of the reference table: modulus ratio E1/E2 of coating over substrate, coating
         thickness over Hertz contact radius, and results relative to the Hertz contact of the
         substrate
    """
    contact = TabulatedContact(row)
    ratio, thickness = row["E1_over_E2"], row["h_over_aH"]
    title = f"Rigid ball on a coating, E1/E2 = {ratio:g}, h = {thickness:g} a_H"
    return Problem(
        pressed(title, rigid_ball(), coated(film(ratio, thickness))),
        (contact,),
        contact.contact_radius,
        TABLE_SOURCE,
        ReferenceKind.SEMI_CLOSED,
        row["est_rel_error"],
        {OVER_PEAK: HERTZ.peak_pressure},
        equations=(FREDHOLM_EQUATION,),
    )


def solved_here(problem: Problem) -> Problem:
    """Replace the tabulated answer of a coated problem by the semi-closed solution of its contact.

    The semi-closed solution is computed when needed, and contains the pressure at every radius.

    problem  problem of a coated body below the standard ball
    """
    exact = exact_contact(problem.scene.body)
    return replace(
        problem,
        ends=(exact,),
        radius=exact.contact_radius,
        source=FREDHOLM,
        uncertainty=SEMI_CLOSED_ERROR,
    )


OVER_HERTZ_RADIUS = "a_H"
# numbers of increments, uniform in contact radius
FEW = 20
MANY = 40
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

    @property
    def stick_radius(self) -> float:
        """Radius of the stick zone, from the reference table [length]."""
        return self.stick_part * self.contact_radius

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
NO_POISSON_BALL = _bare_body("nu_zero", _ROWS[2], FEW)
_ROW = load_reference("frictional_indentation_coated")
COATED = Indentation(
    _ROW,
    "coated, µ = 0.1",
    "coated",
    coated(film(_ROW["E1_over_E2"], _ROW["h_over_aH"])),
    "references/frictional_indentation_coated.json: Volterra equation along the load path",
)
