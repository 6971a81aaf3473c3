"""Families of scenes on coated bodies: pressed without friction, and twisted; semi-closed."""

from __future__ import annotations

import numpy as np
from scipy.optimize import minimize_scalar

from contact_scene import RIGID, Body, IsotropicMaterial, Paraboloid, Scene
from verification.closed_forms.coated_indentation import LayeredIndentation, paraboloid
from verification.closed_forms.coated_torsion import CoatedTorsion, TorsionalSurface, one_layer
from verification.problems.drawn import drawing
from verification.problems.drawn.branches import INTERPOLATED, Twisting, ends, led
from verification.problems.drawn.drawing import Rng
from verification.problems.drawn.known_scene import (
    APPROACH,
    MISES,
    PEAK,
    RADIUS,
    TENSION,
    TWIST,
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
    step, sunk = drawing.pressing(rng, contact.load, radius, fine)
    truths = pressed_truths(contact, sunk)
    if stressed:
        tension, mises = PressedStress(body, contact.pressure, a, contact.load).largest()
        values = {TENSION: tension} | ({} if mises is None else {MISES: mises})
        transformed = "Hankel transforms of the semi-closed pressure"
        truths += tuple(known(1, transformed, values, STRESS_ERROR, ReferenceKind.SEMI_CLOSED))
    scene = Scene(title="Ball on a coating", indenter=ball, body=body, loading=(step,))
    return KnownScene(scene, truths, fine)


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
    scene = led(ball, body, mu, contact.load, "torque", torques)
    source = "Fredholm equation for Abel's transform of the shear, to and fro by Masing's rule"
    truths = (*pressed_truths(contact), *ends(virgin, torques, TWIST, source, INTERPOLATED))
    return KnownScene(scene, truths, fine)


def pressed_truths(contact: LayeredIndentation, sunk: float = 0.0) -> tuple[Truth, ...]:
    """Of the step that presses; sunk is what a tilt takes from the approach [length]."""
    values = {
        APPROACH: contact.approach - sunk,
        PEAK: _peak(contact),
        RADIUS: contact.contact_radius,
    }
    return tuple(known(1, FREDHOLM, values, SEMI_CLOSED_ERROR, ReferenceKind.SEMI_CLOSED))


def _peak(contact: LayeredIndentation) -> float:
    """Largest pressure: beside the axis under a stiff film."""
    r = np.linspace(0.0, contact.contact_radius, 101)
    k = int(np.argmax(contact.pressure(r)))
    if k == 0:
        return float(contact.pressure(0.0))
    bounds = (r[k - 1], r[k + 1])
    less = minimize_scalar(lambda x: -float(contact.pressure(x)), bounds=bounds, method="bounded")
    return -float(less.fun)
