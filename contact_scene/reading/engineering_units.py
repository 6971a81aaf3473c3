"""The SI prefix that makes a quantity readable: 3.17 GPa, 0.6 mm, 0.8 µm."""

from dataclasses import dataclass

PREFIXES = {-9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}

# Lengths of contacts are read as 0.6 mm, not 600 µm; everything else as 500 MPa, not 0.5 GPa.
SMALLEST = {"m": 0.1}
LARGEST_PREFIX = {"m": 0}


@dataclass(frozen=True)
class EngineeringUnit:
    """A unit with its prefix: `value / size` is the number to show next to `name`."""

    size: float
    name: str

    def labelled(self, text: str) -> str:
        """What an axis says of numbers in this unit: `x (mm)`."""
        return f"{text} ({self.name})"

    def text(self, value: float, digits: int = 4) -> str:
        """The value with the unit, to this many significant digits."""
        return f"{value / self.size:.{digits}g} {self.name}"


def engineering_unit(magnitude: float, unit: str) -> EngineeringUnit:
    """The prefixed form of an SI unit that suits numbers up to this magnitude."""
    if not unit:
        return EngineeringUnit(1.0, "")
    exponents = [e for e in PREFIXES if e <= LARGEST_PREFIX.get(unit, 9)]
    smallest = SMALLEST.get(unit, 1.0) * (1 - 1e-9)  # 0.1 mm stays 0.1 mm in spite of round-off
    if magnitude > 0:
        fitting = [e for e in exponents if magnitude >= smallest * 10.0**e]
        exponent = max(fitting, default=min(exponents))
    else:
        exponent = 0
    return EngineeringUnit(10.0**exponent, PREFIXES[exponent] + unit)


def quantity(value: float, unit: str, digits: int = 4) -> str:
    """One value in the unit that suits it."""
    return engineering_unit(abs(value), unit).text(value, digits)
