"""SI prefixes for readable quantities: 3.17 GPa, 0.6 mm, 0.8 µm."""

from dataclasses import dataclass

PREFIXES = {-9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}

# Lengths are written as 0.6 mm, not 600 µm; other quantities as 500 MPa, not 0.5 GPa.
SMALLEST = {"m": 0.1}
LARGEST_PREFIX = {"m": 0}


@dataclass(frozen=True)
class EngineeringUnit:
    """Unit with an SI prefix; `value / size` is the number in this unit."""

    size: float
    name: str

    def labelled(self, text: str) -> str:
        """Append the unit to the label of an axis: `x (mm)`."""
        return f"{text} ({self.name})"

    def text(self, value: float, digits: int = 4) -> str:
        """Write a value with its unit and a number of significant digits."""
        return f"{value / self.size:.{digits}g} {self.name}"


def engineering_unit(magnitude: float, unit: str) -> EngineeringUnit:
    """Select the prefix of an SI unit for numbers up to a magnitude."""
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
    """Write a value in its most readable unit."""
    return engineering_unit(abs(value), unit).text(value, digits)
