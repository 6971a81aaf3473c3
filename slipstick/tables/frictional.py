"""A rigid ball pressed on a coated body with friction, in units of Hertz's contact of the same
force on the bare substrate."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from math import exp, log, pi

import numpy as np
from scipy.optimize import brentq

import radial
from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    RadialDiscretisation,
    Scene,
)
from contact_scene.march import marked_increments
from contact_scene.solver_errors import UnsupportedScene
from radial.plan import PATH_INCREMENTS
from radial.rubbing import Rubbing
from radial.sheared import Sheared
from radial.surface import pressure
from slipstick.tables.table import Found

# Of the contact on the bare substrate: a_H = p_H = δ_H = 1, E*_2 = π/2, W = 2π/3.
BALL, MODULUS, FORCE = Paraboloid(radius=1.0, material=RIGID), pi / 2, 2 * pi / 3
KEPT = 16
# Error of a stick radius of the radial solver, in contact radii.
FRONT = 1e-3
BESIDE = 0.05  # of the contact radius: so near to a front tractions are as uncertain as its place
OF_RING = 2e-5  # of p_H: what rings leave of a traction where two numbers of them happen to agree
# The coefficient of friction is sought from here on, by such factors, and to such a part of itself.
FIRST, FACTOR, FURTHEST, NEAR = 0.1, 2.0, 1e3, 1e-4


def scene(place: Sequence[float], *steps: LoadStep) -> Scene:
    """Of E1/E2, h/a_H, ν and µ, pressed and then led through steps."""
    moduli, thickness, ratio, friction = place
    young = MODULUS * (1 - ratio**2)
    film, base = (
        IsotropicMaterial(young_modulus=modulus, poisson_ratio=ratio)
        for modulus in (moduli * young, young)
    )
    return Scene(
        indenter=BALL,
        body=Body(material=base, layers=(Layer(thickness=thickness, material=film),)),
        friction=CoulombFriction(coefficient=friction),
        loading=(LoadStep(normal_force=FORCE), *steps),
    )


@lru_cache(maxsize=KEPT)
def pressed(place: tuple[float, ...], increments: int, fineness: int) -> Sheared:
    """The contact at the end of so many increments, and so many times as many rings."""
    asked = scene(place)
    solver = Rubbing.of(asked, RadialDiscretisation(), fineness)
    *_, (_, mark) = marked_increments(asked, (increments,), solver, None)
    return mark.state


def scalars(place: Sequence[float], fineness: int) -> Found:
    """Contact radius, approach, and the stick radius over the contact radius."""
    found = pressed(tuple(place), PATH_INCREMENTS * fineness, fineness)
    end = found.end
    values = (end.radius, end.approach, found.front / end.radius)
    return Found(values, abs(end.load / FORCE - 1), (0.0, 0.0, FRONT))


def tractions(place: Sequence[float], fineness: int) -> Found:
    """Pressure, and shear over the coefficient of friction, at a share of the contact radius."""
    *contact, x = place
    found = pressed(tuple(contact), PATH_INCREMENTS * fineness, fineness)
    end, friction = found.end, contact[-1]

    def both(at: float) -> tuple[float, float]:
        places = np.array([at])
        p = pressure(end.contact, places) + end.rings.at(end.changed, places)
        return float(p[0]), float(end.rings.at(end.shear, places)[0]) / friction

    here = both(x)
    left = [OF_RING, OF_RING]
    if abs(x - found.front / end.radius) < BESIDE:
        for off in (-FRONT, FRONT):
            moved = both(min(max(x + off, 0.0), 1.0))
            left = [max(old, abs(a - b)) for old, a, b in zip(left, moved, here, strict=True)]
    return Found(here, abs(end.load / FORCE - 1), tuple(left))


def gripping(place: Sequence[float], fineness: int) -> Found:
    """The coefficient of friction with which the stick reaches to a share of the contact radius;
    raises UnsupportedScene where none does."""
    *contact, share = place
    if not radial.plan(scene((*contact, FIRST))).coupled:
        raise UnsupportedScene(
            f"no coefficient of friction lets the stick reach to {share:g} of the contact radius: "
            "pressure moves the surfaces alike, and all sticks under any; name other values of nu "
            "or E1_over_E2"
        )

    def missed(x: float) -> float:
        found = pressed((*contact, exp(x)), PATH_INCREMENTS // 2 * fineness, fineness)
        return found.front / found.end.radius - share

    low = high = log(FIRST)
    first = last = missed(low)
    while last * first > 0:
        low, high = high, high - np.copysign(log(FACTOR), first)
        if abs(high - log(FIRST)) > log(FURTHEST):
            raise UnsupportedScene(
                f"no coefficient of friction between {exp(min(log(FIRST), low)):.3g} and "
                f"{exp(max(log(FIRST), low)):.3g} lets the stick reach to {share:g} of the contact "
                "radius: name other values of c_over_a, nu or E1_over_E2"
            )
        earlier, last = last, missed(high)
    x = brentq(missed, low, high, xtol=NEAR)
    slope = float(abs((last - earlier) / (high - low)))
    friction = exp(float(x))
    return Found((friction,), NEAR, (friction * FRONT / slope,))
