"""SI prefixes for readable quantities in texts and plots: 3.17 GPa, 0.6 mm, 0.8 µm."""

from dataclasses import dataclass

PREFIXES = {-9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}

# Lengths are written as 0.6 mm, not 600 µm; other quantities as 500 MPa, not 0.5 GPa.
SMALLEST = {"m": 0.1}
LARGEST_PREFIX = {"m": 0}
# A stiffness of an interface is a stress over a small jump: 4 GPa/µm, not 4e+06 GPa/m.
OWN_UNITS = {
    "Pa/m": {
        0: "Pa/m",
        3: "kPa/m",
        6: "MPa/m",
        9: "MPa/mm",
        12: "MPa/µm",
        15: "GPa/µm",
        18: "GPa/nm",
    }
}


@dataclass(frozen=True)
class EngineeringUnit:
    """SI unit with a prefix, such as mm or GPa.

    size  the unit in SI, such as 1e-3 for mm; a value in SI divided by `size` is the number in this
          unit
    name  symbol of the unit with its prefix
    """

    size: float
    name: str

    def labelled(self, text: str) -> str:
        """Append the unit to the label of a plot axis, as in `x (mm)`.

        text  label of the axis
        """
        return f"{text} ({self.name})"

    def text(self, value: float, digits: int = 4) -> str:
        """Write a quantity as text with this unit, such as "0.6 mm".

        value   value in SI
        digits  number of significant digits
        """
        return f"{value / self.size:.{digits}g} {self.name}"


def engineering_unit(magnitude: float, unit: str) -> EngineeringUnit:
    """Select the prefix of an SI unit so that numbers up to a given magnitude are readable.

    For a length of 0.0006 m the result is mm.

    magnitude  largest magnitude [SI unit]
    unit       SI unit without a prefix; empty for pure numbers
    """
    if not unit:
        return EngineeringUnit(1.0, "")
    largest = LARGEST_PREFIX.get(unit, max(PREFIXES))
    prefixed = {e: prefix + unit for e, prefix in PREFIXES.items() if e <= largest}
    names = OWN_UNITS.get(unit, prefixed)
    smallest = SMALLEST.get(unit, 1.0) * (1 - 1e-9)  # 0.1 mm stays 0.1 mm in spite of round-off
    if magnitude > 0:
        fitting = [e for e in names if magnitude >= smallest * 10.0**e]
        exponent = max(fitting, default=min(names))
    else:
        exponent = 0
    return EngineeringUnit(10.0**exponent, names[exponent])


def quantity(value: float, unit: str, digits: int = 4) -> str:
    """Write a value in SI with the most readable prefix of its unit, such as "0.6 mm".

    value   value in SI
    unit    SI unit without a prefix
    digits  number of significant digits
    """
    return engineering_unit(abs(value), unit).text(value, digits)
