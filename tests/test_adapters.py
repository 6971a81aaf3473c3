"""Our own solvers answer challenges by the door of all, each what it can."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from verification import Answer, CannotDo, Solver, judge
from verification.adapters import radius, section, surface
from verification.challenge.door import Posed
from verification.challenge.judgement import Judgement
from verification.judging.outcome import Status

Solve = Callable[[Posed, int], Answer]
CELLS = (surface.answer, surface.ON_CELLS)
ELEMENTS = (section.answer, section.ON_ELEMENTS)
RADII = (radius.answer, radius.ON_RADII)


def failed(found: Judgement) -> set[str]:
    return {row.quantity for row in found.rows if row.status is Status.FAIL}


@pytest.mark.parametrize(
    ("name", "code", "levels", "grade"),
    [
        ("torsion_loop", CELLS, 2, "B"),
        ("torsion_loop", ELEMENTS, 1, "C"),
        ("sliding_stress", CELLS, 3, "B"),
        ("layered_patch/G1_over_G2=0.5", CELLS, 1, "A"),
        ("frictional_indentation/weak", ELEMENTS, 3, "C"),
        ("coated_paraboloid/E1_over_E2=4", ELEMENTS, 3, "C"),
        ("coated_paraboloid/E1_over_E2=4", RADII, 3, "A"),
        ("cone_contact", RADII, 2, "A"),
    ],
)
def test_each_solver_reaches_its_class(
    name: str, code: tuple[Solve, Solver], levels: int, grade: str
) -> None:
    answer, solver = code
    found = judge(name, answer, levels, solver=solver)
    assert found.grade <= grade, found.rows
    assert not found.omitted


@pytest.mark.parametrize(
    ("answer", "name", "said"),
    [
        (radius.answer, "cattaneo_mindlin", "pressure alone"),
        (radius.answer, "hertz_elliptical", "not the same all around"),
        (section.answer, "hertz_elliptical", "not the same all around"),
        (section.answer, "layered_patch/G1_over_G2=2", "contacts only"),
    ],
)
def test_who_cannot_says_why(answer: Solve, name: str, said: str) -> None:
    with pytest.raises(CannotDo, match=said):
        judge(name, answer, 1)


def test_shear_between_rings_is_what_pulls() -> None:
    found = judge("cattaneo_mindlin", section.answer, 1, solver=section.ON_ELEMENTS)
    assert {"shear_x", "shear_x: load carried", "shift_x"} <= {row.quantity for row in found.rows}
    assert "shear_x: load carried" not in failed(found)
