"""The largest stresses of a body under a pressure of revolution, without a grid: by its transform.

Below the surface every component is a Hankel transform of the pressure's transform times the
response of the layers; at the edge of the contact, where tension is largest at the surface, the
outermost material alone answers with (1-2ν)W/2πa² and the layers add a smooth part.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import pi

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize, minimize_scalar
from scipy.special import j0, j1

from contact_scene import Body
from semi_analytical.frf.depth import (
    Descent,
    Level,
    in_plane,
    material_at,
    remainder_at_depth,
)
from semi_analytical.frf.stack import Stack, stack_of
from verification.closed_forms.huber_stress import axis_stress
from verification.closed_forms.quadrature import unit_gauss

Array = NDArray[np.float64]

SHALLOWEST, DEEPEST = 0.08, 2.5  # depths that are searched, over the contact radius
WIDEST = 1.5  # and distances from the axis
DECAYED = 36.0  # exp(-kz) is round-off
PANEL_POINTS, PANEL_PHASE = 16, 8.0
PRESSURE_POINTS = 220


def deepest_mises(contact_radius: float, peak_pressure: float, poisson_ratio: float) -> float:
    """Largest stress of von Mises under Hertz's pressure, on the axis [force/length²]."""

    def less(depth: float) -> float:
        stress = axis_stress(depth, contact_radius, peak_pressure, poisson_ratio)
        return -float(stress.von_mises)

    bounds = (0.05 * contact_radius, 2.0 * contact_radius)
    return -float(minimize_scalar(less, bounds=bounds, options={"xatol": 1e-9}).fun)


@dataclass(frozen=True)
class PressedStress:
    """A body under a pressure.

    pressure        by the distance from the axis, zero beyond contact_radius and falling towards it
                    like a square root [force/length²]
    load            its sum [force]
    """

    body: Body
    pressure: Callable[[Array], Array]
    contact_radius: float
    load: float

    def largest(self) -> tuple[float, float | None]:
        """Largest principal stress and largest stress of von Mises, each anywhere in the body; None
        of the latter where it is at the surface."""
        r = np.linspace(0.0, WIDEST * self.contact_radius, 25)
        found = [(level, r, self.measures(r, level)) for level in self._levels()]
        mises, depth = self._refined(0, found)
        tension, _ = self._refined(1, found)
        deep = depth > 1.5 * SHALLOWEST * self.contact_radius
        return max(tension, self.edge_tension()), mises if deep else None

    def edge_tension(self) -> float:
        """Radial stress of the surface where the contact ends."""
        outer = self._stack.outer
        bare = (1 - 2 * outer.poisson_ratio) * self.load / (2 * pi * self.contact_radius**2)
        if not self.body.layers:
            return bare
        k, weight = self._wavenumbers(self.body.layers[0].thickness)
        plane = in_plane(remainder_at_depth(self._stack, k, 0.0), outer, k)
        weighted, kr = weight * k * self._transform(k), k * self.contact_radius
        mean, half = (plane.along[1] + plane.across[1]) / 2, (plane.along[1] - plane.across[1]) / 2
        return bare + float(np.sum(weighted * (mean * j0(kr) - half * _j2(kr))))

    def measures(self, r: Array, level: Level) -> tuple[Array, Array]:
        """Stress of von Mises and largest principal stress at distances from the axis."""
        k, weight = self._wavenumbers(level.depth)
        fields = Descent(self._stack, k).at(level)
        plane = in_plane(fields, material_at(self._stack, level), k)
        weighted = weight * k * self._transform(k)
        zeroth, first, second = (f(np.outer(r, k)) for f in (j0, j1, _j2))
        mean = zeroth @ (weighted * (plane.along[1] + plane.across[1]) / 2)
        half = second @ (weighted * (plane.along[1] - plane.across[1]) / 2)
        shear = first @ (weighted * fields.traction[0, 1])
        axial = -zeroth @ (weighted * fields.traction[1, 1])
        rr, tt = mean - half, mean + half
        mises = np.sqrt(((rr - tt) ** 2 + (tt - axial) ** 2 + (axial - rr) ** 2) / 2 + 3 * shear**2)
        in_section = (rr + axial) / 2 + np.hypot((rr - axial) / 2, shear)
        return mises, np.maximum(tt, in_section)

    def _refined(
        self, which: int, found: Sequence[tuple[Level, Array, tuple[Array, Array]]]
    ) -> tuple[float, float]:
        """The largest of one of the measures and its depth, from the largest that was found."""
        a = self.contact_radius
        level, r, measures = max(found, key=lambda one: float(np.max(one[2][which])))
        best, place = float(np.max(measures[which])), float(r[np.argmax(measures[which])])
        top, bottom = self._span(level.layer)

        def less(x: Array) -> float:
            there = Level(float(np.clip(x[1] * a, top, bottom)), level.layer)
            return -float(self.measures(np.array([abs(x[0]) * a]), there)[which][0])

        start = np.array([place, level.depth]) / a
        refined = minimize(
            less, start, method="Nelder-Mead",
            options={
                "initial_simplex": start + np.array([[0, 0], [0.03, 0], [0, 0.03]]),
                "xatol": 1e-3, "fatol": 1e-6 * best,
            },
        )  # fmt: skip
        return max(best, -float(refined.fun)), float(np.clip(refined.x[1] * a, top, bottom))

    def _levels(self) -> Iterator[Level]:
        """Depths that are searched, in every material from side to side."""
        for layer in range(len(self.body.layers) + 1):
            top, bottom = self._span(layer)
            if top < bottom:
                for depth in np.linspace(top, bottom, 12 if self.body.layers else 24):
                    yield Level(float(depth), layer)

    def _span(self, layer: int) -> tuple[float, float]:
        bounds = np.cumsum([0.0, *(film.thickness for film in self.body.layers), np.inf])
        a = self.contact_radius
        bottom = min(float(bounds[layer + 1]), max(DEEPEST * a, 1.5 * float(bounds[layer])))
        return max(float(bounds[layer]), SHALLOWEST * a), bottom

    @cached_property
    def _stack(self) -> Stack:
        return stack_of(self.body)

    def _transform(self, k: Array) -> Array:
        """∫ p J₀(kr) r dr; r = a sin t removes the root at the edge."""
        t, weights = unit_gauss(PRESSURE_POINTS)
        a = self.contact_radius
        r, chord = a * np.sin(pi / 2 * t), a * np.cos(pi / 2 * t)
        weighted = pi / 2 * weights * self.pressure(r) * r * chord
        return np.asarray(j0(np.outer(k, r)) @ weighted)

    def _wavenumbers(self, decay: float) -> tuple[Array, Array]:
        """Gauss points and weights up to where exp(-k decay) has gone."""
        a = self.contact_radius
        step = PANEL_PHASE / (2.5 * a + decay)
        last = DECAYED / decay
        fine = step * 2.0 ** -np.arange(12, 0, -1)
        bounds = np.concatenate([[0.0], fine, np.arange(step, last, step), [last]])
        v, weights = unit_gauss(PANEL_POINTS)
        widths = np.diff(bounds)[:, None]
        return (bounds[:-1, None] + widths * v).ravel(), (widths * weights).ravel()


def _j2(x: Array) -> Array:
    """J₂ by recurrence."""
    return np.asarray(2 * np.divide(j1(x), x, out=np.full_like(x, 0.5), where=x > 0) - j0(x))
