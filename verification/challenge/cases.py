"""Challenges for other codes: contact problems with accurately known solutions.

Where equal axes or equal bodies would hide that a code exchanges them, the geometries differ along
x and y, and the bodies differ from each other. Some challenges require numbers at given points.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from math import log
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from contact_scene import (
    RIGID,
    Body,
    FlatPunch,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Scene,
)
from contact_scene.array_types import Field
from contact_scene.geometry import Indenter
from verification.cases.frictional_pressing import (
    NO_SLIP_BALL,
    NO_SLIP_BALL_SOURCE,
    NO_SLIP_FRICTION,
    NO_SLIP_RATIOS,
    NO_SLIP_SOURCE,
)
from verification.challenge.requested_quantities import (
    COMPONENTS,
    LARGE,
    SMALL,
    AskedField,
    AskedValue,
    Challenge,
    Grade,
    Patch,
    Traction,
    round_traction,
)
from verification.closed_forms.cattaneo_mindlin import TangentialHistory
from verification.closed_forms.flat_punch import FlatPunchContact
from verification.closed_forms.huber_stress import hamilton_stress
from verification.problems.cattaneo_mindlin import (
    AMPLITUDE,
    LARGEST,
    OVER_LIMIT,
    OVER_TWIST,
    TORQUE_PARTS,
    TORSION_LOOP,
    TWISTED,
    sheared,
)
from verification.problems.indentation import (
    BALL,
    BARREL,
    COATED,
    CONE,
    NO_POISSON_BALL,
    PUNCH,
    PUNCH_RADIUS,
    REFERENCE_ERROR,
    ROWS,
    STRONG,
    WEAK,
    Indentation,
    coated_ball,
    solved_here,
)
from verification.problems.problem import (
    CONTACT_MODULUS,
    FRICTION,
    FRICTION_LIMIT,
    HERTZ,
    NORMAL_FORCE,
    NU_ZERO,
    RADIUS,
    STEEL,
    Problem,
    frictional,
    half_space,
    paraboloid,
    partial_slip,
    pressed,
    pressing,
    rigid_ball,
)
from verification.references import load_reference

# Radii at which tractions are required. Fractions of the contact radius would reveal it [length].
ROUND_RADII = 5e-5 * np.arange(1, 8)
# Largest radius at which tractions are judged, over the contact radius.
AMONG = 0.9
# Smallest distance of such a radius from the stick edge, over the contact radius.
AWAY = 0.02
STICK_ERROR = 1e-6
# Interpolation error between the radii of the reference: 2.5e-4 on the finer radii of the coated
# row.
PROFILE_ERROR = 3e-4


def of_itself(quantity: str, step: int, value: float, **more: Any) -> AskedValue:
    """Create a required number whose error scale is the number itself.

    quantity  name of the quantity
    step      number of the load step, from 1
    value     reference value
    more      further fields of `AskedValue`
    """
    return AskedValue(quantity, step, value, value, **more)


def stick_radius(step: int, value: float, **more: Any) -> AskedValue:
    """Create an optional number for the radius of the stick zone at the end of a load step.

    The error scale is the Hertz contact radius.

    step   number of the load step, from 1
    value  reference stick radius [length]
    more   further fields of `AskedValue`
    """
    over = HERTZ.contact_radius, "the contact radius", Grade.C
    return AskedValue("stick_radius", step, value, *over, required=False, **more)


def torsion() -> Challenge:
    """Create the challenge of a pressed ball that is twisted to increasing torques (Lubkin).

    The twist, the stick radius and the circumferential shear at each torque are requested.
    """
    values, fields = [], []
    for step, end in enumerate(TWISTED.ends[1:], start=2):
        values += [
            of_itself("twist", step, end.twist, par=Grade.C),
            stick_radius(step, end.stick_radius),
        ]
        shear = round_traction(end.shear, end.contact_radius, end.stick_radius)
        fields.append(
            AskedField(
                "shear_around",
                step,
                "shear traction on the lower body around the z axis, positive along +y at +x",
                shear,
                "L1",
                FRICTION_LIMIT,
                shear.total,
            )
        )
    parts = ", ".join(f"{part:g}" for part in TORQUE_PARTS.values())
    return Challenge(
        "torsion",
        "Lubkin: pressed, then twisted",
        f"{TWISTED.scene.title}: twisted by {parts} of the torque at which all slips.",
        TWISTED.scene,
        TWISTED.source,
        tuple(values),
        tuple(fields),
    )


def torsion_loop() -> Challenge:
    """Create the challenge of a pressed ball under a torque that alternates between two limits.

    The twist at the end of each load step and the energy lost in one cycle are required.
    """
    twists = (
        AskedValue("twist", step, end.twist, LARGEST.twist, OVER_TWIST, Grade.C)
        for step, end in enumerate(TORSION_LOOP.ends[1:], start=2)
    )
    last, energy = len(TORSION_LOOP.ends), TORSION_LOOP.ends[-1].energy_per_cycle
    return Challenge(
        "torsion_loop",
        "A ball twisted to and fro",
        f"{TORSION_LOOP.scene.title}.",
        TORSION_LOOP.scene,
        "Lubkin 1951, with Masing's rule for the reversal",
        (*twists, of_itself("energy_per_cycle", last, energy, uncertainty=1e-9, since=2)),
    )


def pressed_with_friction(one: Indentation) -> Challenge:
    """Create the challenge of a rigid ball that is pressed with friction, with a tabulated
    reference.

    Pressure and radial shear are required at radii that keep a distance from the contact edge and
    from the stick edge.

    one  indentation with friction, with its tabulated reference solution
    """
    problem, a = one.problem(one.increments), one.contact_radius
    scene = problem.scene.model_copy(update={"loading": (pressing(),)})
    r = ROUND_RADII[AMONG * a > ROUND_RADII]
    r = r[np.abs(r - one.stick_radius) > AWAY * a]
    places = np.stack([r, 0 * r, 0 * r], axis=1)
    tractions = {
        "pressure": ("p_over_pH", HERTZ.peak_pressure, "p_H"),
        "shear_radial": ("q_over_mu_pH", one.friction * HERTZ.peak_pressure, OVER_LIMIT),
    }
    numbers = (
        of_itself("approach", 1, one.approach, uncertainty=REFERENCE_ERROR),
        of_itself("contact_radius", 1, a, uncertainty=REFERENCE_ERROR),
        stick_radius(1, one.stick_radius, uncertainty=STICK_ERROR),
        *(
            AskedValue(
                quantity,
                1,
                interpolate_profile(one, profile, r) * scale,
                scale,
                over,
                Grade.C,
                places,
                uncertainty=PROFILE_ERROR,
            )
            for quantity, (profile, scale, over) in tractions.items()
        ),
    )
    return Challenge(
        f"frictional_indentation/{one.file_name}",
        f"Pressed with friction: {one.name}",
        f"{scene.title}. The shear remembers the whole way there: the force grows from zero.",
        scene,
        one.source,
        numbers,
    )


def interpolate_profile(one: Indentation, profile: str, r: Field) -> Field:
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
    """Create the challenge of a flat punch in full stick on a half-space with Poisson's ratio nu.

    The required approach is that of the frictionless punch divided by Mossakovskii's factor.
    """
    punch = FlatPunch(radius=PUNCH_RADIUS, material=RIGID)
    scene = pressed(
        "Flat punch that does not slip",
        punch,
        half_space(nu),
        pressing(1),
        friction=NO_SLIP_FRICTION,
    )
    factor = (1 - nu) * log(3 - 4 * nu) / (1 - 2 * nu)
    smooth = FlatPunchContact(PUNCH_RADIUS, CONTACT_MODULUS, NORMAL_FORCE)
    return Challenge(
        f"full_stick/punch_nu={nu:g}",
        f"A punch that sticks all over, ν = {nu:g}",
        f"{scene.title}: so much friction that no place slips, ν = {nu:g}.",
        scene,
        NO_SLIP_SOURCE,
        (of_itself("approach", 1, smooth.approach / factor),),
    )


def stuck_ball(nu: float) -> Challenge:
    """Create the challenge of a rigid ball in full stick on a half-space with Poisson's ratio nu
    (Spence).

    The approach and the contact radius are required.
    """
    scene = pressed(
        "Rigid ball that does not slip",
        rigid_ball(),
        half_space(nu),
        pressing(),
        friction=NO_SLIP_FRICTION,
    )
    over_a_squared, over_load = NO_SLIP_BALL[nu]
    a = HERTZ.contact_radius / over_load ** (1 / 3)
    approached = HERTZ.approach * over_a_squared / over_load ** (2 / 3)
    return Challenge(
        f"full_stick/ball_nu={nu:g}",
        f"A ball that sticks all over, ν = {nu:g}",
        f"{scene.title}: so much friction that no place slips once it is touched, ν = {nu:g}.",
        scene,
        NO_SLIP_BALL_SOURCE,
        (
            of_itself("approach", 1, approached, uncertainty=1e-7),
            of_itself("contact_radius", 1, a, uncertainty=1e-7),
        ),
    )


# Coefficient of friction µ of the sliding ball.
SLIDING = 0.3
# Shift of the sliding ball; all slip is then along x within 1e-3 radian [length].
SLID = 1e-3
PLACES = 1e-3 * np.array(
    [
        (0, 0, 0.1),
        (0, 0, 0.2),
        (0, 0, 0.4),
        (0.2, 0, 0.1),
        (-0.3, 0, 0.1),
        (-0.4, 0, 0.1),
        (0.2, 0.1, 0.2),
        (-0.1, 0.3, 0.15),
        (0.4, 0.2, 0.3),
        (0.1, -0.3, 0.2),
        (0.1, 0.1, 0.6),
    ]
)
PATCH_SOURCE = "references/influence_coefficients.json: inverse transform, 1e-12"
# Thickness of the layer, traction on the patch, and shear modulus of the substrate [SI].
THICKNESS = 1e-3
TRACTION = 1e6
SUBSTRATE = 80e9
# Required displacement, by component of the reference rows.
MOVED = {
    "zz": "u_z_by_pressure",
    "xx": "u_x_by_shear_x",
    "yy": "u_y_by_shear_y",
    "xy": "u_x_by_shear_y",
    "zx": "u_z_by_shear_x",
}


def sliding_stress() -> Challenge:
    """Create the challenge of the stress below a ball in gross slip along x (Hamilton).

    The surface tractions are the Hertz pressure, and a shear along x of µ times this pressure.
    """
    scene = pressed(
        "Ball that slides on a half-space",
        paraboloid(STEEL),
        STEEL,
        pressing(1),
        LoadStep(tangential_shift=(SLID, 0.0), increments=1),
        friction=SLIDING,
    )
    p0 = HERTZ.peak_pressure
    x, y, z = PLACES.T
    stress = hamilton_stress(x, y, z, HERTZ.contact_radius, p0, SLIDING * p0, STEEL.poisson_ratio)
    return Challenge(
        "sliding_stress",
        "Hamilton: stress below a sliding ball",
        f"{scene.title}: pressed, then moved along x so far that every place slips that way. "
        "Stress in the lower body, tension positive, at places around the contact as it was "
        "before the ball moved: small strains leave it there.",
        scene,
        "Hamilton 1983, as one integral of the potentials",
        tuple(
            AskedValue(f"stress_{name}", 2, stress[n], p0, "p_H", places=PLACES, uncertainty=1e-5)
            for n, name in enumerate(COMPONENTS)
        ),
    )


def layered_patches() -> Iterator[Challenge]:
    """Yield the challenges of a layered half-space under a uniform traction on a square, without
    contact.

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
            Patch(_layered_body(own[0]), side, TRACTION),
            PATCH_SOURCE,
            tuple(
                AskedValue(
                    name, 1, values[key], scale, "the largest u_z_by_pressure", places=places
                )
                for key, name in MOVED.items()
            ),
        )


