"""Mesh, method and cost of a solve by finite elements, in words."""

from __future__ import annotations

from collections.abc import Iterator

from contact_scene import FiniteElementDiscretisation, Scene
from contact_scene.engineering_units import quantity
from fem_reference import Method, Path, Plan, Result
from fem_reference.expected_radius import expected_radius
from fem_reference.memory import required_bytes
from fem_reference.mesh.section_mesh import SectionMesh
from fem_reference.model import ContactModel
from slipstick.cli.plan_text import increments_text

Meshes = tuple[SectionMesh | None, SectionMesh | None]

NODES_PER_ELEMENT = 4  # biquadratic: about one corner, two midsides and a middle each


def section_work(
    scene: Scene, plan: Plan, asked: FiniteElementDiscretisation, method: Method
) -> Iterator[tuple[str, str]]:
    """Mesh, tolerance, increments, factorisations and memory of a solve before it is done."""
    radius = asked.contact_radius or expected_radius(scene)
    sections = ContactModel.of(scene, asked, radius).sections
    chosen = "" if asked.contact_radius else ", estimated without friction"
    yield "method", _method_text(method, asked)
    yield "contact radius", f"{quantity(radius, 'm')}{chosen}"
    yield "mesh", _mesh_text(sections, asked)
    yield "tolerance", f"{asked.tolerance:.3g}"
    yield "increments", increments_text(plan.increments)
    motions = _motions(plan, asked)
    distinct = _distinct(sections)
    text = "one per body and angular harmonic" if motions > 1 else "one per body"
    yield "factorisations", f"{motions * len(distinct)}, {text}; no work where the cache has them"
    largest = max(section.quads.shape[1] for section in distinct)
    components = 2 if motions == 1 else 3
    unknowns = NODES_PER_ELEMENT * largest * components
    yield "memory", f"about {required_bytes(largest, unknowns, components, False) / 2**20:.0f} MiB"


def solved_on_section(result: Result, method: Method, seconds: float) -> Iterator[tuple[str, str]]:
    """How fine and how well it was solved."""
    asked = result.discretisation
    yield "method", _method_text(method, asked)
    yield "mesh", _mesh_text(result.sections, asked)
    worst = max(increment.residuals.worst for increment in result.increments)
    yield "tolerance", f"{asked.tolerance:.3g} (largest residual {worst:.1e})"
    yield "increments", f"{len(result.increments)} in {seconds:.2f} s"


def _method_text(method: Method, asked: FiniteElementDiscretisation) -> str:
    if method is Method.COMPLEMENTARITY:
        return "finite elements, complementarity: no penalty"
    return (
        f"finite elements, penalty of {asked.penalty:g} contact moduli per element, "
        f"{asked.augmentations} augmentation{'s' if asked.augmentations != 1 else ''}"
    )


def _mesh_text(sections: Meshes, asked: FiniteElementDiscretisation) -> str:
    parts = []
    for section in _distinct(sections):
        outline = section.outline
        parts.append(f"{section.quads.shape[1]} elements to {outline.box:.4g} contact radii")
    return f"{asked.elements_per_radius} elements per contact radius; " + ", ".join(parts)


def _distinct(sections: Meshes) -> list[SectionMesh]:
    """Each mesh once: bodies alike share theirs."""
    return list({id(section): section for section in sections if section is not None}.values())


def _motions(plan: Plan, asked: FiniteElementDiscretisation) -> int:
    """Angular harmonics for which a stiffness is factored."""
    if plan.path is Path.HARMONICS:
        return asked.harmonics + 1
    return 2 if plan.path in (Path.TWISTING, Path.SHEARING) else 1
