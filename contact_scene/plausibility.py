"""Whether the numbers of a scene are of a size that such quantities have.

A factor of a thousand is quickly lost between a data sheet and a scene file, and what comes out is
as valid as anything else. Nothing here is an error: remarks are for whoever wrote the scene.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import chain, pairwise

import numpy as np
from pydantic import BaseModel

from contact_scene.engineering_units import quantity
from contact_scene.geometry import HeightMap
from contact_scene.linear_theory import SMALL_STRAIN
from contact_scene.load_path import ControlKind
from contact_scene.pair import contact_modulus
from contact_scene.problem import Path, dotted
from contact_scene.scene import Scene


@dataclass(frozen=True)
class Usual:
    """What a quantity usually is.

    least, most  magnitude [SI unit]
    unit         in SI
    meant        units in which a number alone was perhaps meant, with their sizes, likeliest first
    """

    least: float
    most: float
    unit: str
    meant: Mapping[str, float]


_MODULUS = Usual(1e3, 2e12, "Pa", {"GPa": 1e9, "MPa": 1e6})
_SIZE = Usual(1e-9, 1.0, "m", {"mm": 1e-3, "um": 1e-6})
_STEP = Usual(1e-12, 1e-3, "m", {"um": 1e-6, "nm": 1e-9})

# By key. From gels to diamond, from the tip of a microscope to a wheel.
USUAL: Mapping[str, Usual] = {
    "young_modulus": _MODULUS,
    **dict.fromkeys(("radius", "radii", "window", "contact_radius"), _SIZE),
    "thickness": Usual(1e-10, 0.1, "m", {"um": 1e-6, "mm": 1e-3}),
    "spacing": Usual(1e-10, 1e-2, "m", {"um": 1e-6, "nm": 1e-9}),
    **dict.fromkeys(("approach", "tangential_shift"), _STEP),
    "normal_force": Usual(1e-12, 1e9, "N", {}),
    "coefficient": Usual(0.0, 5.0, "", {"per cent": 1e-2}),
}
# Softer than rubber and larger than a ball: numbers of a scene without units, or in its own.
_SOFTEST, _LARGEST = 1e6, 0.1
_STEEP = 1.0  # heights that differ by more than their distance


def implausible(scene: Scene, **fineness: BaseModel) -> tuple[str, ...]:
    """Remarks on numbers that are hardly what was meant, with what perhaps was.

    fineness  tables of the scene file that say how finely it is to be solved, by name
    Numbers near one that make sense together, of a scene without units, are none.
    """
    strained = tuple(_strained(scene))
    if _without_units(scene) and not strained:
        return ()
    parts = [_numbers(scene, ()), *(_numbers(part, (name,)) for name, part in fineness.items())]
    return (*chain.from_iterable(map(_unusual, parts)), *_steep(scene), *strained)


def _unusual(numbers: Iterator[tuple[Path, float]]) -> Iterator[str]:
    for path, value in numbers:
        usual = USUAL.get(next((part for part in reversed(path) if isinstance(part, str)), ""))
        if usual is not None and value and not usual.least <= abs(value) <= usual.most:
            yield f"{dotted(path)}: {_odd(value, usual)}"


def _odd(value: float, usual: Usual) -> str:
    small = abs(value) < usual.least
    side, limit = ("below", usual.least) if small else ("above", usual.most)
    meant = (
        f'; was "{value:g} {unit}" meant?'
        for unit, size in usual.meant.items()
        if usual.least <= abs(value * size) <= usual.most
    )
    return f"{_text(value, usual)} is {side} the usual {_text(limit, usual)}{next(meant, '')}"


def _text(value: float, usual: Usual) -> str:
    return quantity(value, usual.unit, 6) if usual.unit else f"{value:g}"


def _numbers(value: object, path: Path) -> Iterator[tuple[Path, float]]:
    """Every number of a part of the scene, with its path."""
    if isinstance(value, BaseModel):
        for name in type(value).model_fields:
            yield from _numbers(getattr(value, name), (*path, name))
    elif isinstance(value, tuple):
        for index, entry in enumerate(value):
            yield from _numbers(entry, (*path, index))
    elif isinstance(value, float):
        yield path, value


def _without_units(scene: Scene) -> bool:
    """Whether its numbers are those of nothing that exists, in SI."""
    known = list(_numbers(scene, ()))
    moduli = [value for path, value in known if path[-1] == "young_modulus"]
    radii = [value for path, value in known if {"radius", "radii"} & {*path}]
    return max(moduli) < _SOFTEST and min(radii, default=1.0) >= _LARGEST


def _steep(scene: Scene) -> Iterator[str]:
    if isinstance(indenter := scene.indenter, HeightMap):
        rows, (dx, dy) = indenter.file.values, indenter.spacing
        # Row by row, without a second array of that size.
        along_x = max(float(np.max(np.abs(b - a))) for a, b in pairwise(rows)) / dx
        along_y = max(float(np.max(np.abs(np.diff(row)))) for row in rows) / dy
        if (steepest := max(along_x, along_y)) > _STEEP:
            range_ = quantity(float(np.ptp(indenter.file.values)), "m")
            yield (
                f"indenter.file: the heights differ by {range_} and neighbours by {steepest:.2g} "
                "times their distance; they are read in metres"
            )


def _strained(scene: Scene) -> Iterator[str]:
    """On steps that would press far beyond linear elasticity, by Hertz for what lies outermost."""
    for ramp in scene.load_path():
        k, modulus = scene.indenter.gap_exponent, contact_modulus(scene)
        if k is None:
            continue
        by_force = ramp.normal.kind is ControlKind.FORCE
        power = (
            scene.indenter.contact_under(ramp.normal.end, modulus)
            if by_force
            else scene.indenter.contact_at(ramp.normal.end)
        )
        if power is None or k == 1:  # the strains below a cone do not depend on the load
            continue
        a, b = (p ** (1 / (k + 1 if by_force else k)) for p in power)
        force = ramp.normal.end if by_force else modulus * (a * b) ** 0.5 * ramp.normal.end
        strain = force / (np.pi * a * b) / modulus
        if strain > SMALL_STRAIN:
            load = quantity(ramp.normal.end, "N" if by_force else "m")
            name = "normal_force" if by_force else "approach"
            yield (
                f"loading[{ramp.step}].{name}: {load} on E* = {quantity(modulus, 'Pa')} "
                f"makes strains of about {strain:.2g}, where the theory of small ones has ended"
            )
            return
