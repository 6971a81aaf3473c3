"""Units of physical quantities: tables with exact decimal factors, and pint for all other units."""

from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Context, Decimal
from functools import cache
from types import MappingProxyType
from typing import Any


class UnknownUnit(ValueError):
    """Error for a unit that is unknown or belongs to another physical quantity."""


@dataclass(frozen=True, eq=False)
class Kind:
    """Physical quantity, such as a length, with its units.

    si       SI unit; empty for a pure number
    example  example of a value in a scene file
    units    factor of each unit to the SI unit, in decimal so that "18 mm" is exactly 0.018
    """

    si: str
    example: str
    units: Mapping[str, Decimal]

    def to_si(self, number: Decimal, unit: str, context: Context) -> float:
        """Convert a number with a unit to SI.

        context  decimal context of the multiplication

        Raises `UnknownUnit` for an unknown unit and for a unit of another physical quantity.
        """
        factor = self.units.get(unit)
        if factor is not None:
            return float(context.multiply(number, factor))
        if self.si in ("1", "rad"):
            raise UnknownUnit(unit)  # pint counts percent and m/m as angles, and angles as shares
        return _convert_with_pint(number, unit, self.si)


def _table(**factors: str) -> Mapping[str, Decimal]:
    table = {unit: Decimal(factor) for unit, factor in factors.items()}
    for unit in [unit for unit in table if unit.startswith("u") or "/u" in unit]:
        for micro in "µμ":  # micro sign, Greek mu
            table[unit.replace("u", micro)] = table[unit]
    return MappingProxyType(table)


_DEGREE = Decimal("0.01745329251994329576923690768488612713443")  # pi/180

PURE_NUMBER = Kind("", "", MappingProxyType({}))
LENGTH = Kind("m", '"18 mm"', _table(m="1", cm="1e-2", mm="1e-3", um="1e-6", nm="1e-9"))
FORCE = Kind("N", '"1 kN"', _table(N="1", uN="1e-6", mN="1e-3", kN="1e3", MN="1e6"))
MOMENT = Kind(
    "N m",
    '"2 N m"',
    _table(
        **{"N m": "1", "N mm": "1e-3", "uN m": "1e-6", "mN m": "1e-3", "kN m": "1e3"},
        **{"Nm": "1", "Nmm": "1e-3", "uNm": "1e-6", "mNm": "1e-3", "kNm": "1e3"},
    ),
)
STIFFNESS = Kind(
    "N/m",
    '"50 N/um"',
    _table(**{"N/m": "1", "N/mm": "1e3", "mN/um": "1e3", "N/um": "1e6", "kN/mm": "1e6"}),
)
PRESSURE = Kind("Pa", '"210 GPa"', _table(Pa="1", kPa="1e3", MPa="1e6", GPa="1e9", TPa="1e12"))
_ANGLES = {"rad": Decimal(1), "mrad": Decimal("1e-3"), "deg": _DEGREE, "°": _DEGREE}
ANGLE = Kind("rad", '"20 deg"', MappingProxyType(_ANGLES))
ROTATION = Kind("rad", '"0.1 deg"', MappingProxyType(_ANGLES))
SHARE = Kind("1", '"0.1 %"', MappingProxyType({"%": Decimal("0.01")}))


@cache
def _registry() -> Any:
    # Imported here: the import takes longer than reading a scene.
    from pint import UnitRegistry

    return UnitRegistry(non_int_type=Decimal)


def _convert_with_pint(number: Decimal, unit: str, si: str) -> float:
    from pint.errors import PintError

    try:
        factor = _registry().Quantity(Decimal(1), unit.replace("·", "*")).to(si).magnitude
        return float(number * Decimal(factor))
    except (PintError, ArithmeticError, ValueError, TypeError, AttributeError) as error:
        raise UnknownUnit(unit) from error
