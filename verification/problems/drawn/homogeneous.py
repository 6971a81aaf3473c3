"""Families of scenes on bodies without coating: closed forms."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import pi, sqrt

from contact_scene import (
    RIGID,
    Body,
    Cone,
    CoulombFriction,
    Ellipsoid,
    FlatPunch,
    LoadStep,
    Paraboloid,
    Scene,
    Sphere,
)
from contact_scene.geometry import Indenter
from contact_scene.pair import contact_modulus
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.ciavarella_jaeger import superpose
from verification.closed_forms.cone import ConeContact
from verification.closed_forms.elliptical_contact import EllipticalContact
from verification.closed_forms.flat_punch import FlatPunchContact
from verification.closed_forms.hertz import PointContact
from verification.closed_forms.ruiz import CycledContact
from verification.closed_forms.sheared_surface import (
    stress_by_hertz_pressure,
    stress_by_hertz_shear,
    trailing_edge_tension,
)
from verification.closed_forms.sphere import SphereContact
from verification.closed_forms.torsion import TorsionalPartialSlip
from verification.problems.drawn import drawing
from verification.problems.drawn.branches import INTERPOLATED, Led, Reached, Twisting
from verification.problems.drawn.drawing import Rng
from verification.problems.drawn.known_scene import (
    AMPLITUDE,
    APPROACH,
    ELASTIC,
    F1,
    F2,
    MISES,
    PEAK,
    RADIUS,
    STICK,
    TENSION,
    WORK,
    KnownScene,
    Truth,
    known,
)
from verification.problems.drawn.pressed_stress import deepest_mises
from verification.problems.indentation import NU_ZERO, REFERENCE_ERROR, STRONG, WEAK
from verification.problems.paper_scene import HERTZ
from verification.problems.reference import ROUNDING, ReferenceKind

HERTZIAN, MASING = "Hertz 1882", "Masing's rule on the curve of first loading"
# Shift over the one at which sliding begins; slip across it turns the shear by less than 1e-3.
FAR = 50.0
TURNED = 1e-3


def hertz(rng: Rng, sections: bool = False) -> KnownScene:
    """Unlike bodies or a rigid ball, without friction."""
    radius, a = drawing.sizes(rng)
    ball = Paraboloid(
        radius=radius, material=drawing.material(rng) if rng.random() < 0.5 else RIGID
    )
    matter = drawing.material(rng)
    body, nu = Body(material=matter), matter.poisson_ratio
    contact = PointContact(radius, _modulus(ball, body), a)
    fine = drawing.fineness(rng, (a, a), sections)
    step, values = drawing.pressing(rng, contact, radius, fine)
    values |= {
        PEAK: contact.peak_pressure,
        RADIUS: a,
        ELASTIC: _stored(contact),
        WORK: _stored(contact),
        TENSION: (1 - 2 * nu) / 3 * contact.peak_pressure,
        MISES: deepest_mises(a, contact.peak_pressure, nu),
    }
    scene = Scene(title="Ball", indenter=ball, body=body, loading=(step,))
    return KnownScene(scene, tuple(known(1, HERTZIAN, values)), fine)


def shapes(rng: Rng) -> KnownScene:
    """A cone, a ball with its arc, or a flat punch, without friction."""
    radius, a = drawing.sizes(rng)
    body = Body(material=drawing.material(rng))
    indenter, values, load, source = _shape(rng, body, radius, a)
    fine = drawing.fineness(rng, (a, a), False)
    scene = Scene(
        title=source, indenter=indenter, body=body, loading=(LoadStep(normal_force=load),)
    )
    return KnownScene(scene, tuple(known(1, source, values)), fine)


def _shape(
    rng: Rng, body: Body, radius: float, a: float
) -> tuple[Indenter, dict[str, float], float, str]:
    modulus = _modulus(Paraboloid(radius=radius, material=RIGID), body)
    match int(rng.integers(3)):
        case 0:
            slope = drawing.logarithmic(rng, 0.005, 0.05)
            cone = ConeContact(slope, modulus, a)
            values = {APPROACH: cone.approach, RADIUS: a}
            return Cone(slope_angle=slope, material=RIGID), values, cone.load, "Sneddon 1965: cone"
        case 1:
            ball = SphereContact(radius, modulus, a)
            values = {APPROACH: ball.approach, RADIUS: a, PEAK: ball.peak_pressure}
            return Sphere(radius=radius, material=RIGID), values, ball.load, "Sneddon 1965: sphere"
    load = modulus * a**3 / radius
    punch = FlatPunchContact(a, modulus, load)
    values = {APPROACH: punch.approach, RADIUS: a}
    return FlatPunch(radius=a, material=RIGID), values, load, "Boussinesq 1885: flat punch"


def ellipse(rng: Rng) -> KnownScene:
    """Alike elliptical bodies with ν = 0, sheared along an axis."""
    radius, a = drawing.sizes(rng)
    radii = (radius, radius * drawing.logarithmic(rng, 0.3, 3.0))
    matter = drawing.material(rng, 0.0)
    modulus = matter.young_modulus / 2
    load = modulus * a**3 / radius

    def under(force: float) -> EllipticalContact:
        return EllipticalContact.under_load(force, radii, modulus)

    contact = under(load)
    mu = drawing.friction(rng)
    values = {
        APPROACH: contact.approach,
        PEAK: contact.peak_pressure,
        RADIUS: _mean_axis(contact),
    }

    def virgin(force: float) -> Reached:
        """µE*/G* times the difference of two pressed contacts; E* = G* for ν = 0."""
        state = superpose(under, load, force, mu, 1.0)
        stick_radius = _mean_axis(under(load - force / mu))
        return Reached.first(force, state.shift, stick_radius, float("nan"))

    forces = [part * mu * load for part in drawing.parts(rng)]
    fine = drawing.fineness(rng, contact.semi_axes, False)
    fine = fine._replace(per_radius=fine.per_radius * min(1.0, contact.axis_ratio))
    indenter = Ellipsoid(radii=radii, material=matter)
    led = Led(
        virgin=virgin, forces=forces, load=load, stored=0.4 * load * contact.approach,
        by_motion=drawing.by_motion(rng), source="Jäger 1998", uncertainty=ROUNDING,
    )  # fmt: skip
    truths = (*known(1, "Hertz 1882", values), *led.truths())
    return KnownScene(led.scene(indenter, Body(material=matter), mu), truths, fine)


def cattaneo(rng: Rng, sections: bool = False, near: bool = False) -> KnownScene:
    """Alike balls with ν = 0 pushed, or to and fro; with `near` once to nearly gross slip."""
    radius, a = drawing.sizes(rng)
    matter, mu = drawing.material(rng, 0.0), drawing.friction(rng)
    modulus = matter.young_modulus / 2
    contact = PointContact(radius, modulus, a)
    limit = mu * contact.load

    def virgin(force: float) -> Reached:
        state = PartialSlip(contact.load, a, mu, modulus, force)
        return Reached.first(force, state.shift, state.stick_radius, state.dissipated_energy)

    shares = (1 - drawing.logarithmic(rng, 1e-4, 1e-2),) if near else drawing.parts(rng)
    forces = [part * limit for part in shares]
    first = virgin(forces[0])
    # Mindlin's shear is the one of sliding less that of the stick disc.
    q0, c = mu * contact.peak_pressure, first.stick_radius
    sheared = stress_by_hertz_shear(-a, a, q0, 0.0) - stress_by_hertz_shear(-a, c, q0 * c / a, 0.0)
    tension = float(stress_by_hertz_pressure(-a, a, contact.peak_pressure, 0.0) + sheared)
    fine = drawing.fineness(rng, (a, a), sections)
    led = Led(
        virgin=virgin, forces=forces, load=contact.load, stored=_stored(contact),
        by_motion=drawing.by_motion(rng), source="Mindlin and Deresiewicz 1953",
        uncertainty=ROUNDING,
    )  # fmt: skip
    scene = led.scene(Paraboloid(radius=radius, material=matter), Body(material=matter), mu)
    truths = (
        *_pressed(contact),
        *led.truths(),
        *_of_cycle(contact, limit, forces, surface_stress=not sections),
        *known(2, "Hamilton and Goodman 1966, less the stick disc's", {TENSION: tension}),
    )
    return KnownScene(scene, truths, fine)


def sliding(rng: Rng) -> KnownScene:
    """Alike balls moved far beyond the begin of sliding."""
    radius, a = drawing.sizes(rng)
    matter, mu = drawing.material(rng), drawing.friction(rng)
    ball, body = Paraboloid(radius=radius, material=matter), Body(material=matter)
    contact = PointContact(radius, _modulus(ball, body), a)
    far = FAR * mu * a**2 / radius
    tension = trailing_edge_tension(contact.peak_pressure, mu, matter.poisson_ratio)
    fine = drawing.fineness(rng, (a, a), False)
    scene = Scene(
        title="Sliding ball",
        indenter=ball,
        body=body,
        friction=CoulombFriction(coefficient=mu),
        loading=(
            LoadStep(normal_force=contact.load),
            LoadStep(tangential_shift=(far, 0.0)),
        ),
    )
    truths = (*_pressed(contact), *known(2, "Hamilton 1966", {TENSION: tension}, TURNED))
    return KnownScene(scene, truths, fine)


def twisted(rng: Rng) -> KnownScene:
    """Bodies of any two materials twisted, once or to and fro: torsion couples with nothing; alike,
    so that pressing leaves no shear."""
    radius, a = drawing.sizes(rng)
    matter, mu = drawing.material(rng), drawing.friction(rng)
    ball, body = Paraboloid(radius=radius, material=matter), Body(material=matter)
    contact = PointContact(radius, _modulus(ball, body), a)

    def state(c: float) -> tuple[float, float]:
        found = TorsionalPartialSlip(
            a, contact.peak_pressure, mu, matter.shear_modulus / 2, stick_radius=c
        )
        return found.moment, found.twist

    virgin = Twisting.of(state, 0.1 * a, a)
    limit = pi**2 / 8 * mu * contact.peak_pressure * a**3
    torques = [part * limit for part in drawing.parts(rng)]
    fine = drawing.fineness(rng, (a, a), False)
    led = Led(
        virgin=virgin, forces=torques, load=contact.load, stored=_stored(contact),
        by_motion=drawing.by_motion(rng), twists=True, source=f"Lubkin 1951; {MASING}",
        uncertainty=INTERPOLATED,
    )  # fmt: skip
    return KnownScene(led.scene(ball, body, mu), (*_pressed(contact), *led.truths()), fine)


def indented(rng: Rng, sections: bool = False) -> KnownScene:
    """A rigid ball pressed with friction: self-similar, so that sizes are free."""
    row = (WEAK, STRONG, NU_ZERO)[int(rng.integers(3))]
    radius, a = drawing.sizes(rng)
    matter = drawing.material(rng, float(row.row["nu"]))
    load = 4 * matter.plane_strain_modulus * a**3 / (3 * radius)
    bare = PointContact.under_load(load, radius, matter.plane_strain_modulus)
    reach = a * row.contact_radius / HERTZ.contact_radius
    values = {
        APPROACH: bare.approach * row.approach / HERTZ.approach,
        RADIUS: reach,
        STICK: reach * row.stick_part,
        PEAK: bare.peak_pressure * float(row.row["p0_over_pH"]),
    }
    fine = drawing.fineness(rng, (a, a), sections, finest=24.0)
    scene = Scene(
        title="Rigid ball pressed with friction",
        indenter=Paraboloid(radius=radius, material=RIGID),
        body=Body(material=matter),
        friction=CoulombFriction(coefficient=row.friction),
        loading=(LoadStep(normal_force=load),),
    )
    truths = tuple(known(1, row.source, values, REFERENCE_ERROR, ReferenceKind.SEMI_CLOSED))
    return KnownScene(scene, truths, fine)


def _stored(contact: PointContact) -> float:
    """Energy of a pressed ball: its load grows as the 3/2 power of the approach."""
    return 0.4 * contact.load * contact.approach


def _of_cycle(
    contact: PointContact, limit: float, forces: Sequence[float], *, surface_stress: bool
) -> Iterator[Truth]:
    """The largest of the fields of a closed cycle; finite elements have no stress there."""
    if not drawing.closes(forces):
        return
    a, mu = contact.contact_radius, limit / contact.load
    end = PartialSlip(contact.load, a, mu, contact.contact_modulus, forces[0])
    cycled = CycledContact(end, contact.peak_pressure)
    values = {
        AMPLITUDE: float(cycled.slip_amplitude(a)),
        F1: cycled.largest_f1,
    }
    if surface_stress and cycled.largest_f2 > 0:
        values[F2] = cycled.largest_f2
    source = "Ruiz, Boddington and Chen 1984 of Mindlin's contact"
    yield from known(len(forces) + 1, source, values)


def _pressed(contact: PointContact) -> Iterator[Truth]:
    values = {
        APPROACH: contact.approach,
        PEAK: contact.peak_pressure,
        RADIUS: contact.contact_radius,
        ELASTIC: _stored(contact),
        WORK: _stored(contact),
    }
    return known(1, HERTZIAN, values)


def _mean_axis(contact: EllipticalContact) -> float:
    return sqrt(contact.semi_axes[0] * contact.semi_axes[1])


def _modulus(indenter: Indenter, body: Body) -> float:
    return contact_modulus(Scene(
        title="", indenter=indenter, body=body, loading=(LoadStep(normal_force=1.0),)
    ))  # fmt: skip
