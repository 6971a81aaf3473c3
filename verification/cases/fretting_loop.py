"""The fretting loop with ν = 0, where its closed form is exact."""

from __future__ import annotations

import numpy as np

from verification.cases.levels import ASKED
from verification.cases.loop_charts import hysteresis_chart
from verification.cases.loop_observables import (
    ENERGY_PER_CYCLE,
    LARGEST_SHEAR_ERROR,
    LARGEST_SHIFT_ERROR,
    LARGEST_STICK_RADIUS_ERROR,
)
from verification.judging.case import Case, Level
from verification.judging.declared_case import Reported, Within, case, judged
from verification.judging.ladder import Rung, named, on_cells, part_of_side
from verification.judging.observable import Observable, error_norm
from verification.problems import loop_history as loop
from verification.problems.paper_scene import HERTZ, NU_ZERO

RUIZ = "Ruiz, Boddington and Chen 1984, on Mindlin and Deresiewicz 1953"
# The contact fills 1/1.1 of the window: cells beside it carry nothing.
WINDOW_PER_RADIUS = 2.2
REQUIRED_SHEAR = {128: 2e-3, 256: 1e-3}


def shear_allowed(rung: Rung) -> float:
    """The required figure; on other grids what its order 3/2 makes of that for 128 cells."""
    return REQUIRED_SHEAR.get(rung.count, REQUIRED_SHEAR[128] * (128 / rung.count) ** 1.5)


IMBALANCE = error_norm(
    "largest_energy_imbalance",
    "largest part of the energy that an increment cannot account for: work put in, less what is "
    "stored, dissipated and left to the increment",
    lambda result, *_: loop.largest_imbalance(result),
    "the largest energy so far",
    source="first law",
)
SLIP_AMPLITUDE = Observable(
    "slip_amplitude", "half the range of slip in the cycle, where it is largest", "m",
    lambda result, *_: float(np.max(loop.loop_cycle(result).slip_amplitude)),
    lambda exact: float(exact.cycled.slip_amplitude(HERTZ.contact_radius)),
)  # fmt: skip
LARGEST_SLIP_AMPLITUDE_ERROR = error_norm(
    "largest_slip_amplitude_error",
    "largest difference of half the range of slip in the contact",
    lambda result, _, problem: problem.ends[-1].largest_slip_amplitude_error(result),
    unit="m",
    over=loop.OVER_LARGEST_SLIP,
)
LARGEST_SLIP_DISTANCE_ERROR = error_norm(
    "largest_slip_distance_error",
    "largest difference of the way slipped in the contact",
    lambda result, _, problem: problem.ends[-1].largest_slip_distance_error(result),
    unit="m",
    over=loop.OVER_LARGEST_WAY,
)
RUIZ_F1 = Observable(
    "ruiz_f1", "largest shear times slip amplitude", "Pa m",
    lambda result, *_: float(np.max(loop.loop_cycle(result).ruiz_f1)),
    lambda exact: float(exact.cycled.largest_f1),
    source=RUIZ,
)  # fmt: skip
RUIZ_F2 = Observable(
    "ruiz_f2", "largest shear times slip amplitude times tension of the surface", "Pa^2 m",
    lambda result, *_: loop.largest_f2(result), lambda exact: float(exact.cycled.largest_f2),
    source=RUIZ,
)  # fmt: skip
ROWS = (
    Within(LARGEST_SHEAR_ERROR, shear_allowed, ASKED, each=True),
    Within(LARGEST_SHIFT_ERROR, 1e-4, ASKED, each=True),
    Within(
        LARGEST_STICK_RADIUS_ERROR, part_of_side(0.2), "a fifth of a cell, as for cattaneo_mindlin",
        each=True,
    ),
    Within(ENERGY_PER_CYCLE, 5e-4, ASKED, each=True),
    Within(IMBALANCE, 1e-6, ASKED, each=True),
    Within(
        SLIP_AMPLITUDE, part_of_side(1.5),
        "slip is largest at the edge, and known where the edge runs through a cell: up to half a "
        "cell beside it, where it differs by three times its distance over the radius",
        each=True,
    ),
    Within(
        LARGEST_SLIP_AMPLITUDE_ERROR, 1e-3,
        "no more than is asked of the shear on 256 cells; like that it falls with the power 3/2 of "
        "the cell",
        each=True,
    ),
    Within(
        LARGEST_SLIP_DISTANCE_ERROR, 1e-3,
        "as for the slip amplitude, of which it is five times: one way in the first loading, two "
        "back and two again",
        each=True,
    ),
    Within(
        RUIZ_F1, 1e-3, "as for the slip amplitude: both factors are known there", each=True
    ),
    Within(
        RUIZ_F2, 3e-2,
        "largest 0.03 a from the edge, where the shear ends as a square root and the stress of "
        "cells of constant shear errs with the root of the cell",
        each=True,
    ),
)  # fmt: skip
ON_WIDE_WINDOW = (
    Reported(
        LARGEST_SHEAR_ERROR,
        "the same number of cells on a window of three contact radii: cells 1.36 times as large, "
        "errors 1.36^(3/2) = 1.6 times",
    ),
)


def fretting_loop(level: Level = Level.QUICK) -> Case:
    """The case at the two required counts of cells, and at a finer one at the full level."""
    return fretting_loop_on((128, 256, 512) if level is Level.FULL else (128, 256), quarter=4)


def fretting_loop_on(cells: tuple[int, ...], quarter: int) -> Case:
    """The case on square grids of these many cells per side, T* in `quarter` increments."""
    problem = loop.fretting_loop("Fretting loop, ν = 0", NU_ZERO, quarter)
    grids = on_cells(problem, cells, WINDOW_PER_RADIUS)
    wide = on_cells(problem, cells[:1])
    return case(
        "fretting_loop",
        "Fretting loop, ν = 0",
        "The contact of cattaneo_mindlin on a window of 2.2 contact radii, sheared to 0.9 µW, "
        "back to -0.9 µW and again to 0.9 µW. After a reversal the slip of before stays locked "
        "in, so this judges the memory of the history and not only its last load. Of the cycle "
        "it judges what is reported for fretting: slip amplitude, Ruiz's parameters, and "
        "whether work, stored and dissipated energy balance.",
        judged(grids, ROWS),
        judged(named(f"{wide.levels[0]}, window 3 a", wide), ON_WIDE_WINDOW),
        charts=(lambda results: hysteresis_chart(
            "fretting_hysteresis", results[grids.judged.run.label], problem.ends[-1]
        ),),
    )  # fmt: skip
