"""Cases for the surface response of layered bodies: reference numbers, and laws for random
bodies."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_scene.quantities.residuals import worst
from semi_analytical.frf.stack import Stack
from semi_analytical.frf.surface import scalars
from semi_analytical.influence.layered import LayeredCoefficients
from verification.judging.case import Case, Check, Level, Required
from verification.judging.declared_case import case
from verification.laws.limit_laws import LIMIT_LAWS, SYMMETRY_LAWS, frf_matrix, worst_violation
from verification.problems.problem import Reference, ReferenceKind, identity
from verification.references import load_reference

Field = NDArray[np.float64]
Coefficients = tuple[Field, Field]


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
    """Compute the relative errors of the FRF scalars and of the FRF matrix for one reference row.

    number  index of the row
    """
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
    """Compute the largest relative error of the influence coefficients of one reference row."""
    K = _coefficients(row["G1"], row["nu1"], (row["G2"], row["nu2"]), row["d"])
    i, j = round(row["x"] / row["d"]), round(row["y"] / row["d"])
    errors = [
        abs((np.sign(j) if j and name == "xy" else 1) * K[name][i, abs(j)] - expected)
        for name, expected in row["colloc"].items()
    ]
    return float(worst(*errors) / max(K["zz"][0, 0], K["xx"][0, 0]))


def layered_reference(level: Level = Level.QUICK) -> Case:
    """Create the verification case of FRFs and influence coefficients against reference numbers.

    The bodies are layered. The case is equal at all levels.
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
                Required(1e-14, "twenty times the rounding error"),
                1.0, "1",
            ),
        ),
        equations=(FREQUENCY_RESPONSE,),
        no_order="both sides are exact in the wavenumber, or quadratures to rounding",
    )  # fmt: skip


def frf_laws(level: Level = Level.QUICK) -> Case:
    """Create the verification case of the laws of surface FRFs, for random layered bodies.

    The case is equal at all levels.
    """
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
