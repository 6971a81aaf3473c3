"""Challenges where friction acts without a tangential force: torsion, pressing, full stick."""

from __future__ import annotations

from collections.abc import Iterator
from math import log

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from contact_scene import RIGID, FlatPunch
from verification.cases.frictional_pressing import NO_SLIP_BALL as BALL
from verification.cases.frictional_pressing import NO_SLIP_BALL_SOURCE as BALL_SOURCE
from verification.cases.frictional_pressing import NO_SLIP_FRICTION as FRICTION
from verification.cases.frictional_pressing import NO_SLIP_RATIOS as RATIOS
from verification.cases.frictional_pressing import NO_SLIP_SOURCE as SOURCE
from verification.challenge.often_asked import SMALL, approach, contact_radius, stick_radius
from verification.challenge.requested_quantities import (
    AskedField,
    AskedPoints,
    AskedValue,
    Challenge,
    Grade,
)
from verification.challenge.round_table import RoundTable, tabulated
from verification.closed_forms.flat_punch import FlatPunchContact
from verification.closed_forms.torsion import TorsionalPartialSlip
from verification.problems.cattaneo_mindlin import OVER_LIMIT
from verification.problems.classical import PUNCH_RADIUS
from verification.problems.indentation import (
    COATED,
    NU_ZERO,
    REFERENCE_ERROR,
    STRONG,
    WEAK,
    Indentation,
)
from verification.problems.layered_scene import half_space, pressed, rigid_ball
from verification.problems.paper_scene import (
    CONTACT_MODULUS,
    FRICTION_LIMIT,
    HERTZ,
    NORMAL_FORCE,
    pressing,
)
from verification.problems.torsion import LARGEST, OVER_TWIST, PARTS, TO_AND_FRO, TWISTED

# Parts of the contact radius would print it [length].
ROUND_RADII = 5e-5 * np.arange(1, 8)
AMONG = 0.9  # of the contact radius: where tractions are judged
AWAY = 0.02  # from the edge of stick, over the contact radius
TABLE_ERROR = 2e-5  # of a shear that is linear between the radii of its table
STICK_ERROR = 1e-6
PROFILE_ERROR = 3e-4  # between the reference's radii: 2.5e-4 from the finer ones of the coated row


def frictional() -> Iterator[Challenge]:
    """All of them."""
    yield torsion()
    yield torsion_loop()
    for one in (WEAK, STRONG, NU_ZERO, COATED):
        yield pressed_with_friction(one)
    for nu in RATIOS:
        yield stuck_punch(nu)
        yield stuck_ball(nu)


def torsion() -> Challenge:
    """Lubkin's contact at three torques."""
    values, fields = [], []
    for step, end in enumerate(TWISTED.ends[1:], start=2):
        values += [
            _twist(step, end.twist, end.twist, "itself"),
            stick_radius(end.stick_radius, step),
        ]
        shear = around(end)
        fields.append(
            AskedField(
                "shear_around", step, "shear traction on the lower body around the z axis, "
                "positive along +y at +x", shear, "L1", FRICTION_LIMIT, shear.total,
                uncertainty=TABLE_ERROR,
            )
        )  # fmt: skip
    parts = ", ".join(f"{part:g}" for part in PARTS.values())
    return Challenge(
        "torsion", "Lubkin: pressed, then twisted",
        f"{TWISTED.scene.title}: twisted by {parts} of the torque at which all slips.",
        TWISTED.scene, TWISTED.source, tuple(values), tuple(fields), SMALL,
    )  # fmt: skip


def around(end: TorsionalPartialSlip) -> RoundTable:
    """Shear around the axis."""
    return tabulated(end.shear, end.stick_radius, end.contact_radius)


def torsion_loop() -> Challenge:
    """To and fro."""
    values = [
        _twist(step, end.twist, LARGEST.twist, OVER_TWIST)
        for step, end in enumerate(TO_AND_FRO.ends[1:], start=2)
    ]
    last, energy = len(TO_AND_FRO.ends), TO_AND_FRO.ends[-1].energy_per_cycle
    values.append(
        AskedValue("energy_per_cycle", last, "J", "energy lost to friction between the ends of "
                   f"load steps 2 and {last}", energy, energy, "itself", uncertainty=1e-9, since=2)
    )  # fmt: skip
    return Challenge(
        "torsion_loop", "A ball twisted to and fro", f"{TO_AND_FRO.scene.title}.",
        TO_AND_FRO.scene, "Lubkin 1951, with Masing's rule for the reversal", tuple(values), (),
        SMALL,
    )  # fmt: skip


