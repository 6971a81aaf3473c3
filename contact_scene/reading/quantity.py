"""Validators of physical quantities (numbers in SI, or texts with a unit) and of whole numbers."""

import math
import re
from dataclasses import dataclass, field
from decimal import Context, Decimal
from numbers import Real
from operator import index
from typing import Annotated, Any

import numpy as np
from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from contact_scene.reading.scene_error import (
    refusal,
    shown,
)
from contact_scene.reading.units import (
    ANGLE,
    FORCE,
    FORCE_PER_LENGTH,
    INTERFACE_STIFFNESS,
    LENGTH,
    MOMENT,
    MOMENT_PER_LENGTH,
    PRESSURE,
    PURE_NUMBER,
    ROTATION,
    SHARE,
    STIFFNESS,
    STIFFNESS_PER_LENGTH,
    Kind,
    equal_unit,
)

# "number unit"
_NUMBER = r"[+-]?(?:[0-9]{1,40}(?:\.[0-9]{0,40})?|\.[0-9]{1,40})(?:[eE][+-]?[0-9]{1,4})?"
_UNIT = r"[A-Za-zµμ°%](?:[A-Za-zµμ/^ ]{0,20}[A-Za-zµμ23])?"
QUANTITY_PATTERN = rf"^({_NUMBER}) ?({_UNIT})$"
_QUANTITY = re.compile(QUANTITY_PATTERN)
_NUMBER_ALONE = re.compile(_NUMBER)

# More digits than the pattern allows, so that products with factors of units are rounded once.
_EXACT = Context(prec=200)

# Magnitudes beyond all contacts for which products of a few quantities neither overflow nor
# vanish. Pure numbers have no lower limit.
_PLAUSIBLE = 1e-30, 1e30


class WithUnit(float):
    """Number in SI that the user wrote with a unit, so that a wrong unit is unlikely."""

    def __reduce__(self) -> tuple[type[float], tuple[float]]:
        return float, (float(self),)


class PerLength(WithUnit):
    """Number in SI that the user wrote with the unit per length of a line contact."""


@dataclass(frozen=True)
class Quantity:
    """Validator of numbers of one physical quantity within limits, for use in `Annotated[float,
    ...]`.

    kind             physical quantity, with its units
    above, at_least  lower limit, exclusive or inclusive [SI unit of the kind]
    below, at_most   upper limit, exclusive or inclusive [SI unit of the kind]
    wanted           expected value in words, such as "a positive length"
    per_length       the same quantity per length of a line contact, with its units; None if it has
                     none
    """

    kind: Kind = field(repr=False)  # with a long table
    wanted: str
    above: float | None = None
    at_least: float | None = None
    below: float | None = None
    at_most: float | None = None
    per_length: Kind | None = field(default=None, repr=False)

    @property
    def expected(self) -> str:
        """Expected value of the physical quantity in words, with an example, for messages."""
        return f"{self.wanted} such as {self.kind.example}" if self.kind.units else self.wanted

    def __call__(self, value: Any) -> float:
        """Convert the value of a physical quantity to SI and check its limits.

        Raises a validation error with the received and the expected value.

        value  number in SI, or text with a unit such as "18 mm"
        """
        number = self._convert_value(value)
        if not math.isfinite(number):
            raise refusal(f"got {shown(value)}, which is not finite", self.expected)
        if not (
            (self.above is None or number > self.above)
            and (self.at_least is None or number >= self.at_least)
            and (self.below is None or number < self.below)
            and (self.at_most is None or number <= self.at_most)
        ):
            raise refusal(f"got {shown(value)}", self.expected)
        smallest, largest = (_PLAUSIBLE[0] if self.kind.units else 0.0), _PLAUSIBLE[1]
        if number != 0.0 and not smallest <= abs(number) <= largest:
            bounds = f"a magnitude between {smallest} and {largest} {self.kind.si}"
            raise refusal(f"got {shown(value)}", bounds.rstrip())
        return type(number)(number + 0.0)  # 0.0 for -0.0

    def _convert_value(self, value: Any) -> float:
        if isinstance(value, str):
            return self._convert_text(value)
        if not is_plain(value):
            raise refusal(f"got {shown(value)}", self.expected, self._hint_for(value))
        try:
            return float(value)
        except (TypeError, ValueError, OverflowError):
            raise refusal(f"got {shown(value)}", self.expected) from None

    def _hint_for(self, value: Any) -> str:
        """Return a hint for an unsupported number, such as an object with a unit;
        empty without a hint."""
        if has_unit(value):
            text = f"write a text such as {self.kind.example}, or " if self.kind.units else ""
            return f"{text}pass its number{f' in {self.kind.si}' if self.kind.si else ''}"
        of_a_library = hasattr(value, "__float__") and not isinstance(value, bool)
        return "pass one plain float" if of_a_library else ""

    def _convert_text(self, text: str) -> float:
        match = _QUANTITY.match(text.strip())
        if not self.kind.units:
            raise refusal(f"got the text {shown(text)}", self.expected, "write it without quotes")
        if match is None:
            lone = _NUMBER_ALONE.fullmatch(text.strip())
            hint = f"write {text.strip()} without quotes, or add a unit" if lone else ""
            if _QUANTITY.match(with_point := text.strip().replace(",", ".", 1)):
                hint = f'write a decimal point: "{with_point}"'
            raise refusal(f"got {shown(text)}", self.expected, hint)
        number, unit = match.groups()
        if (factor := self.kind.units.get(unit)) is not None:
            return WithUnit(_EXACT.multiply(Decimal(number), factor))
        if self.per_length and (factor := self.per_length.units.get(unit)) is not None:
            return PerLength(_EXACT.multiply(Decimal(number), factor))
        near = equal_unit(unit, self.kind)
        hint = (
            f'did you mean "{number} {near}"?'
            if near
            else f"the units are {', '.join(self.kind.units)}"
        )
        raise refusal(f"got {shown(text)}", self.expected, hint)

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        bounds = {
            "exclusiveMinimum": self.above,
            "minimum": self.at_least,
            "exclusiveMaximum": self.below,
            "maximum": self.at_most,
        }
        number = {"type": "number", **{k: v for k, v in bounds.items() if v is not None}}
        if not self.kind.units:
            return number
        number["description"] = f"in {self.kind.si}"
        written = {
            "type": "string",
            "pattern": QUANTITY_PATTERN,
            "description": f"number and unit, such as {self.kind.example}",
            "examples": [f"1 {unit}" for unit in self.kind.units if unit.isascii()],
        }
        return {"anyOf": [number, written]}


