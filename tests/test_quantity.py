"""Tests of quantities in scene files: numbers in SI, or texts with a unit, converted without
round-off."""

import math
import re
import warnings
from datetime import timedelta
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pint
import pytest
from pydantic import TypeAdapter, ValidationError

from contact_scene import FiniteElementDiscretisation, SurfaceDiscretisation
from contact_scene.geometry import HeightMap
from contact_scene.reading.quantity import (
    Force,
    Length,
    Moment,
    PoissonRatio,
    PositivePressure,
    Rotation,
    SlopeAngle,
    WithUnit,
)
from contact_scene.reading.units import (
    ANGLE,
    FORCE,
    LENGTH,
    MOMENT,
    PRESSURE,
    SHARE,
    STIFFNESS,
    equal_unit,
)
from slipstick import LoadStep, Paraboloid


@pytest.mark.parametrize(
    ("kind", "written", "expected"),
    [
        (Length, "18 mm", 0.018),
        (Length, "0.388mm", 0.000388),
        (Length, "8 µm", 8e-6),
        (Length, "8 μm", 8e-6),
        (Length, "+.5 m", 0.5),
        (Force, "1 kN", 1000.0),
        (Moment, "2 N m", 2.0),
        (Moment, "-0.3 kNm", -300.0),
        (Moment, "7 N mm", 0.007),
        (Rotation, "-0.1 deg", math.radians(-0.1)),
        (PositivePressure, "210000 N/mm^2", 210e9),
        (SlopeAngle, "20°", math.radians(20)),
        (SlopeAngle, "100 mrad", 0.1),
        (PoissonRatio, 0.5, 0.5),
    ],
)
def test_a_text_with_a_unit_is_the_literal_in_si_to_the_last_bit(kind, written, expected):
    assert TypeAdapter(kind).validate_python(written) == expected


@pytest.mark.parametrize("kind", [LENGTH, FORCE, MOMENT, STIFFNESS, PRESSURE, ANGLE])
def test_each_unit_of_a_table_has_the_factor_of_another_registry(kind):
    assert len(kind.units) > 3
    for unit, factor in kind.units.items():
        apart = re.sub("N(?=m)", "N ", unit)  # "Nm" is a nanometre there
        assert float(factor) == pytest.approx(UNITS.Quantity(1.0, apart).to(kind.si).magnitude)


WRITTEN = """
 g kg t lb lbs kgf kp dyn daN cN pN nN GN TN kn KN Kn mn MN Mn N n newton lbf LBF ozf m M km dm cm
 CM Cm mm MM Mm mM um UM Um uM µm micron nm NM Nm pm Å A in IN inch inches ft mil Pa PA pa hPa kPa
 KPA Kpa MPa Mpa MPA mpa mPa GPa Gpa gpa TPa N/m2 N/m^2 GN/m^2 MN/m^2 kN/m^2 kN/mm^2 N/mm2 N/um^2
 mN/um^2 daN/mm^2 bar mbar Bar ksi psi PSI Msi atm kg/mm^2 N/m N/mm N/cm kN/m MN/m GN/m mN/nm uN/nm
 N/nm N/µm kN/um nN/nm N/m/m mNm kNm Nmm kNmm rad mrad urad deg degree DEG Rad grad %
 percent ppm s Hz
"""


@pytest.mark.parametrize("kind", [LENGTH, FORCE, MOMENT, STIFFNESS, PRESSURE, ANGLE, SHARE])
def test_a_suggested_unit_has_the_size_of_the_written_one(kind):
    pairs = [(written, equal_unit(written, kind)) for written in {*WRITTEN.split()} - {*kind.units}]
    sizes = {pair: size_of_one_in(*pair) for pair in pairs if pair[1] is not None}
    assert sizes == pytest.approx(dict.fromkeys(sizes, 1.0))


def size_of_one_in(written: str, suggested: str) -> float:
    """One written unit in suggested ones; units that differ by case alone agree in m and M."""
    if suggested.lower() == written.lower():
        mega, other = ([one for one in unit if one in "mM"] for unit in (written, suggested))
        return float(mega == other)
    apart, known = (
        re.sub("N(?=m)", "N ", re.sub("(?<=m)2", "^2", unit)) for unit in (written, suggested)
    )
    return UNITS.Quantity(1.0, apart).to(known).magnitude


# ---- numbers of other libraries


HEIGHTS = 1e-6 * np.arange(16.0).reshape(4, 4)
UNITS = pint.UnitRegistry()