def _layered_body(row: dict[str, float]) -> Body:
    def material(modulus: float, nu: float) -> IsotropicMaterial:
        young = 2 * (1 + nu) * SUBSTRATE * modulus / row["G2"]
        return IsotropicMaterial(young_modulus=young, poisson_ratio=nu)

    layer = Layer(thickness=row["h"] * THICKNESS, material=material(row["G1"], row["nu1"]))
    return Body(material=material(row["G2"], row["nu2"]), layers=(layer,))


# Slopes that close the gap at positive y and x. The punch remains in contact everywhere, with its
# load at 0.24 radii from the axis. The contact of the ball stays in the window.
PUNCH_TILT = (0.004, 0.003)
BALL_TILT = (0.008, 0.005)
WORDS = (
    "The tilt (φ_x, φ_y) is given: slopes that close the gap at positive y and at positive x, so "
    "that h = h_i + u_z - approach - φ_x y - φ_y x. Approach is that of the origin."
)


def tilted_punch() -> Challenge:
    """Create the challenge of a flat punch that is pressed and tilted by a prescribed slope.

    The punch remains in contact over its whole end, whose displacement is a plane. The approach and
    the moments are required.
    """
    arm = (
        4 / 3 * CONTACT_MODULUS * PUNCH_RADIUS**3 / NORMAL_FORCE
    )  # of the normal force, per unit slope
    force_at = (arm * PUNCH_TILT[1], arm * PUNCH_TILT[0])
    exact = FlatPunchContact(PUNCH_RADIUS, CONTACT_MODULUS, NORMAL_FORCE, force_at)
    punch = FlatPunch(radius=PUNCH_RADIUS, material=STEEL)
    return _tilted_challenge(
        "tilted_punch",
        "A flat punch pressed and tilted",
        punch,
        PUNCH_TILT,
        "Galin's theorem; Sneddon 1951, § 52",
        force_at,
        (of_itself("approach", 1, exact.approach),),
    )


