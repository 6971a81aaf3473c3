"""Pressing of uncoupled bodies by independent methods: reference for error estimates.

Without coupling, shear does not change the pressure, and the pressure at the end of a load step
depends on the normal load at this time only. It is that of the contact without friction, computed

- for bodies of revolution, with or without layers, by the radial solver without friction, once
  with the default and once with twice the numbers of orders and points, and
- for bare ellipsoids, by Hertz (1882; Johnson 1985, section 4.2) with Carlson's integrals.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from math import exp, log, pi, sqrt

import numpy as np

import radial
from contact_errors.error_formula import Values
from contact_scene import Ellipsoid, LoadRamp, LoadStep, Scene
from contact_scene.body_pair import contact_modulus, coupling
from contact_scene.rig import compliances
from contact_scene.solver_errors import SolverError
from contact_scene.stepping.load_path import ControlKind

# Factors on the orders and points of the two radial solves.
FINENESS = 1.0, 2.0
PRESSING = "approach", "normal_force", "contact_area", "contact_radius", "peak_pressure"
STIFFNESS = ("normal_stiffness",)
# Scalars that are known as long as no shear acts.
ENERGIES = "elastic_energy", "input_work"


def known_pressing(scene: Scene) -> Sequence[Sequence[Values]]:
    """Compute the scalars of the pressing of a scene by methods other than those of the solvers.

    Returns the scalars by name at the end of each load step, once for each method. A load step that
    separates the bodies has none. The result is empty if no method applies: for coupled bodies with
    friction, an approach prescribed through a spring, tilted indenters, and scenes that the radial
    solver refuses.

    scene  contact problem with its load history
    """
    ramps, indenter = scene.load_path(), scene.indenter
    alone = pressing_alone(scene)
    if alone is None:
        return ()
    bare = not (scene.body.layers or indenter.layers)
    if isinstance(indenter, Ellipsoid) and bare:
        found = [[_hertz(scene, indenter, ramp) for ramp in ramps]]
    elif indenter.is_of_revolution:
        found = _by_rings(alone)
    else:
        return ()
    return [list(_known_values(scene, ramps, scalars)) for scalars in found]


def pressing_alone(scene: Scene) -> Scene | None:
    """Return a scene without friction whose pressure is that of a scene; None if there is none.

    There is none for coupled bodies with friction, an approach prescribed through a spring, and
    tilted indenters.

    scene  contact problem with its load history
    """
    ramps = scene.load_path()
    frictionless = scene.friction is None or not scene.friction.largest
    by_force = all(ramp.normal.kind is ControlKind.FORCE for ramp in ramps)
    sprung = compliances(scene.rig)[0] and not by_force
    tilts = any(any(ramp.tilting.end) for ramp in ramps)
    coupled = not frictionless and coupling(scene)[0]
    if sprung or coupled or tilts:
        return None
    loads = [
        LoadStep(normal_force=ramp.normal.end)
        if ramp.normal.kind is ControlKind.FORCE
        else LoadStep(approach=ramp.normal.end)
        for ramp in ramps
    ]
    return scene.model_copy(update={"friction": None, "rig": None, "loading": tuple(loads)})


def _by_rings(alone: Scene) -> list[list[Mapping[str, float]]]:
    """Compute scalars by the radial solver with each fineness; empty if it refuses the scene."""
    try:
        plan = radial.plan(alone)
        return [
            [_pressing_scalars(end) for end in radial.solve(alone, plan=finer).steps]
            for finer in (replace(plan, fineness=fineness) for fineness in FINENESS)
        ]
    except SolverError:
        return []


def _pressing_scalars(end: radial.Increment) -> Mapping[str, float]:
    """Return the scalars of a radial solve without friction, by name; none without contact."""
    if not end.contact_area:
        return {}
    names = (*PRESSING, *STIFFNESS, *ENERGIES)
    return {name: value for name in names if (value := getattr(end, name)) is not None}


def _hertz(scene: Scene, indenter: Ellipsoid, ramp: LoadRamp) -> Mapping[str, float]:
    """Compute the scalars of a bare ellipsoid under a normal load, in closed form.

    With the semi-axes a and b = k a, Carlson's integrals RF and RD, and ∫ over the half-space
    displacement below an ellipsoidal pressure (Johnson 1985, eq. 3.66):

        Ry/Rx = RD(0, k², 1) / RD(0, 1, k²)
        a³ = W Rx RD(0, k², 1) / πE*
        approach = 3W RF(0, k², 1) / 2πE*a
        dW/d(approach) = 3W / 2 approach
    """
    from scipy.optimize import brentq
    from scipy.special import elliprd, elliprf

    rx, ry = indenter.radii
    modulus, end = contact_modulus(scene), ramp.normal.end
    if not end:
        return {}

    def curvatures_apart(log_k: float) -> float:
        k2 = exp(2 * log_k)
        return log(elliprd(0, k2, 1) / elliprd(0, 1, k2)) - log(ry / rx)

    # The axis ratio lies between (Ry/Rx)^½ and Ry/Rx (Johnson 1985, fig. 4.4).
    furthest = abs(log(ry / rx)) + 1.0
    k = exp(brentq(curvatures_apart, -furthest, furthest))
    # a = c W^⅓ and approach = d W^⅔
    c = np.cbrt(rx * elliprd(0, k**2, 1) / (pi * modulus))
    d = 3 / 2 * elliprf(0, k**2, 1) / (pi * modulus * c)
    load = end if ramp.normal.kind is ControlKind.FORCE else (end / d) ** (3 / 2)
    a, approach = c * np.cbrt(load), d * load ** (2 / 3)
    elastic = load * approach / (1 + 3 / 2)  # integral of the load, which grows as approach^(3/2)
    area = pi * k * a**2
    sizes = approach, load, area, a * sqrt(k), 3 / 2 * load / area, 3 / 2 * load / approach
    names = (*PRESSING, *STIFFNESS, *ENERGIES)
    return dict(zip(names, (*map(float, sizes), elastic, elastic), strict=True))


def _known_values(
    scene: Scene, ramps: Sequence[LoadRamp], scalars: Sequence[Mapping[str, float]]
) -> Iterator[Values]:
    """Yield the known scalars of each load step.

    The energies are left out from the first load step on that shears the contact.

    scalars  scalars of the pressing at the end of each load step, by name
    """
    sheared, compliance = False, compliances(scene.rig)[0]
    for ramp, values in zip(ramps, scalars, strict=True):
        shears = any(ramp.tangential.end) or ramp.twisting.end or ramp.strains
        sheared = sheared or bool(shears)
        found = {
            name: np.array([value])
            for name, value in values.items()
            if np.isfinite(value) and not (sheared and name in ENERGIES)
        }
        if found and compliance:
            found["actuator_approach"] = found["approach"] + compliance * found["normal_force"]
        yield found
