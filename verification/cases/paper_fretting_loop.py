"""The paper's own scene, figures 1 and 2: exact arc, ν = 0.3, in the paper's increments."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from contact_scene import Sphere
from verification.cases.loop_charts import (
    hysteresis_chart,
    loading_history_chart,
    tractions_chart,
)
from verification.exhibits.chart import Chart
from verification.judging.case import Case, Finding, Level, Quantity, Required
from verification.judging.ladder import cells_label
from verification.judging.run import Run
from verification.problems import paper_scene as paper
from verification.problems.loop_history import LOADED, ExactLoop, loop_energy, loop_steps
from verification.problems.paper_scene import FRICTION, STEEL
from verification.problems.reference import Reference, ReferenceKind
from verification.quantities import shift_along_x, slip_traction_angle, transverse_shear

if TYPE_CHECKING:
    from semi_analytical import Result

SOURCE = "Mindlin and Deresiewicz 1953, approximate for ν > 0"
EXACT = ExactLoop(STEEL)
QUARTER = 18
BAND = (
    "the closed form lets all slipping points pull along x although they do not slip along x; "
    "solutions of Coulomb's vector law differ from it by parts of a per cent in shift and energy "
    "and by a few per cent in the shear"
)


def paper_fretting_loop(level: Level = Level.QUICK) -> Case:
    """The case: at 128 x 128 cells when quick, at 256 x 256 above."""
    return paper_fretting_loop_on(128 if level is Level.QUICK else 256, QUARTER)


def paper_fretting_loop_on(cells: int, quarter: int) -> Case:
    """The case on a square grid of this many cells per side, T* in `quarter` increments."""
    scene = paper.frictional(
        "Steel ball on steel, fretting loop (paper, figures 1 and 2)",
        Sphere(radius=paper.RADIUS, material=STEEL),
        STEEL,
        *loop_steps(quarter),
    )
    run = Run(cells_label(cells), scene, paper.square_grid(cells, 0.6e-3))
    return Case(
        name="paper_fretting_loop",
        title="Fretting loop of the paper's figures 1 and 2",
        problem=(
            "Two identical bodies of 420 GPa and ν = 0.3, a ball of 18 mm with its exact arc under "
            "1 kN, µ = 0.1, T between ± 0.9 µW. For ν > 0 the closed form breaks the direction law "
            "of friction in its slip ring, so it is a companion here and not a judge: it has to be "
            "near, and the distance is reported."
        ),
        runs=(run,),
        quantities=_quantities(run.label),
        findings=_findings(run.label),
        charts=_charts,
        limits=(
            "The closed form is not the solution of this problem; the ν = 0 loop judges accuracy.",
        ),
    )


def _quantities(run: str) -> tuple[Quantity, ...]:
    return (
        Quantity(
            "largest_shear_error", "largest Σ|q - q_closed| / Σµp of any increment", "", run,
            EXACT.largest_shear_error, _near(0.0, 0.05), Required(0.05, BAND), 1.0, "Σµp",
        ),
        Quantity(
            "largest_shift_error", "largest difference of the shift in any increment", "m", run,
            EXACT.largest_shift_error, _near(0.0, 0.005 * EXACT.end.shift), Required(0.01, BAND),
            EXACT.end.shift, "the largest shift of the loop",
        ),
        Quantity(
            "energy_per_cycle", "energy dissipated from 0.9 µW to -0.9 µW and back", "J", run,
            loop_energy, _near(EXACT.energy_per_cycle, 0.005 * EXACT.energy_per_cycle),
            Required(0.02, BAND),
        ),
    )  # fmt: skip


def _findings(run: str) -> tuple[Finding, ...]:
    return (
        Finding(
            "transverse_shear", "largest |q_y| / µp₀ at the end of the first loading", "", run,
            lambda result: transverse_shear(result.steps[LOADED - 1], FRICTION),
            "zero in the closed form",
        ),
        Finding(
            "largest_transverse_shear", "largest |q_y| / µp₀ of any increment", "", run,
            lambda result: float(
                np.max([transverse_shear(i, FRICTION) for i in result.increments])
            ),
            "zero in the closed form",
        ),
        Finding(
            "slip_direction_deviation",
            "largest angle between shear and x axis in the slip ring, end of the first loading",
            "°", run, lambda result: slip_traction_angle(result.steps[LOADED - 1], FRICTION),
            "zero in the closed form: by this much its slip would turn away from its traction",
        ),
        Finding(
            "shift_at_amplitude", "shift at 0.9 µW over the closed form's, less one", "", run,
            lambda result: shift_along_x(result.steps[LOADED - 1]) / EXACT.end.shift - 1,
            "the vector law makes the contact stiffer",
        ),
    )  # fmt: skip


def _near(value: float, uncertainty: float) -> Reference:
    return Reference(value, ReferenceKind.CLOSED_FORM, SOURCE, uncertainty)


def _charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
    result = next(iter(results.values()))
    return (
        loading_history_chart(result),
        tractions_chart(result, EXACT),
        hysteresis_chart("paper_hysteresis", result, EXACT),
    )
