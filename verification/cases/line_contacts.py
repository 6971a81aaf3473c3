"""Verification cases of line contacts in plane strain: closed forms per unit length.

A cylinder is pressed, pushed, pushed to and fro, strained and slid; wedges and flat punches have
tips and edges. The bodies are half-spaces, or a thin layer on a rigid base. They are solved on
strips, and on plane-strain elements, which are also compared with strips on coated bodies.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np

from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    Cylinder,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Scene,
    Strip,
    Wedge,
)
from verification.closed_forms.line_contact import (
    CylinderContact,
    FlatStrip,
    PushedCylinder,
    SlidingCylinder,
    WedgeContact,
    rounded_strip_load,
)
from verification.judging.case import Case, Level
from verification.judging.declared_case import (
    APPROACH,
    CONTACT_RADIUS,
    ENERGY,
    ENERGY_PER_CYCLE,
    JUDGED_BY,
    PEAK_PRESSURE,
    PRESSURE_L1,
    SHEAR,
    STICK_RADIUS,
    STRIPS,
    STRIPS_WINDOW,
    TOLERANCE_ELEMENTS,
    Observable,
    Within,
    case,
    compared,
    error_norm,
    finest,
    judged,
    number,
    on_elements,
    on_springs,
    on_strips,
    part_of_side,
    scaled_tolerance,
)
from verification.judging.drawings import Drawn, profile
from verification.judging.field_errors import relative_pressure_error
from verification.problems.problem import (
    CONTACT_MODULUS,
    FRICTION,
    OVER_PEAK,
    OVER_RADIUS,
    RADIUS,
    STEEL,
    Problem,
    ReferenceKind,
)
from verification.quantities import relative_difference

TARGET = f"accuracy target of line contacts at {STRIPS} strips, the default"
DISTANCE = 20e-3  # at which the surface does not move
LOAD = 1e6
HERTZ_LINE = CylinderContact(LOAD, RADIUS, CONTACT_MODULUS, DISTANCE)
PUSH = 0.5 * FRICTION * LOAD
SOURCE = "Hertz; Cattaneo 1938; Johnson 1985, sections 4.2 and 7.2"


def _cylinder(*loading: LoadStep, friction: float | None = FRICTION, **changes: Any) -> Scene:
    """Create the scene of a steel cylinder on a half-space of the same steel.

    friction  coefficient of friction; None without friction
    changes   other tables of the scene
    """
    given: dict[str, Any] = {
        "title": "Cylinder on a half-space",
        "indenter": Cylinder(radius=RADIUS, material=STEEL, reference_length=DISTANCE),
        "body": Body(material=STEEL),
        "friction": None if friction is None else CoulombFriction(coefficient=friction),
        "loading": loading,
    }
    return Scene(**(given | changes))


def _problem(
    scene: Scene, *ends: Any, half_width: float = HERTZ_LINE.contact_radius, **more: Any
) -> Problem:
    """Create the problem of a line contact from its scene and the exact answer of each load step.

    half_width  half width of the contact [length]
    more        further attributes of the problem
    """
    scales = {OVER_PEAK: HERTZ_LINE.peak_pressure, OVER_RADIUS: half_width}
    return Problem(scene, ends, half_width, **({"source": SOURCE, "scales": scales} | more))


PRESS = LoadStep(normal_force=LOAD)
PUSHED = PushedCylinder(HERTZ_LINE, FRICTION, PUSH)
PUSHED_LINE = _problem(_cylinder(PRESS, LoadStep(tangential_force=(PUSH, 0.0))), HERTZ_LINE, PUSHED)
LOOP = _problem(
    _cylinder(PRESS, *(LoadStep(tangential_force=(sign * PUSH, 0.0)) for sign in (1, -1, 1))),
    *(HERTZ_LINE, PUSHED, PUSHED, PUSHED),
)
SHIFT_X = number("shift", "tangential shift", quantity="tangential_shift_x")
PRESSED_PEAK, PRESSED_APPROACH = (replace(what, step=0) for what in (PEAK_PRESSURE, APPROACH))
PER_LENGTH = "J/m"


def line_push(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a cylinder that is pressed and pushed.

    level  amount of computation: quick, standard or full
    """
    strips = on_strips(PUSHED_LINE)
    rows = (
        Within(PRESSED_PEAK, 1e-5, TARGET),
        Within(PRESSED_APPROACH, 1e-5, f"as the peak pressure, {TARGET}"),
        Within(replace(PRESSURE_L1, step=0), 2e-4, f"as the half width, {TARGET}"),
        Within(CONTACT_RADIUS, 2e-4, TARGET),
        Within(STICK_RADIUS, 2e-4, TARGET),
        Within(SHIFT_X, 1e-5, f"as the peak pressure, {TARGET}"),
        Within(SHEAR, 2e-4, f"as the half width, {TARGET}"),
        Within(
            replace(ENERGY, unit=PER_LENGTH, source=SOURCE),
            5e-4,
            "slip at the edge, over the width of a strip: twice the error of the half width",
        ),
    )
    return case(
        "line_push",
        "Line contact: a cylinder pressed and pushed",
        "A parabolic cylinder of 18 mm radius under 1 kN/mm, then under a tangential force of "
        "0.5 µW across its axis. Approach and shift are counted from the surface 20 mm from the "
        "contact.",
        judged(strips, rows),
        charts=(
            profile(
                strips,
                "line_push_profile",
                "Pressure and shear over µ",
                "Computed and exact pressure after pressing, shear over µ after the push, and "
                "their differences, in units of the peak pressure.",
                "p / p₀ and q / µp₀",
                HERTZ_LINE.peak_pressure,
                Drawn(lambda end: end.pressure, lambda exact: exact.pressure, "p", 0),
                Drawn(
                    lambda end: end.shear[0] / FRICTION,
                    lambda exact: lambda x: exact.shear(x) / FRICTION,
                    "q/µ",
                    1,
                ),
            ),
        ),
        equations=(
            r"a^2 = \frac{4WR}{\pi E^*},\quad p_0 = \frac{2W}{\pi a},\quad "
            r"\omega_z = \frac{W}{\pi E^*}\left(1 + 2\ln\frac{2L}{a}\right)",
            r"q = \mu\,[p(x; W) - p(x; W - T/\mu)],\quad c = a\sqrt{1 - T/\mu W}",
        ),
        no_order="the errors depend on the places of the edges within strips",
        shows=("line contacts",),
    )


