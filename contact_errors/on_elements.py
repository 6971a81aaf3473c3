"""Errors of a finite-element result, from one with half the elements, one with half the increments
on these and, with harmonics, one with half as many again."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate
from math import pi
from operator import or_

import numpy as np

from contact_errors import estimate
from contact_errors.by_step import ByStep
from contact_errors.coarse_film import CoarseFilm
from contact_errors.element_rules import (
    HARMONICS,
    LEAST_ANNULUS,
    MOTIONS,
    SECTION,
    SECTION_OF_MOTION,
    STICK_BY_HARMONIC,
    penalty_of,
    rules_of_elements,
)
from contact_errors.estimate import Numbers
from contact_errors.levels import Levels
from contact_errors.prescribed import prescribed
from contact_errors.rules import Lengthscale, Rule
from contact_errors.values import Values, charged_by_increments, lost_by_steps, values_of
from contact_results.cycles import fretting_cycles
from contact_scene import FiniteElementDiscretisation, Scene
from contact_scene.solver_errors import SolverError, SurfacesOverlap
from contact_scene.stated_error import Companion, Part, StatedErrors
from contact_scene.summary import ContactStatus
from fem_reference import Increment, Method, Path, Result, solve
from fem_reference.mesh.section_outline import sufficient_box
from fem_reference.scales import Scales

Progress = Callable[[Increment], None]

# Friction acts back on the pressure, which has a cusp on the axis.
CUSPED = (Path.PRESSING_WITH_FRICTION, Path.HARMONICS)
FEWEST_ELEMENTS = 3  # of a companion, over the contact radius
# In elements: below them a number has not converged, however small its differences are.
LEAST = {Lengthscale.CONTACT: 3.0, Lengthscale.STICK: 1.0, Lengthscale.ANNULUS: 0.5}
# Overlap, relative to what the bodies move, that a companion may leave where it cannot do with what
# the run may: the more it leaves the further it is from that.
ANY_OVERLAP = 1.0


def stated_errors(result: Result, *, progress: Progress | None = None) -> StatedErrors:
    """Errors of all numbers at the ends of all steps; solves the companions."""
    return judged(result, progress=progress)[0]


def judged(result: Result, *, progress: Progress | None = None) -> tuple[StatedErrors, ByStep]:
    """The same, and the step whose increments leave them; further companions if that is asked."""

    def values(of: Result) -> tuple[Values, ...]:
        return values_of(of, fretting_cycles(of))

    cycles = fretting_cycles(result)
    fine, mesh, scene = values_of(result, cycles), _half(result), result.scene
    plan = result.plan

    def otherwise_cut(increments: Sequence[int]) -> tuple[Values, ...] | None:
        other = _Companion("half the elements, other increments", cut(scene, increments), mesh)
        found, _ = other.solved(result, progress)
        return None if found is None else values(found)

    by_step = ByStep(plan.increments, plan.path_matters)
    asked = [_Companion("half the elements", scene, mesh)]
    path_matters = any(plan.path_matters)
    if path_matters:
        recut = cut(scene, by_step.recut_from(0))
        asked.append(_Companion("half the elements, other increments", recut, mesh))
    if result.plan.path is Path.HARMONICS:
        more = mesh.model_copy(update={"harmonics": -(-3 * mesh.harmonics // 2)})
        asked.append(_Companion("half the elements, half as many harmonics again", scene, more))
    solved = [one.solved(result, progress) for one in asked]
    companions = tuple(made for _, made in solved)
    coarse = solved[0][0]
    if coarse is None:
        exact = map(prescribed, scene.load_path())
        return StatedErrors(tuple(map(estimate.unknown, fine, exact)), companions), by_step
    base = values(coarse)
    others = [other and values(other) for other, _ in solved[1:]]
    by_harmonics = None
    if path_matters and others[0]:
        by_step = replace(by_step, companions=(base, others[0]), solved=otherwise_cut)
    if result.plan.path is Path.HARMONICS and others[-1]:
        by_harmonics = estimate.differences(base, others[-1])
    levels = Levels(
        scene=scene,
        ground=_Elements(result, by_harmonics),
        rules=[rules_of(result)] * len(fine),
        values=fine,
        change=estimate.differences(fine, base),
        ratio=result.discretisation.elements_per_radius / mesh.elements_per_radius,
        tolerance=result.tolerance,
        matters=tuple(accumulate(result.plan.path_matters, or_)),
        by_path=by_step.together,
        charged=charged_by_increments(result, cycles),
        lost=lost_by_steps(fine, cycles),
    )
    return StatedErrors(tuple(levels.errors()), companions), by_step


def rules_of(result: Result) -> Mapping[str, Rule]:
    """The laws of the errors of a result."""
    path = result.plan.path
    springs = result.method is Method.PENALTY and path is not Path.HARMONICS
    return rules_of_elements(result.scene.indenter, path in CUSPED, springs)


@dataclass(frozen=True)
class _Companion:
    """A scene on another mesh, and in what that differs from the run."""

    differs: str
    scene: Scene
    mesh: FiniteElementDiscretisation

    def solved(self, run: Result, progress: Progress | None) -> tuple[Result | None, Companion]:
        """Its result, None if it has none, and what it took."""
        made = Companion(
            differs=self.differs,
            elements_per_radius=self.mesh.elements_per_radius,
            increments=run.plan.increments,
        )
        try:
            found = self._on_any_mesh(run.method, progress)
        except SolverError as error:
            return None, made.model_copy(update={"refused": str(error)})
        spent = sum(increment.iterations for increment in found.increments)
        counts = {"increments": found.plan.increments, "iterations": spent}
        return found, made.model_copy(update=counts)

    def _on_any_mesh(self, method: Method, progress: Progress | None) -> Result:
        """Its result, with more overlap where its elements leave more than the run may."""
        try:
            return solve(self.scene, self.mesh, method, progress)
        except SurfacesOverlap:
            looser = self.mesh.model_copy(update={"overlap": ANY_OVERLAP})
            return solve(self.scene, looser, method, progress)


def _half(result: Result) -> FiniteElementDiscretisation:
    """Half the elements, the edge of the largest contact in the middle of one."""
    asked = result.discretisation
    count = max(FEWEST_ELEMENTS, asked.elements_per_radius // 2)
    largest = max(increment.contact_radius for increment in result.increments)
    update = {"elements_per_radius": count, "contact_radius": largest * count / (count + 0.5)}
    return asked.model_copy(update=update)


def cut(scene: Scene, increments: Sequence[int]) -> Scene:
    """A scene with these increments."""
    steps = [
        step.model_copy(update={"increments": count})
        for step, count in zip(scene.loading, increments, strict=True)
    ]
    return scene.model_copy(update={"loading": tuple(steps)})


@dataclass(frozen=True)
class _Elements:
    """See `levels.Ground`.

    by_harmonics  what more harmonics change, None where they gave no result or there are none
    """

    result: Result
    by_harmonics: Sequence[Values] | None
    part: Part = "elements"

    def carries(self, step: int) -> bool:
        return self._contact(step) >= 1

    def scatter(self, step: int, rule: Rule) -> float:
        return rule.scatter(self._per(step, rule))

    def _per(self, step: int, rule: Rule) -> float:
        contact, stick, lengthscale = self._contact(step), self._stick(step), rule.lengthscale
        if lengthscale is Lengthscale.FILM:
            return float(np.sqrt(contact * min(contact, self._film.layer)))
        if stick is None or lengthscale in (Lengthscale.CONTACT, Lengthscale.CUSP):
            return contact
        if lengthscale is Lengthscale.STICK:
            return max(stick, 1.0)
        annulus = max(contact - stick, LEAST[Lengthscale.ANNULUS])
        if lengthscale is Lengthscale.ANNULUS:
            return annulus
        return contact / float(np.sqrt(1 + 1 / annulus))

    def _slides(self, step: int) -> bool:
        """Whether all slips, along the force, which leaves the pressure no cusp."""
        return self.result.steps[step].status is ContactStatus.GROSS_SLIDING

    def resolved(self, step: int, name: str, rule: Rule, largest: Numbers) -> bool:
        contact, stick, lengthscale = self._contact(step), self._stick(step), rule.lengthscale
        if contact < LEAST[Lengthscale.CONTACT]:
            return False
        film = self._film
        if film.hides(name) or (film.is_thin and lengthscale is Lengthscale.FILM):
            return False
        if lengthscale is Lengthscale.CUSP and self._slides(step):
            return True
        if lengthscale in (Lengthscale.STICK, Lengthscale.CUSP):
            return stick is not None and stick >= LEAST[Lengthscale.STICK]
        if lengthscale is not Lengthscale.ANNULUS:
            return True
        if self._carries_shear(step) and not np.any(largest):
            return False  # there is slip, and none was seen
        annulus = 0.0 if stick is None else contact - stick
        slips = stick is not None and (self._carries_shear(step) or annulus > 0)
        return not slips or annulus >= LEAST[Lengthscale.ANNULUS]

    def beside(
        self, step: int, name: str, rule: Rule, largest: Numbers
    ) -> Mapping[Part, Numbers] | None:
        end = self.result.steps[step]
        parts: dict[Part, Numbers] = {"section": self._section(name) * largest}
        if rule.lengthscale is Lengthscale.STICK:
            parts["elements"] = self._missed(step) * largest
        if self._film.hides(name):
            left = self._film.left(name, end, largest)
            if left is None:
                return None
            parts["elements"] = left
        if end.overlap is not None and end.approach:
            overlap = end.overlap / abs(end.approach)
            cusp = self.result.plan.path in CUSPED
            parts["penalty"] = penalty_of(name, cusp) * overlap * largest
        if end.angles is not None:
            if self.by_harmonics is None or name not in self.by_harmonics[step]:
                return None
            part = HARMONICS * self.by_harmonics[step][name]
            if rule.lengthscale is Lengthscale.STICK:
                part = np.hypot(part, self._by_sectors(name, end))
            parts["harmonics"] = part
        return parts

    def _contact(self, step: int) -> float:
        """Elements over the contact radius."""
        return self._per_length * self.result.steps[step].contact_radius

    def _stick(self, step: int) -> float | None:
        """Elements over the stick radius; None without shear."""
        radius = self.result.steps[step].stick_radius
        return None if radius is None else self._per_length * radius

    @property
    def _film(self) -> CoarseFilm:
        """The thinnest layer on these elements."""
        rubbed = self.result.plan.path in CUSPED
        return CoarseFilm.of(self.result.scene, self._per_length, rubbed)

    @property
    def _per_length(self) -> float:
        return self.result.discretisation.elements_per_radius / self.result.radius

    def _carries_shear(self, step: int) -> bool:
        """Whether a tangential force or torque acts: then there is slip, seen or not."""
        end = self.result.steps[step]
        return any(end.tangential_force or ()) or bool(end.torque)

    def _missed(self, step: int) -> float:
        """Part of the stick radius that a slip annulus of less than an element takes, unseen."""
        contact, stick = self._contact(step), self._stick(step)
        return 1 / contact if stick is not None and contact - stick < LEAST_ANNULUS else 0.0

    def _by_sectors(self, name: str, end: Increment) -> float:
        """Error of the stick radius [length] or area [length^2] by sectors."""
        reach, harmonics = end.contact_radius, self.result.discretisation.harmonics
        of_radius = STICK_BY_HARMONIC * reach / harmonics
        return of_radius if name == "stick_radius" else 2 * pi * reach * of_radius

    def _section(self, name: str) -> float:
        """Error of a quantity by the size of the section, relative; see `sufficient_box`."""
        scene, unit = self.result.scene, Scales(self.result.radius, 1.0)
        enough = 0.0
        for body, section in zip((scene.body, scene.indenter), self.result.sections, strict=True):
            if section is not None:
                sufficient = sufficient_box(unit.dimensionless(body))
                enough = max(enough, sufficient / section.outline.box)
        return (SECTION_OF_MOTION if name in MOTIONS else SECTION) * enough**2
