"""The fretting loop with ν = 0, where its closed form is exact."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from verification.cases.hertz_point import ASKED
from verification.cases.loop_charts import hysteresis_chart
from verification.cases.loop_history import (
    ExactLoop,
    largest_f2,
    largest_imbalance,
    loop_cycle,
    loop_energy,
    loop_steps,
)
from verification.exhibits.chart import Chart
from verification.judging.case import Case, Finding, Level, Quantity, Required
from verification.judging.ladder import cells_label
from verification.judging.refinement import part_of_a_cell
from verification.judging.run import Run
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import HERTZ, NU_ZERO
from verification.problems.reference import closed_form, exact_zero

if TYPE_CHECKING:
    from semi_analytical import Result

SOURCE = "Mindlin and Deresiewicz 1953"
EXACT = ExactLoop(NU_ZERO)
LARGEST_SHIFT = EXACT.end.shift
CYCLED = EXACT.cycled
LARGEST_SLIP = float(CYCLED.slip_amplitude(HERTZ.contact_radius))
RUIZ = "Ruiz, Boddington and Chen 1984, on Mindlin and Deresiewicz 1953"
# The contact fills 1/1.1 of the window: cells beside it carry nothing.
WINDOW_PER_RADIUS = 2.2
REQUIRED_SHEAR = {128: 2e-3, 256: 1e-3}


def fretting_loop(level: Level = Level.QUICK) -> Case:
    """The case at the two required counts of cells, and at a finer one at the full level."""
    return fretting_loop_on((128, 256, 512) if level is Level.FULL else (128, 256), quarter=4)


def fretting_loop_on(cells: tuple[int, ...], quarter: int) -> Case:
    """The case on square grids of these many cells per side, T* in `quarter` increments."""
    scene = paper.frictional(
        "Fretting loop, ν = 0", paper.paraboloid(NU_ZERO), NU_ZERO, *loop_steps(quarter)
    )
    half_width = WINDOW_PER_RADIUS / 2 * HERTZ.contact_radius
    runs = tuple(Run(cells_label(n), scene, paper.square_grid(n, half_width)) for n in cells)
    wide = Run(f"{cells_label(cells[0])}, window 3 a", scene, paper.hertz_grid(cells[0]))
    return Case(
        name="fretting_loop",
        title="Fretting loop, ν = 0",
        problem=(
            "The contact of cattaneo_mindlin on a window of 2.2 contact radii, sheared to 0.9 µW, "
            "back to -0.9 µW and again to 0.9 µW. After a reversal the slip of before stays locked "
            "in, so this judges the memory of the history and not only its last load. Of the cycle "
            "it judges what is reported for fretting: slip amplitude, Ruiz's parameters, and "
            "whether work, stored and dissipated energy balance."
        ),
        runs=(*runs, wide),
        quantities=tuple(q for n in cells for q in _quantities(n)),
        findings=(
            Finding(
                "largest_shear_error", "largest Σ|q - q_exact| / Σµp of any increment", "",
                wide.label, EXACT.largest_shear_error,
                "the same number of cells on a window of three contact radii: cells 1.36 times as "
                "large, errors 1.36^(3/2) = 1.6 times",
            ),
        ),
        charts=_charts,
    )  # fmt: skip


def shear_allowed(cells: int) -> float:
    """The required figure; on other grids what its order 3/2 makes of that for 128 cells."""
    return REQUIRED_SHEAR.get(cells, REQUIRED_SHEAR[128] * (128 / cells) ** 1.5)


def _quantities(cells: int) -> tuple[Quantity, ...]:
    return *_of_the_history(cells), *_of_the_cycle(cells)


def _of_the_history(cells: int) -> tuple[Quantity, ...]:
    run = cells_label(cells)
    return (
        Quantity(
            "largest_shear_error", "largest Σ|q - q_exact| / Σµp of any increment", "", run,
            EXACT.largest_shear_error, exact_zero(SOURCE),
            Required(shear_allowed(cells), ASKED), 1.0, "Σµp",
        ),
        Quantity(
            "largest_shift_error", "largest difference of the shift in any increment", "m", run,
            EXACT.largest_shift_error, exact_zero(SOURCE), Required(1e-4, ASKED),
            LARGEST_SHIFT, "the largest shift of the loop",
        ),
        Quantity(
            "largest_stick_radius_error",
            "largest difference of the stick radius in any increment", "m", run,
            EXACT.largest_stick_radius_error, exact_zero(SOURCE),
            Required(part_of_a_cell(0.2, cells, WINDOW_PER_RADIUS), "a fifth of a cell, as for "
                     "cattaneo_mindlin"),
            HERTZ.contact_radius, "the contact radius",
        ),
        Quantity(
            "energy_per_cycle", "energy dissipated from 0.9 µW to -0.9 µW and back", "J", run,
            loop_energy, closed_form(EXACT.energy_per_cycle, SOURCE), Required(5e-4, ASKED),
        ),
        Quantity(
            "largest_energy_imbalance", "largest part of the energy that an increment cannot "
            "account for: work put in, less what is stored, dissipated and left to the increment",
            "", run, largest_imbalance, exact_zero("first law"), Required(1e-6, ASKED),
            1.0, "the largest energy so far",
        ),
    )  # fmt: skip


def _of_the_cycle(cells: int) -> tuple[Quantity, ...]:
    run = cells_label(cells)
    return (
        Quantity(
            "slip_amplitude", "half the range of slip in the cycle, where it is largest", "m", run,
            lambda result: float(np.max(loop_cycle(result).slip_amplitude)),
            closed_form(LARGEST_SLIP, SOURCE),
            Required(part_of_a_cell(1.5, cells, WINDOW_PER_RADIUS), "slip is largest at the edge, "
                     "and known where the edge runs through a cell: up to half a cell beside it, "
                     "where it differs by three times its distance over the radius"),
        ),
        Quantity(
            "largest_slip_amplitude_error", "largest difference of half the range of slip in the "
            "contact", "m", run, EXACT.largest_slip_amplitude_error, exact_zero(SOURCE),
            Required(1e-3, "no more than is asked of the shear on 256 cells; like that it falls "
                     "with the power 3/2 of the cell"),
            LARGEST_SLIP, "the largest slip amplitude",
        ),
        Quantity(
            "largest_slip_distance_error", "largest difference of the way slipped in the contact",
            "m", run, EXACT.largest_slip_distance_error, exact_zero(SOURCE),
            Required(1e-3, "as for the slip amplitude, of which it is five times: one way in the "
                     "first loading, two back and two again"),
            5 * LARGEST_SLIP, "the largest way",
        ),
        Quantity(
            "ruiz_f1", "largest shear times slip amplitude", "Pa m", run,
            lambda result: float(np.max(loop_cycle(result).ruiz_f1)),
            closed_form(CYCLED.largest_f1, RUIZ),
            Required(1e-3, "as for the slip amplitude: both factors are known there"),
        ),
        Quantity(
            "ruiz_f2", "largest shear times slip amplitude times tension of the surface", "Pa^2 m",
            run, largest_f2,
            closed_form(CYCLED.largest_f2, RUIZ),
            Required(3e-2, "largest 0.03 a from the edge, where the shear ends as a square root "
                     "and the stress of cells of constant shear errs with the root of the cell"),
        ),
    )  # fmt: skip


def _charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
    finest = max(results.values(), key=lambda result: result.grid.cells)
    return (hysteresis_chart("fretting_hysteresis", finest, EXACT),)
