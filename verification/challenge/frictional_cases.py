"""Challenges with friction but without tangential force, and challenges with numbers at given
points.

The problems are torsion, indentation with friction, full stick, the stress below a sliding ball,
and layered half-spaces under a uniform traction on a square.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import log

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    FlatPunch,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Scene,
)
from verification.cases.frictional_pressing import NO_SLIP_BALL as BALL
from verification.cases.frictional_pressing import NO_SLIP_BALL_SOURCE as BALL_SOURCE
from verification.cases.frictional_pressing import NO_SLIP_FRICTION as FRICTION
from verification.cases.frictional_pressing import NO_SLIP_RATIOS as RATIOS
from verification.cases.frictional_pressing import NO_SLIP_SOURCE as SOURCE
from verification.challenge.requested_quantities import (
    SMALL,
    AskedField,
    AskedPoints,
    AskedValue,
    Challenge,
    Grade,
    Patch,
    RoundTable,
    approach,
    contact_radius,
    stick_radius,
    tabulated,
)
from verification.closed_forms.flat_punch import FlatPunchContact
from verification.closed_forms.huber_stress import hamilton_stress
from verification.closed_forms.torsion import TorsionalPartialSlip
from verification.problems import paper_scene as paper
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
from verification.problems.paper_scene import (
    CONTACT_MODULUS,
    FRICTION_LIMIT,
    HERTZ,
    NORMAL_FORCE,
    STEEL,
    half_space,
    pressed,
    pressing,
    rigid_ball,
)
from verification.problems.torsion import LARGEST, OVER_TWIST, PARTS, TORSION_LOOP, TWISTED
from verification.references import load_reference

# Radii at which tractions are required. Fractions of the contact radius would reveal it [length].
ROUND_RADII = 5e-5 * np.arange(1, 8)
# Largest radius at which tractions are judged, over the contact radius.
AMONG = 0.9
# Smallest distance of such a radius from the stick edge, over the contact radius.
AWAY = 0.02
# Error of a shear that is interpolated linearly between the radii of its table.
TABLE_ERROR = 2e-5
STICK_ERROR = 1e-6
# Interpolation error between the radii of the reference: 2.5e-4 on the finer radii of the coated
# row.
PROFILE_ERROR = 3e-4


def frictional() -> Iterator[Challenge]:
    """Yield the benchmark problems (challenges) of torsion, of indentation with friction, and of
    full stick.

    None of these has a tangential force.
    """
    yield torsion()
    yield torsion_loop()
    for one in (WEAK, STRONG, NU_ZERO, COATED):
        yield pressed_with_friction(one)
    for nu in RATIOS:
        yield stuck_punch(nu)
        yield stuck_ball(nu)


def torsion() -> Challenge:
    """Create the benchmark problem (challenge) of a pressed ball that is twisted to increasing
    torques (Lubkin).

    The twist, the stick radius and the circumferential shear at each torque are requested.
    """
    values, fields = [], []
    for step, end in enumerate(TWISTED.ends[1:], start=2):
        values += [
            _required_twist(step, end.twist, end.twist, "itself"),
            stick_radius(end.stick_radius, step),
        ]
        shear = circumferential_shear(end)
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


def circumferential_shear(end: TorsionalPartialSlip) -> RoundTable:
    """Create a table of the exact circumferential shear of a twisted ball over the radius.

    end  exact solution at the end of a load step
    """
    return tabulated(end.shear, end.stick_radius, end.contact_radius)


def torsion_loop() -> Challenge:
    """Create the benchmark problem (challenge) of a pressed ball under a torque that alternates
    between two limits.

    The twist at the end of each load step and the energy lost in one cycle are required.
    """
    values = [
        _required_twist(step, end.twist, LARGEST.twist, OVER_TWIST)
        for step, end in enumerate(TORSION_LOOP.ends[1:], start=2)
    ]
    last, energy = len(TORSION_LOOP.ends), TORSION_LOOP.ends[-1].energy_per_cycle
    values.append(
        AskedValue("energy_per_cycle", last, "J", "energy lost to friction between the ends of "
                   f"load steps 2 and {last}", energy, energy, "itself", uncertainty=1e-9, since=2)
    )  # fmt: skip
    return Challenge(
        "torsion_loop", "A ball twisted to and fro", f"{TORSION_LOOP.scene.title}.",
        TORSION_LOOP.scene, "Lubkin 1951, with Masing's rule for the reversal", tuple(values), (),
        SMALL,
    )  # fmt: skip


def pressed_with_friction(one: Indentation) -> Challenge:
    """Create the benchmark problem (challenge) of a rigid ball that is pressed with friction, with
    a tabulated reference.

    Pressure and radial shear are required at radii that keep a distance from the contact edge and
    from the stick edge.

    one  indentation with friction, with its tabulated reference solution
    """
    problem, a = one.problem(one.increments), one.contact_radius
    scene = problem.scene.model_copy(update={"loading": (pressing(),)})
    r = ROUND_RADII[AMONG * a > ROUND_RADII]
    r = r[np.abs(r - one.stick_part * a) > AWAY * a]
    places = np.stack([r, 0 * r, 0 * r], axis=1)
    limit = one.friction * HERTZ.peak_pressure
    pressure = interpolate_profile(one, "p_over_pH", r) * HERTZ.peak_pressure
    shear = interpolate_profile(one, "q_over_mu_pH", r) * limit
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


def interpolate_profile(
    one: Indentation, profile: str, r: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Interpolate the tabulated pressure or shear of an indentation to other distances from the
    axis.

    The profile is divided by √(1 - r²/a²), with the contact radius a, because its slope is infinite
    at the contact edge. Cubic splines inside and outside the stick zone interpolate the quotient.

    one      indentation with friction, with its tabulated reference solution
    profile  name of the tabulated traction
    r        distances from the axis [length]
    """
    part, values = np.array(one.row["r_over_a"]), np.array(one.row[profile])
    smooth, at = values / np.sqrt(1 - part**2), r / one.contact_radius
    inside = part < one.stick_part * (1 + 1e-3)
    outside = part > one.stick_part * (1 - 1e-3)
    found = CubicSpline(part[outside], smooth[outside])(at)
    if np.any(sticks := at < one.stick_part):
        found[sticks] = CubicSpline(part[inside], smooth[inside])(at[sticks])
    return np.asarray(found * np.sqrt(1 - at**2))


