"""Common functions of the adapters of this program's solvers to the challenges."""

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
    """Convert the scene of a challenge to a `Scene`; raise CannotDo for prescribed tractions."""
    if "indenter" not in posed.scene:
        raise CannotDo("contacts only, no given tractions")
    return Scene.model_validate(posed.scene)


def given_up(posed: Posed, fineness: int, error: Exception) -> Answer:
    """Return the answer to a challenge on a level whose load history did not converge, without
    results.

    posed     challenge: a problem with a known solution
    fineness  cells or elements over a contact radius, which is about a third of the window
    """
    return Answer(posed.window / 3 / fineness, gave_up={0: str(error)})


def in_increments(scene: Scene, number: int) -> Scene:
    """Set the number of increments of all load steps that prescribe none, in a scene with friction.

    Adapters increase the number with the refinement level, so that the increment error falls as
    well.
    """
    if scene.friction is None:
        return scene
    steps = (s.model_copy(update={"increments": s.increments or number}) for s in scene.loading)
    return scene.model_copy(update={"loading": tuple(steps)})


def number(posed: Posed, key: Key, steps: Sequence[State]) -> float | None:
    """Return a scalar result at the end of a load step; None if the solver does not provide it.

    key    name of the quantity and number of the load step, from 1
    steps  states at the ends of all load steps
    """
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
    """Build the answer to a challenge from results on rings (finite elements or radial solver).

    Quantities that the solver does not provide are left out. Raises CannotDo if none is left.

    steps  states at the ends of all load steps
    h      size of an element or ring [length]
    """
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
        raise CannotDo("the ring results contain no stress below the surface")
    return Answer(h, scalars, fields, points=points)


def _traction(steps: Any, key: Key) -> Vector | None:
    """Return a traction on the rings as a function of the radius at the end of a load step.

    The result is None if the traction is absent or depends on the angle.

    key  name of the traction and number of the load step, from 1
    """
    end = steps[key[1] - 1]
    found = getattr(end, TRACTIONS.get(key[0], ""), None)
    return None if found is None or np.ndim(found) != 1 else found


def between(end: Any, traction: Vector) -> Field:
    """Interpolate a traction from rings to Gauss points between the rings in the contact.

    Returns the points with the traction and the area of each.

    end       state at the end of a load step
    traction  values at the rings [stress]
    """
    inside = end.radii <= 1.05 * end.contact_radius
    r0 = end.radii[:-1][inside[:-1]]
    r1 = end.radii[1:][inside[:-1]]
    nodes, weights = np.polynomial.legendre.leggauss(PER_INTERVAL)
    r = (0.5 * (r0 + r1)[:, None] + 0.5 * (r1 - r0)[:, None] * nodes).ravel()
    area = 2 * pi * r * (0.5 * (r1 - r0)[:, None] * weights).ravel()
    return Field(r, np.zeros_like(r), np.interp(r, end.radii, traction), area)
