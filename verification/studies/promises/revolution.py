"""Laws of contacts of revolution, by finite elements and on radii: no direction and no unit is
another than the others."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from typing import Any

import numpy as np

import radial
from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    FiniteElementDiscretisation,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from fem_reference import Method
from fem_reference import solve as solve_on_rings
from verification.studies.promises.promise import Attempt

WITHIN = 1e-9  # of each quantity's own size
MU, YOUNG, NU, LOAD, RADIUS = 0.1, 210e9, 0.3, 1e3, 0.018
FILM = 2e-4  # as thick as half of the contact is wide
# Iterations end within the tolerance on other ways: what is promised is that of a tighter one.
COARSE = FiniteElementDiscretisation(
    elements_per_radius=4, box=10.0, harmonics=2, tolerance=0.1 * WITHIN
)
WAYS = ("on radii", Method.COMPLEMENTARITY, Method.PENALTY)
OF = {
    "approach": (1, 0), "peak_pressure": (0, 1), "contact_area": (2, 0), "stick_area": (2, 0),
    "dissipated_energy": (3, 1), "elastic_energy": (3, 1),
}  # fmt: skip
"""Of the scalars: powers of length and of stress."""


def turned(count: int) -> Iterator[Attempt]:
    """Pushed along x, and along another line, by each way in turn."""
    chance = random.Random(14)
    for number in range(count):
        way, pose = WAYS[number % len(WAYS)], _drawn(chance)
        angle = chance.choice((math.pi, math.pi / 2, chance.uniform(0, 2 * math.pi)))
        there, here = _end(way, pose), _end(way, pose, angle=angle)
        yield _attempt(way, there, here, f"turned by {angle:.2f}", angle=angle)


def scaled(count: int) -> Iterator[Attempt]:
    """Lengths and moduli times powers of ten between 1e-6 and 1e6, by each way in turn."""
    chance = random.Random(15)
    for number in range(count):
        way, pose = WAYS[number % len(WAYS)], _drawn(chance)
        length, stress = (10.0 ** chance.randint(-6, 6) for _ in range(2))
        there, here = _end(way, pose), _end(way, pose, length=length, stress=stress)
        name = f"{length:g}, {stress:g}"
        yield _attempt(way, there, here, name, length=length, stress=stress)


Pose = tuple[float, bool, float]


def _drawn(chance: random.Random) -> Pose:
    """Part of the friction limit, whether the indenter is rigid, and relative modulus of a film."""
    return chance.uniform(0.2, 0.9), chance.random() < 0.5, chance.choice((0.0, 0.5, 2.0))


def _end(
    way: Any, pose: Pose, *, angle: float = 0.0, length: float = 1.0, stress: float = 1.0
) -> Any:
    push, rigid, film = pose
    force = LOAD * stress * length**2

    def material(modulus: float) -> IsotropicMaterial:
        return IsotropicMaterial(young_modulus=YOUNG * stress * modulus, poisson_ratio=NU)

    def pushed(part: float) -> LoadStep:
        size = part * push * MU * force
        along = (size * math.cos(angle), size * math.sin(angle))
        return LoadStep(tangential_force=along, increments=2)

    films = (Layer(thickness=FILM * length, material=material(film)),) if film else ()
    described = Scene(
        indenter=Paraboloid(
            radius=RADIUS * length, material=RIGID if rigid else material(1.0),
            layers=() if rigid else films,
        ),
        body=Body(material=material(1.0), layers=films),
        friction=CoulombFriction(coefficient=MU),
        loading=(LoadStep(normal_force=force, increments=2), pushed(1.0), pushed(-0.5)),
    )  # fmt: skip
    if isinstance(way, Method):
        return solve_on_rings(described, COARSE, way).steps[-1]
    return radial.solve(described).steps[-1]


def _attempt(
    way: Any, there: Any, here: Any, name: str, *, angle: float = 0.0, length: float = 1.0,
    stress: float = 1.0,
) -> Attempt:  # fmt: skip
    """How far apart two answers are that are to be each other's."""
    apart = {
        of: abs(getattr(here, of) / (length ** powers[0] * stress ** powers[1] * value) - 1.0)
        for of, powers in OF.items()
        if (value := getattr(there, of))
    }
    size = math.hypot(*there.tangential_shift)
    along = math.copysign(1.0, there.tangential_shift[0])
    line = (along * math.cos(angle), along * math.sin(angle))
    for axis, part in enumerate(line):
        found = here.tangential_shift[axis] / (length * size)
        apart[f"shift along {'xy'[axis]}"] = abs(found - part)
    pressure = np.max(np.abs(here.pressure / stress - there.pressure))
    apart["pressure"] = float(pressure / np.max(there.pressure))
    worst = max(apart, key=lambda of: apart[of])
    told = f"{way}, {name}: {worst} {apart[worst]:.1e} apart"
    return Attempt(apart[worst] <= WITHIN, told, apart[worst] / WITHIN)
