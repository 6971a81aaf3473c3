"""The usual route through the same equations: coefficients from a sampled response, fixed
increments, and slip directions that stay as they were.

Samples stand at the cells' centres and between them, the period is an even multiple of the window.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from contact_scene import Body, Scene
from contact_scene.array_types import Field
from semi_analytical import Result, SurfaceGrid, plan
from semi_analytical.frf.stack import Stack, stack_of
from semi_analytical.frf.surface import SurfaceScalars, scalars
from semi_analytical.history import march
from semi_analytical.influence.coefficients import Composite
from semi_analytical.model import ContactModel, halved
from semi_analytical.operator.domain import ReducedGrid
from semi_analytical.operator.transforms import Convolutions, offsets_for

Spectrum = NDArray[np.complex128] | Field

LONG_WAVE = 1e-6  # part of the smallest wavenumber, where only the base is felt
MEAN = 4 * np.arcsinh(1.0)  # of 1/α over the unit square about zero


@dataclass(frozen=True)
class Sampling:
    """How the response is sampled.

    refinement  samples per cell side
    extension   period over twice the window
    """

    refinement: int
    extension: int

    def count(self, offsets: int) -> int:
        """Samples along one side, for so many offsets."""
        return 2 * (offsets - 1) * self.refinement * self.extension


class SampledCoefficients:
    """Influence coefficients of one body by inverse FFT of its sampled response times the transform
    of one loaded cell, at offsets 0 … n − 1 along each side; see `InfluenceCoefficients`."""

    def __init__(
        self, stack: Stack, spacing: tuple[float, float], offsets: tuple[int, int], how: Sampling
    ) -> None:
        self._offsets, self._how = offsets, how
        self._shape = (how.count(offsets[0]), how.count(offsets[1]))
        steps = [side / how.refinement for side in spacing]
        m = 2 * np.pi * np.fft.fftfreq(self._shape[0], steps[0])[:, None]
        n = 2 * np.pi * np.fft.rfftfreq(self._shape[1], steps[1])[None, :]
        alpha = np.hypot(m, n)
        alpha[0, 0] = 1.0  # has no response: replaced below
        self._cos, self._sin = m / alpha, n / alpha
        response = scalars(stack, alpha)
        mean = _mean_about_zero(stack, 2 * np.pi / (self._shape[0] * steps[0]))
        for values, instead in zip(response, mean, strict=True):
            values[0, 0] = instead
        self._response = response
        dx, dy = spacing
        self._load = np.sinc(m * dx / (2 * np.pi)) * np.sinc(n * dy / (2 * np.pi))

    @cached_property
    def zz(self) -> Field:
        """u_z by pressure."""
        return self._at_offsets(self._response.c22)

    @cached_property
    def xx(self) -> Field:
        """u_x by q_x."""
        return self._at_offsets(self._along(self._cos, self._sin))

    @cached_property
    def yy(self) -> Field:
        """u_y by q_y."""
        return self._at_offsets(self._along(self._sin, self._cos))

    @cached_property
    def xy(self) -> Field:
        """u_x by q_y."""
        r = self._response
        return self._at_offsets(self._odd(self._cos * self._sin * (r.c11 - r.csh), (0, 1)))

    @cached_property
    def zx(self) -> Field:
        """u_z by q_x."""
        return self._at_offsets(self._odd(-1j * self._cos * self._response.c12, (0,)))

    @cached_property
    def zy(self) -> Field:
        """u_z by q_y."""
        return self._at_offsets(self._odd(-1j * self._sin * self._response.c12, (1,)))

    def _along(self, cos: Field, sin: Field) -> Field:
        direct: Field = cos**2 * self._response.c11 + sin**2 * self._response.csh
        direct[0, 0] = 0.5 * (self._response.c11[0, 0] + self._response.csh[0, 0])
        return direct

    def _odd(self, frf: Spectrum, axes: tuple[int, ...]) -> Spectrum:
        """Without the shortest waves, which have no partner of the other sign."""
        frf[0, 0] = 0
        for axis in axes:
            frf[(slice(None),) * axis + (self._shape[axis] // 2,)] = 0
        return frf

    def _at_offsets(self, frf: Spectrum) -> Field:
        step = self._how.refinement
        nx, ny = (slice(0, count * step, step) for count in self._offsets)
        return np.fft.irfft2(frf * self._load, self._shape)[nx, ny] * step**2


def _mean_about_zero(stack: Stack, width: float) -> SurfaceScalars:
    """Mean over the square of one sample about zero, where the response is a constant over α."""
    alpha = LONG_WAVE * width
    return SurfaceScalars(*(MEAN / width * alpha * c for c in scalars(stack, alpha)))


class SampledModel(ContactModel):
    """The contact model with sampled coefficients."""

    def __init__(
        self, scene: Scene, grid: ReducedGrid, gap: Field, counter: Convolutions, how: Sampling
    ) -> None:
        super().__init__(scene, grid, gap, counter)
        self.how = how

    @classmethod
    def sampled(cls, scene: Scene, grid: SurfaceGrid, how: Sampling) -> SampledModel:
        """The model of a scene, its gap taken at the cell centres."""
        gap = scene.indenter.initial_gap(*grid.coordinates())
        return cls(scene, ReducedGrid(grid), gap, Convolutions(), how)

    @cached_property
    def coefficients(self) -> Composite:
        """Of both bodies."""
        return Composite(self._of(self.scene.body), self._of(self.scene.indenter))

    @cached_property
    def coarse(self) -> SampledModel | None:
        """The same window with half the cells."""
        coarser = super().coarse
        if coarser is None:
            return None
        return SampledModel(self.scene, coarser.grid, halved(self.gap), self.convolutions, self.how)

    def _of(self, body: Body) -> tuple[SampledCoefficients, ...]:
        if not body.deforms:
            return ()
        offsets = offsets_for(self.window.cells)
        return (SampledCoefficients(stack_of(body), self.grid.spacing, offsets, self.how),)


def solve_sampled(
    scene: Scene, grid: SurfaceGrid, tolerance: float, how: Sampling
) -> tuple[SampledModel, Result]:
    """The scene on the grid, by sampled coefficients; raises what `solve` raises."""
    model, decided = SampledModel.sampled(scene, grid, how), plan(scene)
    return model, Result(scene, grid, tolerance, decided, tuple(march(model, decided, tolerance)))
