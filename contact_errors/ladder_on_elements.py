"""The ladder of the finite elements: elements, increments, section, penalty, harmonics."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from math import ceil, sqrt

import fem_reference
from contact_errors.cost_estimate import Work, estimated_seconds, work_on_elements
from contact_errors.ladder import Growth, Rung, unkept
from contact_errors.on_elements import Progress, cut, judged, rules_of
from contact_errors.values import values_of
from contact_results.cycles import fretting_cycles
from contact_scene import FiniteElementDiscretisation, Scene
from contact_scene.accuracy_reached import AccuracySettings
from contact_scene.free_memory import available_bytes
from contact_scene.standing import Keeper
from fem_reference import Method, Path
from fem_reference.expected_radius import meshed_radius
from fem_reference.memory import required_bytes
from fem_reference.mesh.section_mesh import SectionMesh
from fem_reference.model import ContactModel

FIRST_ELEMENTS, MOST_ELEMENTS = 8, 512
# Increments of the first rung over those that are chosen by default, where the scene names none.
FIRST_INCREMENTS = 0.5
MOST_HARMONICS = 64
# What harmonics change falls at least with their square.
LEAST_MORE_HARMONICS = 1.5
LEAST_TOLERANCE, LEAST_OVERLAP, LARGEST_BOX = 1e-12, 1e-8, 1e6
NODES_PER_ELEMENT = 4  # biquadratic: about one corner, two midsides and a middle each


@dataclass(frozen=True)
class ElementFineness:
    """How fine elements solve a scene: mesh, and increments of every step."""

    mesh: FiniteElementDiscretisation
    increments: tuple[int, ...]


Keeping = Callable[[ElementFineness], AbstractContextManager[Keeper | None]]
Watching = Callable[[ElementFineness], AbstractContextManager[Progress | None]]


@dataclass(frozen=True)
class ElementLadder:
    """See `ladder.Ladder`.

    asked   what is no matter of how fine, and the coarsest of the rest
    method  how contact and friction are enforced
    """

    scene: Scene
    asked: FiniteElementDiscretisation
    method: Method
    keeping: Keeping = unkept
    watching: Watching = unkept

    def first(self) -> ElementFineness:
        plan = fem_reference.plan(self.scene)
        counts = (
            ceil(FIRST_INCREMENTS * count) if matters and step.increments is None else count
            for step, count, matters in zip(
                self.scene.loading, plan.increments, plan.path_matters, strict=True
            )
        )
        return ElementFineness(
            _updated(self.asked, elements_per_radius=FIRST_ELEMENTS), tuple(counts)
        )

    def climbed(self, fineness: ElementFineness) -> Rung[ElementFineness]:
        began, began_processor = time.perf_counter(), time.process_time()
        with self.keeping(fineness) as keeper, self.watching(fineness) as progress:
            scene = cut(self.scene, fineness.increments)
            result = fem_reference.solve(scene, fineness.mesh, self.method, progress, keeper)
        stated, by_step = judged(result)
        return Rung(
            fineness=fineness,
            result=result,
            stated=stated,
            values=values_of(result, fretting_cycles(result)),
            rules=rules_of(result),
            by_step=by_step,
            seconds=time.perf_counter() - began,
            processor_seconds=time.process_time() - began_processor,
        )

    def refined(self, fineness: ElementFineness, by: Growth) -> ElementFineness:
        mesh, less = fineness.mesh, by.less
        matters = fem_reference.plan(self.scene).path_matters
        left = less.get("harmonics")
        more = 1.0 if left is None else max(LEAST_MORE_HARMONICS, left**-0.5)
        finer = _updated(
            mesh,
            elements_per_radius=ceil(by.cells * mesh.elements_per_radius),
            harmonics=min(MOST_HARMONICS, ceil(more * mesh.harmonics)),
            overlap=max(LEAST_OVERLAP, mesh.overlap * less.get("penalty", 1.0)),
            tolerance=max(LEAST_TOLERANCE, mesh.tolerance * less.get("tolerance", 1.0)),
        )
        if "section" in less:
            box = max(section.outline.box for section in self._sections(fineness))
            finer = _updated(finer, box=min(LARGEST_BOX, box / sqrt(less["section"])))
        return ElementFineness(finer, by.increments_of(fineness.increments, matters))

    def seconds(self, fineness: ElementFineness, like: Rung[ElementFineness]) -> float:
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
        mesh = _updated(fineness.mesh, elements_per_radius=elements)
        radius = meshed_radius(self.scene, mesh.contact_radius)
        sections = ContactModel.of(self.scene, mesh, radius).sections
        return [section for section in sections if section is not None]


def largest_bytes(sections: Iterable[SectionMesh], several_motions: bool) -> float:
    """Memory for the factors of the largest section [byte].

    several_motions  whether it moves along the angle too
    """
    largest = max(section.quads.shape[1] for section in sections)
    components = 3 if several_motions else 2
    return required_bytes(largest, NODES_PER_ELEMENT * largest * components, components, False)


def _updated(mesh: FiniteElementDiscretisation, **update: object) -> FiniteElementDiscretisation:
    return mesh.model_copy(update=update)
