"""Surface FRFs and influence coefficients of layered bodies against numbers of other programs."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_scene.residuals import worst
from semi_analytical.frf.stack import Stack
from semi_analytical.frf.surface import scalars
from semi_analytical.influence.layered import LayeredCoefficients
from verification.exhibits.numbers import plain
from verification.exhibits.table import NONE, Table
from verification.judging.case import Case, Check, Level, Required
from verification.laws.frf_matrix import frf_matrix
from verification.problems.reference import Reference, ReferenceKind
from verification.references import load_reference

if TYPE_CHECKING:
    from semi_analytical import Result

FRF_SOURCE = "references/frf.json: boundary-value problem in the layer amplitudes, 50 digits"
COEFFICIENT_SOURCE = "references/influence_coefficients.json: inverse transform, 1e-12"
FRF_ROWS: list[dict[str, Any]] = load_reference("frf")["rows"]
COEFFICIENT_ROWS: list[dict[str, Any]] = load_reference("influence_coefficients")["rows"]
Errors = tuple[float, float]


def layered_reference(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    return Case(
        name="layered_reference",
        title="Layered response against other programs",
        problem=(
            "Surface frequency response of one to five layers on a half-space or a rigid base, "
            "ν up to exactly ½, α h from 1e-6 to 1e4, against a solution with 50 digits; and "
            "displacement by unit traction on a square cell of a coated body, against inverse "
            "transforms. Every row is shown."
        ),
        runs=(),
        quantities=(),
        checks=(
            Check(
                "scalars", "largest error of C₁₁, C₂₂, C_sh, each relative to itself, and of C₁₂ "
                "relative to √(C₁₁C₂₂)", "", f"{len(FRF_ROWS)} rows", lambda: _worst_frf_error(0),
                _exact(FRF_SOURCE, 1e-24), _REQUIRED_FRF, 1.0, "1",
            ),
            Check(
                "matrix", "largest error of an entry relative to the largest entry", "",
                f"{len(FRF_ROWS)} rows", lambda: _worst_frf_error(1), _exact(FRF_SOURCE, 1e-24),
                _REQUIRED_FRF, 1.0, "1",
            ),
            Check(
                "influence_coefficients", "largest error relative to the cell's on itself", "",
                f"{len(COEFFICIENT_ROWS)} rows",
                lambda: max(map(_coefficient_error, range(len(COEFFICIENT_ROWS)))),
                _exact(COEFFICIENT_SOURCE, 1e-12),
                Required(1e-14, "rounding, and twenty times as much; 1e-12 is claimed beside "
                         "sampling_route"),
                1.0, "1",
            ),
        ),
        tables=_tables,
    )  # fmt: skip


_REQUIRED_FRF = Required(5e-15, "required of layered FRFs by the project's accuracy targets")


def _exact(source: str, uncertainty: float) -> Reference:
    return Reference(0.0, ReferenceKind.SEMI_CLOSED, source, uncertainty)


def _stack(row: Mapping[str, Any]) -> Stack:
    base = None if row["base"] == "rigid" else (row["base"]["G"], row["base"]["nu"])
    return Stack([(film["G"], film["nu"], film["h"]) for film in row["layers_top_down"]], base)


@cache
def _frf_errors(number: int) -> Errors:
    """Errors of the scalars and of the matrix of one row."""
    row = FRF_ROWS[number]
    c11, c12, c22, csh = (float(row[key]) for key in ("C11", "C12", "C22", "Csh"))
    got = np.array(scalars(_stack(row), np.hypot(row["m"], row["n"])))
    scale = np.array([c11, np.sqrt(c11 * c22), c22, csh])
    F = {key: float(value) for key, value in row["F"].items()}
    xz, yz = 1j * F["im_xz"], 1j * F["im_yz"]
    expected = np.array([[F["xx"], F["xy"], xz], [F["xy"], F["yy"], yz], [-xz, -yz, F["zz"]]])
    difference = frf_matrix(_stack(row), row["m"], row["n"]) - expected
    return (
        float(np.max(np.abs(got - (c11, c12, c22, csh)) / scale)),
        float(np.abs(difference).max() / np.abs(expected).max()),
    )


def _worst_frf_error(kind: int) -> float:
    return max(_frf_errors(number)[kind] for number in range(len(FRF_ROWS)))


@cache
def _coefficients(G1: float, nu1: float, base: tuple[float, float], d: float) -> Any:
    return LayeredCoefficients(Stack([(G1, nu1, 1.0)], base), (d, d), (101, 8))


def _coefficient_error(number: int) -> float:
    """Largest error of the components of one row."""
    row = COEFFICIENT_ROWS[number]
    K = _coefficients(row["G1"], row["nu1"], (row["G2"], row["nu2"]), row["d"])
    i, j = round(row["x"] / row["d"]), round(row["y"] / row["d"])
    errors = [
        abs((np.sign(j) if j and name == "xy" else 1) * getattr(K, name)[i, abs(j)] - expected)
        for name, expected in row["colloc"].items()
    ]
    return float(worst(*errors) / max(K.zz[0, 0], K.xx[0, 0]))


def _tables(results: Mapping[str, Result]) -> tuple[Table, ...]:
    frf_rows = tuple(
        (
            str(row["id"]),
            str(len(row["layers_top_down"])),
            "rigid" if row["base"] == "rigid" else "half-space",
            plain(row["alpha_h1"]),
            ", ".join(f"{film['nu']:.7g}" for film in row["layers_top_down"]),
            *(plain(error, 2) for error in _frf_errors(n)),
        )
        for n, row in enumerate(FRF_ROWS)
    )
    coefficient_rows = tuple(
        (
            f"G₁/G₂ = {row['G1'] / row['G2']:g}",
            f"({row['x'] / row['d']:g}, {row['y'] / row['d']:g})",
            f"{row['colloc']['zz']:.10g}",
            plain(_coefficient_error(n), 2),
        )
        for n, row in enumerate(COEFFICIENT_ROWS)
    )
    return (
        Table(
            title="Frequency response, row by row",
            columns=("row", "layers", "base", "α h₁", "ν of the layers", "error of the scalars",
                     "error of the matrix"),
            rows=frf_rows, units=NONE
        ),
        Table(
            title="Influence coefficients, row by row",
            columns=("body", "offset in cells", "zz", "largest error of zz, xx, yy, xy, zx"),
            rows=coefficient_rows,
            note="Cells of an eighth of the layer's thickness; errors relative to the loaded "
            "cell's own displacement.", units={"zz": "h/G₂"}
        ),
    )  # fmt: skip
