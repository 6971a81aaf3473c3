"""How large the contact will be: what the fine elements of the mesh are laid out for.

It decides the mesh and not the answer: a contact that outgrows the mesh is noticed.
"""

from math import pi, sqrt, tan

from contact_scene import (
    Body,
    Cone,
    ControlKind,
    Ellipsoid,
    FiniteElementDiscretisation,
    FlatPunch,
    HeightMap,
    IsotropicMaterial,
    LoadRamp,
    LoadStep,
    Scene,
)
from contact_scene.solver_errors import ContactAtZoneEdge
from fem_reference.contact.complementarity.method import complementarity_method
from fem_reference.history import march
from fem_reference.model import ContactModel
from fem_reference.plan import plan

# Layered bodies are pressed on a coarse mesh first.
COARSE = 8
GROWTH, TOO_SMALL = 1.5, 0.5
MOST_TRIALS = 30
COARSE_TOLERANCE = 1e-8


def expected_radius(scene: Scene) -> float:
    """Largest contact radius of the history without friction [length].

    Closed forms for half-spaces (Johnson 1985, sections 4.2 and 5.2); with layers, from a coarse
    mesh of about the right size.
    """
    guess = max(_half_space_radius(scene, ramp) for ramp in scene.load_path())
    layered = scene.body.layers or scene.indenter.layers
    if not layered or isinstance(scene.indenter, FlatPunch):
        return guess
    return max(_coarse_radius(scene, ramp, guess) for ramp in _extremes(scene))


def _extremes(scene: Scene) -> list[LoadRamp]:
    """The ramps with the largest force and the largest approach."""
    ramps = scene.load_path()
    kinds = [[r for r in ramps if r.normal.kind is kind] for kind in ControlKind]
    return [max(same, key=lambda ramp: ramp.normal.end) for same in kinds if same]


def _half_space_radius(scene: Scene, ramp: LoadRamp) -> float:
    """Of a contact between half-spaces, layers counted as if they filled them on their own."""
    indenter, end = scene.indenter, ramp.normal.end
    if isinstance(indenter, FlatPunch):
        return indenter.radius
    modulus = 1 / (_softness(scene.body) + _softness(indenter))
    by_force = ramp.normal.kind is ControlKind.FORCE
    if isinstance(indenter, Cone):
        slope = tan(indenter.slope_angle)
        return sqrt(2 * end / (pi * modulus * slope)) if by_force else 2 * end / (pi * slope)
    assert not isinstance(indenter, HeightMap)
    radius = indenter.radii[0] if isinstance(indenter, Ellipsoid) else indenter.radius
    return (3 * end * radius / (4 * modulus)) ** (1 / 3) if by_force else sqrt(end * radius)


def _softness(body: Body) -> float:
    """(1-ν²)/E, the mean over the elastic materials of a body."""
    parts = [layer.material for layer in body.layers]
    if isinstance(body.material, IsotropicMaterial):
        parts.append(body.material)
    return sum(1 / part.plane_strain_modulus for part in parts) / max(1, len(parts))


def _coarse_radius(scene: Scene, ramp: LoadRamp, guess: float) -> float:
    """Pressed in one increment, on coarse meshes until one fits."""
    by_force = ramp.normal.kind is ControlKind.FORCE
    end = ramp.normal.end
    step = LoadStep(normal_force=end) if by_force else LoadStep(approach=end)
    pressing = scene.model_copy(update={"friction": None, "loading": (step,)})
    decided = plan(pressing)
    radius = guess
    for _ in range(MOST_TRIALS):
        model = ContactModel.of(
            pressing, FiniteElementDiscretisation(elements_per_radius=COARSE), radius
        )
        method = complementarity_method(model, decided)
        try:
            (pressed,) = march(pressing, decided, method, COARSE_TOLERANCE)
        except ContactAtZoneEdge:
            radius *= GROWTH
            continue
        if pressed.contact_radius >= TOO_SMALL * radius:
            return pressed.contact_radius
        radius = max(pressed.contact_radius, radius / 4)
    return radius
