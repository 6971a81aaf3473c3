"""Run by finite elements with Coulomb's law at points (r, θ), as part of a case."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import hypot

from fem_reference import Path, Plan, Result, plan
from fem_reference.compliance.angular_grid import (
    end_grid,
    mid_grid,
)
from fem_reference.contact.method import ContactMethod
from fem_reference.expected_radius import meshed_radius
from fem_reference.fields import Increment
from fem_reference.history import solved_increments
from fem_reference.model import ContactModel
from verification.judging.run import SectionRun

ACROSS = "slip across the load"


@dataclass(frozen=True)
class PointsRun(SectionRun):
    """Run on two sets of points: points with the line of the load, and points halfway between.

    The result is that of the first set, with the mean stick area of both sets, because the errors
    of the stick area by sectors have opposite signs. Coulomb's law is a vector law even if the plan
    neglects slip across the load.
    """

    def solve(self) -> Result:
        """Solve on both sets of points; raises the exceptions of `fem_reference.solve`."""
        scene, discretisation = self.scene, self.discretisation
        decided = _with_vector_law(plan(scene))
        radius = meshed_radius(scene, discretisation.contact_radius)
        model = ContactModel.of(scene, discretisation, radius)
        own, between = (
            solved_increments(
                ContactMethod(model, decided, around=grid(discretisation.harmonics)),
                self.tolerance,
            )
            for grid in (end_grid, mid_grid)
        )
        means = (_with_mean_stick(*pair) for pair in zip(own, between, strict=True))
        increments = tuple(_counted(model, means))
        return Result(scene, discretisation, model.sections, radius, decided, increments)


def _with_vector_law(decided: Plan) -> Plan:
    if decided.path is Path.HARMONICS:
        return decided
    effects = tuple(
        replace(effect, on=True, why="required by this case") if effect.name == ACROSS else effect
        for effect in decided.effects
    )
    return replace(decided, path=Path.HARMONICS, effects=effects)


def _counted(model: ContactModel, increments: Iterator[Increment]) -> Iterator[Increment]:
    """Yield the increments with the number of sparse factorisations on both sets of points.

    The count is that of `solve`: it does not depend on the cache of matrices.
    """
    counted = 0
    for increment in increments:
        spent, counted = model.factorizations - counted, model.factorizations
        yield replace(increment, factorizations=spent)


def _with_mean_stick(own: Increment, between: Increment) -> Increment:
    if own.stick_radius is None or between.stick_radius is None:
        return own
    return replace(own, stick_radius=hypot(own.stick_radius, between.stick_radius) / 2**0.5)