def pressed_with_friction(one: Indentation) -> Challenge:
    """By a row of a reference, tractions away from the edges."""
    problem, a = one.problem(one.increments), one.contact_radius
    scene = problem.scene.model_copy(update={"loading": (pressing(),)})
    r = ROUND_RADII[AMONG * a > ROUND_RADII]
    r = r[np.abs(r - one.stick_part * a) > AWAY * a]
    places = np.stack([r, 0 * r, 0 * r], axis=1)
    limit = one.friction * HERTZ.peak_pressure
    pressure = between(one, "p_over_pH", r) * HERTZ.peak_pressure
    shear = between(one, "q_over_mu_pH", r) * limit
    points = (
        AskedPoints("pressure", 1, "Pa", "pressure", places, pressure, HERTZ.peak_pressure,
                    "p_H", uncertainty=PROFILE_ERROR),
        AskedPoints("shear_radial", 1, "Pa", "shear traction on the lower body, positive outward",
                    places, shear, limit, OVER_LIMIT, uncertainty=PROFILE_ERROR),
    )  # fmt: skip
    radius = one.stick_part * a
    numbers = (
        approach(one.approach, REFERENCE_ERROR), contact_radius(a, REFERENCE_ERROR),
        stick_radius(radius, 1, STICK_ERROR),
    )  # fmt: skip
    return Challenge(
        f"frictional_indentation/{one.file_name}", f"Pressed with friction: {one.name}",
        f"{scene.title}. The shear remembers the whole way there: the force grows from zero.",
        scene, one.source, numbers, (), SMALL, points=points,
    )  # fmt: skip


def between(one: Indentation, profile: str, r: NDArray[np.float64]) -> NDArray[np.float64]:
    """A profile between its radii: cubic inside and outside the stick zone, over the root that it
    has at the edge of contact."""
    part, values = np.array(one.row["r_over_a"]), np.array(one.row[profile])
    smooth, at = values / np.sqrt(1 - part**2), r / one.contact_radius
    inside = part < one.stick_part * (1 + 1e-3)
    outside = part > one.stick_part * (1 - 1e-3)
    found = CubicSpline(part[outside], smooth[outside])(at)
    if np.any(sticks := at < one.stick_part):
        found[sticks] = CubicSpline(part[inside], smooth[inside])(at[sticks])
    return np.asarray(found * np.sqrt(1 - at**2))


def stuck_punch(nu: float) -> Challenge:
    """Mossakovskii's factor of stiffness."""
    punch = FlatPunch(radius=PUNCH_RADIUS, material=RIGID)
    scene = pressed("Flat punch that does not slip", punch, half_space(nu), pressing(1),
                    friction=FRICTION)  # fmt: skip
    factor = (1 - nu) * log(3 - 4 * nu) / (1 - 2 * nu)
    smooth = FlatPunchContact(PUNCH_RADIUS, CONTACT_MODULUS, NORMAL_FORCE)
    return Challenge(
        f"full_stick/punch_nu={nu:g}", f"A punch that sticks all over, ν = {nu:g}",
        f"{scene.title}: so much friction that no place slips, ν = {nu:g}.", scene, SOURCE,
        (approach(smooth.approach / factor),), (), SMALL,
    )  # fmt: skip


def stuck_ball(nu: float) -> Challenge:
    """Spence's ball without slip."""
    scene = pressed("Rigid ball that does not slip", rigid_ball(), half_space(nu), pressing(),
                    friction=FRICTION)  # fmt: skip
    over_a_squared, over_load = BALL[nu]
    a = HERTZ.contact_radius / over_load ** (1 / 3)
    approached = HERTZ.approach * over_a_squared / over_load ** (2 / 3)
    return Challenge(
        f"full_stick/ball_nu={nu:g}", f"A ball that sticks all over, ν = {nu:g}",
        f"{scene.title}: so much friction that no place slips once it is touched, ν = {nu:g}.",
        scene, BALL_SOURCE, (approach(approached, 1e-7), contact_radius(a, 1e-7)), (), SMALL,
    )  # fmt: skip


def _twist(step: int, value: float, scale: float, over: str) -> AskedValue:
    return AskedValue("twist", step, "rad", "rotation of the indenter about z relative to far "
                      "points of the body, right-handed", value, scale, over, Grade.C,
                      limit=1.5)  # fmt: skip