def _stick_centre(result: Any, step: int, _: Problem) -> float:
    """Return the mean of x over the strips that stick at the end of a load step [length]."""
    end = result.steps[step]
    return float(np.mean(result.grid.x[end.in_stick[:, 0]]))


STICK_CENTRE = Observable(
    "stick_centre",
    "mean of x over the strips that stick",
    "m",
    _stick_centre,
    lambda end: float(end.stick_centre),
    OVER_RADIUS,
)
HALF_A_STRIP = "half a strip: the zone is made of whole strips"
STRAINS = (0.1, 0.2)  # distance of the stick zone from the middle, in half widths


def _strained(part: float) -> Problem:
    """Create the problem of a push with a bulk stress in phase (Nowell and Hills 1987).

    part  distance of the stick zone from the middle of the contact, in half widths
    """
    a = HERTZ_LINE.contact_radius
    strain = part * a * FRICTION / RADIUS
    stress = strain * STEEL.plane_strain_modulus
    push = LoadStep(tangential_force=(PUSH, 0.0), bulk_stress=(stress, 0.0, 0.0))
    exact = PushedCylinder(HERTZ_LINE, FRICTION, PUSH, strain)
    return _problem(
        _cylinder(PRESS, push),
        HERTZ_LINE,
        exact,
        source="Nowell and Hills 1987",
        across=1.0,
    )


