"""CalculiX as anybody's code: a rigid ball on a half-space or a coating, with friction or without,
through the decks of `external_codes`, which are in units of Hertz's contact."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from dataclasses import replace
from math import pi
from resource import RUSAGE_CHILDREN, getrusage
from subprocess import SubprocessError
from typing import Any

import numpy as np

from verification.adapters.own_numbers import given_up, pressed_alone, scene_of
from verification.challenge.answer import Answer, Field, Key, Solver, Vector
from verification.challenge.door import CannotDo, Posed
from verification.closed_forms.hertz import PointContact
from verification.external_codes.calculix_deck import Fineness
from verification.external_codes.coated_scene import POISSON_RATIO, CoatedScene
from verification.external_codes.nodal_pressure import at_axis, on_nodes, up_to_edge
from verification.external_codes.under_force import COARSEST, under_force

CALCULIX = Solver("CalculiX")
PRESSED, RUBBED = 4, 20  # increments without and with friction


def answer(posed: Posed, level: int) -> Answer:
    """On COARSEST elements over the contact radius, twice as many, …; CannotDo without `ccx`."""
    if shutil.which("ccx") is None:
        raise CannotDo("ccx is not installed: apt-get install calculix-ccx")
    scene_of(posed)
    contrast, thickness, friction, hertz = _dimensionless(posed)
    increments = RUBBED if friction else PRESSED
    scene = CoatedScene(posed.name, contrast, thickness, friction, 1.0, increments)
    before = _spent()
    try:
        found = _answer(posed, hertz, *under_force(scene, 2**level))
    except (SubprocessError, ValueError) as error:
        found = given_up(posed, COARSEST * 2**level, error)
    return replace(found, seconds=_spent() - before)


def _spent() -> float:
    """CPU seconds of the processes that this one has waited for."""
    of = getrusage(RUSAGE_CHILDREN)
    return of.ru_utime + of.ru_stime


def _dimensionless(posed: Posed) -> tuple[float, float, float, PointContact]:
    """E1/E2, thickness over Hertz's radius, µ, and Hertz's contact of the substrate."""
    indenter, body = posed.scene["indenter"], posed.scene["body"]
    friction = float((posed.scene.get("friction") or {}).get("coefficient", 0.0))
    bodies = [each["material"] for each in (indenter, body) if each["material"] != "rigid"]
    layers = (*body["layers"], *(indenter.get("layers") or ()))
    if indenter["shape"] != "paraboloid" or not pressed_alone(posed):
        raise CannotDo("a ball that is pressed, here")
    if len(layers) > 1 or (len(bodies) > 1 and (layers or friction)):
        raise CannotDo("one layer under a rigid ball, here")
    ratios = {m["poisson_ratio"] for m in (*bodies, *(layer["material"] for layer in layers))}
    if ratios != {POISSON_RATIO}:
        raise CannotDo(f"ν = {POISSON_RATIO:g}, here")
    modulus = 1 / sum((1 - m["poisson_ratio"] ** 2) / m["young_modulus"] for m in bodies)
    hertz = PointContact.under_load(posed.loads[0][0], indenter["radius"], modulus)
    if not layers:
        return 1.0, 1.0, friction, hertz
    contrast = layers[0]["material"]["young_modulus"] / body["material"]["young_modulus"]
    return contrast, layers[0]["thickness"] / hertz.contact_radius, friction, hertz


def _answer(
    posed: Posed, hertz: PointContact, approach: float, found: Mapping[str, Any], on: Fineness
) -> Answer:
    """Back in SI: radii and tractions are over those of Hertz."""
    a, p0 = hertz.contact_radius, hertz.peak_pressure
    r, told = on_nodes(found)
    edge, pressure = up_to_edge(r, told)
    shear = np.array(found["shear"]) * (pressure / told)  # of µp there as much as the nodes tell
    of: Mapping[str, Vector] = {"pressure": pressure, "shear_radial": shear}
    own = {
        "approach": approach * hertz.approach, "contact_radius": edge * a,
        "central_pressure": at_axis(r, pressure, edge) * p0,
    }  # fmt: skip
    scalars: dict[Key, float] = {(q, s): own[q] for q, s in posed.asked if q in own}
    ends = np.array([0.0, *(r[1:] + r[:-1]) / 2, (3 * r[-1] - r[-2]) / 2]) * a
    area = pi * np.diff(ends**2)
    fields = {key: Field(r * a, np.zeros_like(r), of[key[0]] * p0, area) for key in posed.fields}
    points = {
        key: np.interp(places[:, 0] / a, r, of[key[0]]) * p0 for key, places in posed.places.items()
    }
    return Answer(on.finest * a, scalars, fields, points=points)
