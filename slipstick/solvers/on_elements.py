"""Adapter of the finite-element solvers to the solver interface of the commands.

The solvers compute bodies of revolution on their section.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import fem_reference
from contact_scene import FiniteElementDiscretisation, Scene
from contact_scene.reading.engineering_units import quantity
from contact_scene.stepping.checkpoint import CheckpointStore
from fem_reference import Method, Path, Plan, Result
from fem_reference.expected_radius import count_points, meshed_radius, sections_of
from fem_reference.memory import largest_bytes, run_bytes
from fem_reference.mesh.section_mesh import SectionMesh
from fem_reference.plan import ANGULAR
from slipstick.solvers.solver import Pairs, Progress, Solver, increments_text

if TYPE_CHECKING:
    from contact_errors.on_elements import ElementSolver


@dataclass(frozen=True)
class OnElements(Solver):
    """Finite-element solver of bodies of revolution, with the interface `solver.Solver`.

    method  contact method: complementarity or penalty
    """

    method: Method

    table = "fem_reference"
    discretisation = FiniteElementDiscretisation

    def plan(self, scene: Scene, fineness: FiniteElementDiscretisation) -> Plan:
        return fem_reference.plan(scene, penalty=self.method is Method.PENALTY)

    def solve(
        self,
        scene: Scene,
        fineness: FiniteElementDiscretisation,
        plan: Plan,
        progress: Progress | None = None,
        store: CheckpointStore | None = None,
    ) -> Result:
        return fem_reference.solve(scene, fineness, self.method, progress, store)

    @property
    def refinable(self) -> type[ElementSolver]:
        from contact_errors.on_elements import ElementSolver

        return ElementSolver

    def refined(self, scene: Scene, fineness: Any, stress: bool = False) -> ElementSolver:
        return self.refinable(scene, fineness, method=self.method)

    def work(self, scene: Scene, fineness: FiniteElementDiscretisation, plan: Plan) -> Pairs:
        """Yield names and texts of mesh, increments, factorisations, time and memory of a solve."""
        radius = meshed_radius(scene, fineness.contact_radius)
        sections = sections_of(scene, fineness)
        chosen = "" if fineness.contact_radius else ", estimated without friction"
        yield "method", _method_text(self.method, fineness)
        yield "contact radius", f"{quantity(radius, 'm')}{chosen}"
        yield "mesh", _mesh_text(sections, fineness)
        yield "tolerance", f"{fineness.tolerance:.3g}"
        yield "increments", increments_text(plan.increments)
        motions = _count_harmonics(plan, fineness)
        text = "one per body and angular harmonic" if motions > 1 else "one per body"
        yield "factorisations", f"{motions * len(sections)}, {text}"
        yield self.time(scene, fineness)
        largest = largest_bytes(max(each.quads.shape[1] for each in sections), motions > 1)
        points = count_points(sections, plan.path, fineness.harmonics)
        needed = run_bytes(largest, points)
        yield "memory", f"about {needed / 2**20:.0f} MiB"

    def layout(self, result: Result) -> Pairs:
        yield "method", _method_text(self.method, result.discretisation)
        sections = {id(each): each for each in result.sections if each is not None}
        yield "mesh", _mesh_text(sections.values(), result.discretisation)


def _method_text(method: Method, fineness: FiniteElementDiscretisation) -> str:
    """Return the text of the contact method of finite elements with its penalty parameters."""
    if method is Method.COMPLEMENTARITY:
        return "finite elements, complementarity: no penalty"
    return (
        f"finite elements, penalty of {fineness.penalty:g} contact moduli per element, "
        f"augmented until {fineness.overlap:g} of the approach is left as overlap"
    )


def _mesh_text(sections: Iterable[SectionMesh], fineness: FiniteElementDiscretisation) -> str:
    """Return the text of the number of elements and of the size of the meshed sections."""
    parts = []
    for section in sections:
        outline = section.outline
        parts.append(f"{section.quads.shape[1]} elements to {outline.box:.4g} contact radii")
    return f"{fineness.elements_per_radius} elements per contact radius; " + ", ".join(parts)


def _count_harmonics(plan: Plan, fineness: FiniteElementDiscretisation) -> int:
    """Return the number of angular harmonics whose stiffness matrix a solve factorises.

    The command `slipstick plan` prints the number of factorisations.

    plan      solution path of the solve
    fineness  settings with the number of harmonics
    """
    if plan.path in ANGULAR:
        return fineness.harmonics + 1 + (plan.path is Path.WHOLE_CIRCLE)
    return 1 if plan.path in (Path.PRESSING, Path.PRESSING_WITH_FRICTION) else 2
