"""CalculiX as anybody's code: a rigid ball on a half-space or a coating, with friction or without,
through the decks of `external_codes`, which are in units of Hertz's contact."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from math import log, pi, sqrt
from typing import Any

import numpy as np

from verification.adapters.own_numbers import pressed_alone, scene_of
from verification.challenge.answer import Answer, Field, Key, Solver, Vector
from verification.challenge.door import CannotDo, Posed
from verification.closed_forms.hertz import PointContact
from verification.external_codes.calculix_deck import Fineness
from verification.external_codes.coated_scene import POISSON_RATIO, CoatedScene
from verification.external_codes.run_calculix import run_calculix

CALCULIX = Solver("CalculiX")
COARSEST, STIFFNESS = 16, 1000.0  # elements over the Hertz radius, springs in E*/a_H; both double
REACH = 1.6  # Hertz radii of equal elements
PRESSED, RUBBED = 4, 20  # increments without and with friction
RUNS = 3  # to find the approach at which the force is the one asked for
NEAR = 1e-5  # to that force: tractions that are told are of the last run
RISE = 1.5  # of the logarithm of the force with that of the approach, to begin with


def answer(posed: Posed, level: int) -> Answer:
    """On COARSEST elements over the Hertz radius, twice as many, …; CannotDo without `ccx`."""
    if shutil.which("ccx") is None:
        raise CannotDo("ccx is not installed: apt-get install calculix-ccx")
    scene_of(posed)
    contrast, thickness, friction, hertz = _dimensionless(posed)
    times = 2**level
    fineness = Fineness(COARSEST * times, STIFFNESS * times, REACH)
    approach, rise, tried = 1.0, RISE, []
    increments = RUBBED if friction else PRESSED
    for _ in range(RUNS):
        scene = CoatedScene(posed.name, contrast, thickness, friction, approach, increments)
        found = run_calculix(scene, fineness)
        force = found["normal_force"]
        tried.append((log(approach), log(force)))
        if len(tried) > 1:
            (x0, y0), (x1, y1) = tried[-2:]
            rise = (y1 - y0) / (x1 - x0)
        approach *= force ** (-1 / rise)
        if abs(force - 1) < NEAR:
            break
    return _answer(posed, hertz, approach, found, fineness)


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
    posed: Posed, hertz: PointContact, approach: float, found: Mapping[str, Any], fineness: Fineness
) -> Answer:
    """Back in SI: radii and tractions are over those of Hertz."""
    a, p0 = hertz.contact_radius, hertz.peak_pressure
    r = np.array(found["radii"]) * a
    of: Mapping[str, Vector] = {
        "pressure": np.array(found["pressure"]) * p0, "shear_radial": np.array(found["shear"]) * p0
    }  # fmt: skip
    h = a / fineness.elements
    own = {"approach": approach * hertz.approach, "contact_radius": _edge(r, of["pressure"])}
    scalars: dict[Key, float] = {(q, s): own[q] for q, s in posed.asked if q in own}
    inner, outer = np.maximum(r - h / 2, 0), r + h / 2
    area = pi * (outer**2 - inner**2)
    fields = {key: Field(r, np.zeros_like(r), of[key[0]], area) for key in posed.fields}
    points = {key: np.interp(places[:, 0], r, of[key[0]]) for key, places in posed.places.items()}
    return Answer(h, scalars, fields, points=points)


def _edge(r: Vector, pressure: Vector) -> float:
    """Where the square of the pressure, a line in r² near the edge, would vanish: nodes next to the
    edge ripple."""
    near = np.flatnonzero(r > 0.6 * r[-1])[:-3]
    slope, at_axis = np.polyfit(r[near] ** 2, pressure[near] ** 2, 1)
    return sqrt(-at_axis / slope)
