"""Families of scenes on coated bodies: pressed without friction, and twisted; semi-closed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.polynomial import Chebyshev
from scipy.optimize import minimize_scalar

import radial
from contact_scene import (
    RIGID,
    Body,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from verification.closed_forms.coated_indentation import LayeredIndentation, paraboloid
from verification.closed_forms.coated_torsion import CoatedTorsion, TorsionalSurface, one_layer
from verification.problems.drawn import drawing
from verification.problems.drawn.branches import INTERPOLATED, Led, Twisting
from verification.problems.drawn.drawing import Rng
from verification.problems.drawn.known_scene import (
    APPROACH,
    ELASTIC,
    MISES,
    PEAK,
    RADIUS,
    TENSION,
    WORK,
    KnownScene,
    Truth,
    known,
)
from verification.problems.drawn.pressed_stress import PressedStress
from verification.problems.layered_scene import FREDHOLM, surface_of
from verification.problems.reference import ReferenceKind

SEMI_CLOSED_ERROR = 1e-9
STRESS_ERROR = 1e-4  # of the search for the largest
MOST_LAYERS = 2
STOPS = 14  # contact radii between which the energy is interpolated


def pressed(rng: Rng, sections: bool = False, stressed: bool = False) -> KnownScene:
    """One or two layers under a ball that is rigid or homogeneous, without friction.

    stressed  whether the largest stresses are known too
    """
    radius, a = drawing.sizes(rng)
    body = drawing.coated_body(rng, a, MOST_LAYERS)
    rigid = rng.random() < 0.7
    ball = Paraboloid(radius=radius, material=RIGID if rigid else drawing.material(rng))
    bodies = (body,) if rigid else (body, Body(material=ball.material))
    contact = paraboloid(surface_of(*bodies), radius, a)
    fine = drawing.fineness(rng, (a, a), sections, finest=40.0)
    step, values = drawing.pressing(rng, contact, radius, fine)
    truths = tuple(pressed_truths(contact, stored_energy(contact), values))
    if stressed:
        tension, mises = PressedStress(body, contact.pressure, a, contact.load).largest()
        values = {TENSION: tension} | ({} if mises is None else {MISES: mises})
        transformed = "Hankel transforms of the semi-closed pressure"
        truths += tuple(known(1, transformed, values, STRESS_ERROR, ReferenceKind.SEMI_CLOSED))
    scene = Scene(title="Ball on a coating", indenter=ball, body=body, loading=(step,))
    return KnownScene(scene, truths, fine)


def films(rng: Rng) -> KnownScene:
    """A rigid ball on a film of 1/100 to 100 times the base modulus, without friction."""
    radius, reach = drawing.sizes(rng)
    base = drawing.material(rng)
    film = Layer(
        thickness=reach * drawing.logarithmic(rng, 0.03, 3.0),
        material=IsotropicMaterial(
            young_modulus=base.young_modulus * drawing.logarithmic(rng, 1e-2, 1e2),
            poisson_ratio=float(rng.uniform(0.0, 0.49)),
        ),
    )
    scene = Scene(
        title="Ball on a film",
        indenter=Paraboloid(radius=radius, material=RIGID),
        body=Body(material=base, layers=(film,)),
        loading=(LoadStep(normal_force=4 * base.plane_strain_modulus * reach**3 / (3 * radius)),),
    )
    (end,) = radial.solve(scene).steps
    values = {name: float(getattr(end, name)) for name in (APPROACH, RADIUS, PEAK, ELASTIC, WORK)}
    fine = drawing.fineness(rng, (end.contact_radius,) * 2, False, finest=40.0)
    truths = known(1, "the radial solver", values, SEMI_CLOSED_ERROR, ReferenceKind.OTHER_SOLVER)
    return KnownScene(scene, tuple(truths), fine)


def twisted(rng: Rng, sections: bool = False) -> KnownScene:
    """Alike coated balls twisted once, or to and fro."""
    radius, a = drawing.sizes(rng)
    body, mu = drawing.coated_body(rng, a), drawing.friction(rng)
    ball = drawing.ball_like(body, radius)
    contact = paraboloid(surface_of(body, body), radius, a)
    (film,) = body.layers
    assert isinstance(body.material, IsotropicMaterial)
    outer, base = film.material.shear_modulus, body.material.shear_modulus
    surface = TorsionalSurface(
        lambda k: 2 * one_layer(k, film.thickness, outer, base), outer / 2, film.thickness
    )

    def limit(r: drawing.Array) -> drawing.Array:
        return np.asarray(mu * contact.pressure(r))

    def state(c: float) -> tuple[float, float]:
        found = CoatedTorsion(surface, a, limit, c)
        return found.torque, found.twist

    sliding = CoatedTorsion(surface, a, limit, 0.5 * a).sliding_torque
    torques = [part * sliding for part in drawing.parts(rng)]
    virgin = Twisting.of(state, 0.15 * a, a)
    fine = drawing.fineness(rng, (a, a), sections, finest=40.0)
    stored = stored_energy(contact)
    led = Led(
        virgin=virgin, forces=torques, load=contact.load, stored=stored,
        by_motion=drawing.by_motion(rng), twists=True, uncertainty=INTERPOLATED,
        source="Fredholm equation for Abel's transform of the shear, to and fro by Masing's rule",
    )  # fmt: skip
    return KnownScene(
        led.scene(ball, body, mu), (*pressed_truths(contact, stored), *led.truths()), fine
    )


def pressed_truths(
    contact: LayeredIndentation, stored: float, others: Mapping[str, float] | None = None
) -> Iterator[Truth]:
    """Of the step that presses.

    stored  energy
    others  instead of the approach
    """
    values = dict(others or {APPROACH: contact.approach})
    values |= {PEAK: _peak(contact), RADIUS: contact.contact_radius}
    yield from known(1, FREDHOLM, values, SEMI_CLOSED_ERROR, ReferenceKind.SEMI_CLOSED)
    energies = {ELASTIC: stored, WORK: stored}
    yield from known(1, FREDHOLM, energies, INTERPOLATED, ReferenceKind.SEMI_CLOSED)


def stored_energy(contact: LayeredIndentation) -> float:
    """Energy of a contact pressed from first touch, ∫ W d(approach) over the contact radius."""
    domain = [0.0, contact.contact_radius]
    stops = Chebyshev.basis(STOPS, domain=domain).roots()
    states = [paraboloid(contact.surface, contact.radius, float(a)) for a in stops]
    load, approach = (
        Chebyshev.fit(stops, [getattr(s, name) for s in states], STOPS - 1, domain=domain)
        for name in ("load", "approach")
    )
    return float((load * approach.deriv()).integ(lbnd=0.0)(contact.contact_radius))


def _peak(contact: LayeredIndentation) -> float:
    """Largest pressure: beside the axis under a stiff film."""
    r = np.linspace(0.0, contact.contact_radius, 101)
    k = int(np.argmax(contact.pressure(r)))
    if k == 0:
        return float(contact.pressure(0.0))
    bounds = (r[k - 1], r[k + 1])
    less = minimize_scalar(lambda x: -float(contact.pressure(x)), bounds=bounds, method="bounded")
    return -float(less.fun)
