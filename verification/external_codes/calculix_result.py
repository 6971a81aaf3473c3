"""What is read from the files that CalculiX writes."""

from __future__ import annotations

import math
from dataclasses import dataclass

from verification.external_codes.coated_scene import HERTZ, NORMAL_FORCE

WEDGE = 180  # wedges of 2°, to which axisymmetric elements are expanded, in the circle

Numbers = list[float]


@dataclass(frozen=True)
class Tractions:
    """At the corner nodes of the surface that are touched.

    radii     over the Hertz radius
    pressure  over the Hertz pressure
    shear     its absolute value, likewise
    """

    radii: Numbers
    pressure: Numbers
    shear: Numbers


def read_normal_force(dat: str) -> float:
    """Reaction of the ball over the nominal force, from the last total in a .dat file.

    Raises ValueError if the file holds none.
    """
    lines = dat.splitlines()
    totals = [n for n, line in enumerate(lines) if "total force" in line]
    if not totals:
        raise ValueError("no total force in the .dat file; did ccx finish?")
    return -float(lines[totals[-1] + 2].split()[1]) * WEDGE / NORMAL_FORCE


def read_tractions(frd: str) -> Tractions:
    """Contact stresses at the surface z = 0 of the last increment in an .frd file, inside out.

    Midside nodes, to which the stress of one element has been extrapolated, are left out. Raises
    ValueError if there is no contact stress.
    """
    places = _block(frd, "    2C")
    stresses = _block(frd, " -4  CONTACT")
    surface = sorted((at[0], node) for node, at in places.items() if at[1] == 0)
    rows = [(r, stresses.get(node, (0.0,) * 6)) for r, node in surface[::2]]
    touched = [(r, stress) for r, stress in rows if stress[_PRESSURE] > 0]
    if not touched:
        raise ValueError("no contact stress in the .frd file; did ccx finish?")
    return Tractions(
        [round(r / HERTZ.contact_radius, 7) for r, _ in touched],
        [_digits(stress[_PRESSURE]) for _, stress in touched],
        [_digits(math.hypot(*stress[_SHEAR])) for _, stress in touched],
    )


_PRESSURE, _SHEAR = 3, slice(4, 6)


def _digits(stress: float) -> float:
    """Over the Hertz pressure, to the digits that the file has."""
    return float(f"{stress / HERTZ.peak_pressure:.6g}")


def _block(frd: str, head: str) -> dict[int, tuple[float, ...]]:
    """Values by node of the last block of this head: number and values in fixed columns."""
    block: dict[int, tuple[float, ...]] = {}
    inside = False
    for line in frd.splitlines():
        if line.startswith(head):
            block, inside = {}, True
        elif line.startswith(" -3"):
            inside = False
        elif inside and line.startswith(" -1"):
            starts = range(13, len(line.rstrip()), 12)
            block[int(line[3:13])] = tuple(float(line[at : at + 12]) for at in starts)
    return block
