"""The fretting loop with ν = 0, where its closed form is exact."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from verification.cases import paper_scene as paper
from verification.cases.case import (
    Case,
    Level,
    Quantity,
    Required,
    Run,
    closed_form,
    exact_zero,
)
from verification.cases.chart import Chart
from verification.cases.hertz_point import label
from verification.cases.loop_charts import hysteresis_chart
from verification.cases.loop_history import ExactLoop, loop_energy, loop_steps
from verification.cases.paper_scene import HERTZ, NU_ZERO

if TYPE_CHECKING:
    from semi_analytical import Result

SOURCE = "Mindlin and Deresiewicz 1953"
ASKED = "required of this scene by the project's accuracy targets"
EXACT = ExactLoop(NU_ZERO)
LARGEST_SHIFT = EXACT.end.shift
# Shear allowed at a number of cells per side, as required.
SHEAR_ALLOWED = {128: 2e-3, 256: 1e-3}
COARSE_SHEAR_ALLOWED = 5e-3


def fretting_loop(level: Level = Level.QUICK) -> Case:
    """The case: at 128 x 128 cells when quick, at 256 x 256 too above."""
    return fretting_loop_on((128,) if level is Level.QUICK else (128, 256), quarter=6)


def fretting_loop_on(cells: tuple[int, ...], quarter: int) -> Case:
    """The case on square grids of these many cells per side, T* in `quarter` increments."""
    scene = paper.frictional(
        "Fretting loop, ν = 0", paper.paraboloid(NU_ZERO), NU_ZERO, *loop_steps(quarter)
    )
    runs = tuple(Run(label(n), scene, paper.hertz_grid(n)) for n in cells)
    return Case(
        name="fretting_loop",
        title="Fretting loop, ν = 0",
        problem=(
            "The contact of cattaneo_mindlin, sheared to 0.9 µW, back to -0.9 µW and again to "
            "0.9 µW. After a reversal the slip of before stays locked in, so this judges the "
            "memory of the history and not only its last load."
        ),
        runs=runs,
        quantities=tuple(q for n in cells for q in _quantities(n)),
        charts=_charts,
    )


def _quantities(cells: int) -> tuple[Quantity, ...]:
    run = label(cells)
    return (
        Quantity(
            "largest_shear_error", "largest Σ|q - q_exact| / Σµp of any increment", "", run,
            EXACT.largest_shear_error, exact_zero(SOURCE),
            Required(SHEAR_ALLOWED.get(cells, COARSE_SHEAR_ALLOWED), ASKED), 1.0, "Σµp",
        ),
        Quantity(
            "largest_shift_error", "largest difference of the shift in any increment", "m", run,
            EXACT.largest_shift_error, exact_zero(SOURCE), Required(1e-4, ASKED),
            LARGEST_SHIFT, "the largest shift of the loop",
        ),
        Quantity(
            "largest_stick_radius_error",
            "largest difference of the stick radius in any increment with a slip ring of 0.1 a",
            "m", run, EXACT.largest_stick_radius_error, exact_zero(SOURCE),
            Required(1 / cells, "a third of a cell over the contact radius: a border between two "
                     "zones of cells is known to a part of a cell"),
            HERTZ.contact_radius, "the contact radius",
        ),
        Quantity(
            "energy_per_cycle", "energy dissipated from 0.9 µW to -0.9 µW and back", "J", run,
            loop_energy, closed_form(EXACT.energy_per_cycle, SOURCE), Required(5e-4, ASKED),
        ),
    )  # fmt: skip


def _charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
    return (hysteresis_chart("fretting_hysteresis", list(results.values())[-1], EXACT),)
