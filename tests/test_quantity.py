"""Quantities: numbers in SI, or texts with a unit, to the last bit."""

import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter, ValidationError

from contact_scene.quantity import (
    Force,
    FrictionCoefficient,
    Length,
    Moment,
    PoissonRatio,
    PositiveLength,
    PositivePressure,
    PressingForce,
    Rotation,
    SlopeAngle,
    Tolerance,
)


def value_of(kind: Any, written: Any) -> float:
    return TypeAdapter(kind).validate_python(written)


@pytest.mark.parametrize(
    ("kind", "written", "expected"),
    [
        (Length, "18 mm", 0.018),
        (Length, "1.2 mm", 0.0012),
        (Length, "0.388mm", 0.000388),
        (Length, "-8 um", -8e-6),
        (Length, "8 µm", 8e-6),
        (Length, "8 μm", 8e-6),
        (Length, "5e2 nm", 5e-7),
        (Length, "+.5 m", 0.5),
        (Length, " 18 mm ", 0.018),
        (Length, "1 inch", 0.0254),
        (Force, "1 kN", 1000.0),
        (Force, "-90 N", -90.0),
        (Force, "2 kg*m/s^2", 2.0),
        (Force, "3 N m/m", 3.0),
        (Moment, "2 N m", 2.0),
        (Moment, "-0.3 kNm", -300.0),
        (Moment, "7 N mm", 0.007),
        (Moment, "2 N*m", 2.0),
        (Moment, "2 N·cm", 0.02),
        (Rotation, "-0.1 deg", math.radians(-0.1)),
        (Rotation, "1 mrad", 0.001),
        (PositivePressure, "420 GPa", 420e9),
        (PositivePressure, "210000 N/mm^2", 210e9),
        (PositivePressure, "210000 N/mm**2", 210e9),
        (SlopeAngle, "20 deg", math.radians(20)),
        (SlopeAngle, "20°", math.radians(20)),
        (SlopeAngle, "100 mrad", 0.1),
        (PoissonRatio, 0, 0.0),
        (PoissonRatio, 0.5, 0.5),
    ],
)
def test_a_text_with_a_unit_is_the_literal_in_si_to_the_last_bit(
    kind: Any, written: Any, expected: float
) -> None:
    assert value_of(kind, written) == expected


@given(st.floats(1e-29, 1e29))
def test_a_plain_number_is_taken_as_it_is(number: float) -> None:
    assert value_of(PositiveLength, number) == number


@pytest.mark.parametrize(
    "written",
    [
        "18 s", "18 N", "18", "mm", "18 mn", "18 mm mm", "18  mm", "1,8 mm", "18 %", "1_8 mm", "",
        "18 furlongses", "nan mm", "inf m", "1e9999 m", "1e-400 m", "18 mm; 1", "__import__('os')",
        "18 m^99", "(18) mm", "18 mm # x", "1" * 50 + " m", True, None, [], {}, math.nan, math.inf,
        -math.inf, 10**400, 0, 0.0, -1, "-1 mm", "0 mm", 5e-324, 1e300,
    ],
)  # fmt: skip
def test_what_is_not_a_positive_length_is_refused_with_an_example(written: Any) -> None:
    with pytest.raises(ValidationError) as caught:
        value_of(PositiveLength, written)
    (error,) = caught.value.errors()
    assert error["type"] == "refused"
    assert error["ctx"]["message"].startswith("got ")
    assert "length" in error["ctx"]["expected"] or "magnitude" in error["ctx"]["expected"]


@pytest.mark.parametrize(
    ("kind", "inside", "outside"),
    [
        (PoissonRatio, [0.5, -0.999, 0.0], [0.5001, -1.0, -2, math.nan, "0.3", True]),
        (FrictionCoefficient, [0.0, 0.1, 3], [-0.1, math.inf, "0.1", False]),
        (Tolerance, [1e-8, 0.1, 1e-12], [1e-13, 0.2, 0.0, -1e-8, "1e-8"]),
        (
            SlopeAngle,
            [0.01, 1.04, "59.9 deg"],
            [0.0, math.pi / 3, 1.05, "60 deg", "60 percent", "1 m/m", "1 m"],
        ),
        (PressingForce, [0.0, 1e-30, 1e30], [-1.0, 1e31, 1e-31]),
        (Force, [0.0, -1.0, 1], [1e31, math.nan]),
    ],
)
def test_bounds_hold(kind: Any, inside: list[Any], outside: list[Any]) -> None:
    for written in inside:
        value_of(kind, written)
    for written in outside:
        with pytest.raises(ValidationError):
            value_of(kind, written)


@pytest.mark.parametrize(
    ("kind", "written", "hint"),
    [
        (Length, "18 MM", '"18 mm"'),
        (PositivePressure, "5 gpa", '"5 GPa"'),
        (PressingForce, "1 kn", '"1 kN"'),
        (Length, "0.018", "without quotes"),
    ],
)
def test_a_near_miss_gets_a_suggestion(kind: Any, written: str, hint: str) -> None:
    with pytest.raises(ValidationError) as caught:
        value_of(kind, written)
    assert hint in caught.value.errors()[0]["ctx"]["hint"]


@given(st.text(max_size=30) | st.from_regex(r"[0-9.eE+-]{1,8} ?[A-Za-z*/^ 0-9-]{1,12}"))
def test_no_text_gets_past_the_validator_in_any_other_way(text: str) -> None:
    try:
        value = value_of(Length, text)
    except ValidationError:
        return
    assert math.isfinite(value)