class WithUnits(np.ndarray[Any, Any]):
    """As unyt and astropy: an array with a unit that float() forgets."""

    units = "mm"


class Series:
    """As pandas and torch: several numbers, one of which float() takes without a word."""

    def __init__(self, *values: float) -> None:
        self.values = np.array(values)

    def __array__(self, dtype=None, copy=None):
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


def with_units(values):
    return np.asarray(values).view(WithUnits)


def masked(values):
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
    *(UNITS.Quantity(18.0, "mm"), UNITS.Quantity(18.0, ""), with_units(18.0), Millimetres(18.0)),
    *(np.ma.masked, masked(18.0), np.array([18.0]), Series(18.0), Series(18.0, 19.0)),
    *(np.array(18.0, dtype=object), np.array("18 mm"), np.complex128(18 + 1j), np.True_),
    *(np.timedelta64(18, "s"), timedelta(18), np.datetime64("2020"), b"18 mm", "0x12 m", "１８ mm"),
    *(np.float32("inf"), Decimal("sNaN"), Fraction(10**999), object(), [18.0], {"m": 18.0}),
)
NO_COUNT = (
    *(5.0, "5", 5 + 0j, np.True_, np.timedelta64(5), with_units(5), masked(5), Series(5)),
    *(np.array([5]), UNITS.Quantity(5, ""), 10**999, -1),
)
NO_PAIR = (
    *({1.0, 2.0}, {1.0: 2.0, 2.0: 1.0}, "12", b"12", 1.0, (1.0,), np.ones((2, 2)), np.ones(3)),
    *(masked([1.0, 2.0]), np.array([1.0, np.nan]), UNITS.Quantity([1.0, 2.0], "kN")),
    *((UNITS.Quantity(1.0, "N"),) * 2, Series(1.0, 2.0), (Series(1.0), 2.0), (np.ma.masked, 2.0)),
)
NO_HEIGHTS = (
    *(with_units(HEIGHTS), masked(HEIGHTS), UNITS.Quantity(HEIGHTS, "um"), HEIGHTS + 1j),
    *(HEIGHTS.astype(object), HEIGHTS.astype(str), HEIGHTS > 0, HEIGHTS.tolist()),
    *((1e6 * HEIGHTS).astype("m8[s]"), HEIGHTS * np.nan, HEIGHTS.ravel(), HEIGHTS[:3], None),
    Series(*HEIGHTS[0]),
)


def radius(value):
    return Paraboloid(radius=value, material="rigid").radius


@pytest.mark.parametrize("value", SAME, ids=repr)
def test_a_number_of_any_library_is_its_own_bits(value):
    found = radius(value)
    assert type(found) is (WithUnit if isinstance(value, str) else float)
    assert found == (0.018 if isinstance(value, str) else float(value))


def test_arrays_and_whole_numbers_of_numpy_are_taken():
    step = LoadStep(tangential_force=np.array([1.0, 2.0]), increments=np.int64(5))
    assert (step.tangential_force, step.increments) == ((1.0, 2.0), 5)
    for values in (HEIGHTS, HEIGHTS.astype("f4"), (1e6 * HEIGHTS).astype(int), HEIGHTS.T):
        taken = HeightMap(file=values, spacing=1e-6, material="rigid").file.values
        assert np.array_equal(taken, values)
        assert not np.shares_memory(taken, values)


REFUSALS = (
    (lambda value: Paraboloid(radius=value, material="rigid"), NO_LENGTH),
    (lambda value: LoadStep(normal_force=1.0, increments=value), NO_COUNT),
    (lambda value: SurfaceDiscretisation(cells=(value, 16)), NO_COUNT),
    (lambda value: FiniteElementDiscretisation(elements_per_radius=value), NO_COUNT),
    (lambda value: LoadStep(tangential_force=value), NO_PAIR),
    (lambda value: HeightMap(file=value, spacing=1e-6, material="rigid"), NO_HEIGHTS),
)


@pytest.mark.parametrize(
    ("make", "value"), [(make, value) for make, values in REFUSALS for value in values]
)
def test_what_is_no_length_count_pair_or_height_is_refused(make, value):
    """By one exception, without a warning, that says what came in words that can be printed."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ValidationError) as found:
            make(value)
    for detail in found.value.errors(include_url=False):
        assert detail["msg"].isprintable()
        assert len(detail["msg"]) < 300


def test_a_quantity_with_a_unit_is_told_what_to_write():
    with pytest.raises(ValidationError, match=r'write a text such as "18 mm", or .* in m'):
        radius(UNITS.Quantity(18, "mm"))