def tilted_ball() -> Challenge:
    """Create the challenge of a ball that is pressed and tilted by the slope φ.

    A tilted paraboloid is a shifted paraboloid: x²/2R - φx = (x - Rφ)²/2R - Rφ²/2. The approach,
    the contact radius and the moments are required.
    """
    drop = 0.5 * RADIUS * (BALL_TILT[0] ** 2 + BALL_TILT[1] ** 2)
    return _tilted_challenge(
        "tilted_ball",
        "A ball pressed and tilted",
        paraboloid(STEEL),
        BALL_TILT,
        "Hertz 1882, below the place where the slope is zero",
        (RADIUS * BALL_TILT[1], RADIUS * BALL_TILT[0]),
        (
            of_itself("approach", 1, HERTZ.approach - drop),
            of_itself("contact_radius", 1, HERTZ.contact_radius),
        ),
    )


def _tilted_challenge(
    name: str,
    title: str,
    indenter: Indenter,
    tilt: tuple[float, float],
    source: str,
    force_at: tuple[float, float],
    values: tuple[AskedValue, ...],
) -> Challenge:
    step = LoadStep(normal_force=NORMAL_FORCE, tilt=tilt)
    scene = pressed(title, indenter, STEEL, step)
    largest = NORMAL_FORCE * max(force_at), "the larger moment"
    moments = (
        AskedValue(f"moment_{axis}", 1, NORMAL_FORCE * at, *largest, Grade.C)
        for axis, at in (("x", force_at[1]), ("y", force_at[0]))
    )
    return Challenge(name, title, f"{title}. {WORDS}", scene, source, (*values, *moments))


