"""Surface response of layered bodies: reference numbers, laws, and the sampling method."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial
from typing import Any

import numpy as np

from contact_scene.quantities.residuals import worst
from semi_analytical.frf.stack import Stack
from semi_analytical.frf.surface import scalars
from semi_analytical.influence.layered import LayeredCoefficients
from verification.exhibits.chart import (
    NONE,
    Chart,
    Look,
    Panel,
    Table,
    curve,
    percent,
    plain,
    table_of,
)
from verification.judging.case import Case, Check, Level, Required
from verification.judging.declared_case import case
from verification.laws.law import frf_matrix, worst_violation
from verification.laws.limit_laws import LIMIT_LAWS, SYMMETRY_LAWS
from verification.laws.sampling_route import SamplingErrors, sampling_errors
from verification.problems.problem import Reference, ReferenceKind, identity
from verification.references import load_reference

COEFFICIENT_SOURCE = "references/influence_coefficients.json: inverse transform, 1e-12"
FRF_ROWS: list[dict[str, Any]] = load_reference("frf")["rows"]
COEFFICIENT_ROWS: list[dict[str, Any]] = load_reference("influence_coefficients")["rows"]
FREQUENCY_RESPONSE = (
    r"\tilde{\mathbf{u}}(\mathbf{k}) = \mathbf{F}(\mathbf{k}) \tilde{\mathbf{t}}(\mathbf{k}),\quad "
    r"\mathbf{K}(\mathbf{x}) = \frac{1}{4\pi^2} \int \mathbf{F}(\mathbf{k}) \tilde{c}(\mathbf{k}) "
    r"e^{i \mathbf{k} \cdot \mathbf{x}} d^2 k"
)


def _stack(row: Mapping[str, Any]) -> Stack:
    base = None if row["base"] == "rigid" else (row["base"]["G"], row["base"]["nu"])
    return Stack([(film["G"], film["nu"], film["h"]) for film in row["layers_top_down"]], base)


@cache
def _frf_errors(number: int) -> tuple[float, float]:
    """Compute the errors of the scalars and of the matrix of one row."""
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


def _coefficient_error(row: Mapping[str, Any]) -> float:
    """Compute the largest error of the components of one row."""
    K = _coefficients(row["G1"], row["nu1"], (row["G2"], row["nu2"]), row["d"])
    i, j = round(row["x"] / row["d"]), round(row["y"] / row["d"])
    errors = [
        abs((np.sign(j) if j and name == "xy" else 1) * getattr(K, name)[i, abs(j)] - expected)
        for name, expected in row["colloc"].items()
    ]
    return float(worst(*errors) / max(K.zz[0, 0], K.xx[0, 0]))


def _row_tables(_: Any) -> tuple[Table, Table]:
    frf = table_of(
        "Frequency response, row by row",
        {
            "row": lambda n: str(FRF_ROWS[n]["id"]),
            "layers": lambda n: str(len(FRF_ROWS[n]["layers_top_down"])),
            "base": lambda n: "rigid" if FRF_ROWS[n]["base"] == "rigid" else "half-space",
            "α h₁": lambda n: plain(FRF_ROWS[n]["alpha_h1"]),
            "ν of the layers": lambda n: ", ".join(
                f"{film['nu']:.7g}" for film in FRF_ROWS[n]["layers_top_down"]
            ),
            "error of the scalars": lambda n: plain(_frf_errors(n)[0], 2),
            "error of the matrix": lambda n: plain(_frf_errors(n)[1], 2),
        },
        range(len(FRF_ROWS)),
    )
    coefficients = table_of(
        "Influence coefficients, row by row",
        {
            "body": lambda row: f"G₁/G₂ = {row['G1'] / row['G2']:g}",
            "offset in cells": lambda row: f"({row['x'] / row['d']:g}, {row['y'] / row['d']:g})",
            "zz": lambda row: f"{row['colloc']['zz']:.10g}",
            "largest error of zz, xx, yy, xy, zx": lambda row: plain(_coefficient_error(row), 2),
        },
        COEFFICIENT_ROWS,
        "Cells of an eighth of the layer's thickness; errors relative to the loaded cell's own "
        "displacement.",
        {"zz": "h/G₂"},
    )
    return frf, coefficients


def layered_reference(level: Level = Level.QUICK) -> Case:
    """Build the case of FRFs and influence coefficients of layered bodies against reference
    numbers.

    The case is equal at all levels.
    """
    frf = "references/frf.json: boundary-value problem in the layer amplitudes, 50 digits"
    required = Required(5e-15, "required of layered FRFs by the project's accuracy targets")

    def exact(source: str, uncertainty: float) -> Reference:
        return Reference(0.0, ReferenceKind.SEMI_CLOSED, source, uncertainty)

    return case(
        "layered_reference",
        "Layered response against other programs",
        "Surface frequency response of one to five layers on a half-space or a rigid base, ν up "
        "to exactly ½, α h from 1e-6 to 1e4, against a solution with 50 digits. Displacement by "
        "unit traction on a square cell of a coated body, against inverse transforms. Every row "
        "is shown.",
        checks=(
            Check(
                "scalars", "largest error of C₁₁, C₂₂, C_sh, each relative to itself, and of C₁₂ "
                "relative to √(C₁₁C₂₂)", "", f"{len(FRF_ROWS)} rows",
                partial(_worst_frf_error, 0), exact(frf, 1e-24), required, 1.0, "1",
            ),
            Check(
                "matrix", "largest error of an entry relative to the largest entry", "",
                f"{len(FRF_ROWS)} rows", partial(_worst_frf_error, 1), exact(frf, 1e-24),
                required, 1.0, "1",
            ),
            Check(
                "influence_coefficients", "largest error relative to the loaded cell's own "
                "displacement", "",
                f"{len(COEFFICIENT_ROWS)} rows",
                lambda: max(map(_coefficient_error, COEFFICIENT_ROWS)),
                exact(COEFFICIENT_SOURCE, 1e-12),
                Required(1e-14, "twenty times the rounding error; sampling_route states 1e-12"),
                1.0, "1",
            ),
        ),
        tables=_row_tables,
        equations=(FREQUENCY_RESPONSE,),
        no_order="both sides are exact in the wavenumber, or quadratures to rounding",
    )  # fmt: skip


def frf_laws(level: Level = Level.QUICK) -> Case:
    """Build the case of the laws of any surface FRF, for random layered bodies; equal at all
    levels."""
    laws = sorted(SYMMETRY_LAWS + LIMIT_LAWS, key=lambda law: int(law.number[1:]))
    return case(
        "frf_laws",
        "Laws of the frequency response of layered bodies",
        "Laws of mechanics for the surface response of any layered body: reciprocity, "
        "symmetries, positive energy, limits, monotonicity. Each law is tested on random bodies "
        "of one to five layers on a half-space or a rigid base, with stiffness contrasts to 1e6, "
        "ν from -0.95 to exactly ½, thicknesses over four and wavenumbers over eight decades. "
        "The value is the largest violation, relative to the largest entry unless stated "
        "otherwise. The bodies are the same in every run; the tests search for larger "
        "violations.",
        checks=tuple(
            Check(
                law.name, f"{law.number}: {law.statement}", "", f"{law.draws} bodies",
                partial(worst_violation, law),
                identity(0.0, f"property {law.number} of elastic layered half-spaces"),
                Required(
                    law.allowed, "bound of the law" if law.allowed == 1 else "rounding, or the "
                    "law's own next order",
                ),
                1.0, "1",
            )
            for law in laws
        ),
        equations=(
            r"\mathbf{F}(\mathbf{k}) = \mathbf{F}(\mathbf{k})^H,\quad "
            r"\mathbf{t}^H \mathbf{F} \mathbf{t} > 0,\quad "
            r"\mathbf{F}(\mathbf{R}\mathbf{k}) = \mathbf{R} \mathbf{F}(\mathbf{k}) \mathbf{R}^T",
        ),
        no_order="laws of the response itself, in which nothing converges",
    )  # fmt: skip


# The first configuration of the reference rows: cells of an eighth of the layer's thickness.
BODY = Stack([(2.0, 0.3, 1.0)], (1.0, 0.25))
REFINEMENTS = (1, 2, 4, 8, 16)
EXTENSIONS = (2, 4, 8, 16)
EXTENSION, REFINEMENT = 4, 4  # held while the other one varies
MEASURES: dict[str, Callable[[SamplingErrors], float]] = {
    "loaded cell": lambda errors: errors.own,
    "next cell": lambda errors: errors.neighbour,
    "last cell, shape": lambda errors: errors.far_shape,
    "coupling": lambda errors: errors.coupling,
}


@cache
def _sampled(refinement: int, extension: int) -> SamplingErrors:
    return sampling_errors(BODY, 0.125, 32, refinement, extension)


def _sampling_table(_: Any) -> tuple[Table]:
    settings = [(r, EXTENSION) for r in REFINEMENTS] + [
        (REFINEMENT, e) for e in EXTENSIONS if e != EXTENSION
    ]
    rows = tuple(
        (
            f"refinement {r}, extension {e}",
            str((32 * r * e) ** 2),
            *(percent(of(_sampled(r, e))) for of in MEASURES.values()),
            percent(_sampled(r, e).far),
        )
        for r, e in settings
    )
    table = Table(
        title="Error of sampled coefficients, relative to the coefficient",
        columns=("setting", "samples", *MEASURES, "last cell, absolute"),
        rows=(*rows, ("exact coefficients, no parameter", "0", *["< 1e-10 %"] * 5)),
        note="The shape at the last cell of the window is the error after subtraction of a "
        "constant, as with a free approach. The last row is the bound of layered_reference.",
        units=NONE,
    )
    return (table,)


def _sampling_chart(
    by: str,
    settings: Sequence[int],
    at: Callable[[int], SamplingErrors],
    caption: str,
    *labels: str,
) -> Chart:
    """Draw the errors against one of the two parameters.

    labels  of the axis and of the fixed parameter
    """
    curves = [
        curve(name, settings, [abs(of(at(n))) for n in settings], Look.POINTS, series)
        for series, (name, of) in enumerate(MEASURES.items())
    ]
    exact = curve("exact coefficients", settings[:: len(settings) - 1], (1e-12, 1e-12), Look.BOUND)
    panel = Panel(
        x_label=labels[0], y_label="relative error", logarithmic=True, height=1.6,
        title=labels[1], curves=(*curves, exact),
    )  # fmt: skip
    return Chart(
        name=f"sampling_by_{by}",
        title=f"Sampled coefficients against {by}",
        caption=f"{caption} Thin black dashes at the bottom: the exact coefficients.",
        rows=((panel,),),
    )


def sampling_route(level: Level = Level.QUICK) -> Case:
    """Build the case of influence coefficients from a sampled FRF, against the exact coefficients.

    The case is equal at all levels.
    """
    finest = REFINEMENTS[-1]
    return case(
        "sampling_route",
        "Influence coefficients from a sampled frequency response",
        "Influence coefficients are usually computed, as in the paper, by an inverse FFT of "
        "samples of the frequency response times the transform of one loaded cell. This method "
        "has two parameters: the refinement (samples per cell side) against aliasing, and the "
        "extension (period over window) against periodic images. Its errors are measured against "
        "the exact coefficients, which have no parameter and an error of 1e-12: a layer twice as "
        "stiff as its substrate, 32 x 32 cells of 1/8 of its thickness.",
        checks=(
            Check(
                "sampled_tends_to_exact", "error of the loaded cell at the finest sampling", "",
                f"refinement {finest}, extension {EXTENSION}",
                lambda: _sampled(finest, EXTENSION).own,
                identity(0.0, "both are the same integral, once sampled and once not"),
                Required(5e-3, "the error of sampling; the exact coefficients share no step with "
                "it"), 1.0, "the coefficient",
            ),
        ),
        charts=(
            lambda _: _sampling_chart(
                "refinement", REFINEMENTS, lambda r: _sampled(r, EXTENSION),
                "Refinement slowly reduces the error of the loaded and the next cell. The error "
                "of distant cells, caused by periodic images, remains.",
                "samples per cell side", f"extension {EXTENSION}",
            ),
            lambda _: _sampling_chart(
                "extension", EXTENSIONS, lambda e: _sampled(REFINEMENT, e),
                "A longer period removes the images from distant cells and has no effect on the "
                "loaded cell.",
                "period / window", f"refinement {REFINEMENT}",
            ),
        ),
        tables=_sampling_table,
        limits=(
            f"The exact coefficients are judged in layered_reference ({COEFFICIENT_SOURCE}).",
        ),
        equations=(FREQUENCY_RESPONSE,),
        no_order="the table and both charts vary two parameters; no order is claimed",
    )  # fmt: skip
