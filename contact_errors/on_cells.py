"""Errors of a semi-analytical result, from one with half the cells and one with half the
increments on these."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from contact_errors import estimate
from contact_errors.half_the_cells import Progress, on_wide_cells, recut
from contact_errors.prescribed import prescribed
from contact_errors.rules import Lengthscale, Rule, rules_for
from contact_errors.values import Values, charged_by_increments, scale, values_of
from contact_results.cycles import fretting_cycles
from contact_results.remarks import left_out
from contact_scene.stated_error import EXACT, Part, StatedError, StatedErrors
from semi_analytical import Result
from semi_analytical.plan import Coupling
from semi_analytical.resolution import Resolution, resolution

Numbers = NDArray[np.float64]

# In cells: below them a number has not converged, however small its differences are.
LEAST = {Lengthscale.CONTACT: 3.0, Lengthscale.STICK: 1.0, Lengthscale.ANNULUS: 0.5}
LEAST_LAYER, LEAST_WAVE = 1.0, 4.0
# What stands out of a random surface, in root mean squares: one place in a thousand.
HIGHEST = 3.0
# A slip annulus that is narrower scatters no less by its width.
NARROWEST = 0.5


def stated_errors(
    result: Result, *, surface_stress: bool = False, progress: Progress | None = None
) -> StatedErrors:
    """Errors of all numbers at the ends of all steps; solves the companions.

    surface_stress  also of what takes the stress at the surface
    """

    def values(of: Result) -> tuple[Values, ...]:
        return values_of(of, fretting_cycles(of, surface_stress=surface_stress))

    cycles = fretting_cycles(result, surface_stress=surface_stress)
    fine = values_of(result, cycles)
    wide, half_the_cells = on_wide_cells(result, result.plan, "half the cells", progress)
    if wide is None:
        exact = map(prescribed, result.scene.load_path())
        return StatedErrors(tuple(map(estimate.unknown, fine, exact)), (half_the_cells,))
    companions = [half_the_cells]
    coarse, path = values(wide), None
    if any(step.path_matters for step in result.plan.path):
        recut_plan = recut(result.plan)
        differs = "half the cells, other increments"
        other, made = on_wide_cells(result, recut_plan, differs, progress)
        companions.append(made)
        change = estimate.differences(coarse, values(other)) if other else None
        path = _Path(change, charged_by_increments(result, cycles))
    ratio = wide.grid.spacing[0] / result.grid.spacing[0]
    levels = _Levels(result, fine, estimate.differences(fine, coarse), ratio, path)
    return StatedErrors(tuple(levels.errors()), tuple(companions))


@dataclass(frozen=True)
class _Path:
    """What increments cost.

    change   by other increments, of every step; None where they gave no result
    charged  what the increments of the run tell themselves
    """

    change: Sequence[Values] | None
    charged: Sequence[Mapping[str, float]]


@dataclass(frozen=True)
class _Levels:
    """A result beside its companions.

    values  of every step
    change  |values - those on wide cells|
    ratio   of the spacings
    path    None where increments do not matter
    """

    result: Result
    values: Sequence[Values]
    change: Sequence[Values]
    ratio: float
    path: _Path | None

    @cached_property
    def left_out(self) -> float:
        """Pressure of the heights between the cells, over the peak."""
        return left_out(self.result)

    def errors(self) -> Iterator[Mapping[str, StatedError]]:
        """Of every step."""
        scene, plan = self.result.scene, self.result.plan
        rules = rules_for(scene.indenter, plan.coupling is not Coupling.NONE)
        largest = estimate.largest_so_far(self.values)
        path_matters = False
        steps = zip(scene.load_path(), plan.path, resolution(self.result), strict=True)
        for k, (ramp, increments, cells) in enumerate(steps):
            path_matters = path_matters or increments.path_matters
            exact = prescribed(ramp)
            yield {
                name: EXACT
                if name in exact
                else self._error(k, name, rules.get(name), largest[k][name], cells, path_matters)
                for name in self.values[k]
            }

    def _error(
        self,
        k: int,
        name: str,
        rule: Rule | None,
        largest: Numbers,
        cells: Resolution,
        path_matters: bool,
    ) -> StatedError:
        """Of one number at the end of step k."""
        change = self.change[k].get(name)
        if rule is None or change is None or cells.contact < 1:
            return estimate.UNKNOWN
        count = _cells_per(rule.lengthscale, cells)
        scatter = largest * rule.scatter(count)
        solved = estimate.PER_TOLERANCE * self.result.tolerance
        unsolved = solved * np.maximum(largest, scale(name, self.values[k]))
        parts: dict[Part, Numbers] = {
            "cells": estimate.by_cells(rule, change, self.ratio, scatter),
            "tolerance": unsolved,
        }
        if name == "peak_pressure":
            parts["cells"] = parts["cells"] + HIGHEST * self.left_out * largest
        apart = estimate.contradicts(change, largest, unsolved)
        if path_matters:
            assert self.path is not None
            if name in self.path.charged[k]:
                parts["increments"] = np.array([self.path.charged[k][name]])
            elif self.path.change is None or name not in self.path.change[k]:
                return estimate.UNKNOWN
            else:
                by_path = self.path.change[k][name]
                parts["increments"] = estimate.by_increments(rule, by_path, scatter)
                apart = apart or estimate.contradicts(by_path, largest, unsolved)
        return estimate.stated(parts, _resolved(rule.lengthscale, cells) and not apart)


def _cells_per(lengthscale: Lengthscale, cells: Resolution) -> float:
    """Cells on what a quantity is resolved by; fewer than it has where that is a combination."""
    if lengthscale is Lengthscale.STICK:
        return max(cells.stick or 0.0, 1.0)
    if lengthscale is Lengthscale.FILM:
        return min(cells.contact, cells.layer or cells.contact)
    if cells.annulus is None:
        return cells.contact
    annulus = max(cells.annulus, NARROWEST)
    if lengthscale is Lengthscale.ANNULUS:
        return float(np.sqrt(cells.contact * annulus))
    if lengthscale is Lengthscale.SLIP:
        return cells.contact / np.sqrt(1 + 1 / annulus)
    return cells.contact


def _resolved(lengthscale: Lengthscale, cells: Resolution) -> bool:
    """Whether differences between levels mean anything."""
    if cells.contact < LEAST[Lengthscale.CONTACT]:
        return False
    if cells.layer is not None and cells.layer < LEAST_LAYER:
        return False
    if cells.wave is not None and cells.wave < LEAST_WAVE:
        return False
    if lengthscale is Lengthscale.STICK:
        return cells.stick is not None and cells.stick >= LEAST[Lengthscale.STICK]
    if lengthscale in (Lengthscale.SLIP, Lengthscale.ANNULUS):
        return cells.annulus is None or cells.annulus >= LEAST[Lengthscale.ANNULUS]
    return True
