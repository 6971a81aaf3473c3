"""Validation of arguments: ValueError with the name of an argument outside its range."""

import math
from functools import cache

import numpy as np
from numpy.typing import NDArray

# µW computed on two paths differs in the last digits; that much excess counts as T = µW.
ROUNDING = 1e-14


def require_positive(**quantities: float) -> None:
    """Raise ValueError naming the first quantity that is not a finite number above zero."""
    for name, value in quantities.items():
        if not (math.isfinite(value) and value > 0):
            raise ValueError(f"{name} is {value!r}, expected a finite number > 0")


def require_non_negative(**quantities: float) -> None:
    """Raise ValueError naming the first quantity that is not a finite number of at least zero."""
    for name, value in quantities.items():
        if not (math.isfinite(value) and value >= 0):
            raise ValueError(f"{name} is {value!r}, expected a finite number >= 0")


def require_within_friction_limit(
    tangential_force: float, friction_coefficient: float, load: float
) -> None:
    """Raise ValueError when |tangential force| exceeds friction coefficient times load."""
    limit = friction_coefficient * load
    if not abs(tangential_force) <= limit * (1 + ROUNDING):
        raise ValueError(
            f"tangential force {tangential_force!r} exceeds friction limit {limit!r} "
            f"(= {friction_coefficient!r} * {load!r}): gross sliding, no static solution"
        )


@cache
def unit_gauss(order: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Nodes and weights with sum(weights * f(nodes)) = integral of f from 0 to 1."""
    nodes, weights = np.polynomial.legendre.leggauss(order)
    nodes, weights = (nodes + 1) / 2, weights / 2
    nodes.setflags(write=False)
    weights.setflags(write=False)
    return nodes, weights
