"""Refinement levels of the finite elements: elements, increments, section, overlap, harmonics."""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import dataclass
from math import ceil

import fem_reference
from contact_errors.cost_estimate import Work, estimated_seconds, work_on_elements
from contact_errors.on_elements import coarse_solves, with_increments
from contact_errors.refinement import Keeping, Refinement, RefinementLevel, no_context
from contact_scene import FiniteElementDiscretisation, Scene
from contact_scene.accuracy_reached import AccuracySettings
from contact_scene.free_memory import available_bytes
from contact_scene.increment_error import with_error
from contact_scene.stated_error import StatedErrors
from fem_reference import Method, Path
from fem_reference.expected_radius import meshed_radius
from fem_reference.memory import required_bytes
from fem_reference.mesh.section_mesh import SectionMesh
from fem_reference.model import ContactModel

FIRST_ELEMENTS, MOST_ELEMENTS, MOST_HARMONICS = 8, 512, 64
# Increments of the first level over the default, where the scene names none.
FIRST_INCREMENTS = 0.5
LEAST_TOLERANCE, LEAST_OVERLAP, LARGEST_BOX = 1e-12, 1e-8, 1e6
NODES_PER_ELEMENT = 4  # biquadratic: about one corner, two midsides and one centre each


@dataclass(frozen=True)
class ElementFineness:
    """Mesh, and increments of every step."""

    mesh: FiniteElementDiscretisation
    increments: tuple[int, ...]


@dataclass(frozen=True)
class ElementLevels:
    """See `refinement.Levels`.

    asked   mesh parameters that are kept, and the coarsest values of the others
    method  law of contact and friction
    """

    scene: Scene
    asked: FiniteElementDiscretisation
    method: Method
    keeping: Keeping = no_context
    watching: Keeping = no_context

    def first(self) -> ElementFineness:
        plan = fem_reference.plan(self.scene)
        counts = (
            ceil(FIRST_INCREMENTS * count) if matters and step.increments is None else count
            for step, count, matters in zip(
                self.scene.loading, plan.increments, with_error(self.scene), strict=True
            )
        )
        mesh = self.asked.model_copy(update={"elements_per_radius": FIRST_ELEMENTS})
        return ElementFineness(mesh, tuple(counts))

    def solved(self, fineness: ElementFineness) -> RefinementLevel[ElementFineness]:
        began, began_processor = time.perf_counter(), time.process_time()
        with self.keeping(fineness) as keeper, self.watching(fineness) as progress:
            scene = with_increments(self.scene, fineness.increments)
            result = fem_reference.solve(scene, fineness.mesh, self.method, progress, keeper)
        run, companions = coarse_solves(result)
        return RefinementLevel(
            fineness=fineness,
            result=result,
            stated=StatedErrors(tuple(run.errors()), companions),
            run=run,
            seconds=time.perf_counter() - began,
            processor_seconds=time.process_time() - began_processor,
        )

    def refined(self, fineness: ElementFineness, by: Refinement) -> ElementFineness:
        mesh, others = fineness.mesh, by.others
        update: dict[str, object] = {
            "elements_per_radius": ceil(by.cells * mesh.elements_per_radius - 1e-9),
            "harmonics": min(MOST_HARMONICS, ceil(others.get("harmonics", 1) * mesh.harmonics)),
            "overlap": max(LEAST_OVERLAP, mesh.overlap / others.get("penalty", 1.0)),
            "tolerance": max(LEAST_TOLERANCE, mesh.tolerance / others.get("tolerance", 1.0)),
        }
        if "section" in others:
            box = max(section.outline.box for section in self._sections(fineness))
            update["box"] = min(LARGEST_BOX, box * others["section"])
        increments = by.increments_of(self.scene, fineness.increments)
        return ElementFineness(mesh.model_copy(update=update), increments)

    def seconds(self, fineness: ElementFineness, like: RefinementLevel[ElementFineness]) -> float:
        return estimated_seconds(
            like.processor_seconds, self._work(like.fineness), self._work(fineness)
        )

    def _work(self, fineness: ElementFineness) -> Work:
        coupled = fem_reference.plan(self.scene).path is Path.HARMONICS
        harmonics = fineness.mesh.harmonics if coupled else 1
        return work_on_elements(fineness.mesh.elements_per_radius, fineness.increments, harmonics)

    def memory(self, fineness: ElementFineness) -> int:
        path = fem_reference.plan(self.scene).path
        several = path in (Path.TWISTING, Path.SHEARING, Path.HARMONICS)
        return int(largest_bytes(self._sections(fineness), several))

    def too_large(self, fineness: ElementFineness) -> str | None:
        if fineness.mesh.elements_per_radius > MOST_ELEMENTS:
            return f"the next round would take more than {MOST_ELEMENTS} elements over the radius"
        needed, available = self.memory(fineness), available_bytes()
        if needed <= available:
            return None
        return (
            f"the next round, {fineness.mesh.elements_per_radius} elements over the radius, needs "
            f"about {needed / 2**30:.1f} GiB; {available / 2**30:.1f} GiB are available"
        )

    def most_growth(self, fineness: ElementFineness) -> float:
        return MOST_ELEMENTS / fineness.mesh.elements_per_radius

    def settings(self, fineness: ElementFineness) -> AccuracySettings:
        return AccuracySettings(
            elements_per_radius=fineness.mesh.elements_per_radius,
            increments=fineness.increments,
            tolerance=fineness.mesh.tolerance,
        )

    def _sections(self, fineness: ElementFineness) -> list[SectionMesh]:
        elements = min(MOST_ELEMENTS, fineness.mesh.elements_per_radius)
        mesh = fineness.mesh.model_copy(update={"elements_per_radius": elements})
        radius = meshed_radius(self.scene, mesh.contact_radius)
        sections = ContactModel.of(self.scene, mesh, radius).sections
        return [section for section in sections if section is not None]


def largest_bytes(sections: Iterable[SectionMesh], several_motions: bool) -> float:
    """Memory for the factors of the largest section [byte].

    several_motions  whether it moves along the angle, too
    """
    largest = max(section.quads.shape[1] for section in sections)
    components = 3 if several_motions else 2
    return required_bytes(largest, NODES_PER_ELEMENT * largest * components, components, False)
