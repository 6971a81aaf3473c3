"""The laws that any surface FRF obeys, tried on random layered bodies."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from verification.judging.case import Case, Check, Level, Required
from verification.laws.law import Law, worst_violation
from verification.laws.limit_laws import LIMIT_LAWS
from verification.laws.symmetry_laws import SYMMETRY_LAWS
from verification.problems.reference import identity

LAWS = tuple(sorted(SYMMETRY_LAWS + LIMIT_LAWS, key=lambda law: int(law.number[1:])))


def frf_laws(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    return Case(
        name="frf_laws",
        title="Laws of the frequency response of layered bodies",
        problem=(
            "What mechanics says of the surface response of any layered body, whatever its "
            "materials: reciprocity, symmetries, positive energy, limits, monotonicity. Each law "
            "is tried on random bodies of one to five layers on a half-space or a rigid base, "
            "stiffness contrasts to 1e6, ν from -0.95 to exactly ½, thicknesses over four and "
            "wavenumbers over eight decades. The value is the worst violation found, relative to "
            "the largest entry where nothing else is said. The bodies are the same in every run; "
            "the tests search for worse ones."
        ),
        runs=(),
        quantities=(),
        checks=tuple(map(_check, LAWS)),
    )


def _check(law: Law) -> Check:
    measure: Callable[[], float] = partial(worst_violation, law)
    return Check(
        law.name, f"{law.number}: {law.statement}", "", f"{law.draws} bodies", measure,
        identity(0.0, f"property {law.number} of elastic layered half-spaces"),
        Required(law.allowed, "bound of the law" if law.allowed == 1 else "rounding, or the law's "
                 "own next order"),
        1.0, "1",
    )  # fmt: skip
