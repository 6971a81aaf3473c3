"""How large the contact will be: what the fine elements of the mesh are laid out for.

It decides the mesh and not the answer: a contact that does not fit the mesh is noticed.
"""

from math import sqrt

from contact_scene import (
    Body,
    ControlKind,
    FiniteElementDiscretisation,
    LoadRamp,
    LoadStep,
    Scene,
)
from contact_scene.checks.expected_contact import contact_approach
from contact_scene.reading.scene_text import shape_text
from contact_scene.solver_errors import ContactAtZoneEdge, UnsupportedScene
from fem_reference.contact.method import ContactMethod
from fem_reference.history import march
from fem_reference.mesh.section_mesh import SectionMesh
from fem_reference.mesh.section_outline import sufficient_box
from fem_reference.model import ContactModel, outermost_modulus
from fem_reference.plan import plan
from fem_reference.scales import Scales

# Bodies with layers that are not deep are pressed on a coarse mesh first.
COARSE = 8
GROWTH, TOO_SMALL = 1.5, 0.5
MAX_TRIALS = 30
COARSE_TOLERANCE = 1e-8
# In contact radii: of coatings a million times as stiff as what is below them, sections are larger
# by many decades, and so is the work; the radius needs none of them.
LARGEST_COARSE_BOX = 1e4
# In contact radii: the contact hardly depends on what lies below a thicker layer.
DEEP = 100.0


def sections_of(scene: Scene, discretisation: FiniteElementDiscretisation) -> list[SectionMesh]:
    """Mesh the deformable bodies of a scene; equal bodies share their mesh."""
    radius = meshed_radius(scene, discretisation.contact_radius)
    sections = ContactModel.of(scene, discretisation, radius).sections
    return list({id(section): section for section in sections if section is not None}.values())


def meshed_radius(scene: Scene, asked: float | None) -> float:
    """What the mesh is laid out for: a rim, where a ring of nodes must lie; else the contact radius
    that is asked for or, if that is None, expected [length]."""
    return scene.indenter.rim or asked or expected_radius(scene)


def expected_radius(scene: Scene) -> float:
    """Largest contact radius of the history without friction [length].

    Closed forms for half-spaces and below deep layers; with other layers, from a coarse mesh of
    about the right size.
    """
    guess = max(_half_space_radius(scene, ramp) for ramp in scene.load_path())
    layered = scene.body.layers or scene.indenter.layers
    if not layered or scene.indenter.rim is not None:
        return guess
    bare = max(_bare_radius(scene, ramp) for ramp in scene.load_path())
    thick = [body.layers[0].thickness for body in (scene.body, scene.indenter) if body.layers]
    if min(thick) > DEEP * bare:
        return bare
    return max(_coarse_radius(scene, ramp, guess) for ramp in _extremes(scene))


def _extremes(scene: Scene) -> list[LoadRamp]:
    """The ramps with the largest force and the largest approach."""
    ramps = scene.load_path()
    kinds = [[r for r in ramps if r.normal.kind is kind and r.normal.end] for kind in ControlKind]
    return [max(same, key=lambda ramp: ramp.normal.end) for same in kinds if same]


def _bare_radius(scene: Scene, ramp: LoadRamp) -> float:
    """Of a contact between half-spaces of the outermost materials."""
    outermost = [
        body.model_copy(update={"material": body.layers[0].material, "layers": ()})
        if body.layers
        else body
        for body in (scene.body, scene.indenter)
    ]
    bodies = dict(zip(("body", "indenter"), outermost, strict=True))
    return _half_space_radius(scene.model_copy(update=bodies), ramp)


def _half_space_radius(scene: Scene, ramp: LoadRamp) -> float:
    """Of a contact between half-spaces, layers counted as if they filled them on their own."""
    indenter, end, exponent = scene.indenter, ramp.normal.end, scene.indenter.gap_exponent
    if indenter.rim is not None:
        return indenter.rim
    modulus = 1 / (_softness(scene.body) + _softness(indenter))
    if ramp.normal.kind is ControlKind.FORCE:
        power, more = indenter.contact_under(end, modulus), 1
    else:
        power, more = indenter.contact_at(contact_approach(scene, end, modulus)), 0
    if power is None or exponent is None:
        raise UnsupportedScene(
            f"how large the contact will be is not known beforehand of this indenter "
            f"({shape_text(indenter)}); give contact_radius in [fem_reference]"
        )
    degree = exponent + more
    return sqrt(power[0]) if degree == 2 else power[0] ** (1 / degree)


def _softness(body: Body) -> float:
    """(1-ν²)/E, the mean over the elastic materials of a body."""
    parts = body.elastic_materials
    return sum(1 / part.plane_strain_modulus for part in parts) / max(1, len(parts))


def _coarse_radius(scene: Scene, ramp: LoadRamp, guess: float) -> float:
    """Pressed in one increment, on coarse meshes until one fits."""
    by_force = ramp.normal.kind is ControlKind.FORCE
    end = ramp.normal.end
    step = LoadStep(normal_force=end) if by_force else LoadStep(approach=end)
    pressing = scene.model_copy(update={"friction": None, "loading": (step,)})
    decided = plan(pressing)
    radius = guess
    for _ in range(MAX_TRIALS):
        model = ContactModel.of(pressing, _coarse(scene, radius), radius)
        try:
            (pressed,) = march(ContactMethod(model, decided), COARSE_TOLERANCE)
        except ContactAtZoneEdge:
            radius *= GROWTH
            continue
        if pressed.contact_radius >= TOO_SMALL * radius:
            return pressed.contact_radius
        radius = max(pressed.contact_radius, radius / 4)
    return radius


def _coarse(scene: Scene, radius: float) -> FiniteElementDiscretisation:
    """Elements that tell how large a contact is, if it is of about this radius."""
    to_radius = Scales(radius, outermost_modulus(scene)).dimensionless
    bodies = [to_radius(body) for body in (scene.body, scene.indenter)]
    deepest = max(sum(layer.thickness for layer in body.layers) for body in bodies)
    short = 10.0 * deepest <= LARGEST_COARSE_BOX < max(map(sufficient_box, bodies))
    box = LARGEST_COARSE_BOX if short else None
    return FiniteElementDiscretisation(elements_per_radius=COARSE, box=box)
