"""What scripts hand over from other libraries is taken bit for bit, or refused by one message."""

import warnings
from collections.abc import Callable
from datetime import timedelta
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pint
import pytest
from pydantic import BaseModel, ValidationError

from contact_scene import FiniteElementDiscretisation, SurfaceDiscretisation
from contact_scene.geometry import HeightMap
from contact_scene.quantity import WithUnit
from slipstick import LoadStep, Paraboloid

HEIGHTS = 1e-6 * np.arange(16.0).reshape(4, 4)
UNITS: Any = pint.UnitRegistry()


class WithUnits(np.ndarray[Any, Any]):
    """As unyt and astropy: an array with a unit that float() forgets."""

    units = "mm"


class Series:
    """As pandas and torch: several numbers, one of which float() takes without a word."""

    def __init__(self, *values: float) -> None:
        self.values = np.array(values)

    def __array__(self, dtype: Any = None, copy: Any = None) -> Any:
        return self.values

    def __float__(self) -> float:
        if len(self.values) != 1:
            raise RuntimeError("cannot be converted to a scalar")
        return float(self.values[0])

    def __index__(self) -> int:
        return int(float(self))


class Millimetres(float):
    """As of a library whose numbers are floats."""

    unit = "mm"


def with_units(values: Any) -> Any:
    return np.asarray(values).view(WithUnits)


def masked(values: Any) -> Any:
    return np.ma.masked_array(values, mask=np.ones(np.shape(values), bool))


SAME = (
    np.float64(0.018),
    np.float32(0.018),
    np.longdouble("0.018"),
    np.array(0.018),
    Decimal("0.018"),
    Fraction(18, 1000),
    np.str_("18 mm"),
)
NO_LENGTH = (
    *(UNITS.Quantity(18.0, unit) for unit in ("mm", "m", "N", "percent", "mm/m", "")),
    *(with_units(18.0), with_units([18.0]), Millimetres(18.0)),
    *(np.ma.masked, masked(18.0), np.ma.array([18.0]), np.array([18.0]), np.array([18.0, 19.0])),
    *(Series(18.0), Series(18.0, 19.0), np.array(18.0, dtype=object), np.array("18 mm")),
    *(18 + 0j, np.complex128(18 + 1j), np.True_, True, np.timedelta64(18, "s"), timedelta(18)),
    *(np.datetime64("2020"), b"18 mm", "nan", "NaN mm", "inf m", "1e999 m", "0x12 m", "１８ mm"),
    *(float("nan"), np.float32("inf"), Decimal("sNaN"), Decimal("1e999"), Fraction(10**999)),
    *(10**999, None, object(), [18.0], {18.0}, {"m": 18.0}, lambda: 18.0),
)
NO_COUNT = (
    *(5.0, "5", 5 + 0j, np.True_, np.timedelta64(5), with_units(5), masked(5), Series(5)),
    *(np.array([5]), UNITS.Quantity(5, ""), UNITS.Quantity(5, "mm"), 10**999, -1),
)
NO_PAIR = (
    *({1.0, 2.0}, frozenset({1.0, 2.0}), {1.0: 2.0, 2.0: 1.0}, "12", b"12", 1.0, (1.0,)),
    *(np.ones((2, 2)), np.ones(3), masked([1.0, 2.0]), np.array([1.0, np.nan])),
    *(UNITS.Quantity([1.0, 2.0], "kN"), (UNITS.Quantity(1.0, "N"),) * 2, Series(1.0, 2.0)),
    *((Series(1.0), 2.0), (1.0 + 0j, 2.0), (np.ma.masked, 2.0)),
)
NO_HEIGHTS = (
    *(with_units(HEIGHTS), masked(HEIGHTS), np.ma.array(HEIGHTS), UNITS.Quantity(HEIGHTS, "um")),
    *(HEIGHTS + 1j, HEIGHTS.astype(object), HEIGHTS.astype(str), HEIGHTS > 0, HEIGHTS.tolist()),
    *((1e6 * HEIGHTS).astype("m8[s]"), HEIGHTS * np.nan, HEIGHTS.ravel(), HEIGHTS[:3], None, 5),
    Series(*HEIGHTS[0]),
)


def radius(value: Any) -> Any:
    return Paraboloid(radius=value, material="rigid").radius  # type: ignore[arg-type]


@pytest.mark.parametrize("value", SAME, ids=repr)
def test_a_number_of_any_library_is_its_own_bits(value: Any) -> None:
    found = radius(value)
    assert type(found) is (WithUnit if isinstance(value, str) else float)
    assert found == (0.018 if isinstance(value, str) else float(value))


def test_arrays_and_whole_numbers_of_numpy_are_taken() -> None:
    step = LoadStep(tangential_force=np.array([1.0, 2.0]), increments=np.int64(5))  # type: ignore[arg-type]
    assert (step.tangential_force, step.increments) == ((1.0, 2.0), 5)
    for values in (HEIGHTS, HEIGHTS.astype("f4"), (1e6 * HEIGHTS).astype(int), HEIGHTS.T):
        taken = HeightMap(file=values, spacing=1e-6, material="rigid").file.values  # type: ignore[arg-type]
        assert np.array_equal(taken, values)
        assert not np.shares_memory(taken, values)


def refused(make: Callable[[], BaseModel]) -> None:
    """By one exception, without a warning, that says what came in words that can be printed."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ValidationError) as found:
            make()
    for detail in found.value.errors(include_url=False):
        assert detail["msg"].isprintable()
        assert len(detail["msg"]) < 300


@pytest.mark.parametrize("value", NO_LENGTH, ids=lambda value: type(value).__name__)
def test_what_is_no_length_is_refused(value: Any) -> None:
    refused(lambda: Paraboloid(radius=value, material="rigid"))  # type: ignore[arg-type]


@pytest.mark.parametrize("value", NO_COUNT, ids=lambda value: type(value).__name__)
def test_what_is_no_count_is_refused(value: Any) -> None:
    refused(lambda: LoadStep(normal_force=1.0, increments=value))
    refused(lambda: SurfaceDiscretisation(cells=(value, 16)))
    refused(lambda: FiniteElementDiscretisation(elements_per_radius=value))


@pytest.mark.parametrize("value", NO_PAIR, ids=lambda value: type(value).__name__)
def test_what_is_no_pair_is_refused(value: Any) -> None:
    refused(lambda: LoadStep(tangential_force=value))


@pytest.mark.parametrize("value", NO_HEIGHTS, ids=lambda value: type(value).__name__)
def test_what_are_no_heights_is_refused(value: Any) -> None:
    refused(lambda: HeightMap(file=value, spacing=1e-6, material="rigid"))  # type: ignore[arg-type]


def test_a_quantity_with_a_unit_is_told_what_to_write() -> None:
    with pytest.raises(ValidationError, match=r'write a text such as "18 mm", or .* in m'):
        radius(UNITS.Quantity(18, "mm"))
