"""Surface FRF of a body over a range of wavenumbers, and its table `frf.csv`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from contact_results.files.csv_file import Column, write_meanings, write_table

if TYPE_CHECKING:
    from semi_analytical.frf.stack import Stack

Array = NDArray[np.float64]

TABLE, MEANT = "frf.csv", "frf_columns.csv"
FIGURES = ("frf.png", "frf.svg")

POINTS_PER_DECADE = 8
# Without layers there is no length that a wave could be long or short against: from 10 µm to 10 cm.
HALF_SPACE_RANGE = (1e1, 1e5)
# From waves that feel the base alone to waves that feel the outermost layer alone.
LONGEST, SHORTEST = 1e-2, 10.0

NAMES = ("F_ss", "F_tt", "F_zz", "C")
MEANINGS = {
    "F_ss": "along the wave by shear along it",
    "F_tt": "across the wave by shear across it",
    "F_zz": "normal by pressure",
    "C": "normal by shear along the wave",
}


@dataclass(frozen=True)
class FrequencyResponse:
    """The four scalars of a body that is not rigid, at increasing wavenumbers alpha [1/length]."""

    stack: Stack
    alpha: Array

    @cached_property
    def columns(self) -> dict[str, Array]:
        """F_ss, F_tt, F_zz and C by name [length^3/force]."""
        from semi_analytical.frf.surface import scalars

        with np.errstate(over="ignore", invalid="ignore"):  # refused by whoever asks for more
            response = scalars(self.stack, self.alpha)
        return dict(
            zip(NAMES, (response.c11, response.csh, response.c22, response.c12), strict=True)
        )

    @cached_property
    def dimensionless(self) -> dict[str, Array]:
        """The same times alpha and the shear modulus of the outermost material."""
        scale = self.alpha * self.stack.outer.shear_modulus
        return {name: scale * values for name, values in self.columns.items()}

    @cached_property
    def reach(self) -> Array:
        """alpha times the thickness of the outermost layer; zero without layers."""
        return self.alpha * (self.stack.layers[0].thickness if self.stack.layers else 0.0)


def natural_range(stack: Stack) -> tuple[float, float]:
    """Wavenumbers between which the response passes from the base's to the outer material's."""
    if not stack.layers:
        return HALF_SPACE_RANGE
    thicknesses = [film.thickness for film in stack.layers]
    return LONGEST / sum(thicknesses), SHORTEST / min(thicknesses)


def frequency_response(
    stack: Stack, between: tuple[float, float], points: int | None
) -> FrequencyResponse:
    """The response at logarithmically spaced wavenumbers.

    between  lowest and highest wavenumber [1/length]
    points   how many; None for eight per decade
    """
    low, high = between
    count = points or int(np.ceil(POINTS_PER_DECADE * np.log10(high / low))) + 1
    return FrequencyResponse(stack, np.geomspace(low, high, count))


def write_responses(response: FrequencyResponse, directory: Path) -> None:
    """Write `frf.csv`, and beside it what its columns mean."""
    scaled = "the same times alpha and the shear modulus G of the outermost material"
    columns = {
        Column("alpha", "1/m", "Wavenumber."): response.alpha,
        Column("alpha h", "", "alpha times the thickness of the outermost layer."): response.reach,
    }
    for name, values in response.columns.items():
        columns[Column(name, "m^3/N", f"Displacement {MEANINGS[name]}.")] = values
    for name, values in response.dimensionless.items():
        columns[Column(f"alpha G {name}", "", f"{name}, {scaled}.")] = values
    rows = zip(*(values.tolist() for values in columns.values()), strict=True)
    write_table(directory / TABLE, tuple(columns), rows)
    write_meanings(directory / MEANT, {TABLE: tuple(columns)})
