"""What a contact is measured in: SI with prefixes, or its own radius, pressure and approach."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from math import pi
from typing import TYPE_CHECKING, Protocol

from contact_scene.engineering_units import EngineeringUnit, engineering_unit, quantity
from contact_scene.material import IsotropicMaterial

if TYPE_CHECKING:
    from contact_results.surface import Result
    from contact_scene import Scene
    from contact_scene.body import Body
    from contact_scene.geometry import ShapedBody

UNBROKEN = "\N{NO-BREAK SPACE}"
# What makes a number negligible, beside the size that the load gives it.
ROUND_OFF = 1e-9


class Loaded(Protocol):
    """The end of a loading step."""

    @property
    def normal_force(self) -> float: ...
    @property
    def approach(self) -> float: ...
    @property
    def contact_radius(self) -> float: ...


class Peaked(Loaded, Protocol):
    """The same with its pressure."""

    @property
    def peak_pressure(self) -> float: ...


class NaturalUnit(EngineeringUnit):
    """A size of the contact, as a divisor."""

    def labelled(self, text: str) -> str:
        """`radius r / a`, `x / a at y = 0`, `x / a, z = 0`."""
        what, *where = re.split(r"(?=,| at )", text, maxsplit=1)
        return f"{what} / {self.name}{''.join(where)}"


@dataclass(frozen=True)
class Units:
    """The units of figures.

    sizes  those of kinds of quantities that are not SI with a prefix
    note   what they are, for a caption
    """

    sizes: Mapping[str, EngineeringUnit] = field(default_factory=dict)
    note: str = ""

    def of(self, kind: str, magnitude: float, unit: str) -> EngineeringUnit:
        """The unit of a kind of quantity, or the SI unit with the prefix that suits it."""
        return self.sizes.get(kind) or engineering_unit(magnitude, unit)


SI = Units()


def natural_units(result: Result) -> Units:
    """Those of a result; see `natural_units_of`."""
    return natural_units_of(result.scene, result.steps)


def natural_units_of(scene: Scene, ends: Sequence[Peaked]) -> Units:
    """The radius a, peak pressure p0 and approach δ of Hertz' contact under the last load, of the
    bodies without their coatings; of the run itself where there is no such contact. Shear is over
    µp0, slip and shift over µδ, forces over the last load W and µW, where µ is one number.

    For a body of revolution a^3 = 3 W R / 4 E*, p0 = 3 W / 2πa^2, δ = a^2/R (Johnson 1985, eqs.
    4.22-4.24).

    ends  of the loading steps
    """
    tip, body = scene.indenter, scene.body
    mu = scene.friction.uniform if scene.friction is not None else None
    load = next((end.normal_force for end in reversed(ends) if end.normal_force > 0), 0.0)
    found = _hertz(tip, body, load)
    if found is not None:
        a, p0, approach = found
        whose = "Hertz' contact under the last load"
        whose += ", uncoated" if body.layers or tip.layers else ""
    else:
        a = max(end.contact_radius for end in ends)
        p0 = max(end.peak_pressure for end in ends)
        approach = max(abs(end.approach) for end in ends)
        whose = "this contact at its largest"
    mu, by = (mu, "µ") if mu else (1.0, "")
    sizes = {
        "length": NaturalUnit(a, "a"),
        "pressure": NaturalUnit(p0, "$p_0$"),
        "shear": NaturalUnit(mu * p0, f"{by}$p_0$"),
        "slip": NaturalUnit(mu * approach, f"{by}δ"),
        "tangential_shift": NaturalUnit(mu * approach, f"{by}δ"),
        "approach": NaturalUnit(approach, "δ"),
        "normal_force": NaturalUnit(load, "$W_0$"),
        "tangential_force": NaturalUnit(mu * load, f"{by}$W_0$"),
    }
    values = (
        f"a = {quantity(a, 'm')}",
        f"$p_0$ = {quantity(p0, 'Pa')}",
        f"δ = {quantity(approach, 'm')}",
        f"$W_0$ = {quantity(load, 'N')}",
        *([f"µ = {mu:g}"] if by else []),
    )
    note = f"{whose}: {', '.join(value.replace(' ', UNBROKEN) for value in values)}"
    return Units({kind: unit for kind, unit in sizes.items() if unit.size > 0}, note)


def _hertz(tip: ShapedBody, body: Body, load: float) -> tuple[float, float, float] | None:
    """Radius, peak pressure and approach; None where bodies are not of Hertz' kind."""
    if not (tip.is_of_revolution and tip.gap_exponent == 2 and load > 0):
        return None
    materials = (body.material, tip.material)
    elastic = [m for m in materials if isinstance(m, IsotropicMaterial)]
    if not elastic:
        return None
    contact = tip.contact_under(load, 1 / sum(1 / m.plane_strain_modulus for m in elastic))
    touching = tip.contact_at(1.0)
    assert contact is not None
    assert touching is not None
    a = contact[0] ** (1 / 3)
    return a, 3 * load / (2 * pi * a**2), a**2 / touching[0]


def natural_size(ends: Iterable[Loaded], unit: str) -> float:
    """The size that a quantity of a unit has under these loads; 0 where they do not tell."""
    ends = list(ends)
    force, radius, approach = (
        max((abs(getattr(end, name)) for end in ends), default=0.0)
        for name in ("normal_force", "contact_radius", "approach")
    )
    sizes = {"N": force, "N m": force * radius, "m": approach, "J": force * approach}
    slope = approach / radius if radius else 0.0
    return (sizes | {"rad": slope}).get(unit, 0.0)


def without_round_off(value: float, ends: Iterable[Loaded], unit: str) -> float:
    """The value, or 0 where it is round-off beside the load."""
    return 0.0 if abs(value) <= ROUND_OFF * natural_size(ends, unit) else value
