"""Estimate of the contact radius before the solve, for which the fine elements are laid out.

The estimate affects the mesh only. A contact that exceeds the fine elements is detected, and the
scene is solved again on a larger mesh.
"""

from collections.abc import Sequence
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
from fem_reference.history import solved_increments
from fem_reference.mesh.element_order import ELEMENTS
from fem_reference.mesh.section_mesh import SectionMesh
from fem_reference.mesh.section_outline import sufficient_box
from fem_reference.model import ContactModel, outermost_modulus
from fem_reference.plan import ANGULAR, Path, plan
from fem_reference.scales import Scales

# Elements per radius of the coarse mesh for bodies with layers that are not thick.
COARSE = 8
GROWTH = 1.5
TOO_SMALL = 0.5
MAX_TRIALS = 30
COARSE_TOLERANCE = 1e-8
# Largest outer radius of the coarse mesh, in contact radii. Coatings much stiffer than their
# substrate require larger sections for accurate stresses, but not for the contact radius.
LARGEST_COARSE_BOX = 1e4
# Layer thickness in contact radii, above which the material below the layer is neglected.
DEEP = 100.0


def sections_of(scene: Scene, discretisation: FiniteElementDiscretisation) -> list[SectionMesh]:
    """Create the finite-element meshes of the deformable bodies of a scene.

    The contact on these meshes is not solved. Used to count elements for the cost estimate. Equal
    bodies share one mesh, which occurs once in the list. A contact radius that is not prescribed is
    estimated first.

    discretisation  element sizes, and the prescribed contact radius, if there is one
    """
    radius = meshed_radius(scene, discretisation.contact_radius)
    sections = ContactModel.of(scene, discretisation, radius).sections
    return list({id(section): section for section in sections if section is not None}.values())


def count_points(sections: Sequence[SectionMesh], path: Path, harmonics: int) -> int:
    """Count the contact points whose tractions are solved with one dense matrix.

    Used to estimate the memory of a solve.

    sections   meshes of the deformable bodies, which have the same surface nodes
    path       tractions that the solve computes
    harmonics  highest angular harmonic of the discretisation
    """
    rings = len(sections[0].radii[:: ELEMENTS.degree])
    if path not in ANGULAR:
        return rings
    return rings * (2 * harmonics if path is Path.WHOLE_CIRCLE else harmonics + 1)


def meshed_radius(scene: Scene, prescribed: float | None) -> float:
    """Return the contact radius for which the meshes of a scene are laid out [length].

    The radius is that of the indenter's rim if there is a rim, else the prescribed radius, else the
    expected contact radius.

    scene       contact problem
    prescribed  radius requested in the discretisation [length]; None without one
    """
    return scene.indenter.rim or prescribed or expected_radius(scene)


def expected_radius(scene: Scene) -> float:
    """Estimate the largest contact radius of the load history, without friction [length].

    The fine elements of the mesh are laid out for this radius. Half-spaces and thick layers have
    closed forms. Contacts of bodies with other layers are solved on a coarse mesh.

    scene  contact problem with its load history
    """
    guess = max(_half_space_radius(scene, ramp) for ramp in scene.load_path())
    layered = scene.body.layers or scene.indenter.layers
    if not layered or scene.indenter.rim is not None:
        return guess
    bare = max(_bare_radius(scene, ramp) for ramp in scene.load_path())
    thick = [body.layers[0].thickness for body in (scene.body, scene.indenter) if body.layers]
    if min(thick) > DEEP * bare:
        return bare
    return max(_coarse_radius(scene, ramp, guess) for ramp in _largest_ramps(scene))


def _largest_ramps(scene: Scene) -> list[LoadRamp]:
    """Return the ramp with the largest final force,
    and that with the largest final approach, if any."""
    ramps = scene.load_path()
    kinds = [[r for r in ramps if r.normal.kind is kind and r.normal.end] for kind in ControlKind]
    return [max(same, key=lambda ramp: ramp.normal.end) for same in kinds if same]


