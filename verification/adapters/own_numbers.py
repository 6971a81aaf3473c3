"""What our solvers have in common: scenes of challenges, and numbers of increments."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi
from typing import Any

import numpy as np

from contact_scene import Scene
from contact_scene.quantities.increment import State
from verification.challenge.answer import Answer, Field, Key, Vector
from verification.challenge.python_api import (
    CannotDo,
    Posed,
)
from verification.observed.ring_errors import at_radii


def scene_of(posed: Posed) -> Scene:
    """As our solvers read it; raises CannotDo where the tractions are given."""
    if "indenter" not in posed.scene:
        raise CannotDo("contacts only, no given tractions")
    return Scene.model_validate(posed.scene)


def given_up(posed: Posed, fineness: int, error: Exception) -> Answer:
    """Of a level whose history did not get to its end: nothing of it is trusted.

    fineness  cells or elements over a contact radius, which is about a third of the window
    """
    return Answer(posed.window / 3 / fineness, gave_up={0: str(error)})


def in_increments(scene: Scene, number: int) -> Scene:
    """With friction the way matters: steps that name no increments take this many, so that finer
    levels do not stall at the error of the path."""
    if scene.friction is None:
        return scene
    steps = (s.model_copy(update={"increments": s.increments or number}) for s in scene.loading)
    return scene.model_copy(update={"loading": tuple(steps)})


def number(posed: Posed, key: Key, steps: Sequence[State]) -> float | None:
    """By the name that a result has for it; None where it has none."""
    quantity, step = key
    end = steps[step - 1]
    if quantity in ("shift_x", "shift_y"):
        shift = end.tangential_shift
        return None if shift is None else float(shift["xy".index(quantity[-1])])
    if quantity in ("moment_x", "moment_y"):
        return None if end.moment is None else float(end.moment["xy".index(quantity[-1])])
    if quantity == "energy_per_cycle":
        lost = end.dissipated_energy
        before = steps[posed.since[key] - 1].dissipated_energy
        return None if lost is None or before is None else lost - before
    found = getattr(end, quantity, None)
    return None if found is None else float(found)


PER_INTERVAL = 4  # points of Gauss between two rings
TRACTIONS = {
    "pressure": "pressure", "shear_x": "shear_along_load", "shear_radial": "shear_radial",
    "shear_around": "shear_circumferential",
}  # fmt: skip


def answer_on_rings(posed: Posed, steps: Any, h: float) -> Answer:
    """From the increments at the end of every loading step; what they do not have is left out."""
    scalars: dict[Key, float] = {}
    for key in posed.asked:
        value = number(posed, key, steps)
        if key[0] == "central_pressure" and np.ndim(steps[0].pressure) == 1:
            value = float(at_radii(steps[0], steps[0].pressure, np.zeros(1))[0])
        if value is not None:
            scalars[key] = value
    fields, points = {}, {}
    for key in posed.fields:
        traction = _traction(steps, key)
        if traction is not None:
            fields[key] = between(steps[key[1] - 1], traction)
    for key, places in posed.places.items():
        traction = _traction(steps, key)
        if traction is not None:
            points[key] = at_radii(
                steps[key[1] - 1], traction, np.hypot(places[:, 0], places[:, 1])
            )
    if not scalars and not fields and not points:
        raise CannotDo("stress below the surface, of which rings have none here")
    return Answer(h, scalars, fields, points=points)


def _traction(steps: Any, key: Key) -> Vector | None:
    """One function of the radius; None where there is none, or it depends on the angle too."""
    end = steps[key[1] - 1]
    found = getattr(end, TRACTIONS.get(key[0], ""), None)
    return None if found is None or np.ndim(found) != 1 else found


def between(end: Any, traction: Vector) -> Field:
    """At points of Gauss between the rings, each standing for its part of the ring."""
    inside = end.radii <= 1.05 * end.contact_radius
    r0 = end.radii[:-1][inside[:-1]]
    r1 = end.radii[1:][inside[:-1]]
    nodes, weights = np.polynomial.legendre.leggauss(PER_INTERVAL)
    r = (0.5 * (r0 + r1)[:, None] + 0.5 * (r1 - r0)[:, None] * nodes).ravel()
    area = 2 * pi * r * (0.5 * (r1 - r0)[:, None] * weights).ravel()
    return Field(r, np.zeros_like(r), np.interp(r, end.radii, traction), area)
