"""Step ends of coupled contacts, on which the edge correction is judged.

A rigid paraboloid on a bare or a coated half-space whose surface materials are dissimilar, so that
pressure and shear are coupled: five load histories with a reversal, six of two steps.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    Ellipsoid,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from semi_analytical.grid import SurfaceGrid
from verification.closed_forms.hertz import PointContact

RADIUS, LOAD = 11e-3, 150.0
MODULUS, POISSON = 210e9, 0.3
A = PointContact.under_load(LOAD, RADIUS, MODULUS / (1 - POISSON**2)).contact_radius


@dataclass(frozen=True)
class CoupledEdges:
    """A scene, and its window in units of `A` along x and y."""

    scene: Scene
    window: tuple[float, float]

    def grid(self, cells: int) -> SurfaceGrid:
        """Cells on that window."""
        return SurfaceGrid((cells, cells), (self.window[0] * A, self.window[1] * A))


def _push(mu: float, part: float, increments: int, across: float = 0.0) -> LoadStep:
    """Tangential force (part, across) µW."""
    limit = mu * LOAD
    return LoadStep(tangential_force=(part * limit, across * limit), increments=increments)


def _contact(
    loading: Sequence[LoadStep],
    *,
    film: tuple[float, float] | None = None,
    poisson: float = POISSON,
    mu: float = 0.3,
    radii: tuple[float, float] = (1.0, 1.0),
    window: tuple[float, float],
) -> CoupledEdges:
    """A pressed indenter with these further steps.

    film  Young's modulus over that of the body, thickness over `A`
    """
    layers: tuple[Layer, ...] = ()
    if film is not None:
        material = IsotropicMaterial(young_modulus=film[0] * MODULUS, poisson_ratio=POISSON)
        layers = (Layer(thickness=film[1] * A, material=material),)
    tip: Paraboloid | Ellipsoid = Paraboloid(radius=RADIUS, material=RIGID)
    if radii != (1.0, 1.0):
        tip = Ellipsoid(radii=(radii[0] * RADIUS, radii[1] * RADIUS), material=RIGID)
    scene = Scene(
        indenter=tip,
        body=Body(
            material=IsotropicMaterial(young_modulus=MODULUS, poisson_ratio=poisson), layers=layers
        ),
        friction=CoulombFriction(coefficient=mu),
        loading=(LoadStep(normal_force=LOAD, increments=8), *loading),
    )
    return CoupledEdges(scene, window)


_HISTORY = [_push(0.3, part, n) for part, n in ((0.3, 3), (0.6, 3), (0.9, 3), (-0.6, 6))]
CONTACTS = {
    "bare": _contact(_HISTORY, window=(2.8, 2.8)),
    "film 4, .4": _contact(_HISTORY, film=(4.0, 0.4), window=(2.2, 2.2)),
    "film 4, .1": _contact(_HISTORY, film=(4.0, 0.1), window=(2.6, 2.6)),
    "film .25, .4": _contact(_HISTORY, film=(0.25, 0.4), window=(3.5, 3.5)),
    "film .25, .1": _contact(_HISTORY, film=(0.25, 0.1), window=(3.1, 3.1)),
    "film 10, .3": _contact([_push(0.2, 0.6, 6)], film=(10.0, 0.3), mu=0.2, window=(1.9, 1.9)),
    "strong friction": _contact([_push(1.0, 0.6, 6)], poisson=0.1, mu=1.0, window=(2.8, 2.8)),
    "ellipsoid": _contact([_push(0.3, 0.6, 6)], radii=(1.0, 2.0), window=(2.8, 4.4)),
    "unloaded": _contact(
        [LoadStep(normal_force=0.4 * LOAD, increments=6)], film=(4.0, 0.4), window=(2.2, 2.2)
    ),
    "oblique": _contact([_push(0.3, 0.5, 6, across=0.3)], window=(2.8, 2.8)),
    "thin film": _contact([_push(0.1, 0.6, 6)], film=(3.0, 0.03), mu=0.1, window=(2.8, 2.8)),
}
