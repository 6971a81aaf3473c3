"""A rigid ball pressed on a coated body with friction, and pushed until nothing sticks, in units of
Hertz's contact of the same force on the substrate."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from math import exp, log, pi

import numpy as np
from scipy.optimize import brentq

import radial
from contact_errors.on_radii import FRONT
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
from contact_scene.solver_errors import NotConverged, UnsupportedScene
from radial.plan import PATH_INCREMENTS
from radial.rubbing import Rubbing
from radial.sheared import Sheared
from radial.surface import pressure
from slipstick.tables.table import Found

# Of the contact on the bare substrate: a_H = p_H = δ_H = 1, E*_2 = π/2, W = 2π/3.
BALL, MODULUS, FORCE = Paraboloid(radius=1.0, material=RIGID), pi / 2, 2 * pi / 3
KEPT = 16
BESIDE = 0.05  # of the contact radius: so near to a front tractions are as uncertain as its place
OF_RING = 2e-5  # of p_H: what rings leave of a traction where two numbers of them happen to agree
# The coefficient of friction is sought from here on, by such factors, and to such a part of itself.
FIRST, FACTOR, FURTHEST, NEAR = 0.1, 2.0, 1e3, 1e-4
# Increments of a push: pressing, to a part of µW, and from there to another.
PRESSING, PUSHES = 10, ((0.8, 8), (0.99, 10))
SMALL = (0.01, 0.15)  # stick areas over that of the contact which tell where there is none
FEWEST = 4
OF_FIT = 2e-4  # T/µW: what the power of the stick area beyond 3/2 leaves


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
                "radius; where pressure moves the surfaces alike there is none: name other values "
                "of c_over_a, nu or E1_over_E2"
            )
        earlier, last = last, missed(high)
    x = brentq(missed, low, high, xtol=NEAR)
    slope = float(abs((last - earlier) / (high - low)))
    friction = exp(float(x))
    return Found((friction,), NEAR, (friction * FRONT / slope,))


def onset(place: Sequence[float], fineness: int) -> Found:
    """T/µW at which the last stick goes, in the limit of fine increments; half as many rings and
    angles again where all is to be finer."""
    rings = (1 + fineness) / 2
    coarse, fine = (_onset(place, times * fineness, rings) for times in (1, 2))
    return Found((2 * fine - coarse,), 0.0, (OF_FIT,))


def _onset(place: Sequence[float], times: int, rings: float) -> float:
    """With so many times as many increments: the stick area A falls in line with the shift, and the
    force goes with it but for what the stick still carries, T = T₀ - αA - βA^(3/2); so Cattaneo's
    contact, where α = 0."""
    limit = place[-1] * FORCE
    steps = (
        LoadStep(tangential_force=(part * limit, 0.0), increments=count * times)
        for part, count in PUSHES
    )
    asked = scene(place, *steps)
    decided = radial.plan(asked)
    decided = replace(decided, increments=(PRESSING * times, *decided.increments[1:]))
    ends = radial.solve(asked, plan=decided, fineness=rings).increments
    areas, forces = [], []
    for end in ends:
        if end.step == 1:
            continue
        assert end.stick_radius is not None
        assert end.tangential_force is not None
        share = (end.stick_radius / end.contact_radius) ** 2
        if SMALL[0] < share < SMALL[1]:
            areas.append(share)
            forces.append(end.tangential_force[0] / limit)
    if len(areas) < FEWEST:
        raise NotConverged("where a stick area ends (too few increments)", len(areas), 0.0, 0.0)
    A = np.array(areas)
    basis = np.stack([np.ones_like(A), A, A**1.5], axis=1)
    return float(np.linalg.lstsq(basis, np.array(forces), rcond=None)[0][0])