# Poisson's ratios of the bodies under changing loads.
POISSON_RATIOS = (0.0, 0.3, 0.5)
STEPS = (
    LoadStep(normal_force=0.8 * NORMAL_FORCE),
    LoadStep(normal_force=NORMAL_FORCE, tangential_force=(50.0, 0.0)),
    LoadStep(tangential_force=(50.0, 50.0)),
    LoadStep(normal_force=0.9 * NORMAL_FORCE, tangential_force=(20.0, 60.0)),
    LoadStep(torque=6e-3),
)


def scene_of(poisson_ratio: float) -> Scene:
    """Create the scene of a ball on a body of the same material under changing forces and a torque.

    The modulus E* of the contact is that of the standard ball for every Poisson's ratio.
    """
    modulus = 2 * CONTACT_MODULUS * (1 - poisson_ratio**2)
    material = IsotropicMaterial(young_modulus=modulus, poisson_ratio=poisson_ratio)
    scene = frictional(
        f"Ball under changing loads, ν = {poisson_ratio:g}", paraboloid(material), material
    )
    return scene.model_copy(update={"loading": STEPS})


def changing_loads() -> Iterator[Challenge]:
    """Yield the challenges of a ball under changing normal and tangential forces and a torque.

    The references are numbers of the radial solver, extrapolated to fine increments.
    """
    content = load_reference("changing_loads")
    for nu in POISSON_RATIOS:
        scene, ends = scene_of(nu), content["ends"][f"{nu:g}"]
        yield Challenge(
            f"changing_loads/nu={nu:g}",
            f"Both forces change, the direction turns, then a twist: ν = {nu:g}",
            f"{scene.title}. Each load step is a straight path from the preceding loads to its "
            "own: pressed by 0.8 kN; 1 kN and 50 N along x; 50 N along y added; 0.9 kN "
            "and (20, 60) N; a torque of 6 N mm about z.",
            scene,
            content["source"],
            tuple(
                _changing_load_value(step, name, value, ends)
                for step, values in ends.items()
                for name, value in values.items()
            ),
            shares="the scene: two solvers of this program agree within the uncertainty",
        )


