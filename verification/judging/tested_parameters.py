"""Dimensionless parameters of a solved scene, for the table of validity of a report."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from contact_scene import IsotropicMaterial, Scene

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
    found = {
        LAYER_THICKNESS: _thicknesses(scene, result),
        LAYER_MODULUS: _modulus_ratios(scene),
        POISSON_RATIO: (
            material.poisson_ratio
            for body in (scene.indenter, scene.body)
            for material in body.elastic_materials
        ),
        FRICTION: _friction_coefficients(scene),
        TANGENTIAL_FORCE: _friction_shares(scene, result),
    }
    rounded = {name: {float(f"{v:.{DIGITS}g}") for v in values} for name, values in found.items()}
    return {name: tuple(sorted(values)) for name, values in rounded.items() if values}


def _thicknesses(scene: Scene, result: Result) -> Iterator[float]:
    radius = max(increment.contact_radius for increment in result.increments)
    if radius > 0:
        for body in (scene.indenter, scene.body):
            yield from (layer.thickness / radius for layer in body.layers)


def _modulus_ratios(scene: Scene) -> Iterator[float]:
    for body in (scene.indenter, scene.body):
        below = body.material
        substrate = below.young_modulus if isinstance(below, IsotropicMaterial) else np.inf
        yield from (layer.material.young_modulus / substrate for layer in body.layers)


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
        largest = max(shares, default=0.0)
        yield from [largest] if largest > 0 else []
