"""Dimensionless parameters of a solved scene, for the table of validity of a report."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from contact_scene import Body, IsotropicMaterial, Scene

if TYPE_CHECKING:
    from contact_results.surface import Result

LAYER_THICKNESS = "h/a"
LAYER_MODULUS = "E1/E2"
POISSON_RATIO = "ν"
FRICTION = "µ"
TANGENTIAL_FORCE = "T/(µW)"

# Digits of a stored parameter. Ranges need few, and more would differ between machines.
DIGITS = 4


def dimensionless_parameters(scene: Scene, result: Result) -> dict[str, tuple[float, ...]]:
    """Return the dimensionless parameters of a solved scene, by name; absent effects have none.

    A parameter has several values in ascending order if the scene has several materials or layers,
    or a map of the coefficient of friction (its smallest and its largest value).

    h/a     thickness of a layer over the largest contact radius, or half width, of the result
    E1/E2   Young's modulus of a layer over that of its substrate; 0 on a rigid substrate
    ν       Poisson's ratio of a layer or body
    µ       coefficient of friction
    T/(µW)  largest tangential force over the friction limit; absent without a tangential force
    """
    bodies = scene.indenter, scene.body
    radius = max(increment.contact_radius for increment in result.increments)
    layers = [(layer, _base_modulus(body)) for body in bodies for layer in body.layers]
    found = {
        LAYER_THICKNESS: (layer.thickness / radius for layer, _ in layers if radius > 0),
        LAYER_MODULUS: (layer.material.young_modulus / base for layer, base in layers),
        POISSON_RATIO: (each.poisson_ratio for body in bodies for each in body.elastic_materials),
        FRICTION: _friction_coefficients(scene),
        TANGENTIAL_FORCE: _friction_shares(scene, result),
    }
    rounded = {name: {float(f"{v:.{DIGITS}g}") for v in values} for name, values in found.items()}
    return {name: tuple(sorted(values)) for name, values in rounded.items() if values}


def _base_modulus(body: Body) -> float:
    base = body.material
    return base.young_modulus if isinstance(base, IsotropicMaterial) else np.inf


def _friction_coefficients(scene: Scene) -> Iterator[float]:
    if scene.friction is not None:
        slope = scene.friction.slope(0.0)
        yield from (float(np.min(slope)), float(np.max(slope)))


def _friction_shares(scene: Scene, result: Result) -> Iterator[float]:
    mu = scene.friction.uniform if scene.friction is not None else None
    if mu:
        shares = [
            float(np.hypot(*increment.tangential_force)) / (mu * increment.normal_force)
            for increment in result.increments
            if increment.tangential_force is not None and increment.normal_force > 0
        ]
        yield from [max(shares)] if any(shares) else []
