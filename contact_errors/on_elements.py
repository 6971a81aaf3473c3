"""Errors of a finite-element result, from one with half the elements, one with half the increments
on these and, with harmonics, one with half as many again."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

from contact_errors import estimate
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
from contact_errors.prescribed import prescribed
from contact_errors.rules import Lengthscale, Rule
from contact_errors.values import Values, charged_by_increments, scale, values_of
from contact_results.cycles import fretting_cycles
from contact_scene import FiniteElementDiscretisation, Scene
from contact_scene.solver_errors import SolverError
from contact_scene.stated_error import EXACT, Companion, Part, StatedError, StatedErrors
from fem_reference import Increment, Method, Path, Result, solve
from fem_reference.mesh.section_outline import sufficient_box
from fem_reference.scales import Scales

Numbers = NDArray[np.float64]
Progress = Callable[[Increment], None]

# Friction acts back on the pressure, which has a cusp on the axis.
CUSPED = (Path.PRESSING_WITH_FRICTION, Path.HARMONICS)
FEWEST_ELEMENTS = 3  # of a companion, over the contact radius
# Fewer increments than these are doubled where others are halved: halves of them tell nothing.
FEW_INCREMENTS = 4
# In elements: below them a number has not converged, however small its differences are.
LEAST = {Lengthscale.CONTACT: 3.0, Lengthscale.STICK: 1.0, Lengthscale.ANNULUS: 0.5}


def stated_errors(
    result: Result, *, surface_stress: bool = False, progress: Progress | None = None
) -> StatedErrors:
    """Errors of all numbers at the ends of all steps; solves the companions.

    surface_stress  also of what takes the stress at the surface
    """

    def values(of: Result) -> tuple[Values, ...]:
        return values_of(of, fretting_cycles(of, surface_stress=surface_stress))

    cycles = fretting_cycles(result, surface_stress=surface_stress)
    fine, mesh, scene = values_of(result, cycles), _half(result), result.scene
    asked = [_Companion("half the elements", scene, mesh)]
    path_matters = any(result.plan.path_matters)
    if path_matters:
        asked.append(_Companion("half the elements, other increments", _recut(result), mesh))
    if result.plan.path is Path.HARMONICS:
        more = mesh.model_copy(update={"harmonics": -(-3 * mesh.harmonics // 2)})
        asked.append(_Companion("half the elements, half as many harmonics again", scene, more))
    solved = [one.solved(result, progress) for one in asked]
    companions = tuple(made for _, made in solved)
    coarse = solved[0][0]
    if coarse is None:
        exact = map(prescribed, scene.load_path())
        return StatedErrors(tuple(map(estimate.unknown, fine, exact)), companions)
    base = values(coarse)
    others = [
        estimate.differences(base, values(other)) if other else None for other, _ in solved[1:]
    ]
    levels = _Levels(
        result=result,
        values=fine,
        change=estimate.differences(fine, base),
        ratio=result.discretisation.elements_per_radius / mesh.elements_per_radius,
        by_path=others[0] if path_matters else None,
        by_harmonics=others[-1] if result.plan.path is Path.HARMONICS else None,
        charged=charged_by_increments(result, cycles),
    )
    return StatedErrors(tuple(levels.errors()), companions)


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
            found = solve(self.scene, self.mesh, run.method, progress)
        except SolverError as error:
            return None, made.model_copy(update={"refused": str(error)})
        spent = sum(increment.iterations for increment in found.increments)
        counts = {"increments": found.plan.increments, "iterations": spent}
        return found, made.model_copy(update=counts)


def _half(result: Result) -> FiniteElementDiscretisation:
    """Half the elements, the edge of the largest contact in the middle of one."""
    asked = result.discretisation
    count = max(FEWEST_ELEMENTS, asked.elements_per_radius // 2)
    largest = max(increment.contact_radius for increment in result.increments)
    update = {"elements_per_radius": count, "contact_radius": largest * count / (count + 0.5)}
    return asked.model_copy(update=update)


def _recut(result: Result) -> Scene:
    """Half the increments where the path matters, twice as many where these are few."""
    plan, steps = result.plan, []
    for step, count, matters in zip(
        result.scene.loading, plan.increments, plan.path_matters, strict=True
    ):
        other = 2 * count if count < FEW_INCREMENTS else count // 2
        steps.append(step.model_copy(update={"increments": other if matters else count}))
    return result.scene.model_copy(update={"loading": tuple(steps)})


@dataclass(frozen=True)
class _Levels:
    """A result beside its companions.

    values        of every step
    change        |values - those with half the elements|
    ratio         of the elements
    by_path       what other increments change, None where they gave no result or do not matter
    by_harmonics  what more harmonics change, None likewise
    charged       what the increments of the run tell themselves
    """

    result: Result
    values: Sequence[Values]
    change: Sequence[Values]
    ratio: float
    by_path: Sequence[Values] | None
    by_harmonics: Sequence[Values] | None
    charged: Sequence[Mapping[str, float]]

    def errors(self) -> Iterator[Mapping[str, StatedError]]:
        """Of every step."""
        scene, rules = self.result.scene, rules_of(self.result)
        largest = estimate.largest_so_far(self.values)
        steps = zip(scene.load_path(), self.result.steps, strict=True)
        for k, (ramp, end) in enumerate(steps):
            exact = prescribed(ramp)
            yield {
                name: EXACT
                if name in exact
                else self._error(k, end, name, rules.get(name), largest[k][name])
                for name in self.values[k]
            }

    def _error(
        self, k: int, end: Increment, name: str, rule: Rule | None, largest: Numbers
    ) -> StatedError:
        """Of one number at the end of step k."""
        change = self.change[k].get(name)
        contact, stick = self._elements(end)
        if rule is None or change is None or contact < 1:
            return estimate.UNKNOWN
        plan = self.result.plan
        scatter = largest * rule.scatter(_elements_per(rule.lengthscale, contact, stick))
        solved = estimate.PER_TOLERANCE * self.result.tolerance
        unsolved = solved * np.maximum(largest, scale(name, self.values[k]))
        parts: dict[Part, Numbers] = {
            "elements": estimate.by_cells(rule, change, self.ratio, scatter)
            + _missed(rule.lengthscale, contact, stick) * largest,
            "section": self._section(name) * largest,
            "tolerance": unsolved,
        }
        apart = estimate.contradicts(change, largest, unsolved)
        if end.overlap is not None and end.approach:
            overlap = end.overlap / abs(end.approach)
            parts["penalty"] = penalty_of(name, self._cusp) * overlap * largest
        if any(plan.path_matters[: k + 1]):
            if name in self.charged[k]:
                parts["increments"] = np.array([self.charged[k][name]])
            elif self.by_path is None or name not in self.by_path[k]:
                return estimate.UNKNOWN
            else:
                by_path = self.by_path[k][name]
                parts["increments"] = estimate.by_increments(rule, by_path, scatter)
                apart = apart or estimate.contradicts(by_path, largest, unsolved)
        if end.angles is not None:
            if self.by_harmonics is None or name not in self.by_harmonics[k]:
                return estimate.UNKNOWN
            part = HARMONICS * self.by_harmonics[k][name]
            if rule.lengthscale is Lengthscale.STICK:
                part = np.hypot(part, self._by_sectors(name, end))
            parts["harmonics"] = part
        carried = any(end.tangential_force or ()) or bool(end.torque)
        resolved = _resolved(rule.lengthscale, contact, stick, carried)
        if carried and rule.lengthscale is Lengthscale.ANNULUS and not np.any(largest):
            resolved = False  # there is slip, and none was seen
        return estimate.stated(parts, resolved and not apart)

    def _by_sectors(self, name: str, end: Increment) -> float:
        """Error of the stick radius [length] or area [length^2] by sectors."""
        reach, harmonics = end.contact_radius, self.result.discretisation.harmonics
        of_radius = STICK_BY_HARMONIC * reach / harmonics
        return of_radius if name == "stick_radius" else 2 * pi * reach * of_radius

    @property
    def _cusp(self) -> bool:
        """Whether friction acts back on the pressure."""
        return self.result.plan.path in CUSPED

    def _section(self, name: str) -> float:
        """Error of a quantity by the size of the section, relative; see `sufficient_box`."""
        scene, unit = self.result.scene, Scales(self.result.radius, 1.0)
        enough = 0.0
        for body, section in zip((scene.body, scene.indenter), self.result.sections, strict=True):
            if section is not None:
                sufficient = sufficient_box(unit.dimensionless(body))
                enough = max(enough, sufficient / section.outline.box)
        return (SECTION_OF_MOTION if name in MOTIONS else SECTION) * enough**2

    def _elements(self, end: Increment) -> tuple[float, float | None]:
        """Elements over the contact and the stick radius; None without shear."""
        per_length = self.result.discretisation.elements_per_radius / self.result.radius
        stick = None if end.stick_radius is None else per_length * end.stick_radius
        return per_length * end.contact_radius, stick


def _elements_per(lengthscale: Lengthscale, contact: float, stick: float | None) -> float:
    """Elements on what a quantity is resolved by."""
    if stick is None or lengthscale is Lengthscale.CONTACT:
        return contact
    if lengthscale is Lengthscale.STICK:
        return max(stick, 1.0)
    annulus = max(contact - stick, LEAST[Lengthscale.ANNULUS])
    if lengthscale is Lengthscale.ANNULUS:
        return annulus
    return contact / float(np.sqrt(1 + 1 / annulus))


def _missed(lengthscale: Lengthscale, contact: float, stick: float | None) -> float:
    """Part of the stick radius that a slip annulus of less than an element takes, unseen."""
    narrow = stick is not None and contact - stick < LEAST_ANNULUS
    return 1 / contact if narrow and lengthscale is Lengthscale.STICK else 0.0


def _resolved(lengthscale: Lengthscale, contact: float, stick: float | None, carried: bool) -> bool:
    """Whether differences between levels mean anything.

    carried  whether a tangential force or torque acts: then there is slip, seen or not
    """
    if contact < LEAST[Lengthscale.CONTACT]:
        return False
    if lengthscale is Lengthscale.STICK:
        return stick is not None and stick >= LEAST[Lengthscale.STICK]
    if lengthscale is Lengthscale.ANNULUS and stick is not None:
        annulus = contact - stick
        return not (carried or annulus > 0) or annulus >= LEAST[Lengthscale.ANNULUS]
    return True
