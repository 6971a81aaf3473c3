"""Loaded circle that represents the tractions of a contact, for the stress below the surface.

The solver gives tractions at rings. The stress requires tractions that end at a circular contact
edge with √(1-η²), where η is the distance from the centre over the radius of the circle. Fields and
edge of an axisymmetric contact are available at rings. With a tangential load, hats on rings do not
end at the contact edge. p² is smooth there: a least-squares fit of p² over the outer rings has its
zeros on the circle, and its values replace p near the edge.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline, RectBivariateSpline

from contact_scene.array_types import Array, Mask
from contact_scene.checks.axisymmetric import ELSEWHERE
from contact_scene.solver_errors import UnsupportedScene
from radial.stress.loaded_circle import LoadedCircle

# grid of a circle; the error of linear interpolation is about 1e-5
RADII = 241
ANGLES = 360
FEWEST = 4  # least number of rings that determine the edge
# Distance from the centre, over the contact radius, up to which rings of an axisymmetric contact at
# points are used. Beyond it, the pressure over its root scatters by up to a half.
OUTERMOST = 0.99
HARMONICS = 3  # highest angular harmonic of the fit
STEPS = 20  # of Newton's method, for the zeros of p²
ZERO = 1e-9  # square of the pressure at a zero, over the largest one; more has not converged
PERIOD = 4  # angles beyond a full turn that the periodic spline repeats


class EdgeFit(NamedTuple):
    """Settings of the least-squares fit of the squared pressure p² near the contact edge.

    The fit determines the circle on which p² is zero. Two settings give an error estimate of the
    stress below the surface.

    begins       smallest radius of the fitted points over the radius of the outermost loaded ring
    over         smallest pressure of the fitted points over the largest pressure; nodes beyond the
                 edge have less
    powers       highest power of 1 - r²/a² in the fit
    fitted_from  distance from the centre, over the radius of the circle, from which the fit
                 replaces p
    last         distance from the centre, over the radius of the circle, up to which the ratio of
                 shear to pressure is taken from the nodes
    """

    begins: float = 0.7
    over: float = 0.2
    powers: int = 2
    fitted_from: float = 0.9
    last: float = 0.965


USUAL = EdgeFit()
# Second fit of equal quality. The difference of both is an error estimate.
ANOTHER = EdgeFit(begins=0.6, powers=3, fitted_from=0.87)


def axisymmetric_circle(
    radii: Array, radius: float, outward: Array, around: Array, p: Array, *, on_points: bool
) -> LoadedCircle:
    """Represent the tractions of an axisymmetric contact, given at rings, as a loaded circle.

    radii               radii of the rings (n,) [length]
    radius              contact radius [length]
    outward, around, p  radial shear q_r, circumferential shear q_θ and pressure at the rings (n,)
                        [force/length²]
    on_points           True if the tractions are unknowns of a contact at points, which scatter at
                        the edge, False if they are those of a known contact edge
    raises              UnsupportedScene if too few rings resolve the contact
    """
    within = radii < (OUTERMOST if on_points else 1 - 1e-9) * radius
    eta = radii[within] / radius
    _refuse_few(len(eta))
    root = np.sqrt((1 - eta) * (1 + eta))
    places = np.linspace(0.0, 1.0, RADII)
    spline = CubicSpline(eta, p[within] / root)
    beyond = np.maximum(places - eta[-1], 0.0)
    smooth = spline(places - beyond) + spline(eta[-1], 1) * beyond
    shear_ratios = [
        np.interp(places, eta, q[within] / p[within]) * smooth for q in (outward, around)
    ]
    return LoadedCircle(radius, 0.0, np.stack([*shear_ratios, smooth])[..., None])


def fit_tangential_circle(
    radii: Array, angles: Array, outward: Array, around: Array, p: Array, fit: EdgeFit = USUAL
) -> LoadedCircle:
    """Fit a loaded circle to the pressure and shear of a contact with tangential load.

    Its normal force is that of the nodal pressures. The angles cover 0 to π, and the other half is
    the mirror image.

    radii               radii of the nodes (n,) [length]
    angles              angles from 0 to π (J + 1,) [radian]
    outward, around, p  radial shear q_r, circumferential shear q_θ and pressure at the nodes
                        (n, J + 1) [force/length²]
    fit                 settings of the fit near the contact edge
    raises              UnsupportedScene if too few rings resolve the edge
    """
    size = float(radii[np.flatnonzero(np.max(p, axis=1) > 0)[-1]])
    weights = np.gradient(radii)[:, None] * radii[:, None] * np.ones_like(angles)
    r, theta = np.broadcast_arrays(radii[:, None] / size, angles)
    fitted = (p > fit.over * np.max(p)) & (r > fit.begins)
    _refuse_few(int(np.min(np.count_nonzero(fitted, axis=0))))
    centre, radius = _fit_edge_circle(r, theta, p, np.where(fitted, weights, 0), fit.powers + 1)
    cos, sin = np.cos(theta), np.sin(theta)
    x, y = r * cos, r * sin
    rho, angle = np.hypot(x - centre, y) / radius, np.arctan2(y, x - centre)
    margin = 1 - rho**2
    # p² is fitted as a multiple of 1 - ρ², with weights (1 - ρ²)².
    weights = np.where(fitted & (margin > 0), weights * margin**2, 0.0)
    factor = _least_squares(margin, angle, p * p / np.where(margin, margin, 1), weights, fit.powers)
    inner = (rho < fit.fitted_from) & (p > 0)
    smooth = np.sqrt(np.maximum(factor(margin, angle), 0.0))
    smooth[inner] = p[inner] / np.sqrt(margin[inner])
    known = (rho < fit.last) & (p > 0)
    shear_ratios = [
        _extend_outwards(q / np.where(known, p, 1.0), known)
        for q in (outward * cos - around * sin, outward * sin + around * cos)
    ]
    eta, phi = np.linspace(0.0, radius, RADII)[:, None], 2 * np.pi * np.arange(ANGLES) / ANGLES
    x, y = centre + eta * np.cos(phi), eta * np.sin(phi)
    at, to = np.hypot(x, y), np.arctan2(y, x)
    fields = [
        _full_circle_spline(field, r[:, 0], angles, sense, degree)(at, to, grid=False)
        for field, sense, degree in (
            (shear_ratios[0], 1, 1),
            (shear_ratios[1], -1, 1),
            (smooth, 1, 3),
        )
    ]
    whole = np.stack([fields[0] * fields[2], fields[1] * fields[2], fields[2]])
    circle = LoadedCircle(radius * size, centre * size, whole)
    return replace(circle, smooth=whole * (_normal_force(radii, angles, p) / circle.load))


def _refuse_few(rings: int) -> None:
    """Raise UnsupportedScene if too few rings resolve the edge,
    where the stress needs the pressure."""
    if rings < FEWEST:
        raise UnsupportedScene(
            f"{rings} rings resolve the edge of the contact, and the stress below the surface "
            f"requires {FEWEST}. The rings lie over the largest contact of the history: remove "
            f"later loads with a larger contact from the scene, or {ELSEWHERE}"
        )


def _least_squares(
    s: Array, angles: Array, values: Array, weights: Array, powers: int
) -> Callable[[Array, Array], Array]:
    """Fit Σ c_mk cos mθ s^k to values near the contact edge by weighted least squares.

    The result is a function of s and θ that evaluates the fit. Used for the squared pressure p²,
    and for p² over its factor s.

    s, angles        coordinates of the points: s = 1 - r²/a² with a reference radius a, and θ (any
                     shape)
    values, weights  values at the points and their weights in the squares (same shape)
    powers           highest power of s
    """

    def terms(s: Array, angle: Array) -> Array:
        """Return the terms cos mθ s^k of a least-squares fit near the contact edge (…, terms).

        The angular harmonic m runs from 0 to 3, the power k from 0 to `powers`.

        s, angle  coordinates s = 1 - r²/a² and θ of the points (…)
        """
        return np.stack(
            [np.cos(m * angle) * s**k for m in range(HARMONICS + 1) for k in range(powers + 1)],
            axis=-1,
        )

    root = np.sqrt(weights)
    found = np.linalg.lstsq(
        terms(s, angles)[weights > 0] * root[weights > 0, None],
        (values * root)[weights > 0],
    )[0]
    return lambda s, angle: np.asarray(terms(s, angle) @ found)


def _fit_edge_circle(
    r: Array, theta: Array, p: Array, weights: Array, powers: int
) -> tuple[float, float]:
    """Fit the squared pressure, and find centre and radius of the circle on which it is zero.

    The circle is the contact edge. Newton's method finds a zero of the fit at each angle, and least
    squares give the circle. If a fit has no zero, because the pressure waves, the highest power is
    reduced. The centre lies on the x axis. Both results are over the radius of the outermost loaded
    ring.

    r, theta  coordinates of the nodes, r over the radius of the outermost loaded ring
    p         pressure at the nodes [force/length²]
    weights   weights of the nodes in the fit
    powers    highest power of 1 - r² in the fit
    raises    UnsupportedScene if no fit has a zero near the outermost loaded ring
    """
    angles, step = theta[0], 1e-6
    innermost = np.min(r[weights > 0])
    for highest in range(powers, 0, -1):
        squared = _least_squares(1 - r * r, theta, p * p, weights, highest)
        s = np.zeros_like(angles)
        for _ in range(STEPS):
            slope = (squared(s + step, angles) - squared(s - step, angles)) / (2 * step)
            s -= squared(s, angles) / slope
        is_zero = np.abs(squared(s, angles)) < ZERO * np.max(p) ** 2
        if np.all(is_zero & (np.abs(s) < 1 - innermost**2)):
            # r² = 2 x c + R² - c²
            x = np.sqrt(1 - s) * np.cos(angles)
            law = np.stack([2 * x, np.ones_like(x)], axis=1)
            centre, rest = np.linalg.lstsq(law, 1 - s)[0]
            return float(centre), float(np.sqrt(rest + centre**2))
    raise UnsupportedScene(
        "the pressure of the outer rings does not determine the edge of the contact, which the "
        f"stress below the surface requires. Use more increments, or {ELSEWHERE}"
    )


def _extend_outwards(ratio: Array, known: Mask) -> Array:
    """Extend a field (n, rays) from the axis outwards by its outermost known value on each ray."""
    last = len(known) - 1 - np.argmax(known[::-1], axis=0)
    position = np.minimum(np.arange(len(known))[:, None], last)
    return np.asarray(np.take_along_axis(ratio, position, axis=0))


def _full_circle_spline(
    field: Array, r: Array, angles: Array, sense: int, degree: int
) -> RectBivariateSpline:
    """Create a spline over the full circle through a field on half of it and its mirror image.

    field   values at the nodes (n, J + 1)
    sense   1 for a field that is even about θ = 0, -1 for an odd field
    degree  degree of the spline in r; the degree in θ is 3
    """
    whole = np.hstack([sense * field[:, :0:-1], field])
    turns = np.concatenate([-angles[:0:-1], angles])
    before, behind = slice(-PERIOD - 1, -1), slice(1, PERIOD + 1)
    whole = np.hstack([whole[:, before], whole, whole[:, behind]])
    turns = np.concatenate([turns[before] - 2 * np.pi, turns, turns[behind] + 2 * np.pi])
    return RectBivariateSpline(r, turns, whole, kx=degree, ky=3)


def _normal_force(radii: Array, angles: Array, p: Array) -> float:
    """Compute ∫ p dA [force] of p (n, J + 1) on half a circle and its mirror image, linear in r."""
    rings = 2 * np.asarray(np.trapezoid(p, angles, axis=1))
    inner, outer = radii[:-1], radii[1:]
    parts = (2 * inner + outer) * rings[:-1] + (inner + 2 * outer) * rings[1:]
    return float(np.sum((outer - inner) * parts) / 6)
