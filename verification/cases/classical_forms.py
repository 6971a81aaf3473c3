"""Where the textbook forms of the layered response lose their digits."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache, partial
from typing import TYPE_CHECKING

import numpy as np

from verification.exhibits.numbers import plain
from verification.exhibits.table import NONE, Table
from verification.judging.case import Case, Check, Level, Required
from verification.laws.classical_forms import CONTRASTS, DEPTHS, FORMS, DigitLoss, digit_losses
from verification.problems.reference import identity

if TYPE_CHECKING:
    from semi_analytical import Result

WELL_CONDITIONED = ((0.5, 2.0, 4.0), (0.5, 1.0, 2.0))  # contrasts, α h


def classical_forms(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    return Case(
        name="classical_forms",
        title="Where classical forms of the layered response lose digits",
        problem=(
            "Four ways in which one layer on a half-space is usually computed, each exact in "
            "exact arithmetic, against the recursion used here: transfer matrices (Thomson 1950, "
            "Haskell 1953), layer stiffness matrices (Kausel and Roësset 1981), one linear system "
            "for all amplitudes, and the closed form with λ and κ (O'Sullivan and King 1988). "
            "Where all are well conditioned they are independent confirmations; the table shows "
            "where they are not. The recursion itself is within 5e-15 everywhere, see "
            "layered_reference."
        ),
        runs=(),
        quantities=(),
        checks=tuple(
            Check(
                f"agreement_{form.replace(' ', '_')}", f"{form} against the recursion", "",
                "E₁/E₂ 0.5 to 4, α h 0.5 to 2", partial(_agreement, form),
                identity(0.0, "the same response, written differently"),
                Required(1e-13, "well conditioned: a few roundings"), 1.0, "1",
            )
            for form in FORMS
        ),
        tables=_tables,
    )  # fmt: skip


@cache
def _losses(contrasts: tuple[float, ...], depths: tuple[float, ...]) -> tuple[DigitLoss, ...]:
    return tuple(digit_losses(contrasts, depths))


def _agreement(form: str) -> float:
    return max(loss.error for loss in _losses(*WELL_CONDITIONED) if loss.form == form)


def _tables(results: Mapping[str, Result]) -> tuple[Table, ...]:
    found = {
        (loss.contrast, loss.depth, loss.form): loss.error for loss in _losses(CONTRASTS, DEPTHS)
    }
    rows = tuple(
        (
            f"E₁/E₂ = {contrast:g}, α h = {depth:g}",
            *(_text(found[contrast, depth, form]) for form in FORMS),
        )
        for contrast in CONTRASTS
        for depth in DEPTHS
    )
    return (
        Table(
            title="Largest relative error of C₁₁ and C₂₂",
            columns=("layer and wavenumber", *FORMS),
            rows=rows,
            note="Growing exponentials overflow; stiff layers drown the substrate's stiffness; "
            "thin layers make the closed form a difference of numbers near one.",
            units=NONE,
        ),
    )


def _text(error: float) -> str:
    if not np.isfinite(error):
        return "overflows"
    return "all digits" if error > 0.1 else plain(error, 1)
