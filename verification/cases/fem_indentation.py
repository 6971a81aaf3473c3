"""A rigid ball pressed on bodies that slip away below it, by finite elements."""

from __future__ import annotations

from verification.cases.levels import because, finest
from verification.judging.case import Case, Level
from verification.judging.declared_case import Drawing, Reported, Within, case, judged
from verification.judging.drawings import Drawn, profile
from verification.judging.ladder import Ladder, asked, named, on_elements
from verification.judging.observable import Observable
from verification.judging.observables import APPROACH, CONTACT_RADIUS
from verification.judging.pressing_errors import PRESSURE, SHEAR
from verification.observed.end_state import contact_radius, stick_radius
from verification.problems.indentation import COATED, FEW, STRONG, WEAK, Indentation
from verification.problems.sheared import OVER_LIMIT

MANY = 60
ASKED = "asked of the finite elements"
STICK_PART = Observable(
    "stick_radius", "stick radius over contact radius", "",
    lambda result, *_: stick_radius(result) / contact_radius(result),
    lambda exact: float(exact.stick_part),
)  # fmt: skip
ROWS = (
    Within(APPROACH, 2e-4, ASKED),
    Within(CONTACT_RADIUS, 2e-3, "asked of the finite elements at 64 per radius"),
    Within(PRESSURE, asked(2e-3, 1), because(1)),
    Within(SHEAR, 1e-2, ASKED),
)


def pressed(one: Indentation, elements: int, increments: int) -> Ladder:
    """The scene of frictional_indentation, but for its increments, on one mesh."""
    meshes = on_elements(one.problem(increments), (elements,), over=0.97, of=one.name)
    return named(f"{one.name}, {increments} increments", meshes)


def fem_indentation(level: Level = Level.QUICK) -> Case:
    """The case, on finer meshes at higher levels."""
    n = finest(level)
    meshes = {
        one: pressed(one, n, increments)
        for one, increments in {WEAK: FEW, STRONG: MANY, COATED: FEW}.items()
    }
    return case(
        "fem_indentation",
        "Finite elements: pressing with friction",
        "The scenes of frictional_indentation by finite elements: pressure as a linear "
        "complementarity problem and radial shear as a quadratic program within the friction "
        "limit, one after the other until they agree. No penalty: contact and stick are exact "
        "over the hat functions of the tractions.",
        *(judged(mesh, (*ROWS, _coarse(one, n))) for one, mesh in meshes.items()),
        charts=tuple(shear_profile("fem_indentation", one, mesh) for one, mesh in meshes.items()),
        limits=(
            f"The shear is judged where the increments allow: {FEW} for µ = 0.1, {MANY} for "
            "µ = 0.3.",
        ),
    )


def _coarse(one: Indentation, elements: int) -> Reported:
    return Reported(
        STICK_PART, f"the reference has {one.stick_part:.4f}; one element is {1 / elements:.4f}"
    )


def shear_profile(name: str, one: Indentation, mesh: Ladder) -> Drawing:
    """The outward shear over the radius."""
    (step,) = mesh.problem.scene.loading
    return profile(
        mesh,
        f"{name}_{one.file_name}",
        f"Shear over the radius, {one.name}",
        f"Outward shear by finite elements after {step.increments} increments over the reference, "
        "and their difference: it remembers the whole way.",
        "q / µp_H",
        mesh.problem.scale(OVER_LIMIT),
        Drawn(lambda end: end.shear_radial, lambda exact: exact.shear),
    )
