"""Units of physical quantities: tables with exact decimal factors."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from types import MappingProxyType


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


def unit_factors(**factors: str) -> Mapping[str, Decimal]:
    """Return the factors of units to the SI unit by name, with both spellings of micro.

    factors  decimal factors by name of the unit; "u" stands for micro
    """
    table = {unit: Decimal(factor) for unit, factor in factors.items()}
    for unit in [unit for unit in table if unit.startswith("u") or "/u" in unit]:
        for micro in "µμ":  # micro sign, Greek mu
            table[unit.replace("u", micro)] = table[unit]
    return MappingProxyType(table)


_DEGREE = "0.01745329251994329576923690768488612713443"  # pi/180
# exact by definition
_INCH = "0.0254"
_POUND = "4.4482216152605"

PURE_NUMBER = Kind("", "", MappingProxyType({}))
COUNT = Kind("", "", unit_factors(**{"": "1"}))  # such as the number of a load step, in a table
LENGTH = Kind(
    "m",
    '"18 mm"',
    unit_factors(
        **{"m": "1", "cm": "1e-2", "mm": "1e-3", "um": "1e-6", "nm": "1e-9"},
        **{"in": _INCH, "inch": _INCH},
    ),
)
FORCE = Kind(
    "N", '"1 kN"', unit_factors(N="1", uN="1e-6", mN="1e-3", kN="1e3", MN="1e6", lbf=_POUND)
)
FORCE_PER_LENGTH = Kind(
    "N/m",
    '"100 N/mm"',
    unit_factors(
        **{"N/m": "1", "N/mm": "1e3", "mN/mm": "1", "N/um": "1e6", "kN/m": "1e3", "kN/mm": "1e6"}
    ),
)
MOMENT = Kind(
    "N m",
    '"2 N m"',
    unit_factors(
        **{"N m": "1", "N mm": "1e-3", "uN m": "1e-6", "mN m": "1e-3", "kN m": "1e3"},
        **{"Nm": "1", "Nmm": "1e-3", "uNm": "1e-6", "mNm": "1e-3", "kNm": "1e3"},
    ),
)
STIFFNESS = Kind(
    "N/m",
    '"50 N/um"',
    unit_factors(**{"N/m": "1", "N/mm": "1e3", "mN/um": "1e3", "N/um": "1e6", "kN/mm": "1e6"}),
)
# A moment N m and a stiffness N/m, per metre of a line contact.
MOMENT_PER_LENGTH = Kind("N", '"20 N"', FORCE.units)
STIFFNESS_PER_LENGTH = Kind(
    "N/m^2", '"50 N/mm^2"', unit_factors(**{"N/m^2": "1", "N/mm^2": "1e6", "kN/mm^2": "1e9"})
)
# Stress per separation of the two sides of an interface.
INTERFACE_STIFFNESS = Kind(
    "Pa/m",
    '"1 GPa/um"',
    unit_factors(
        **{"Pa/m": "1", "MPa/mm": "1e9", "MPa/um": "1e12", "GPa/um": "1e15", "GPa/nm": "1e18"},
        **{"N/m^3": "1", "N/mm^3": "1e9"},
    ),
)
PRESSURE = Kind(
    "Pa",
    '"210 GPa"',
    unit_factors(
        **{"Pa": "1", "kPa": "1e3", "MPa": "1e6", "GPa": "1e9", "TPa": "1e12"},
        **{"bar": "1e5", "N/m^2": "1", "N/mm^2": "1e6", "psi": "6894.757293168361336722673445"},
    ),
)
_ANGLES = unit_factors(**{"rad": "1", "mrad": "1e-3", "deg": _DEGREE, "°": _DEGREE})
ANGLE = Kind("rad", '"20 deg"', _ANGLES)
ROTATION = Kind("rad", '"0.1 deg"', _ANGLES)
SHARE = Kind("1", '"0.1 %"', unit_factors(**{"%": "0.01"}))

_PREFIXES = {
    **{"": 0, "p": -12, "n": -9, "u": -6, "µ": -6, "μ": -6, "m": -3, "c": -2, "d": -1},
    **{"da": 1, "h": 2, "k": 3, "M": 6, "G": 9, "T": 12},
}
# Powers of metre and newton.
_SYMBOLS = {"m": (1, 0), "N": (0, 1), "Pa": (-2, 1)}
_FACTOR = re.compile(r"(da|[pnuµμmcdhkMGT]?)(m|N|Pa)\^?([1-9]?) ?")
_PRODUCT = re.compile(rf"(?:{_FACTOR.pattern})*")


def equal_unit(unit: str, kind: Kind) -> str | None:
    """Return the unit of a quantity with the meaning of a text that is not among its units.

    An example is GPa for GN/m^2. In a text that is no unit in SI, such as gpa, letters of the other
    case are accepted, except m and M, which are milli and mega. Returns None if there is no such
    unit.
    """
    size = _size(unit)
    if size is not None:
        return next((known for known in kind.units if _size(known) == size), None)
    return next((known for known in kind.units if _fold_case(known) == _fold_case(unit)), None)


def _size(unit: str) -> tuple[int, int, int] | None:
    """Return the powers of ten, metre and newton in a unit; None for other units."""
    ten = metre = newton = 0
    for sign, product in zip((1, -1, -1), unit.split("/"), strict=False):
        if not product or not _PRODUCT.fullmatch(product):
            return None
        for prefix, symbol, power in _FACTOR.findall(product):
            times = sign * int(power or 1)
            ten += times * _PREFIXES[prefix]
            metre += times * _SYMBOLS[symbol][0]
            newton += times * _SYMBOLS[symbol][1]
    return ten, metre, newton


def _fold_case(unit: str) -> str:
    return "".join(letter if letter in "mM" else letter.lower() for letter in unit)