def _changing_load_value(
    step: str, name: str, value: float, ends: dict[str, dict[str, float]]
) -> AskedValue:
    """Create a required number of a challenge with changing loads, with its error scale and
    uncertainty.

    The error scale is the largest shift, twist or dissipated energy of the load history.

    step   number of the load step, as text
    name   name of the quantity, such as "shift_x"
    value  reference value
    ends   reference values at the ends of the load steps, by step and name
    """
    kind = name.partition("_")[0]
    scale = max(
        abs(number)
        for values in ends.values()
        for other, number in values.items()
        if other.startswith(kind)
    )
    return AskedValue(
        name,
        int(step),
        value,
        scale,
        f"the largest {kind}",
        Grade.C,
        uncertainty=load_reference("changing_loads")["uncertainty"][name],
    )


# Shift [length] by tangential force over µW. Mean of two solvers, which differ by 1e-4: 128 x 128
# cells and 64 elements per radius, extrapolated from 40 + 3 x 12 and 80 + 3 x 24 increments.
SHIFTS = {0.3: 1.7327e-7, 0.6: 3.8068e-7, 0.9: 6.6704e-7}
UNCERTAINTY = 1e-4


def paper_figure() -> Challenge:
    """Create the challenge of a rigid ball on a coated body, pressed with friction and then
    sheared.

    The coating is twice as stiff as its substrate and as thick as the Hertz contact radius. The
    approach and the tangential shifts are required.
    """
    pushes = (LoadStep(tangential_force=(part * FRICTION_LIMIT, 0.0)) for part in SHIFTS)
    shifts = (
        of_itself("shift_x", step, shift, par=Grade.C, uncertainty=UNCERTAINTY)
        for step, shift in enumerate(SHIFTS.values(), start=2)
    )
    title = "Coated body under a rigid ball, pressed with friction, then sheared"
    scene = pressed(title, rigid_ball(), COATED.body, pressing(), *pushes, friction=FRICTION)
    return Challenge(
        "paper_figure_4",
        title,
        f"{title}. Pressing leaves radial shear, and the way there matters: every force grows "
        "in proportion to time.",
        scene,
        f"{COATED.source}; the shifts by slipstick's finite elements and cells, which agree",
        (of_itself("approach", 1, COATED.approach, uncertainty=REFERENCE_ERROR), *shifts),
        shares="for the approach nothing; the shifts are what two of them agree on",
    )


