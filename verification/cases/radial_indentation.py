"""Pressing with friction by the radial solver, against integral equations and Goodman's limit."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache, partial

import numpy as np

import radial
from contact_scene import RadialDiscretisation
from radial import Increment
from verification.closed_forms.goodman import stick_ratio
from verification.judging.case import Case, Check, Level, Required
from verification.problems.indentation import COATED, FEW, NU_ZERO, STRONG, WEAK, Indentation
from verification.problems.layered_scene import half_space, pressed, rigid_ball
from verification.problems.paper_scene import HERTZ, pressing
from verification.problems.reference import Reference, ReferenceKind

CONTACTS = (WEAK, STRONG, NU_ZERO, COATED)
INCREMENTS = 64  # twice as many where the cells take twice as many
RINGS = 512  # to compare shear between them
INNERMOST = 0.05  # radii from which on shear is compared, over the contact's
BESIDE = 0.05  # and how near to the front it is not, over the front's

# Nearly without coupling, by which Goodman's answer is off by about β².
NU = 0.49
BETA = (1 - 2 * NU) / (2 * (1 - NU))
RATIOS = (0.5, 1.0)  # µ/β

ASKED = "asked of the radial solver at these increments"


def radial_indentation(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    checks = [_check(one, *row) for one in CONTACTS for row in ROWS]
    return Case(
        name="radial_indentation",
        title="Pressing with friction in one dimension",
        problem="The paper's ball, rigid, pressed by 1 kN on half-spaces and on a coating that "
        f"move towards the axis below it, in {INCREMENTS} increments, or twice as many where "
        "nearly all sticks, by the radial solver. The references come from integral equations "
        "over the radius. Where bodies hardly couple, the stick radius is Goodman's.",
        runs=(),
        quantities=(),
        checks=(*checks, *map(_goodman, RATIOS)),
    )


def _check(
    one: Indentation, name: str, meaning: str, error: Callable[[Indentation], float],
    required: Required, unit: str,
) -> Check:  # fmt: skip
    reference = Reference(0.0, ReferenceKind.SEMI_CLOSED, one.source, UNCERTAIN[name])
    return Check(
        f"{one.file_name}_{name}", f"{one.name}: {meaning}", "", one.name, partial(error, one),
        reference, required, 1.0, unit,
    )  # fmt: skip


@cache
def _ended(one: Indentation) -> Increment:
    problem = one.problem(INCREMENTS * one.increments // FEW)
    return radial.solve(problem.scene, RadialDiscretisation(rings=RINGS)).steps[-1]


def _approach(one: Indentation) -> float:
    return abs(_ended(one).approach / one.approach - 1)


def _radius(one: Indentation) -> float:
    return abs(_ended(one).contact_radius / one.contact_radius - 1)


def _front(one: Indentation) -> float:
    found = _ended(one).stick_radius
    assert found is not None
    return abs(found - one.stick_part * one.contact_radius) / HERTZ.contact_radius


def _mean_shear(one: Indentation) -> float:
    """At the radii of the row, by the shear over √(1-x²), which has no root, between rings."""
    end = _ended(one)
    assert end.shear_radial is not None
    r = end.radii[end.pressure > 0] / end.contact_radius
    smooth = end.shear_radial[: len(r)] / np.sqrt(1 - r**2)
    x = one.radii / one.contact_radius
    told = (x >= INNERMOST) & (np.abs(x / one.stick_part - 1) > BESIDE)
    off = np.interp(x, r, smooth) * np.sqrt(1 - x**2) - one.shear(one.radii)
    return float(np.mean(np.abs(off[told]))) / (one.friction * HERTZ.peak_pressure)


ROWS: tuple[tuple[str, str, Callable[[Indentation], float], Required, str], ...] = (
    ("approach", "error of the approach relative to itself", _approach, Required(1e-6, ASKED), "1"),
    ("contact_radius", "error of the contact radius relative to itself", _radius,
     Required(1e-6, ASKED), "1"),
    ("stick_radius", "error of the stick radius over that of Hertz", _front,
     Required(1e-3, ASKED), "a_H"),
    ("mean_shear", f"mean error of the shear from {INNERMOST:g} a on, beside the front",
     _mean_shear, Required(1e-4, ASKED), "µp_H"),
)  # fmt: skip
UNCERTAIN: Mapping[str, float] = {
    "approach": 2e-8, "contact_radius": 2e-8, "stick_radius": 5e-7, "mean_shear": 3e-6,
}  # fmt: skip


def _goodman(ratio: float) -> Check:
    friction = ratio * BETA
    title = f"ν = {NU:g}, µ = {ratio:g} β"
    exact = stick_ratio(friction, BETA)
    scene = pressed(title, rigid_ball(), half_space(NU), pressing(INCREMENTS), friction=friction)

    def error() -> float:
        end = radial.solve(scene).steps[-1]
        assert end.stick_radius is not None
        return abs(end.stick_radius / end.contact_radius - exact)

    return Check(
        f"goodman_{ratio:g}", f"{title}: error of the stick radius over the contact radius", "",
        title, error,
        Reference(0.0, ReferenceKind.CLOSED_FORM, "Goodman 1962; Spence 1975", BETA**2),
        Required(1e-3, f"asked of the stick radius; {BETA**2:.0e} of it is Goodman's"), 1.0, "1",
    )  # fmt: skip