def line_loop(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a cylinder under reversed pushes, and with bulk stress.

    level  amount of computation: quick, standard or full
    """
    loop = on_strips(LOOP, of="loop")
    energy = replace(
        ENERGY_PER_CYCLE,
        meaning="energy dissipated from 0.5 µW to -0.5 µW and back",
        unit=PER_LENGTH,
    )
    strained = [on_strips(_strained(part), of=f"e = {part:g} a") for part in STRAINS]
    rows = (
        Within(STICK_CENTRE, 0.5 * STRIPS_WINDOW / STRIPS, HALF_A_STRIP),
        Within(STICK_RADIUS, 5e-4, f"half a strip at either end, {TARGET}"),
        Within(SHEAR, 5e-4, f"half a strip at either end, {TARGET}"),
    )
    return case(
        "line_loop",
        "Line contact: loop, and push with bulk stress in phase",
        "The cylinder of line_push under a tangential force that is reversed twice, and under a "
        "tangential force that grows with a bulk stress of the lower body, which moves the stick "
        "zone towards one edge.",
        judged(loop, (Within(energy, 1e-4, "as the energy of line_push at the end of a loop"),)),
        *(
            judged(
                of,
                [replace(row, name=f"{row.what.name}_at_{part:g}") for row in rows],
            )
            for part, of in zip(STRAINS, strained, strict=True)
        ),
        equations=(
            r"\int T\,d\delta = 4 E",
            r"q = \mu\,[p(x; a) - \tfrac{c}{a} p(x - e; c)],\quad c = a\sqrt{1 - T/\mu W},\quad "
            r"e = \varepsilon_{xx} R/\mu",
        ),
        no_order=JUDGED_BY.format("line_push"),
        shows=("line contacts",),
    )


SLOPE = 0.01
WEDGE = WedgeContact(1e5, SLOPE, CONTACT_MODULUS)
FLAT = 1e-3
EDGE_RADIUS = 50e-3
ROUNDED = 1.5 * FLAT
TILTED_STRIP = FlatStrip(LOAD, FLAT, CONTACT_MODULUS, 0.2 * LOAD * FLAT)


def _shaped(shape: type, load: float, **sizes: float) -> Scene:
    indenter = shape(material=STEEL, reference_length=0.1, **sizes)
    return _cylinder(LoadStep(normal_force=load), friction=None, indenter=indenter)


MIDDLE = error_norm(
    "middle_pressure",
    "largest relative error of the pressure in the middle half",
    relative_pressure_error(0.0, 0.5),
)
TILT = number("tilt", "tilt", quantity="tilt_y")


def line_shapes(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a wedge, a rounded and a sharp punch of infinite length.

    level  amount of computation: quick, standard or full
    """
    wedge = _problem(
        _shaped(Wedge, WEDGE.load, slope_angle=SLOPE),
        WEDGE,
        half_width=WEDGE.contact_radius,
        source="Johnson 1985, section 5.2",
    )
    rounded = _problem(
        _shaped(
            Strip,
            rounded_strip_load(ROUNDED, FLAT, EDGE_RADIUS, CONTACT_MODULUS),
            half_width=FLAT,
            edge_radius=EDGE_RADIUS,
        ),
        SimpleNamespace(contact_radius=ROUNDED),
        half_width=ROUNDED,
        source="Ciavarella, Hills and Monno 1998",
    )
    press = LoadStep(normal_force=LOAD, moment=(0.0, TILTED_STRIP.moment))
    sharp = _problem(
        _shaped(Strip, LOAD, half_width=FLAT).model_copy(update={"loading": (press,)}),
        TILTED_STRIP,
        half_width=FLAT,
        across=1.0,
        source="Sadowsky 1928; Johnson 1985, section 2.8",
    )
    of_flat = (
        Within(MIDDLE, 1e-5, f"second order with the edge at its best place, {TARGET}"),
        Within(TILT, 2e-5, "twice the error of the pressure, whose moment it is"),
    )
    return case(
        "line_shapes",
        "Line contact: wedge and flat punches",
        "A wedge of 0.01 rad, a flat punch with rounded edges, and a flat punch with sharp edges "
        "under a moment of 0.2 Wb, with the half width b. The sharp edges lie 0.175 strips inside "
        "the outermost borders of strips.",
        judged(
            on_strips(wedge, of="wedge"),
            (
                Within(CONTACT_RADIUS, 2e-4, TARGET, name="half_width_of_wedge"),
                Within(PRESSURE_L1, 1e-3, "a strip over the half width: infinite at the tip"),
            ),
        ),
        judged(
            on_strips(rounded, of="rounded"),
            (Within(CONTACT_RADIUS, 2e-4, TARGET, name="half_width_of_rounded"),),
        ),
        judged(on_strips(sharp, of="sharp"), of_flat),
        equations=(
            r"W = E^* a \tan\alpha,\quad p = \tfrac{1}{\pi} E^* \tan\alpha\,\mathrm{arcosh}(a/|x|)",
            r"W = \frac{E^*}{R} \int_b^a \frac{t\,(t - b)}{\sqrt{a^2 - t^2}}\,dt",
            r"p = \frac{W}{\pi\sqrt{b^2 - x^2}} \left(1 + \frac{2 M x}{W b^2}\right)",
        ),
        no_order=JUDGED_BY.format("line_push"),
        shows=("line contacts", "shapes"),
    )


SLIDING = SlidingCylinder(LOAD, RADIUS, STEEL.plane_strain_modulus, 0.3, 0.5 * 0.4 / 0.7)
THIN = IsotropicMaterial(young_modulus=1e9, poisson_ratio=0.3)
UNIAXIAL = 1e9 * 0.7 / (1.3 * 0.4)
HALF = 1e-3
THICKNESS = 1e-3 / 80
THIN_PEAK = UNIAXIAL * HALF**2 / (2 * RADIUS * THICKNESS)
OF_THIN = "the limit of thin layers, to second order in h/a"
RIGID_CYLINDER = Cylinder(radius=RADIUS, material=RIGID, reference_length=DISTANCE)
THIN_LAYER = _problem(
    _cylinder(
        LoadStep(normal_force=4 / 3 * THIN_PEAK * HALF),
        friction=None,
        indenter=RIGID_CYLINDER,
        body=Body(material=RIGID, layers=(Layer(thickness=THICKNESS, material=THIN),)),
    ),
    SimpleNamespace(peak_pressure=THIN_PEAK),
    uncertainty=(THICKNESS / HALF) ** 2,
    half_width=HALF,
    source="Johnson 1985, section 5.8",
)


# Along the line the surface is softer than across it by 1/(1 - ν).
ALONG = PUSHED.shift / (1 - STEEL.poisson_ratio)
SHIFT_Y = number(
    "shift_along", "shift along the line", quantity="tangential_shift_y", exact="shift"
)


def _middle(result: Any, step: int, _: Problem) -> float:
    """Return the distance of the middle of the contact from x = 0 [length]."""
    end = result.steps[step]
    return abs(float(np.mean(result.grid.x[end.pressure[:, 0] > 0])))


MIDDLE_OF_CONTACT = Observable(
    "middle",
    "distance of the middle of the contact from the apex",
    "m",
    _middle,
    lambda end: float(end.distance_of_middle),
    OVER_RADIUS,
)


def line_unlike(level: Level = Level.QUICK) -> Case:
    """Create the verification case of unlike bodies, a thin layer, and a push along the line.

    level  amount of computation: quick, standard or full
    """
    sliding = _problem(
        _cylinder(
            LoadStep(normal_force=LOAD, tangential_shift=(0.0, 0.0)),
            LoadStep(tangential_shift=(1e-3, 0.0)),
            friction=SLIDING.friction,
            indenter=RIGID_CYLINDER,
        ),
        HERTZ_LINE,
        SLIDING,
        half_width=SLIDING.contact_radius,
        source="Johnson 1985, section 8.2",
    )
    along = _problem(
        _cylinder(PRESS, LoadStep(tangential_force=(0.0, PUSH))),
        HERTZ_LINE,
        SimpleNamespace(shift=ALONG, stick_radius=PUSHED.stick_radius),
    )
    strip = STRIPS_WINDOW / STRIPS
    return case(
        "line_unlike",
        "Line contact: sliding of unlike bodies, thin layer, push along the line",
        "A rigid cylinder slides on a half-space with µ = 0.3; it is pressed on a layer of 1/80 "
        "of the half width on a rigid base; and the cylinder of line_push is pushed along its "
        "axis, which shears the bodies without any change of volume.",
        judged(
            on_strips(sliding, of="sliding"),
            (
                Within(CONTACT_RADIUS, 3e-4, "the exponents at the edges are not exactly 1/2"),
                Within(MIDDLE_OF_CONTACT, strip, "a strip: both edges are borders of strips"),
            ),
        ),
        judged(
            on_strips(THIN_LAYER, of="thin layer"),
            (Within(PEAK_PRESSURE, 2 / 80**2, OF_THIN),),
        ),
        judged(
            on_strips(along, of="along"),
            (
                Within(SHIFT_Y, 1e-5, "as the shift of line_push"),
                Within(STICK_RADIUS, 2e-4, TARGET),
            ),
        ),
        equations=(
            r"a^2 = \frac{4 W R}{\pi E^* (1 - 4\gamma^2)},\quad \tan\pi\gamma = \mu\beta,\quad "
            r"p \propto (a + x)^{1/2 \pm \gamma} (a - x)^{1/2 \mp \gamma}",
            r"p = \frac{E (1 - \nu)}{(1 + \nu)(1 - 2\nu)}\,\frac{a^2 - x^2}{2 R h}",
            r"\delta_y = \delta_x/(1 - \nu)",
        ),
        no_order=JUDGED_BY.format("line_push"),
        shows=("line contacts", "unlike bodies"),
    )


ON_ELEMENTS = f"accuracy target of line contacts on elements, at {TOLERANCE_ELEMENTS}"
A_TENTH = "a tenth of an element: the edge is extrapolated from the last values"
COATING = Layer(
    thickness=0.5 * HERTZ_LINE.contact_radius,
    material=IsotropicMaterial(young_modulus=2 * STEEL.young_modulus, poisson_ratio=0.25),
)


def _coated(*loading: LoadStep, friction: float | None = FRICTION) -> Problem:
    """Create the problem of a cylinder on a half-space, of which one or both are coated.

    With friction both bodies are coated alike, so that pressure and shear are not coupled.
    """
    body = Body(material=STEEL, layers=(COATING,))
    cylinder = Cylinder(radius=RADIUS, material=STEEL, reference_length=DISTANCE)
    if friction is not None:
        cylinder = cylinder.model_copy(update={"layers": body.layers})
    scene = _cylinder(*loading, friction=friction, indenter=cylinder, body=body)
    return _problem(scene, *[HERTZ_LINE] * len(loading))


COATED_LINES = {
    "coated": _coated(PRESS, friction=None),
    "both coated": _coated(PRESS, LoadStep(tangential_force=(PUSH, 0.0))),
}


def line_on_elements(level: Level = Level.QUICK) -> Case:
    """Create the verification case of line contacts on plane-strain elements.

    level  amount of computation: quick, standard or full
    """
    elements = finest(level)
    pushed = on_elements(PUSHED_LINE, (elements,), of="pushed")
    of_peak, of_mean, of_edge = (
        scaled_tolerance(1e-4, 2.0),
        scaled_tolerance(2e-5, 2.0),
        part_of_side(0.1),
    )
    rows = (
        Within(PRESSED_PEAK, of_peak, f"second order, {ON_ELEMENTS}"),
        Within(PRESSED_APPROACH, of_mean, "a fifth of the peak pressure: a mean over the contact"),
        Within(
            replace(PRESSURE_L1, step=0),
            scaled_tolerance(1e-3, 1.5),
            "order 3/2: an error of O(√h) at the edge, on elements of the width h",
        ),
        Within(CONTACT_RADIUS, of_edge, A_TENTH),
        Within(STICK_RADIUS, of_edge, A_TENTH),
        Within(SHIFT_X, of_peak, "as the peak pressure"),
        Within(SHEAR, scaled_tolerance(2e-3, 1.5), "as the pressure, over µ, with two edges"),
        Within(
            replace(ENERGY, unit=PER_LENGTH, source=SOURCE),
            part_of_side(0.3),
            "three times the error of the stick half width: third power of the slip zone's width",
        ),
    )
    strips = {"peak_pressure": 1e-5, "approach": 1e-5, "contact_radius": 2e-4}
    strips_pushed = {"tangential_shift": 1e-5, "stick_radius": 2e-4}
    own = {
        **{"peak_pressure": of_peak, "approach": of_mean, "contact_radius": of_edge},
        **{"tangential_shift": of_peak, "stick_radius": of_edge},
    }
    coated = []
    for pair, of in COATED_LINES.items():
        one, other = on_elements(of, (elements,), of=pair).judged, on_strips(of, of=pair)
        for step, allowed in enumerate((strips, strips_pushed)[: len(of.ends)]):
            coated += [
                compared(
                    f"{name}_of_{pair.replace(' ', '_')}",
                    f"difference of elements from strips: {name.replace('_', ' ')}, relative",
                    one,
                    other.judged,
                    partial(relative_difference, name, step),
                    own[name](one, of.radius) + more,
                    "sum of the tolerances of both solvers for half-spaces",
                    "strips, which share only the scene",
                    ReferenceKind.OTHER_SOLVER,
                )
                for name, more in allowed.items()
            ]
    return case(
        "line_on_elements",
        "Line contact: plane-strain elements",
        "The cylinder of line_push and the thin layer of line_unlike on finite elements in plane "
        "strain, with the exact law and with a penalty. A steel cylinder on a steel half-space "
        "with a coating twice as stiff and half as thick as the half width, and with this coating "
        "on both bodies and a push, are compared with strips.",
        judged(pushed, rows),
        judged(on_springs(pushed, f"pushed, {elements} elements per radius, penalty"), rows),
        judged(
            on_elements(THIN_LAYER, (elements,), of="thin layer"),
            (Within(PEAK_PRESSURE, 2 / 80**2, OF_THIN),),
        ),
        *coated,
        equations=(
            r"u_z = \frac{1}{2\pi G} \left(\frac{z^2}{r^2} - 2 (1 - \nu) \ln\frac{r}{L}\right)"
            r"\ \text{at the end of the section}",
        ),
        no_order="the errors depend on the places of the edges within elements",
        shows=("line contacts", "finite elements"),
    )