# Tangential force over µW at the ends of the load steps.
FORCES = (0.3, 0.6, 0.9, 0.99)
# Tangential force over its maximum in the loop.
QUARTERS = (0.25, 0.5, 0.75, 1.0)


@cache
def challenges() -> dict[str, Challenge]:
    """Return all challenges for other codes, by name.

    The peak pressure of a cone is infinite, and a punch prescribes the contact radius: these are
    not required.
    """
    round_pressure = round_traction(HERTZ.pressure, HERTZ.contact_radius)
    every = (
        _pressed_challenge("hertz_point", "Hertz: a ball on a half-space", BALL, round_pressure),
        hertz_elliptical(),
        _pressed_challenge("cone_contact", "A cone on a half-space", CONE, None),
        Challenge(
            "flat_punch",
            "A flat punch on a half-space",
            _problem_text(PUNCH),
            PUNCH.scene,
            PUNCH.source,
            (of_itself("approach", 1, PUNCH.ends[0].approach),),
        ),
        *(cattaneo_mindlin(), loop(), tilted_punch(), tilted_ball(), *coated_balls()),
        *(torsion(), torsion_loop()),
        *map(pressed_with_friction, (WEAK, STRONG, NO_POISSON_BALL, COATED)),
        *(stuck(nu) for nu in NO_SLIP_RATIOS for stuck in (stuck_punch, stuck_ball)),
        *(paper_figure(), sliding_stress(), *layered_patches(), *changing_loads()),
    )
    return {one.name: one for one in every}


def hertz_elliptical() -> Challenge:
    """Create the challenge of a barrel on a half-space, whose Hertz contact is an ellipse.

    The window is square, so that a code that exchanges x and y gets wrong semi-axes.
    """
    exact = BARREL.ends[0]
    axes = (
        of_itself(f"semi_axis_{axis}", 1, length)
        for axis, length in zip("xy", exact.semi_axes, strict=True)
    )
    pressure = Traction(lambda x: exact.pressure(x, 0.0), exact.semi_axes)
    return _pressed_challenge(
        "hertz_elliptical", "Hertz: a barrel on a half-space", BARREL, pressure, tuple(axes)
    )


def coated_balls() -> Iterator[Challenge]:
    """Yield one challenge of a frictionless rigid ball for each tabulated coating."""
    for row in ROWS:
        problem = coated_ball(row)
        exact = solved_here(problem).ends[0]
        yield _pressed_challenge(
            f"coated_paraboloid/E1_over_E2={row['E1_over_E2']:g}",
            problem.scene.title,
            problem,
            round_traction(exact.pressure, exact.contact_radius),
            shares="of the numbers nothing; the pressure is of a semi-closed solution that takes "
            "the layers' frequency response from ours",
        )


def cattaneo_mindlin() -> Challenge:
    """Create the challenge of a ball that is pressed and then sheared in 4 load steps (Cattaneo,
    Mindlin).

    The approach, and at each step the tangential shift, the stick radius and the shear are
    requested.
    """
    problem = sheared("Ball pressed and sheared, ν = 0", FORCES)
    values, fields = [of_itself("approach", 1, HERTZ.approach)], []
    for step, end in enumerate(problem.ends[1:], start=2):
        values += _shift_and_stick_radius(step, end, end.sliding_shift)
        shear = round_traction(end.shear, end.contact_radius, end.stick_radius)
        fields.append(_required_shear(step, shear, end.tangential_force))
    return Challenge(
        "cattaneo_mindlin",
        "Cattaneo and Mindlin: pressed, then sheared",
        _problem_text(problem),
        problem.scene,
        problem.source,
        tuple(values),
        tuple(fields),
    )


