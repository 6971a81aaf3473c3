"""Histories of bodies that couple: to and fro, aside, and unloaded, seen in several ways."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

import semi_analytical
from contact_scene import LoadStep
from contact_scene.residuals import worst
from verification.cases.coupled_contacts import BACK, BARE, FILM, PRESSED, PUSHED
from verification.cases.turned import difference_after_quarter, difference_of_motion
from verification.judging.case import Case, Comparison, Finding, Level, Quantity, Required
from verification.judging.run import OTHER_NORMS, SOLVER_TOLERANCE, Run, SectionRun
from verification.observed.laws import observed
from verification.problems.reference import ReferenceKind, identity
from verification.quantities import shear_of, shift_along_x

if TYPE_CHECKING:
    import fem_reference

TURN = 30.0  # degrees
# Cells, elements per radius, harmonics.
SIZES = {Level.QUICK: (32, 16, 4), Level.STANDARD: (64, 32, 8), Level.FULL: (128, 64, 12)}

ISOTROPY = 5e-3  # on the quick grid
ISOTROPY_WHY = (
    "set by hand: four times what square cells leave at the edges of contact and stick on 32 of "
    "them, in proportion to the cell on others"
)
SOLVERS = {"shift": 5e-3, "energy": 1.5e-2, "approach": 1e-3}  # on the quick discretisations


def coupled_history(level: Level = Level.QUICK) -> Case:
    """The case, on finer discretisations at higher levels."""
    return coupled_history_on(*SIZES[level])


def coupled_history_on(cells: int, elements: int, harmonics: int) -> Case:
    """The case on a square grid of so many cells per side, and with so many elements per radius and
    harmonics."""
    # The history follows the states before the edge correction: so do the identities.
    runs = [replace(BARE.run(cells, degrees), edge="off") for degrees in (0.0, TURN, 90.0)]
    films = [replace(FILM.run(cells, degrees), edge="off") for degrees in (0.0, 90.0)]
    section = BARE.section(elements, harmonics)
    led = {run.label: LedByMotion() for run in (runs[0], films[0])}
    return Case(
        name="coupled_history",
        title="To and fro, aside and unloaded, with coupling",
        problem=(
            "A rigid ball pressed on bodies whose pressure and shear act on each other, pushed by "
            "two thirds of µW, pulled back as far, pushed aside and unloaded under that force. "
            "What a surface remembers of a reversal, of another direction and of unloading has no "
            "closed form here. The same history is therefore seen turned, led by the motion that "
            "it took instead of by its forces, and solved by finite elements."
        ),
        runs=(*runs, *films, section),
        quantities=tuple(q for label, again in led.items() for q in _led_back(label, again)),
        findings=tuple(
            Finding(
                "led_by_motion_iterations", "iterations of the history led by its motion", "",
                label, again.iterations,
                "work of the solve behind led_by_motion, beside the runs of this case; its motions "
                "are known only after the run",
            )
            for label, again in led.items()
        ),
        comparisons=(
            *(
                Comparison(
                    "turned_by_90", f"{contact.name}: difference of pressure, shear and shift "
                    "after a right angle", (b.label, a.label), difference_after_quarter,
                    100 * SOLVER_TOLERANCE,
                    "square cells turn into themselves; residuals of two solves, answered by "
                    "tractions and carried through the history",
                    "isotropic bodies and friction",
                )
                for contact, a, b in ((BARE, runs[0], runs[2]), (FILM, films[0], films[1]))
            ),
            Comparison(
                f"turned_by_{TURN:g}", f"{BARE.name}: difference of shift and energy lost after "
                f"{TURN:g}°", (runs[1].label, runs[0].label), difference_of_motion(TURN),
                ISOTROPY * SIZES[Level.QUICK][0] / cells, ISOTROPY_WHY,
                "isotropic bodies and friction",
            ),
            *_both_solvers(section, runs[0], cells),
        ),
        limits=(
            "The increments are the same for all, so that their error is not seen.",
        ),
    )  # fmt: skip


def _led_back(label: str, led: LedByMotion) -> tuple[Quantity, ...]:
    return (
        Quantity(
            "led_by_motion", "difference from the same history led by its approach and shift, in "
            "any increment: pressure, shear; infinite if the solver gives that history up",
            "", label, led.difference,
            identity(0.0, "force and motion are conjugate: what leads does not matter"),
            Required(100 * SOLVER_TOLERANCE, "residuals of two solves, answered by tractions and "
                     "carried through the history"),
            1.0, "the pressure",
        ),
        Quantity(
            "laws_led_by_motion", "largest violation of a law of contact and friction, or part of "
            "the energy unaccounted for, in the history led by its motion; infinite if the solver "
            "gives it up", "", label, led.violation,
            identity(0.0, "the laws do not ask what leads"),
            Required(OTHER_NORMS * SOLVER_TOLERANCE, "as of every run"),
            1.0, "dimensionless",
        ),
    )  # fmt: skip


class LedByMotion:
    """A result's history once more, led by its own approach and shift increment by increment.

    The motions are not known before the result, so this is no run of the case. It is solved once
    for all that is measured on it; what the solver gives up is infinitely far off.
    """

    def __init__(self) -> None:
        self._solved: tuple[semi_analytical.Result, semi_analytical.Result | None] | None = None

    def difference(self, result: semi_analytical.Result) -> float:
        """Σ|Δp|/Σp or Σ|Δq|/Σp, the larger in any increment."""
        led = self._led(result)
        if led is None:
            return math.inf
        return worst(
            *(
                float(np.sum(np.abs(field(a) - field(b))) / np.sum(b.pressure))
                for a, b in zip(led.increments, result.increments, strict=True)
                for field in (_pressure, shear_of)
            )
        )

    def violation(self, result: semi_analytical.Result) -> float:
        """What the laws see in it, dimensionless."""
        led = self._led(result)
        if led is None:
            return math.inf
        violation, imbalance = observed(led)
        return worst(violation, imbalance or 0.0)

    def iterations(self, result: semi_analytical.Result) -> float:
        """Of all its increments."""
        led = self._led(result)
        return math.inf if led is None else float(sum(i.iterations for i in led.increments))

    def _led(self, result: semi_analytical.Result) -> semi_analytical.Result | None:
        if self._solved is None or self._solved[0] is not result:
            self._solved = result, solved_by_motion(result)
        return self._solved[1]


def solved_by_motion(result: semi_analytical.Result) -> semi_analytical.Result | None:
    """The history of a result with its approach and shift prescribed; None if that is given up."""
    steps = tuple(
        LoadStep(
            approach=i.approach,
            tangential_shift=None if i.step == PRESSED else _pair(i.tangential_shift),
            increments=1,
        )
        for i in result.increments
    )
    scene = result.scene.model_copy(update={"loading": steps})
    try:
        return semi_analytical.solve(scene, result.grid, result.tolerance)
    except semi_analytical.SolverError:
        return None


def _pressure(increment: Any) -> Any:
    return increment.pressure


def _pair(vector: Any) -> tuple[float, float]:
    x, y = vector
    return float(x), float(y)


def _both_solvers(section: SectionRun, surface: Run, cells: int) -> tuple[Comparison, ...]:
    finer = SIZES[Level.QUICK][0] / cells
    because = (
        "set by hand: about three times what both leave on the quick discretisations, in "
        "proportion to the cell on others; a loop that forgets its first half is off by 0.2"
    )

    def compared(name: str, meaning: str, step: int, read: Callable[[Any], float]) -> Comparison:
        def difference(fem: fem_reference.Result, sam: semi_analytical.Result) -> float:
            return abs(read(fem.steps[:step]) / read(sam.steps[:step]) - 1)

        return Comparison(
            f"{name}_{'pushed' if step == PUSHED else 'back'}",
            f"{meaning} after the {'push' if step == PUSHED else 'reversal'}, relative",
            (section.label, surface.label), difference, SOLVERS[name] * finer, because,
            "the other solver, on the same increments", ReferenceKind.OTHER_SOLVER,
        )  # fmt: skip

    return tuple(
        compared(name, meaning, step, read)
        for step in (PUSHED, BACK)
        for name, meaning, read in (
            ("shift", "difference of the shift", _shift),
            ("energy", "difference of the energy lost", _energy),
            ("approach", "difference of the approach", _approach),
        )
    )


def _shift(steps: Any) -> float:
    return shift_along_x(steps[-1])


def _energy(steps: Any) -> float:
    return float(steps[-1].dissipated_energy)


def _approach(steps: Any) -> float:
    return float(steps[-1].approach)