def _bare_radius(scene: Scene, ramp: LoadRamp) -> float:
    """Estimate the contact radius of half-spaces of the outermost materials [length],
    which is accurate for thick layers."""
    outermost = [
        body.model_copy(update={"material": body.layers[0].material, "layers": ()})
        if body.layers
        else body
        for body in (scene.body, scene.indenter)
    ]
    bodies = dict(zip(("body", "indenter"), outermost, strict=True))
    return _half_space_radius(scene.model_copy(update=bodies), ramp)


def _half_space_radius(scene: Scene, ramp: LoadRamp) -> float:
    """Estimate the contact radius at the end of a load step by half-space theory [length].

    Each body is treated as a half-space. Its compliance is the mean of (1-ν²)/E over its layers and
    its substrate. An indenter with a rim has the radius of the rim. Raise UnsupportedScene if the
    shape of the indenter has no closed form.

    scene  contact problem with its bodies
    ramp   linear change of the loads in the load step
    """
    indenter, end = scene.indenter, ramp.normal.end
    if indenter.rim is not None:
        return indenter.rim
    modulus = 1 / (_mean_compliance(scene.body) + _mean_compliance(indenter))
    if ramp.normal.kind is ControlKind.FORCE:
        power, degree = indenter.contact_under(end, modulus), indenter.load_exponent
    else:
        power = indenter.contact_at(contact_approach(scene, end, modulus))
        degree = indenter.gap_exponent
    if power is None or degree is None:
        raise UnsupportedScene(
            f"the contact radius of this indenter ({shape_text(indenter)}) cannot be estimated "
            "before the solve. Set contact_radius in [fem_reference]"
        )
    return sqrt(power[0]) if degree == 2 else power[0] ** (1 / degree)


def _mean_compliance(body: Body) -> float:
    """Compute the unweighted mean of (1-ν²)/E over layers and substrate [length^2/force];
    0 if rigid."""
    parts = body.elastic_materials
    return sum(1 / part.plane_strain_modulus for part in parts) / max(1, len(parts))


def _coarse_radius(scene: Scene, ramp: LoadRamp, guess: float) -> float:
    """Compute the contact radius at the end of a load step by a solve on a coarse mesh [length].

    Friction is neglected. The normal load is applied in one increment. The solve is repeated on
    another mesh until the contact fits into the fine elements and is not much smaller than their
    zone. Used for bodies whose layers are not thick.

    scene  contact problem with its bodies
    ramp   linear change of the loads in the load step
    guess  contact radius for the first mesh [length]
    """
    by_force = ramp.normal.kind is ControlKind.FORCE
    end = ramp.normal.end
    step = LoadStep(normal_force=end) if by_force else LoadStep(approach=end)
    pressing = scene.model_copy(update={"friction": None, "loading": (step,)})
    decided = plan(pressing)
    radius = guess
    for _ in range(MAX_TRIALS):
        model = ContactModel.of(pressing, _coarse_discretisation(scene, radius), radius)
        try:
            (pressed,) = solved_increments(ContactMethod(model, decided), COARSE_TOLERANCE)
        except ContactAtZoneEdge:
            radius *= GROWTH
            continue
        if pressed.edge_radius >= TOO_SMALL * radius:
            return pressed.edge_radius
        radius = max(pressed.edge_radius, radius / 4)
    return radius


def _coarse_discretisation(scene: Scene, radius: float) -> FiniteElementDiscretisation:
    """Return the discretisation of the coarse mesh on which the contact radius is estimated.

    The outer radius of the mesh is limited to LARGEST_COARSE_BOX contact radii if the layers are
    thin enough.

    scene   contact problem with its bodies
    radius  largest contact radius for which the mesh is laid out [length]
    """
    to_radius = Scales(radius, outermost_modulus(scene)).dimensionless
    bodies = [to_radius(body) for body in (scene.body, scene.indenter)]
    deepest = max(sum(layer.thickness for layer in body.layers) for body in bodies)
    plane = scene.indenter.is_line
    enough = max(sufficient_box(body, plane=plane) for body in bodies)
    short = 10.0 * deepest <= LARGEST_COARSE_BOX < enough
    box = LARGEST_COARSE_BOX if short else None
    return FiniteElementDiscretisation(elements_per_radius=COARSE, box=box)