@dataclass(frozen=True)
class WholeNumber:
    """Validator of whole numbers between two inclusive limits, for use in `Annotated[int, ...]`."""

    at_least: int
    at_most: int

    def __call__(self, value: Any) -> int:
        """Return a whole number of a scene, such as a number of cells, if it is within its limits.

        Raises a validation error for all other values, also for 5.0 and true.

        value  value as written in the scene
        """
        try:
            number = index(value) if is_plain(value) else None
        except TypeError:
            number = None
        if number is None or not self.at_least <= number <= self.at_most:
            raise refusal(
                f"got {shown(value)}", f"a whole number from {self.at_least} to {self.at_most}"
            )
        return number

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        return {"type": "integer", "minimum": self.at_least, "maximum": self.at_most}


def is_plain(value: Any) -> bool:
    """Determine if a value of a scene can be converted to a real number without loss.

    Values with a unit, mask, imaginary part or several entries are excluded, and also truth values
    and times.

    value  value passed in Python
    """
    if type(value) in (float, int):
        return True
    if type(value) is np.ndarray:
        return value.shape == () and value.dtype.kind in "fiu"
    if isinstance(value, bool | np.timedelta64) or not isinstance(value, Real | Decimal):
        return False
    return not has_unit(value)


def has_unit(value: Any) -> bool:
    """Determine if a value is an object with a unit from a Python library, such as pint.

    Scenes refuse such objects and require numbers in SI.

    value  value passed in Python
    """
    return hasattr(value, "units") or hasattr(value, "unit")


Length = Annotated[float, Quantity(LENGTH, "a length")]
PositiveLength = Annotated[float, Quantity(LENGTH, "a positive length", above=0.0)]
PressingLength = Annotated[float, Quantity(LENGTH, "a length not below 0", at_least=0.0)]
Force = Annotated[float, Quantity(FORCE, "a force", per_length=FORCE_PER_LENGTH)]
PressingForce = Annotated[
    float, Quantity(FORCE, "a force not below 0", at_least=0.0, per_length=FORCE_PER_LENGTH)
]
Torque = Annotated[float, Quantity(MOMENT, "a moment")]
Moment = Annotated[float, Quantity(MOMENT, "a moment", per_length=MOMENT_PER_LENGTH)]
# "60 deg" rounds up.
_MAX_ROTATION = math.nextafter(math.pi / 3, math.inf)
Rotation = Annotated[
    float,
    Quantity(
        ROTATION,
        "an angle from -60 to 60 deg",
        at_least=-_MAX_ROTATION,
        at_most=_MAX_ROTATION,
    ),
]
BulkStrain = Annotated[
    float, Quantity(PURE_NUMBER, "a strain from -0.1 to 0.1", at_least=-0.1, at_most=0.1)
]
Stress = Annotated[float, Quantity(PRESSURE, "a stress")]
PositiveStiffness = Annotated[
    float,
    Quantity(STIFFNESS, "a positive stiffness", above=0.0, per_length=STIFFNESS_PER_LENGTH),
]
PositiveInterfaceStiffness = Annotated[
    float, Quantity(INTERFACE_STIFFNESS, "a positive stiffness per area", above=0.0)
]
PositivePressure = Annotated[float, Quantity(PRESSURE, "a positive pressure", above=0.0)]
SlopeAngle = Annotated[
    float,
    Quantity(
        ANGLE, "an angle of the surface above 0 and below 60 deg", above=0.0, below=math.pi / 3
    ),
]
PoissonRatio = Annotated[
    float,
    Quantity(PURE_NUMBER, "a number above -1 and at most 0.5", above=-1.0, at_most=0.5),
]
FrictionCoefficient = Annotated[float, Quantity(PURE_NUMBER, "a number not below 0", at_least=0.0)]
Tolerance = Annotated[
    float, Quantity(PURE_NUMBER, "a number from 1e-12 to 0.1", at_least=1e-12, at_most=0.1)
]
Share = Annotated[
    float,
    Quantity(SHARE, "a share above 0 and at most 50 %", above=0.0, at_most=0.5),
]
