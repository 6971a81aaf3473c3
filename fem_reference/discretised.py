"""Finite-element solver with variable discretisation, for runs, error estimates and refinement.

The variable parameters are the elements over the contact radius, the increments, the tolerance, the
size of the meshed section, the overlap of the penalty method and the angular harmonics.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import ceil, pi
from typing import Any, ClassVar, Self

from contact_scene import FiniteElementDiscretisation
from contact_scene.body_pair import coupling
from contact_scene.contact_features import EDGE, SMOOTH, Features, has_cusp, is_singular
from contact_scene.discretised import (
    LINEAR,
    SHARES,
    TANGENTIAL,
    CoarseSolve,
    Discretisation,
    DiscretisedSolver,
    Fineness,
    Pairs,
    Refinement,
    Work,
    change_settings,
    slip_zone,
)
from contact_scene.quantities.stated_error import (
    Part,
)
from contact_scene.quantities.summary import ContactStatus
from contact_scene.reading.engineering_units import quantity
from contact_scene.solver_errors import SurfacesOverlap
from fem_reference.expected_radius import count_points, meshed_radius, sections_of
from fem_reference.fields import Increment, Method, Result
from fem_reference.memory import NODES_PER_ELEMENT, largest_bytes, matrix_bytes, run_bytes
from fem_reference.mesh.section_mesh import SectionMesh
from fem_reference.plan import ANGULAR, Path, Plan, plan
from fem_reference.solve import solve

# Solution paths in which friction changes the pressure, so that the pressure has a cusp on the
# axis. On the whole circle it does so for coupled bodies.
CUSPED = (Path.PRESSING_WITH_FRICTION, Path.TWISTING_WITH_FRICTION, Path.HARMONICS)
# Solution paths with the angular harmonic 0 alone, without torsion.
PRESSED = (Path.PRESSING, Path.PRESSING_WITH_FRICTION)
FEWEST_ELEMENTS = 4
SMALLEST_BOX = 5.0
FEWEST_HARMONICS = 2
LARGEST_OVERLAP = 1.0
FIRST_ELEMENTS = 8
MAX_ELEMENTS = 512
MAX_HARMONICS = 64
LEAST_OVERLAP = 1e-8
LARGEST_BOX = 1e6
# Unknowns whose work equals the overhead of an operation. Measured on the scenes of
# `tests/test_cost_estimate.py`: 600 to 2900.
ELEMENT_OVERHEAD = 32.0**2
# The factorisations of a solve take as long as this number of increments.
SET_UP_INCREMENTS = 50


@dataclass(frozen=True)
class ElementSolver(DiscretisedSolver):
    """Finite-element solver of one scene, with variable mesh, increments and tolerance.

    discretisation  mesh settings of the scene file or of a result
    chosen_plan     plan of a solved result (modelled effects, increments); None for the plan made
                    of the scene
    method          contact method: complementarity or penalty
    """

    discretisation: FiniteElementDiscretisation
    chosen_plan: Plan | None = None
    method: Method = Method.COMPLEMENTARITY

    table: ClassVar[str] = "fem_reference"
    settings: ClassVar[type[Discretisation]] = FiniteElementDiscretisation
    part: ClassVar[Part] = "elements"
    cells: ClassVar[str] = "elements"
    most: ClassVar[float] = MAX_ELEMENTS
    factorises_each_mesh: ClassVar[bool] = True

    @classmethod
    def of(cls, result: Result) -> Self:
        return cls(result.scene, result.discretisation, result.plan, result.method)

    @property
    def plan(self) -> Plan:
        return self.chosen_plan or plan(self.scene, penalty=self.method is Method.PENALTY)

    def run(self, progress: Any = None, store: Any = None) -> Result:
        return solve(self.scene, self.discretisation, self.method, progress, store)

    def run_fineness(self) -> Fineness:
        asked = self.discretisation
        return Fineness(asked, self.plan.increments, asked.tolerance)

    def run_memory(self) -> float:
        """Estimate the peak memory of a run, including libraries and figures [byte]."""
        points = count_points(self._sections, self.plan.path, self.discretisation.harmonics)
        return run_bytes(self._factoring_bytes(self._sections), points)

    def describe_space(self) -> Pairs:
        asked = self.discretisation
        radius = meshed_radius(self.scene, asked.contact_radius)
        chosen = "" if asked.contact_radius else ", estimated without friction"
        yield "method", _method_text(self.method, asked)
        name = "half width" if self.scene.indenter.is_line else "contact radius"
        yield name, f"{quantity(radius, 'm')}{chosen}"
        yield "mesh", _mesh_text(self._sections, asked)

    def describe_work(self) -> Pairs:
        """Yield the number of factorisations: one per body and angular harmonic, if there are."""
        motions, path = 2, self.plan.path
        if path in ANGULAR:
            motions = self.discretisation.harmonics + 1 + (path is Path.WHOLE_CIRCLE)
        elif path in PRESSED:
            motions = 1
        text = "one per body and angular harmonic" if motions > 1 else "one per body"
        yield "factorisations", f"{motions * len(self._sections)}, {text}"

    def describe_result(self, result: Result) -> Pairs:
        yield "method", _method_text(self.method, result.discretisation)
        sections = {id(each): each for each in result.sections if each is not None}
        yield "mesh", _mesh_text(sections.values(), result.discretisation)

    def solve(self, fineness: Fineness, progress: Any = None, store: Any = None) -> Result:
        """Solve the scene on a mesh of finite elements.

        The penalty method reduces the overlap of the surfaces to a limit. If this fails on coarse
        elements, the scene is solved again with the largest allowed overlap.

        fineness  mesh settings, increments and tolerance
        progress  function that is called after every increment, or None
        store     store of checkpoints from which an interrupted solve resumes, or None
        """
        scene = self.scene.with_increments(fineness.increments)
        mesh = change_settings(fineness.space, tolerance=fineness.tolerance)
        try:
            return solve(scene, mesh, self.method, progress, store)
        except SurfacesOverlap:
            looser = change_settings(mesh, overlap=LARGEST_OVERLAP)
            return solve(scene, looser, self.method, progress)

    def space_of(self, result: Result) -> FiniteElementDiscretisation:
        return result.discretisation

    def coarser(self, result: Result, share: float, more: int) -> FiniteElementDiscretisation:
        """Return mesh settings with fewer elements over the contact radius, for an error estimate.

        The error depends on the position of the contact edge within an element, so the coarse
        solves of an error estimate differ in this position. In one of them the elements are
        sized such that the edge lies in the middle of an element.

        result  result whose errors are estimated
        share   fraction of the elements of the result
        more    number of elements added to this fraction
        """
        mesh, radius = result.discretisation, result.radius
        count = max(FEWEST_ELEMENTS, ceil(share * mesh.elements_per_radius)) + more
        if (share, more) == SHARES[1][1:]:
            # The edge of the contact lies in the middle of an element.
            largest = max(increment.edge_radius for increment in result.increments)
            radius = largest * count / (count + 0.5)
        return change_settings(mesh, elements_per_radius=count, contact_radius=radius)

    def mesh_coarse_solves(
        self, base: FiniteElementDiscretisation, result: Result
    ) -> Iterator[CoarseSolve]:
        """Yield the coarse solves that change overlap, harmonics or size of the meshed section.

        Each of these solves measures the error that one mesh parameter causes. The overlap of the
        surfaces applies to the penalty method only. The angular harmonics apply to contacts solved
        with Fourier harmonics in the angle only.

        base    mesh settings of a coarse solve, in which the parameters are changed
        result  result whose errors are estimated
        """
        if self.method is Method.PENALTY:
            overlap = min(LARGEST_OVERLAP, 10 * base.overlap)
            ratio = overlap / base.overlap
            yield CoarseSolve("penalty", "ten times the overlap", "overlap", overlap, ratio)
        if result.plan.path in ANGULAR:
            few = max(FEWEST_HARMONICS, 2 * base.harmonics // 3)
            ratio = base.harmonics / few
            yield CoarseSolve("harmonics", "two thirds of the harmonics", "harmonics", few, ratio)
        box = max(section.outline.box for section in result.sections if section is not None)
        if (small := max(SMALLEST_BOX, box / 4)) <= box / 2:
            ratio = (box / small) ** self._section_power
            yield CoarseSolve("section", "smaller section", "box", small, ratio)

    def cell_sides(self, result: Result) -> tuple[float, ...]:
        return (result.radius / result.discretisation.elements_per_radius,)

    def unknowns(self, result: Result) -> int:
        """Estimate the number of displacements at the nodes of both sections, for one harmonic."""
        elements = sum(each.quads.shape[1] for each in result.sections if each is not None)
        return 2 * NODES_PER_ELEMENT * int(elements)

    def record_entry(self, space: FiniteElementDiscretisation) -> Mapping[str, Any]:
        return {"elements_per_radius": space.elements_per_radius}

    def measure_features(self, result: Result, end: Increment) -> Features:
        """Measure contact, stick zone and layers in half elements at the end of a load step.

        The sizes determine if the mesh resolves the contact. The limits are given in cells. A
        linear element resolves a feature as well as two cells, so half elements are counted.

        result  result of the finite-element solver
        end     state at the end of the load step
        """
        indenter, (side,) = self.scene.indenter, self.cell_sides(result)
        path = result.plan.path
        cusped = path in CUSPED or (path is Path.WHOLE_CIRCLE and coupling(self.scene)[0])
        thinnest = min(self.scene.body.thinnest, indenter.thinnest)
        area = 2 * side if end.is_line else 2 * pi * end.contact_radius * side
        per_length = LINEAR / side
        stick, annulus = slip_zone(end, per_length)
        return Features(
            contact=per_length * end.contact_radius,
            layer=per_length * thinnest,
            stick=stick,
            annulus=annulus,
            largest_order=EDGE if is_singular(indenter) else SMOOTH,
            infinite=is_singular(indenter),
            cusp=cusped or has_cusp(indenter),
            peak_by_edge=True,
            slip_by_line=True,
            slides=end.status is ContactStatus.GROSS_SLIDING,
            # The edge of the contact moves by whole elements: of 48 drawn layers of half to one
            # element the stated error of the radius does not cover 6, of 84 thicker layers none.
            layer_at_edge=LINEAR,
            largest={"contact_radius": side, "contact_area": area},
        )

    def neglected_errors(self, result: Result) -> Mapping[str, float]:
        """Return relative errors of tangential scalars due to the neglected slip across the load.

        The asymmetry of a friction map is added. The other errors are not zero for contacts solved
        with shear along the load only (Path.SHEARING), in plane strain excepted. In Mindlin's
        solution the slip is inclined to the load by at most α = ν/(4 - 2ν) with Poisson's ratio ν
        (Johnson 1985, section 7.2).
        Shear of this inclination carries 1 - α²/2 of the load, so the relative error is α²/2.
        Layers respond differently along and across a wave for any ν, so the largest α, that of
        ν = ½, applies to them.

        Slip amplitude and F1 are largest values in the contact. The slip of an annulus from the
        stick radius c varies around its mean like cos 2θ, by ν/(4 - 2ν) (φ - sin 4φ / 4) over
        sin 2φ / 2 - φ cos 2φ at the radius r = c / cos φ. The elements have the mean, so that these
        scalars lack this part: 2α for a narrow annulus (φ → 0) and α for gross slip (φ = π/2).
        """
        by_map = super().neglected_errors(result)
        if result.plan.path is not Path.SHEARING or self.scene.indenter.is_line:
            return by_map
        bodies = self.scene.body, self.scene.indenter
        ratios = (m.poisson_ratio for body in bodies for m in body.elastic_materials)
        nu = 0.5 if any(body.layers for body in bodies) else max(ratios)
        inclined = nu / (4 - 2 * nu)
        across = dict.fromkeys(TANGENTIAL, inclined**2 / 2)
        around = dict.fromkeys(("slip_amplitude", "ruiz_f1"), 2 * inclined)
        lost = across | around
        return {name: share + by_map.get(name, 0.0) for name, share in lost.items()}

    @property
    def parts(self) -> tuple[Part, ...]:
        penalty: tuple[Part, ...] = ("penalty",) if self.method is Method.PENALTY else ()
        harmonics: tuple[Part, ...] = ("harmonics",) if self.plan.path in ANGULAR else ()
        return (self.part, *penalty, "section", *harmonics)

    def first_space(self) -> FiniteElementDiscretisation:
        return change_settings(self.discretisation, elements_per_radius=FIRST_ELEMENTS)

    def refine_space(
        self, space: FiniteElementDiscretisation, by: Refinement
    ) -> FiniteElementDiscretisation:
        finer = change_settings(
            space,
            elements_per_radius=ceil(by.get(self.part, 1.0) * space.elements_per_radius - 1e-9),
            harmonics=min(MAX_HARMONICS, ceil(by.get("harmonics", 1.0) * space.harmonics)),
            overlap=max(LEAST_OVERLAP, space.overlap / by.get("penalty", 1.0)),
        )
        if "section" not in by:
            return finer
        box = max(section.outline.box for section in sections_of(self.scene, space))
        box *= by["section"] ** (1 / self._section_power)
        return change_settings(finer, box=min(LARGEST_BOX, box))

    def work(self, fineness: Fineness) -> Work:
        harmonics = fineness.space.harmonics if self.plan.path in ANGULAR else 1
        repetitions = harmonics * (SET_UP_INCREMENTS + sum(fineness.increments))
        return Work(fineness.space.elements_per_radius**2, repetitions, ELEMENT_OVERHEAD)

    def memory(self, fineness: Fineness) -> int:
        count = min(MAX_ELEMENTS, fineness.space.elements_per_radius)
        mesh = change_settings(fineness.space, elements_per_radius=count)
        sections = sections_of(self.scene, mesh)
        points = count_points(sections, self.plan.path, mesh.harmonics)
        return max(self._factoring_bytes(sections), int(matrix_bytes(points)))

    @property
    def _section_power(self) -> float:
        """Power of the section size L in the refinement factor:
        the error formula assumes 1/L², but the error in plane strain is like 1/L."""
        return 0.5 if self.scene.indenter.is_line else 1.0

    @cached_property
    def _sections(self) -> Sequence[SectionMesh]:
        """Meshes of a run, without those of equal bodies."""
        return sections_of(self.scene, self.discretisation)

    def _factoring_bytes(self, sections: Iterable[SectionMesh]) -> int:
        elements = max(each.quads.shape[1] for each in sections)
        return largest_bytes(elements, self.plan.path not in PRESSED)


@dataclass(frozen=True)
class PenaltySolver(ElementSolver):
    """Finite-element solver by a penalty, which is augmented until the overlap is small."""

    method: Method = Method.PENALTY


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
    parts, per, sizes = [], "contact radius", "contact radii"
    for section in sections:
        outline = section.outline
        if outline.plane:
            per, sizes = "half width", "half widths"
        parts.append(f"{section.quads.shape[1]} elements to {outline.box:.4g} {sizes}")
    return f"{fineness.elements_per_radius} elements per {per}; " + ", ".join(parts)