def stuck_punch(nu: float) -> Challenge:
    """Create the benchmark problem (challenge) of a flat punch in full stick on a half-space with
    Poisson's ratio nu.

    The required approach is that of the frictionless punch divided by Mossakovskii's factor.
    """
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
    """Create the benchmark problem (challenge) of a rigid ball in full stick on a half-space with
    Poisson's ratio nu (Spence).

    The approach and the contact radius are required.
    """
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


def _required_twist(step: int, value: float, scale: float, over: str) -> AskedValue:
    return AskedValue("twist", step, "rad", "rotation of the indenter about z relative to far "
                      "points of the body, right-handed", value, scale, over, Grade.C)  # fmt: skip


# Coefficient of friction µ of the sliding ball.
SLIDING = 0.3
# Shift of the sliding ball; all slip is then along x within 1e-3 radian [length].
SLID = 1e-3
PLACES = 1e-3 * np.array(
    [
        (0, 0, 0.1), (0, 0, 0.2), (0, 0, 0.4), (0.2, 0, 0.1), (-0.3, 0, 0.1), (-0.4, 0, 0.1),
        (0.2, 0.1, 0.2), (-0.1, 0.3, 0.15), (0.4, 0.2, 0.3), (0.1, -0.3, 0.2), (0.1, 0.1, 0.6),
    ]
)  # fmt: skip
COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")
PATCH_SOURCE = "references/influence_coefficients.json: inverse transform, 1e-12"
# Thickness of the layer, traction on the patch, and shear modulus of the substrate [SI].
THICKNESS, TRACTION, SUBSTRATE = 1e-3, 1e6, 80e9
# Displacement component and direction of the traction, by component of the reference rows.
MOVED = {
    "zz": ("u_z_by_pressure", "displacement along z under pressure on the patch"),
    "xx": ("u_x_by_shear_x", "displacement along x under shear along x on the patch"),
    "yy": ("u_y_by_shear_y", "displacement along y under shear along y on the patch"),
    "xy": ("u_x_by_shear_y", "displacement along x under shear along y on the patch"),
    "zx": ("u_z_by_shear_x", "displacement along z under shear along x on the patch"),
}


