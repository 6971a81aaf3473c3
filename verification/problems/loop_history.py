"""Fretting loop of the paper's figure 1, and its closed form at every increment."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from contact_scene import IsotropicMaterial
from contact_scene.loading import LoadStep
from verification.closed_forms.ruiz import CycledContact
from verification.closed_forms.tangential_history import TangentialHistory
from verification.norms import shear_error
from verification.problems import paper_scene as paper
from verification.problems.cattaneo_mindlin import (
    OVER_LIMIT,
    OVER_SLIDING_SHIFT,
)
from verification.problems.paper_scene import FRICTION, HERTZ
from verification.problems.problem import Problem
from verification.quantities import energy_between, force_along_x, shear_of, shift_along_x

if TYPE_CHECKING:
    from contact_results.cycles import FrettingCycle
    from semi_analytical import Increment, Result

SOURCE = "Mindlin and Deresiewicz 1953"
OVER_LARGEST_SHIFT = "the largest shift of the loop"
OVER_LARGEST_SLIP = "the largest slip amplitude"
OVER_LARGEST_WAY = "the largest way"
AMPLITUDE = 0.9  # of µW
LOADED, UNLOADED, RELOADED = 2, 3, 4  # loading steps that end at T*, -T*, T*
PRESSED = 1
WINDOW_PER_RADIUS = 2.2  # the contact takes 1/1.1 of the width of the window


def loop_steps(quarter: int) -> tuple[LoadStep, ...]:
    """Return the load steps from 0 to T*, -T* and T*, with `quarter` increments per T*."""
    return (
        paper.tangential_step(AMPLITUDE, quarter),
        paper.tangential_step(-AMPLITUDE, 2 * quarter),
        paper.tangential_step(AMPLITUDE, 2 * quarter),
    )


@dataclass(frozen=True)
class ExactLoop:
    """Mindlin and Deresiewicz's loop for two identical bodies of a material."""

    material: IsotropicMaterial

    @cached_property
    def virgin(self) -> TangentialHistory:
        """The contact before any tangential force."""
        return TangentialHistory(paper.partial_slip(self.material, 0.0))

    @property
    def sliding_shift(self) -> float:
        """Shift at which the whole contact slides [length]."""
        return self.virgin.virgin.sliding_shift

    @property
    def end(self) -> TangentialHistory:
        """State at the end of the first loading."""
        return self.virgin.loaded_to(AMPLITUDE * paper.FRICTION_LIMIT)

    @property
    def energy_per_cycle(self) -> float:
        """Area of the closed loop [force*length]: four times what the first loading takes."""
        return 4 * self.end.dissipated_energy

    def along(self, result: Result) -> Iterator[tuple[Increment, TangentialHistory]]:
        """Every increment with tangential force, and the closed form under the same force."""
        state = self.virgin
        for increment in result.increments:
            if increment.step > PRESSED:
                state = state.loaded_to(force_along_x(increment))
                yield increment, state

    def largest_shear_error(self, result: Result) -> float:
        """Return the largest Σ|q - q_exact| / Σµp of any increment [1]."""
        r = np.hypot(*result.grid.coordinates())
        return float(np.max([
            shear_error(shear_of(i), exact.shear(r), FRICTION * i.pressure)
            for i, exact in self.along(result)
        ]))  # fmt: skip

    def largest_shift_error(self, result: Result) -> float:
        """Return the largest difference of the shift from the closed form in any increment
        [length]."""
        return float(np.max([abs(shift_along_x(i) - e.shift) for i, e in self.along(result)]))

    @property
    def cycled(self) -> CycledContact:
        """The steady cycle, for ν = 0."""
        force = AMPLITUDE * paper.FRICTION_LIMIT
        return CycledContact(paper.partial_slip(self.material, force), paper.HERTZ.peak_pressure)

    def largest_slip_amplitude_error(self, result: Result) -> float:
        """Return the largest difference of the slip amplitude from the closed form in the
        contact [length]."""
        a = paper.HERTZ.contact_radius
        r = np.hypot(*result.grid.coordinates())
        expected = self.cycled.slip_amplitude(np.minimum(r, a))
        error = np.abs(loop_cycle(result).slip_amplitude - expected)
        return float(np.max(error[r < a]))

    def largest_slip_distance_error(self, result: Result) -> float:
        """Return the largest difference of the accumulated slip from the closed form in the contact
        [length].

        The slip reverses only where the force does, at ± its amplitude.
        """
        a, way = paper.HERTZ.contact_radius, result.steps[-1].slip_distance
        assert way is not None
        r = np.hypot(*result.grid.coordinates())
        expected = 5 * self.cycled.slip_amplitude(np.minimum(r, a))
        return float(np.max(np.abs(way - expected)[r < a]))

    def largest_stick_radius_error(self, result: Result) -> float:
        """Return the largest difference of the stick radius from the closed form [length]."""
        return float(np.max([
            abs((i.stick_radius or 0.0) - e.stick_radius) for i, e in self.along(result)
        ]))  # fmt: skip


def fretting_loop(title: str, material: IsotropicMaterial, quarter: int) -> Problem:
    """Create the problem of the loop of the paper's ball, with `quarter` increments per T*.

    The answer is that of the whole loop, and exact for ν = 0.
    """
    exact = ExactLoop(material)
    slip = float(exact.cycled.slip_amplitude(HERTZ.contact_radius))
    return Problem(
        paper.frictional(title, paper.paraboloid(material), material, *loop_steps(quarter)),
        (exact,),
        HERTZ.contact_radius,
        SOURCE,
        scales={
            OVER_LARGEST_SHIFT: exact.end.shift,
            OVER_SLIDING_SHIFT: exact.sliding_shift,
            OVER_LARGEST_SLIP: slip,
            OVER_LARGEST_WAY: 5 * slip,
            OVER_LIMIT: FRICTION * HERTZ.peak_pressure,
        },
        equations=(
            r"\Delta(T) = \Delta^* - 2 \Delta_1\left(\tfrac{T^* - T}{2}\right),\quad "
            r"\Delta_1(T) = \frac{3 \mu W}{4 a G^*} \left[1 - (1 - T/\mu W)^{2/3}\right]",
        ),
    )


def loop_energy(result: Result) -> float:
    """Return the energy dissipated from T* to -T* and back [force*length]."""
    return energy_between(result, LOADED, RELOADED)


def loop_cycle(result: Result) -> FrettingCycle:
    """Return the fretting cycle of the loop."""
    from contact_results.cycles import fretting_cycles

    (cycle,) = fretting_cycles(result)
    return cycle


def largest_f2(result: Result) -> float:
    """Return the largest value of Ruiz's second parameter of the loop [force²/length³]."""
    f2 = loop_cycle(result).ruiz_f2
    assert f2 is not None
    return float(np.max(f2))


def largest_imbalance(result: Result) -> float:
    """Return the largest energy imbalance of any increment, relative [1]."""
    return max(i.energy_imbalance for i in result.increments if i.energy_imbalance is not None)
