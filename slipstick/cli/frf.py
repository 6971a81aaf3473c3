"""`slipstick maintain frf`: the surface frequency response of the lower body of a scene."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from slipstick.cli.options import SceneArgument, SetOption, directory, optional

if TYPE_CHECKING:
    from contact_results.files.frequency_response import FrequencyResponse
    from semi_analytical.frf.stack import Stack


@dataclass(frozen=True)
class WaveVector:
    """Wavenumbers along x and y [1/m]."""

    m: float
    n: float


@dataclass(frozen=True)
class Band:
    """First and last wavenumber of a table [1/m]."""

    low: float
    high: float


def _numbers(text: str) -> tuple[float, float]:
    """Two finite numbers with a comma between them."""
    try:
        first, second = (float(part) for part in text.split(","))
    except ValueError:
        raise typer.BadParameter(f"got {text!r}, expected two numbers such as 100,-200") from None
    if not (math.isfinite(first) and math.isfinite(second)):
        raise typer.BadParameter(f"got {text!r}, expected finite numbers")
    return first, second


def _wave_vector(text: str) -> WaveVector:
    return WaveVector(*_numbers(text))


def _band(text: str) -> Band:
    low, high = _numbers(text)
    if not 0 < low < high:
        raise typer.BadParameter(f"got {text!r}, expected 0 < LOW < HIGH")
    return Band(low, high)


def frf(
    scene: SceneArgument,
    at: Annotated[
        list[WaveVector] | None,
        optional(
            "--at",
            metavar="M,N",
            parser=_wave_vector,
            help="Give the 3x3 matrix at these wavenumbers along x and y, in 1/m, negative ones "
            "too; any number of times.",
        ),
    ] = None,
    between: Annotated[
        Band | None,
        optional(
            "--range",
            metavar="LOW,HIGH",
            parser=_band,
            help="First and last wavenumber of the table, in 1/m; fitted to the layers if absent.",
        ),
    ] = None,
    points: Annotated[
        int | None,
        optional(
            "--points", min=2, max=100_000, help="Rows of the table; eight per decade if absent."
        ),
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print matrices as JSON, in m³/N: [re, im] for each.")
    ] = False,
    output: Annotated[
        Path | None,
        directory("Write the table (CSV) and its plot (PNG, SVG) there; made if absent."),
    ] = None,
    overrides: SetOption = None,
) -> None:
    """Surface displacement of the lower body by a traction that varies as exp(i(mx + ny)).

    Rows are displacements along x, y, z, columns tractions on the body, z into the body. Of the
    file only the table [body] is read, and a modulus may have any positive value.
    """  # fmt: skip
    from contact_scene import read_body
    from semi_analytical.frf.stack import stack_of

    stack = stack_of(read_body(scene, overrides or ()))
    if at:
        if output or between or points:
            raise typer.BadParameter("--at gives matrices; --output, --range, --points a table")
        _print_matrices(stack, at, as_json)
        return
    response = _tabulated(stack, between, points)
    if as_json:
        _print_matrices(
            stack, [WaveVector(alpha, 0.0) for alpha in response.alpha.tolist()], as_json
        )
    else:
        _print_table(response)
    if output:
        _write(response, output, f"Surface FRF of the lower body of {scene.name}")


def _print_matrices(stack: Stack, wave_vectors: list[WaveVector], as_json: bool) -> None:
    matrices = [_matrix(stack, k) for k in wave_vectors]
    if as_json:
        rows = [
            {"m": k.m, "n": k.n, "F": matrix}
            for k, matrix in zip(wave_vectors, matrices, strict=True)
        ]
        typer.echo(json.dumps(rows, allow_nan=False))
        return
    for k, matrix in zip(wave_vectors, matrices, strict=True):
        typer.echo(f"F at m = {k.m!r}, n = {k.n!r} 1/m, in m³/N")
        for row in matrix:
            typer.echo("  " + "  ".join(f"{re:+.9e} {im:+.9e}i" for re, im in row))


def _matrix(stack: Stack, k: WaveVector) -> list[list[list[float]]]:
    """The 3x3 matrix as pairs of real and imaginary part."""
    import numpy as np

    from semi_analytical.frf.matrix import frf_matrix
    from semi_analytical.frf.uniform_load import uniform_load_matrix

    with np.errstate(all="ignore"):  # what leaves the range of doubles is refused below
        try:
            F = frf_matrix(stack, k.m, k.n) if k.m or k.n else uniform_load_matrix(stack)
        except ValueError as error:
            raise typer.BadParameter(f"--at {k.m!r},{k.n!r}: {error}") from None
    if not np.all(np.isfinite(F)):
        raise typer.BadParameter(f"--at {k.m!r},{k.n!r}: the response exceeds the range of doubles")
    parts = np.stack([F.real, F.imag], axis=-1) + 0.0  # 0, not -0
    return [[[float(part) for part in entry] for entry in row] for row in parts]


def _tabulated(stack: Stack, between: Band | None, points: int | None) -> FrequencyResponse:
    import numpy as np

    from contact_results.files.frequency_response import frequency_response, natural_range
    from contact_scene import Problem, SceneError

    if stack.is_rigid:
        raise SceneError(
            [Problem(("body", "material"), "is rigid, without layers", "something that deforms")]
        )
    band = (between.low, between.high) if between else natural_range(stack)
    response = frequency_response(stack, band, points)
    if not np.all(np.isfinite(list(response.columns.values()))):
        raise typer.BadParameter(
            "the response exceeds the range of doubles; choose another --range"
        )
    return response


def _print_table(response: FrequencyResponse) -> None:
    from contact_results.files.frequency_response import MEANINGS
    from contact_scene.engineering_units import quantity
    from slipstick.cli.terminal import print_pairs, print_table

    outer = quantity(response.stack.outer.shear_modulus, "Pa", 6)
    print_pairs({**MEANINGS, "G": f"{outer}, of the outermost material"}.items())
    columns = {"α\n1/m": [f"{alpha:.4g}" for alpha in response.alpha]}
    if response.stack.layers:
        columns["α h\n"] = [f"{reach:.4g}" for reach in response.reach]
    for name, values in response.columns.items():
        columns[f"{name}\nm³/N"] = [f"{value:.4e}" for value in values]
    for name, values in response.dimensionless.items():
        columns[f"αG·{name}\n"] = [f"{value:.6g}" for value in values]
    print_table(columns, zip(*columns.values(), strict=True), numbers=True)


def _write(response: FrequencyResponse, directory: Path, title: str) -> None:
    from contact_results.directory.run_directory import files_at_once
    from contact_results.figures.frf_plot import write_frf_figures
    from contact_results.files.frequency_response import TABLE, write_responses

    with files_at_once(directory, TABLE, ()) as staging:
        write_responses(response, staging)
        write_frf_figures(response, staging, title)
    typer.echo(f"table and figures in {directory}")
