"""Sliding under other readings of Coulomb's law, computed apart from the product's solver.

The paper's friction law bounds |q| by µp but does not say in which direction a slipping cell pulls
(its equation (6)). Each reading here keeps the pressure of the end of the normal loading and shifts
the indenter in small steps; in each the shear minimises ½ q·A q - c·q over what the reading admits,
found by projected gradients with momentum (Beck and Teboulle 2009) and restarts (O'Donoghue and
Candès 2015). Slow, short, and independent of the Newton method that it is compared with.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]
Map = Callable[[Field], Field]

TOLERANCE = 1e-7
MOST_ITERATIONS = 4000
CHECK_EVERY = 5
POWER_ITERATIONS = 40
# The power method comes from below.
STIFFNESS_MARGIN = 1.02


class FrictionLaw(StrEnum):
    """Readings of the law of friction."""

    VECTOR = "vector"  # |q| <= µp, slip opposes q: Coulomb's law as the product solves it
    FROZEN_DIRECTIONS = "frozen-directions"  # a slipping cell keeps its first direction
    FROZEN_TRANSVERSE = "frozen-transverse"  # q_y stays as the normal loading left it
    COMPONENT_WISE = "component-wise"  # |q_x| <= µp and |q_y| <= µp, each by itself


@dataclass(frozen=True)
class FixedPressure:
    """The shear problem at a pressure that does not change.

    displace         shear (2, nx, ny) -> tangential displacement, symmetric and positive
    bound            friction limit µp (nx, ny)
    largest          eigenvalue of `displace` on the contact, or a little more
    self_compliance  displacement of a cell by its own unit shear
    """

    displace: Map
    bound: Field
    largest: float
    self_compliance: float

    @classmethod
    def of(cls, displace: Map, bound: Field, self_compliance: float) -> FixedPressure:
        """With the largest eigenvalue found by the power method."""
        inside = bound > 0
        v = np.random.default_rng(4).normal(size=(2, *bound.shape)) * inside
        largest = 0.0
        for _ in range(POWER_ITERATIONS):
            v = v / np.sqrt(np.sum(v * v))
            image = displace(v) * inside
            largest = float(np.sum(v * image))
            v = image
        return cls(displace, bound, STIFFNESS_MARGIN * largest, self_compliance)


@dataclass(frozen=True)
class Held:
    """Shear, its displacement, who sticks, who is held at a direction (frozen directions only),
    and the residual of the last solve."""

    shear: Field
    displacement: Field
    in_stick: Mask
    frozen: Mask
    residual: float = 0.0


def at_rest(problem: FixedPressure, shear: Field) -> Held:
    """The state that the normal loading leaves: cells at their limit have slipped."""
    slipping = np.hypot(*shear) >= problem.bound * (1 - 1e-6)
    inside = problem.bound > 0
    return Held(shear, problem.displace(shear), inside & ~slipping, inside & slipping)


def shifted(problem: FixedPressure, law: FrictionLaw, state: Held, by: float) -> Held:
    """The state after the indenter moved along x by a small shift [length].

    raises  ArithmeticError if the iteration does not converge
    """
    target = state.displacement + np.array([by, 0.0])[:, None, None]
    return LAWS[law](problem, state, target)


def vector(problem: FixedPressure, state: Held, target: Field) -> Held:
    """Coulomb's law: the nearest shear on the disc."""
    return _solved(problem, target, state, lambda y: _on_discs(y, problem.bound))


def component_wise(problem: FixedPressure, state: Held, target: Field) -> Held:
    """Each component cut off by itself."""
    bound = problem.bound
    return _solved(problem, target, state, lambda y: np.clip(y, -bound, bound))


def frozen_transverse(problem: FixedPressure, state: Held, target: Field) -> Held:
    """q_y as it is, and what the disc leaves for q_x."""
    q_y = state.shear[1]
    limit = np.sqrt(np.maximum(problem.bound**2 - q_y**2, 0.0))
    new = _solved(problem, target, state, lambda y: np.stack([np.clip(y[0], -limit, limit), q_y]))
    z = _trial(problem, new, target)
    return replace(new, in_stick=(problem.bound > 0) & (np.abs(z[0]) <= limit))


def frozen_directions(problem: FixedPressure, state: Held, target: Field) -> Held:
    """A cell that slips keeps q until the surfaces would move against it; then it is free again."""
    fixed, frozen = state.shear, state.frozen
    while True:
        held = frozen
        new = _solved(
            problem, target, state,
            lambda y, held=held: np.where(held, fixed, _on_discs(y, problem.bound)),  # type: ignore[misc]
        )  # fmt: skip
        moved = target - new.displacement
        against = frozen & (np.sum(moved * fixed, axis=0) < 0)
        if not np.any(against):
            break
        frozen = frozen & ~against
        state = replace(state, shear=new.shear, displacement=new.displacement)
    inside = problem.bound > 0
    beyond = np.hypot(*_trial(problem, new, target)) > problem.bound
    frozen = frozen | (inside & beyond)
    return replace(new, in_stick=inside & ~frozen, frozen=frozen)


LAWS: dict[FrictionLaw, Callable[[FixedPressure, Held, Field], Held]] = {
    FrictionLaw.VECTOR: vector,
    FrictionLaw.FROZEN_DIRECTIONS: frozen_directions,
    FrictionLaw.FROZEN_TRANSVERSE: frozen_transverse,
    FrictionLaw.COMPONENT_WISE: component_wise,
}


def _on_discs(y: Field, bound: Field) -> Field:
    size = np.hypot(y[0], y[1])
    return np.asarray(y * np.where(size > bound, bound / np.where(size > 0, size, 1.0), 1.0))


def _trial(problem: FixedPressure, state: Held, target: Field) -> Field:
    """q + γ (c - A q): inside the admissible set where the cell sticks."""
    return np.asarray(state.shear + (target - state.displacement) / problem.self_compliance)


def _solved(problem: FixedPressure, target: Field, start: Held, project: Map) -> Held:
    """The admissible shear of least energy ½ q·A q - c·q."""
    step, total = 1 / problem.largest, np.sum(problem.bound)
    q = project(start.shear)
    Aq = problem.displace(q)
    y, Ay, t = q, Aq, 1.0
    residual = np.inf
    for iteration in range(MOST_ITERATIONS):
        if iteration % CHECK_EVERY == 0:
            state = replace(start, shear=q, displacement=Aq)
            z = _trial(problem, state, target)
            residual = float(np.sum(np.hypot(*(project(z) - q))) / total)
            if residual <= TOLERANCE:
                sticks = (problem.bound > 0) & np.all(project(z) == z, axis=0)
                return replace(state, in_stick=sticks, residual=residual)
        new = project(y - step * (Ay - target))
        A_new = problem.displace(new)
        if np.sum((y - new) * (new - q)) > 0:
            t = 1.0
        t_next = (1 + np.sqrt(1 + 4 * t * t)) / 2
        momentum = (t - 1) / t_next
        y, Ay = new + momentum * (new - q), A_new + momentum * (A_new - Aq)
        q, Aq, t = new, A_new, t_next
    raise ArithmeticError(f"the shear did not converge: residual {residual:.1e}")
