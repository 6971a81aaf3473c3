"""Verification of the verification itself: statistics and printed numbers, and result files.

The statistics are compared with hand computation. All these examples have refinement levels h = 1,
2, 4 and an error a + c h, plus a deviation (1, -6, 8) ε. The deviation is orthogonal to the line
that is fitted with weights 1/h, as 1 - 6/4 + 8/16 = 1 - 6/2 + 8/4 = 0. Its weighted sum of squares
is (1 + 9 + 4) ε².

Tables and arrays of the result files must agree with each other. Their scene is a ball under an
eccentric force, tangential forces in two directions and a torque, so that all loads and motions
have different components.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache, partial
from math import hypot, log, sqrt
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import h5py
import numpy as np

import semi_analytical
from contact_results.directory.file_names import CYCLES, FIELDS, INCREMENTS
from contact_results.result_files import write_result
from contact_results.stress.loaded_bodies import state_of_result
from contact_results.stress.on_cells import OnCells
from contact_results.stress.stress_maxima import (
    Extreme,
    extremes,
)
from contact_scene import Body, LoadStep, Scene
from contact_scene.array_types import Field
from contact_scene.quantities.increment import (
    SCALARS,
    components,
)
from contact_scene.quantities.residuals import worst
from verification.convergence.observed_order import error_line, observed_order, richardson
from verification.judging.case import (
    SOLVER_TOLERANCE,
    Case,
    Derived,
    Level,
    Quantity,
    Required,
    computed_error,
)
from verification.judging.judgement import judge_quantity
from verification.judging.outcome import Verdict, failure_text, uncertainty_text
from verification.problems.problem import (
    HERTZ,
    NORMAL_FORCE,
    STEEL,
    Reference,
    ReferenceKind,
    closed_form,
    coated,
    film,
    frictional,
    identity,
    paraboloid,
    pressed,
    square_grid,
)

LEVELS = (1.0, 2.0, 4.0)
BESIDE = (1.0, -6.0, 8.0)
LIMIT = 5.0
# u_num = √(c² + s²) = ½ by s² = 14 ε² on 3 - 2 levels; with u_ref it is 13/10, and U twice that.
SLOPE = 0.3
SCATTER = 0.4
OF_REFERENCE = 1.2
EPSILON = SCATTER / sqrt(14)
U = 2.6
# Student's t with one degree of freedom: quantiles of 97.5 % (two-sided 95 %) and 95 %.
STUDENT = 1 / np.tan(np.pi / 40)
ONE_SIDED = 1 / np.tan(np.pi / 20)
HAND = "worked by hand"
TO_ROUNDING = Required(1e-9, "the same numbers to rounding")
PRINTED = Required(0.05, "two digits are printed")


@dataclass(frozen=True)
class _Rung:
    """Hold one refinement level of an example, in place of a solver run and its result.

    label    label of the level
    spacing  discretisation parameter h
    value    value of the judged quantity
    """

    label: str
    spacing: float
    value: float


def worked_examples(level: Level = Level.QUICK) -> Case:
    """Create the verification case of statistical results that are computed by hand.

    Judged are tolerances, extrapolated limits, confidence intervals, and the numbers that reports
    print. All levels are equal.
    """
    return Case(
        name="worked_examples",
        title="Worked examples of the harness",
        problem="Values on three and four levels with round numbers for fits, scatters and "
        "intervals. Judged are a tolerance derived from refinement, the limit and its "
        "uncertainty, the intervals of an order and of a line, and the printed numbers.",
        runs=(),
        quantities=tuple(
            Quantity(
                name,
                meaning,
                "",
                "by hand",
                measure,
                closed_form(value, HAND),
                tolerance,
                runs=(),
            )
            for name, meaning, measure, value, tolerance in _EXAMPLES
        ),
        equations=(
            r"U = 2 \sqrt{c^2 + s^2 + u_\mathrm{ref}^2},\quad "
            r"s^2 = \frac{\sum_i w_i \varepsilon_i^2}{n - 2}",
        ),
        no_order="arithmetic by hand",
        shows=("statistics",),
    )


def _judge_example() -> Verdict:
    """Judge a quantity of an example with a tolerance that is derived from three refinement levels.

    The reference differs from the finest value by twice the expanded uncertainty U. The error scale
    is 2.
    """
    rungs = [
        _Rung(f"h = {h:g}", h, LIMIT + SLOPE * h + EPSILON * r)
        for h, r in zip(LEVELS, BESIDE, strict=True)
    ]
    known: Any = {rung.label: rung for rung in rungs}
    finest = rungs[0]
    quantity = Quantity(
        "value",
        "a value",
        "",
        finest.label,
        lambda result: float(result.value),
        Reference(finest.value - 2 * U, ReferenceKind.CLOSED_FORM, HAND, OF_REFERENCE),
        Derived(tuple(rung.label for rung in reversed(rungs)), 1.0, 1e9, HAND),
        scale=2.0,
    )
    runs: Any = tuple(rungs)
    return judge_quantity(quantity, Case("by_hand", "", "", runs, (quantity,)), known)


def _printed_number(text: str) -> float:
    found = re.search(r"± ([\d.e-]+)", text)
    return float(found[1]) if found else float("nan")


def _extrapolate_example(part: int) -> float:
    """Return the Richardson-extrapolated limit of four example levels, or its standard uncertainty.

    The fourth level has h = 8, and its value lies on the line a + c h.

    part  0 for the limit, 1 for its uncertainty
    """
    h = np.array([*LEVELS, 8.0])
    f = LIMIT + SLOPE * h + EPSILON * np.array([*BESIDE, 0.0])
    return richardson(h, f, 1.0)[part]


def _example_errors() -> list[float]:
    """Return the errors of three example levels, whose fitted order of convergence is exactly 2.

    The errors are h² e^(x ε), where the deviation x = (1, -2, 1) is orthogonal to any line over log
    h.
    """
    return [h**2 * np.exp(EPSILON * x) for h, x in zip(LEVELS, (1, -2, 1), strict=True)]


_EXAMPLES: tuple[tuple[str, str, Callable[[], float], float, Required], ...] = (
    (
        "derived_tolerance",
        "tolerance U = 2 √(c² + s² + u_ref²), s² = 14 ε²",
        lambda: _judge_example().allowed * _judge_example().scale,
        U,
        TO_ROUNDING,
    ),
    (
        "printed_tolerance",
        "tolerance, as printed in the text of a failed verdict",
        lambda: _printed_number(failure_text(_judge_example())),
        U,
        PRINTED,
    ),
    (
        "printed_uncertainty",
        "uncertainty of the reference over the scale, as printed",
        lambda: _printed_number(uncertainty_text(_judge_example())),
        OF_REFERENCE / 2,
        PRINTED,
    ),
    (
        "limit",
        "limit of four levels on a line, with the deviation ε",
        partial(_extrapolate_example, 0),
        LIMIT,
        TO_ROUNDING,
    ),
    # The two finest levels alone have the limit a + 8 ε. Of the fit, s² = 14 ε²/2, times the
    # element of the inverse of [[Σ1/h², Σ1/h], [Σ1/h, 4]] = [[85/64, 15/8], [15/8, 4]].
    (
        "uncertainty_of_the_limit",
        "standard uncertainty of the limit: √(7 · 256/115 + 8²) ε",
        partial(_extrapolate_example, 1),
        EPSILON * hypot(sqrt(7 * 256 / 115), 8),
        TO_ROUNDING,
    ),
    (
        "interval_of_the_order",
        "half-width of the order's 95 % interval: t √(6 ε² / 2 ln²2)",
        lambda: observed_order(LEVELS, _example_errors()).half_width,
        STUDENT * EPSILON * sqrt(3) / log(2),
        TO_ROUNDING,
    ),
    (
        "margin_of_the_order",
        "one-sided 95 % margin of the order: t₁ √(6 ε² / 2 ln²2)",
        lambda: observed_order(LEVELS, _example_errors()).margin,
        ONE_SIDED * EPSILON * sqrt(3) / log(2),
        TO_ROUNDING,
    ),
    (
        "interval_of_the_line",
        "half-width of the line's 95 % band in its middle: t √(6 ε² / 3)",
        lambda: error_line(LEVELS, _example_errors()).reach,
        STUDENT * EPSILON * sqrt(2),
        TO_ROUNDING,
    ),
)


CELLS = 24
COARSE = 16
MARGIN = 1.2  # half the window over Hertz's radius
# moments M_x and M_y over the normal force [m]
ARM = 1e-5
ACROSS = 2e-5
TORQUE = 5e-3
PUSH = 50.0
ASIDE = 20.0


def _push_step(along: float) -> LoadStep:
    return LoadStep(tangential_force=(along, ASIDE), increments=2)


SCENE = Scene(
    title="Ball pressed beside its tip, pushed, twisted and pushed to and fro",
    indenter=paraboloid(STEEL),
    body=Body(material=STEEL),
    friction=frictional("", paraboloid(STEEL), STEEL).friction,
    loading=(
        LoadStep(
            normal_force=NORMAL_FORCE,
            moment=(ARM * NORMAL_FORCE, ACROSS * NORMAL_FORCE),
            increments=2,
        ),
        _push_step(PUSH),
        LoadStep(torque=TORQUE, increments=2),
        _push_step(-PUSH),
        _push_step(PUSH),
    ),
)
CONSISTENT = identity(0.0, "consistency of the files")
# A stiff layer bends, so that the stress at its lower side differs much from that in the base.
COATED = pressed("Ball on a stiff coating", paraboloid(STEEL), coated(film(4.0, 0.25)))


@dataclass(frozen=True, eq=False)
class _Written:
    """Hold the content of the result files of one solve, read without the file reader of the
    program.

    increments  rows of the table of increments: text by column name
    cycle       last row of the table of fretting cycles: text by column name
    arrays      arrays of the fields file by their path
    """

    increments: list[dict[str, str]]
    cycle: dict[str, str]
    arrays: Mapping[str, Field]

    def column(self, name: str) -> Field:
        unit = SCALARS[name].unit or 1
        return np.array(
            [
                [float(row[f"{part} [{unit}]"] or "nan") for part in components(name)]
                for row in self.increments
            ]
        )


def written_files(level: Level = Level.QUICK) -> Case:
    """Create the verification case of the content of result files.

    Loads must be the sums of the tractions, tables must agree with arrays, and the position of a
    maximum must be correct. All levels are equal.
    """
    return Case(
        name="written_files",
        title="Contents of result files",
        problem="A ball with an eccentric force is loaded by tangential forces in two directions "
        "and by a torque, so that loads and motions have two different components. The result "
        "files are read back: loads are the sums of the tractions in the files, tables agree "
        "with the fields, and the position of a maximum is that in the field. Below a stiff "
        "coating the stress at the sides of the interface is bounded by that of the layer and "
        "the base.",
        runs=(),
        quantities=(
            computed_error(
                "loads",
                "largest difference of normal force, tangential force, torque and moments in the "
                "table from the sums of the tractions, over the largest of each",
                "files",
                loads,
                CONSISTENT,
                Required(10 * SOLVER_TOLERANCE, "equilibrium, met to the tolerance of the solver"),
            ),
            computed_error(
                "columns",
                "largest difference of a column of the table from the data set of this name, over "
                "its largest value",
                "files",
                columns,
                CONSISTENT,
                Required(1e-15, "the same numbers, written twice"),
            ),
            computed_error(
                "place_of_f1",
                "relative difference of Ruiz's first parameter at the tabulated position from its "
                "largest value",
                "files",
                place_of_f1,
                CONSISTENT,
                Required(1e-12, "the same cell"),
            ),
            computed_error(
                "sides_of_an_interface",
                "largest excess of the stress on a side of the interface over that of the adjacent "
                "layer or base",
                "files",
                sides_of_an_interface,
                CONSISTENT,
                Required(1e-12, "a maximum over a part is at most that over the whole"),
            ),
        ),
        equations=(
            r"W = \int p \, dA,\quad \mathbf{T} = \int \mathbf{q} \, dA,\quad "
            r"M_z = \int (x q_y - y q_x) \, dA",
        ),
        no_order="numbers of one run, written twice",
        shows=("files",),
    )


@cache
def _written_result() -> _Written:
    grid = square_grid(CELLS, MARGIN * HERTZ.contact_radius)
    result = semi_analytical.solve(SCENE, grid, SOLVER_TOLERANCE)
    with TemporaryDirectory() as name:
        directory = Path(name)
        write_result(result, directory, figures="none", all_fields=True)
        with h5py.File(directory / FIELDS) as file:
            arrays = {
                f"increments/{key}": np.array(value)
                for key, value in _group_items(file, "increments")
            }
            arrays |= {
                f"last_cycle/{key}": np.array(value)
                for key, value in _group_items(file, "last_cycle")
            }
            arrays |= {axis: np.array(file[axis]) for axis in "xy"}
        return _Written(
            _table_rows(directory / INCREMENTS), _table_rows(directory / CYCLES)[-1], arrays
        )


def _group_items(file: h5py.File, group: str) -> Any:
    found: Any = file[group]
    return found.items()


def _table_rows(path: Path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def loads() -> float:
    """Compute the largest relative difference between written loads and sums of the written
    tractions [1].

    The loads are forces, torque and moments of all increments in the table.
    """
    found = _written_result()
    x, y = found.arrays["x"], found.arrays["y"]
    area = (x[1] - x[0]) * (y[1] - y[0])
    p = found.arrays["increments/pressure"]
    q_x, q_y = np.moveaxis(found.arrays["increments/shear"], 1, 0)
    X, Y = np.meshgrid(x, y, indexing="ij")

    def summed(*fields: Field) -> Field:
        return area * np.stack([np.sum(field, axis=(1, 2)) for field in fields], axis=-1)

    sums = {
        "normal_force": summed(p),
        "tangential_force": summed(q_x, q_y),
        "torque": summed(X * q_y - Y * q_x),
        "moment": summed(p * Y, p * X),
    }
    return worst(*(_relative_difference(found.column(name), total) for name, total in sums.items()))


def columns() -> float:
    """Compute the largest relative difference between a table column and the array of the same
    quantity [1].

    All scalars that both table and fields file contain are compared. The result is NaN if missing
    values differ.
    """
    found = _written_result()
    there = [name for name in SCALARS if f"increments/{name}" in found.arrays]
    apart = []
    for name in there:
        tabulated = found.column(name)
        stored = found.arrays[f"increments/{name}"].reshape(tabulated.shape).astype(float)
        if not np.array_equal(np.isnan(tabulated), np.isnan(stored)):
            return float("nan")
        apart.append(_relative_difference(np.nan_to_num(tabulated), np.nan_to_num(stored)))
    return worst(*apart)


def _relative_difference(tabulated: Field, stored: Field) -> float:
    return float(np.max(np.abs(tabulated - stored)) / (np.max(np.abs(stored)) or 1.0))


def place_of_f1() -> float:
    """Compute by how much the field of Ruiz's parameter F1 at its tabulated position is below its
    maximum.

    F1 is shear times slip amplitude. The difference is relative to the maximum [1].
    """
    found = _written_result()
    field = found.arrays["last_cycle/ruiz_f1"]
    cell = tuple(
        int(np.argmin(np.abs(found.arrays[axis] - float(found.cycle[f"ruiz_f1_{axis} [m]"]))))
        for axis in "xy"
    )
    return float(1 - field[cell] / np.max(field))


@cache
def _stress_extremes() -> dict[tuple[str, str], Extreme]:
    grid = square_grid(COARSE, MARGIN * HERTZ.contact_radius)
    state = state_of_result(semi_analytical.solve(COATED, grid, SOLVER_TOLERANCE), 1)
    depth = COATED.body.layers[0].thickness
    field = OnCells(state, see_edge=False).stress((0.5 * depth, 1.5 * depth))
    return {(e.region, e.measure): e for e in extremes(field)}


def sides_of_an_interface() -> float:
    """Compute the largest excess of a stress maximum at an interface over that of the adjacent
    material [1].

    The maximum over the whole layer or base cannot be smaller than that at the interface. The depth
    of the interface is also compared with the thickness of the layer.
    """
    found, excess = _stress_extremes(), [0.0]
    depth = COATED.body.layers[0].thickness
    for whole, side in (("layer 1", "above"), ("base", "below")):
        for (region, measure), extreme in found.items():
            if region == f"interface 1 {side}" and (whole, measure) in found:
                largest = found[whole, measure].value
                excess += [(extreme.value - largest) / abs(largest), abs(extreme.depth / depth - 1)]
    return worst(*(max(value, 0.0) if np.isfinite(value) else value for value in excess))