def loop() -> Challenge:
    """Create the challenge of a ball under constant load and an alternating tangential force.

    Each load step of the fretting loop prescribes a force. The tangential shift, stick radius and
    shear of each step, and the energy per cycle are requested.
    """
    turns = (*QUARTERS, *reversed(QUARTERS[:-1]), 0.0, *(-q for q in QUARTERS))
    turns += (*(-q for q in reversed(QUARTERS[:-1])), 0.0, *QUARTERS)
    problem = sheared("Fretting loop, ν = 0", tuple(AMPLITUDE * part for part in turns))
    state = TangentialHistory(partial_slip(NU_ZERO, 0.0))
    values: list[AskedValue] = []
    fields: list[AskedField] = []
    lost = 0.0
    for step, part in enumerate(turns, start=2):
        state = state.loaded_to(AMPLITUDE * part * FRICTION_LIMIT)
        if step == 1 + len(QUARTERS):
            lost = state.dissipated_energy
        values += _shift_and_stick_radius(step, state, state.virgin.sliding_shift)
        kinks = (one.stick_radius for _, one in state.branches())
        shear = round_traction(state.shear, HERTZ.contact_radius, *kinks)
        fields.append(_required_shear(step, shear, state.tangential_force))
    energy = state.dissipated_energy - lost
    values.append(of_itself("energy_per_cycle", 1 + len(turns), energy, since=1 + len(QUARTERS)))
    return Challenge(
        "fretting_loop",
        "A fretting loop: sheared to and fro under a constant load",
        _problem_text(problem),
        problem.scene,
        "Mindlin and Deresiewicz 1953",
        tuple(values),
        tuple(fields),
    )


def _pressed_challenge(
    name: str,
    title: str,
    problem: Problem,
    pressure: Traction | None,
    more: tuple[AskedValue, ...] = (),
    shares: str = "",
) -> Challenge:
    """Create a challenge with one load step, in which a normal force of 1 kN presses the indenter.

    name      name of the challenge
    problem   verification problem with its exact solution
    pressure  exact pressure; None if no pressure is required
    more      required numbers in place of the contact radius
    shares    parts that the reference has in common with our own solvers
    """
    exact, u = problem.ends[0], problem.uncertainty
    values = [of_itself("approach", 1, exact.approach, uncertainty=u), *more]
    if not more:
        values.append(of_itself("contact_radius", 1, exact.contact_radius, uncertainty=u))
    fields = []
    if pressure is not None:
        peak = float(pressure.values(np.zeros(1))[0])
        values.append(of_itself("central_pressure", 1, peak, required=False, uncertainty=u))
        fields.append(
            AskedField(
                "pressure",
                1,
                "pressure, positive in compression, zero outside the contact",
                pressure,
                "L2",
                NORMAL_FORCE,
                NORMAL_FORCE,
                uncertainty=u,
            )
        )
    return Challenge(
        name,
        title,
        _problem_text(problem),
        problem.scene,
        problem.source,
        tuple(values),
        tuple(fields),
        SMALL if problem.radius < 0.4 * SMALL else LARGE,
        shares,
    )


def _problem_text(problem: Problem) -> str:
    return f"{problem.scene.title}."


def _shift_and_stick_radius(step: int, end: Any, sliding: float) -> Iterator[AskedValue]:
    yield AskedValue("shift_x", step, end.shift, sliding, "the shift at gross sliding")
    yield stick_radius(step, end.stick_radius)


def _required_shear(step: int, shear: Traction, force: float) -> AskedField:
    return AskedField(
        "shear_x",
        step,
        "shear traction along x on the lower body, along +x where the indenter pulls that way",
        shear,
        "L1",
        FRICTION_LIMIT,
        force,
    )