def at_places() -> Iterator[Challenge]:
    """Yield the benchmark problems (challenges) that require numbers at given points: stresses and
    surface displacements.
    """
    yield sliding_stress()
    yield from layered_patches()


def sliding_stress() -> Challenge:
    """Create the benchmark problem (challenge) of the stress below a ball in gross slip along x
    (Hamilton).

    The surface tractions are the Hertz pressure, and a shear along x of µ times this pressure.
    """
    scene = Scene(
        title="Ball that slides on a half-space",
        indenter=paper.paraboloid(STEEL),
        body=Body(material=STEEL),
        friction=CoulombFriction(coefficient=SLIDING),
        loading=(pressing(1), LoadStep(tangential_shift=(SLID, 0.0), increments=1)),
    )
    p0 = HERTZ.peak_pressure
    x, y, z = PLACES.T
    stress = hamilton_stress(x, y, z, HERTZ.contact_radius, p0, SLIDING * p0, STEEL.poisson_ratio)
    return Challenge(
        "sliding_stress", "Hamilton: stress below a sliding ball",
        f"{scene.title}: pressed, then moved along x so far that every place slips that way. "
        "Stress in the lower body, tension positive, at places around the contact as it was "
        "before the ball moved: small strains leave it there.", scene,
        "Hamilton 1983, as one integral of the potentials", (), (), SMALL,
        points=tuple(
            AskedPoints(f"stress_{name}", 2, "Pa", f"σ_{name}", PLACES, stress[n], p0, "p_H",
                        Grade.B, uncertainty=1e-5)
            for n, name in enumerate(COMPONENTS)
        ),
    )  # fmt: skip


def layered_patches() -> Iterator[Challenge]:
    """Yield the benchmark problems (challenges) of a layered half-space under a uniform traction on
    a square, without contact.

    The displacements at given points of the surface are required. The references are dimensionless;
    the layer is given a thickness of 1 mm.
    """
    rows = load_reference("influence_coefficients")["rows"]
    for ratio in dict.fromkeys(row["G1"] / row["G2"] for row in rows):
        own = [row for row in rows if row["G1"] / row["G2"] == ratio]
        side = own[0]["d"] * THICKNESS
        places = THICKNESS * np.array([(row["x"], row["y"], 0.0) for row in own])
        moved = THICKNESS * TRACTION / SUBSTRATE
        values = {key: moved * np.array([row["colloc"][key] for row in own]) for key in MOVED}
        scale = float(np.max(values["zz"]))
        yield Challenge(
            f"layered_patch/G1_over_G2={ratio:g}",
            f"A patch of traction on a layer, G1/G2 = {ratio:g}",
            f"A layer of {THICKNESS:g} m on a half-space. No contact: on the square "
            f"|x|, |y| < {side / 2:g} m of its surface acts a uniform traction of {TRACTION:g} Pa, "
            "pressure along +z or shear along +x or +y, one at a time.",
            Patch(_layered_body(own[0]), side, TRACTION), PATCH_SOURCE, (), (), SMALL, points=tuple(
                AskedPoints(name, 1, "m", meaning, places, values[key], scale,
                            "the largest u_z_by_pressure", Grade.B)
                for key, (name, meaning) in MOVED.items()
            ),
        )  # fmt: skip


def _layered_body(row: dict[str, float]) -> Body:
    def material(modulus: float, nu: float) -> IsotropicMaterial:
        young = 2 * (1 + nu) * SUBSTRATE * modulus / row["G2"]
        return IsotropicMaterial(young_modulus=young, poisson_ratio=nu)

    layer = Layer(thickness=row["h"] * THICKNESS, material=material(row["G1"], row["nu1"]))
    return Body(material=material(row["G2"], row["nu2"]), layers=(layer,))
