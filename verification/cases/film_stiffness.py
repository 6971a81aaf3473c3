"""What a film adds to the stiffness of a flat punch, to first order."""

from __future__ import annotations

from math import log

import numpy as np
from numpy.typing import NDArray

from semi_analytical.frf.stack import Film, HalfSpace, Stack
from semi_analytical.frf.surface import scalars
from verification.closed_forms.coated_indentation import LayeredSurface, flat_punch
from verification.closed_forms.gao_chiu_lee import modulus_weight, ratio_weight
from verification.judging.case import Case, Check, Level, Required
from verification.problems.reference import closed_form

SOURCE = "Gao, Chiu and Lee 1992, first order in the difference of film and substrate"
DEPTHS = (0.1, 0.5, 1.0, 3.0)  # thickness over punch radius
RATIO = 0.3
STEP = 1e-4
ASKED = Required(
    2e-8, "three times what differences of 1e-4 leave; the project's accuracy targets require 1e-5"
)


def film_stiffness(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    return Case(
        name="film_stiffness",
        title="Flat punch on a film: first-order stiffness",
        problem=(
            "The contact stiffness of a flat punch on a film that differs little from its "
            "substrate, differentiated by the film's shear modulus and Poisson's ratio. Gao, Chiu "
            "and Lee give the derivatives in closed form from the homogeneous stress field alone. "
            "Here they are central differences of the stiffness from our layered response, by the "
            "semi-closed integral equation."
        ),
        runs=(),
        quantities=(),
        checks=tuple(check for depth in DEPTHS for check in _derivatives(depth)),
    )


def stiffness(depth: float, shear_modulus: float, poisson_ratio: float) -> float:
    """Load per approach of a punch of unit radius on a film on a substrate of G = 1."""
    stack = Stack([Film(shear_modulus, poisson_ratio, depth)], HalfSpace(1.0, RATIO))

    def compliance(k: NDArray[np.float64]) -> NDArray[np.float64]:
        return scalars(stack, k).c22

    surface = LayeredSurface(compliance, 2 * shear_modulus / (1 - poisson_ratio), depth)
    return flat_punch(surface, 1.0).load


def _by_modulus(depth: float) -> float:
    stiff, soft = (log(stiffness(depth, 1 + step, RATIO)) for step in (STEP, -STEP))
    return (stiff - soft) / (log(1 + STEP) - log(1 - STEP))


def _by_ratio(depth: float) -> float:
    high, low = (log(stiffness(depth, 1.0, RATIO + step)) for step in (STEP, -STEP))
    return (1 - RATIO) * (high - low) / (2 * STEP)


def _derivatives(depth: float) -> tuple[Check, Check]:
    subject = f"h/a = {depth:g}"
    return (
        Check(
            "by_shear_modulus", "∂ ln S / ∂ ln G₁", "", subject, lambda: _by_modulus(depth),
            closed_form(modulus_weight(depth, RATIO), SOURCE), ASKED, 1.0, "1",
        ),
        Check(
            "by_poisson_ratio", "(1 - ν) ∂ ln S / ∂ ν₁ at fixed G₁", "", subject,
            lambda: _by_ratio(depth), closed_form(ratio_weight(depth), SOURCE), ASKED, 1.0, "1",
        ),
    )  # fmt: skip
