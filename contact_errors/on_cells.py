"""Errors of a semi-analytical result, from one with half the cells and one with half the
increments on these."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate, pairwise
from operator import or_

import numpy as np
from scipy import ndimage

from contact_errors import estimate
from contact_errors.by_step import ByStep, undone
from contact_errors.estimate import Numbers
from contact_errors.half_the_cells import Progress, on_wide_cells
from contact_errors.levels import Levels
from contact_errors.prescribed import prescribed
from contact_errors.rules import EDGES, RIM, Lengthscale, Rule, rules_for
from contact_errors.values import Values, charged_by_increments, lost_by_steps, values_of
from contact_results.cycles import fretting_cycles
from contact_results.remarks import left_out
from contact_scene.geometry import SmoothTip
from contact_scene.stated_error import Part, StatedErrors
from contact_scene.summary import ContactStatus
from semi_analytical import Increment, Result
from semi_analytical.edge.film_response import film_law
from semi_analytical.plan import Coupling
from semi_analytical.resolution import Resolution, resolution

# In cells: below them a number has not converged, however small its differences are.
LEAST = {
    Lengthscale.CONTACT: 4.0,
    Lengthscale.TURN: 8.0,
    Lengthscale.STICK: 1.0,
    Lengthscale.ANNULUS: 0.5,
}
LEAST_LAYER, LEAST_WAVE = 1.0, 4.0
# Of the contact with its edges inside the cells, over a layer thinner than it is wide: an edge that
# is fitted over all of the contact is bent by the layer, and on half the cells alike.
LEAST_OVER_LAYER = 6.0
# A film that is much stiffer than its base bends and stands on its rim, within its thickness t of
# the edge: there the largest mean of a cell exceeds the peak by this part of it times t^-5/2 at
# most, t in cells (films 8 to 80 times as stiff, of 1 to 13 cells).
RIM_OF_FILM, ORDER_OF_RIM = 0.45, 2.5
# One of a quarter to seven tenths of the contact radius bends over all of the contact: a fitted
# edge is off by this part of the radius times m^-3/2 at most, m cells per radius, and on half the
# cells alike (films 5 to 100 times as stiff as their base).
BENDS, OVER_CONTACT = 5.0, (0.25, 0.7)
EDGE_OF_FILM, ORDER_OF_EDGE = 0.2, 1.5
# Part of what the last round of an edge changes that its extrapolation leaves (by the approach of
# drawn scenes: .08 in the median).
LEFT_BY_ROUNDS = 0.1
# What a turn scatters with its load on a middle or an edge of cells, over the most.
BESIDE_MIRRORS = 0.3
# What stands out of a random surface, in root mean squares: one place in a thousand.
HIGHEST = 3.0
# A slip annulus that is narrower scatters no less by its width.
NARROWEST = 0.5


def stated_errors(result: Result, *, progress: Progress | None = None) -> StatedErrors:
    """Errors of all numbers at the ends of all steps; solves the companions."""
    return judged(result, progress=progress)[0]


def judged(result: Result, *, progress: Progress | None = None) -> tuple[StatedErrors, ByStep]:
    """The same, and the step whose increments leave them; further companions if that is asked."""

    def values(of: Result) -> tuple[Values, ...]:
        return values_of(of, fretting_cycles(of))

    plan, cycles = result.plan, fretting_cycles(result)
    matters = tuple(step.path_matters for step in plan.path)
    by_step = ByStep(plan.increments, matters)
    fine = values_of(result, cycles)
    wide, half_the_cells = on_wide_cells(result, result.plan, "half the cells", progress)
    if wide is None:
        exact = map(prescribed, result.scene.load_path())
        unknown = StatedErrors(tuple(map(estimate.unknown, fine, exact)), (half_the_cells,))
        return unknown, by_step
    companions = [half_the_cells]
    coarse = values(wide)

    def otherwise_cut(counts: Sequence[int]) -> tuple[Values, ...] | None:
        differs = "half the cells, other increments"
        found, made = on_wide_cells(result, plan.cut_into(counts), differs, progress)
        companions.append(made)
        return None if found is None else values(found)

    if any(matters):
        other = otherwise_cut(by_step.recut_from(0))
        if other is not None:
            by_step = replace(by_step, companions=(coarse, other), solved=otherwise_cut)
    levels = Levels(
        scene=result.scene,
        ground=_Cells(result),
        rules=[
            rules_at(result, [end], [beside])
            for end, beside in zip(result.steps, wide.steps, strict=True)
        ],
        values=fine,
        change=estimate.differences(fine, coarse),
        ratio=wide.grid.spacing[0] / result.grid.spacing[0],
        tolerance=result.tolerance,
        matters=tuple(accumulate(matters, or_)),
        by_path=by_step.by_squares if undone(result.scene) else by_step.together,
        charged=charged_by_increments(result, cycles),
        lost=lost_by_steps(fine, cycles),
    )
    return StatedErrors(tuple(levels.errors()), tuple(companions)), by_step


def rules_at(
    result: Result, states: Sequence[Increment], beside: Sequence[Increment] = ()
) -> Mapping[str, Rule]:
    """The laws of the errors of a result.

    states  where they shall hold
    beside  those of its companion there
    """
    scene, coupled = result.scene, result.plan.coupling is not Coupling.NONE
    return rules_for(
        scene.indenter,
        cusp=coupled,
        edges=all(state.edge_change is not None for state in states),
        alone=any(state.edge_change is None for state in beside),
        layers=bool(scene.body.layers or scene.indenter.layers),
        film=not coupled and film_law(scene.body, scene.indenter, result.grid.spacing) is not None,
        border=all(state.edge_report is None or state.edge_report.border for state in states),
    )


@dataclass(frozen=True)
class _Cells:
    """See `levels.Ground`."""

    result: Result
    part: Part = "cells"

    @cached_property
    def _at(self) -> Sequence[Resolution]:
        return resolution(self.result)

    @cached_property
    def _left_out(self) -> float:
        """Pressure of the heights between the cells, over the peak."""
        return left_out(self.result)

    def carries(self, step: int) -> bool:
        return self._at[step].contact >= 1

    def beside(
        self, step: int, name: str, rule: Rule, largest: Numbers
    ) -> Mapping[Part, Numbers] | None:
        if rule.lengthscale is Lengthscale.LOST and self.result.scene.indenter.rim is not None:
            return self._at_rim(step, largest)
        change = self.result.steps[step].edge_change
        left_out = 0.0
        if change is not None and name in EDGES:
            # Rounds stop at what cells leave anyway, whatever the tolerance.
            left_out = LEFT_BY_ROUNDS * change
        if name == "peak_pressure":
            left_out += HIGHEST * self._left_out + self._rim_of_film(step)
        elif change is not None and name in ("contact_radius", "contact_area"):
            left_out += (1 if name == "contact_radius" else 2) * self._edge_of_film(step)
        if rule.lengthscale is Lengthscale.STICK and self._hides_stick(step):
            return {"cells": left_out * largest + self._cell(name)}
        return {"cells": left_out * largest} if left_out else {}

    def _hides_stick(self, step: int) -> bool:
        """Whether no cell sticks, though not all slides: what does is narrower than a cell."""
        return self._at[step].stick == 0.0 and not self._slides(step)

    def _cell(self, name: str) -> float:
        """Radius or area of as much stick as cells may hide."""
        widest = max(self.result.grid.spacing)
        return widest if name == "stick_radius" else float(np.pi * widest**2)

    def _at_rim(self, step: int, largest: Numbers) -> Mapping[Part, Numbers] | None:
        """Slip goes with the motions, as these with the radius that cells make of a rim. Where no
        cell slips there, what pressure drags along does so within one, and nobody tells how far."""
        cells = self._at[step]
        if cells.annulus is None and self.result.plan.coupling is not Coupling.NONE:
            return None
        return {"cells": RIM.factor * RIM.scatter(cells.contact) * largest}

    def _edge_of_film(self, step: int) -> float:
        """What a fitted edge leaves wrong of the radius, over itself, below a film that bends over
        all of the contact; 0 elsewhere."""
        cells, (least, most) = self._at[step], OVER_CONTACT
        if cells.layer is None or not least < cells.layer / cells.contact < most:
            return 0.0
        scene = self.result.scene
        bends = any(
            upper.young_modulus >= BENDS * lower.young_modulus
            for body in (scene.body, scene.indenter)
            for upper, lower in pairwise(body.elastic_materials)
        )
        return float(EDGE_OF_FILM * cells.contact**-ORDER_OF_EDGE) if bends else 0.0

    def _rim_of_film(self, step: int) -> float:
        """What cells leave wrong of a peak at the edge of the contact, over itself; 0 elsewhere."""
        cells, end = self._at[step], self.result.steps[step]
        if cells.layer is None:
            return 0.0
        place = np.unravel_index(np.argmax(end.pressure), end.pressure.shape)
        to_edge = ndimage.distance_transform_edt(end.in_contact)[place]
        if to_edge > min(cells.layer, cells.contact / 2) + 1:
            return 0.0
        return float(RIM_OF_FILM * max(cells.layer, LEAST_LAYER) ** -ORDER_OF_RIM)

    def scatter(self, step: int, rule: Rule) -> Numbers | float:
        found = rule.scatter(self._per(step, rule))
        return found * self._off_mirrors(step) if rule.lengthscale is Lengthscale.TURN else found

    def _off_mirrors(self, step: int) -> Numbers | float:
        """|sin 2πf| along y and x of a load at the part f of a cell: a contact that is its own
        mirror image and has its middle on a middle or an edge of cells turns by no error."""
        result, end = self.result, self.result.steps[step]
        mirrored = isinstance(result.scene.indenter, SmoothTip)
        if not mirrored or result.plan.coupling is not Coupling.NONE or end.moment is None:
            return 1.0
        place = end.moment / (end.normal_force * np.array(result.grid.spacing[::-1]))
        return np.hypot(np.sin(2 * np.pi * place), BESIDE_MIRRORS)

    def _per(self, step: int, rule: Rule) -> float:
        """Fewer than there are where the length scale is a combination."""
        cells, lengthscale = self._at[step], rule.lengthscale
        if lengthscale is Lengthscale.STICK:
            return max(cells.stick or 0.0, 1.0)
        if lengthscale is Lengthscale.FILM:
            return min(cells.contact, cells.layer or cells.contact)
        if cells.annulus is None:
            return cells.contact
        annulus = max(cells.annulus, NARROWEST)
        if lengthscale is Lengthscale.ANNULUS:
            return float(np.sqrt(cells.contact * annulus))
        if lengthscale is Lengthscale.LOST:
            return float((cells.contact * annulus**4) ** 0.2)
        if lengthscale is Lengthscale.SLIP:
            return float(cells.contact / np.sqrt(1 + 1 / annulus))
        return cells.contact

    def _slides(self, step: int) -> bool:
        """Whether all slips, along the force, which leaves the pressure no cusp."""
        return self.result.steps[step].status is ContactStatus.GROSS_SLIDING

    def resolved(self, step: int, name: str, rule: Rule, largest: Numbers) -> bool:
        cells, lengthscale = self._at[step], rule.lengthscale
        if cells.contact < LEAST[Lengthscale.CONTACT]:
            return False
        if cells.layer is not None and cells.layer < LEAST_LAYER:
            return False
        if cells.wave is not None and cells.wave < LEAST_WAVE:
            return False
        if name in EDGES and self.result.steps[step].edge_change is not None:
            thin = cells.layer is not None and cells.layer < 2 * cells.contact
            if thin and cells.contact < LEAST_OVER_LAYER:
                return False
        if lengthscale is Lengthscale.TURN:
            return cells.contact >= LEAST[Lengthscale.TURN]
        if lengthscale is Lengthscale.CUSP and self._slides(step):
            return True
        if lengthscale in (Lengthscale.STICK, Lengthscale.CUSP):
            return cells.stick is not None and cells.stick >= LEAST[Lengthscale.STICK]
        if lengthscale in (Lengthscale.SLIP, Lengthscale.ANNULUS, Lengthscale.LOST):
            return cells.annulus is None or cells.annulus >= LEAST[Lengthscale.ANNULUS]
        return True
