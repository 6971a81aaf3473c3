"""A scene in section, as numbers: what the picture on its sheet is drawn from, to scale."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from contact_scene import RIGID, Body, IsotropicMaterial, Rigid, Scene
from contact_scene.description import Description
from contact_scene.engineering_units import quantity

POINTS = 48  # of the indenter's outline
HALF_WIDTH = 3.5  # contact radii to each side of the axis
DIGITS = 5
LOADS = (
    ("W", ("normal_force",)),
    ("ω_z", ("approach",)),
    ("T", ("tangential_force",)),
    ("ω_x", ("tangential_shift",)),
    ("M_z", ("torque", "twist")),
    ("M", ("moment", "tilt")),
)  # fmt: skip


class SketchedLayer(Description):
    """A layer: thickness [length], and its material in words."""

    thickness: float
    material: str


class SketchedBody(Description):
    """Layers, outermost first, and what is below them in words."""

    layers: tuple[SketchedLayer, ...]
    substrate: str


class SectionSketch(Description):
    """The plane y = 0 before loading, with the contact radius under the largest load."""

    half_width: float
    """What is shown to each side of the origin [length]."""

    contact_radius: float
    """The largest of the history [length]."""

    outline: tuple[tuple[float, float], ...]
    """(x, gap at first touch) along the indenter, where it can touch [length]."""

    indenter: SketchedBody
    body: SketchedBody
    friction: str
    loads: tuple[str, ...]
    """Symbols of the forces and motions that some loading step names."""


def section_sketch(scene: Scene, contact_radius: float) -> SectionSketch | None:
    """The section of a scene; None without a contact to scale it by.

    contact_radius  the largest of the history [length]
    """
    if not contact_radius > 0:
        return None
    half_width = _rounded(HALF_WIDTH * contact_radius)
    return SectionSketch(
        half_width=half_width,
        contact_radius=_rounded(contact_radius),
        outline=_outline(scene, half_width),
        indenter=_body(scene.indenter),
        body=_body(scene.body),
        friction=_friction(scene),
        loads=tuple(
            symbol
            for symbol, names in LOADS
            if any(getattr(step, name) is not None for step in scene.loading for name in names)
        ),
    )


def _outline(scene: Scene, half_width: float) -> tuple[tuple[float, float], ...]:
    indenter = scene.indenter
    if indenter.extent is not None:
        half_width = min(half_width, indenter.extent[0] / 2)
    x = np.linspace(-half_width, half_width, POINTS + 1)
    gap = np.asarray(indenter.initial_gap(x, np.zeros_like(x)))
    touching = np.isfinite(gap)
    ends = _rim(scene, x, touching)
    x = np.concatenate([ends[:1], x[touching], ends[1:]])
    gap = np.asarray(indenter.initial_gap(x, np.zeros_like(x)))
    return tuple((_rounded(a), _rounded(h)) for a, h in zip(x, gap, strict=True))


def _rim(scene: Scene, x: NDArray[np.float64], touching: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Where an indenter with a rim ends, to both sides; nothing where it goes on."""
    if touching.all():
        return np.array([])
    inside, outside = x[touching][-1], x[-1]
    for _ in range(40):
        middle = (inside + outside) / 2
        if np.isfinite(scene.indenter.initial_gap(middle, 0.0)):
            inside = middle
        else:
            outside = middle
    return np.array([-inside, inside])


def _body(body: Body) -> SketchedBody:
    return SketchedBody(
        layers=tuple(
            SketchedLayer(
                thickness=_rounded(layer.thickness),
                material=f"{quantity(layer.thickness, 'm', 3)}: {_material(layer.material)}",
            )
            for layer in body.layers
        ),
        substrate=_material(body.material),
    )


def _material(material: IsotropicMaterial | Rigid) -> str:
    if material is RIGID or isinstance(material, Rigid):
        return "rigid"
    stiffness = quantity(material.young_modulus, "Pa", 3)
    return f"E = {stiffness}, ν = {material.poisson_ratio:.4g}"


def _friction(scene: Scene) -> str:
    if scene.friction is None:
        return "no friction"
    mu = scene.friction.coefficient
    return f"µ = {mu:.4g}" if isinstance(mu, float) else "µ from a map"


def _rounded(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")
