"""The bodies exchanged: what lay below is the indenter, and the other way round."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

import radial
from contact_scene import RIGID, Body, LoadStep, Paraboloid, RadialDiscretisation, Scene
from contact_scene.residuals import worst
from verification.judging.case import Case, Check, Comparison, Level, Required
from verification.judging.run import SOLVER_TOLERANCE, Run, SectionRun, per_radius
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import SUBSTRATE, coated, film, pressed
from verification.problems.paper_scene import HERTZ, NORMAL_FORCE, pressing
from verification.problems.reference import identity
from verification.quantities import shear_of

FRICTION, PART = 0.2, 0.6  # and part of µW that pushes
CELLS = {Level.QUICK: 32, Level.STANDARD: 64, Level.FULL: 128}
ELEMENTS = {Level.QUICK: 12, Level.STANDARD: 24, Level.FULL: 48}
RINGS = 128
MARGIN = 1.3  # half the window over Hertz's radius
PRESSING = (pressing(3),)
PUSHED = LoadStep(tangential_force=(PART * FRICTION * NORMAL_FORCE, 0.0), increments=2)
SOURCE = (
    "a mirror in the contact plane exchanges the bodies and turns the tangential force, half a "
    "turn about z turns it back; the gap does not know which of the bodies is curved"
)
BECAUSE = "residuals of two solves, which tractions answer a few times over"
SAME = "largest difference of pressure, shear, approach and shift, after the half turn"


@dataclass(frozen=True)
class _Pair:
    """Two bodies by what they are made of; the upper one is a ball."""

    name: str
    lower: Body
    upper: Body

    @property
    def exchanged(self) -> _Pair:
        return replace(self, name=f"{self.name}, exchanged", lower=self.upper, upper=self.lower)

    def scene(self, *loading: LoadStep) -> Scene:
        ball = Paraboloid(
            radius=paper.RADIUS, material=self.upper.material, layers=self.upper.layers
        )
        return pressed(self.name, ball, self.lower, *loading, friction=FRICTION)


PAIRS = (
    _Pair("rigid ball on a body", Body(material=SUBSTRATE), Body(material=RIGID)),
    _Pair("ball on its own material, coated", coated(film(2.0, 0.5)), Body(material=SUBSTRATE)),
)


def exchanged_bodies(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids and meshes at higher levels."""
    side = CELLS[level]
    grid = paper.square_grid(side, MARGIN * HERTZ.contact_radius)
    elements = per_radius(ELEMENTS[level], MARGIN * HERTZ.contact_radius)
    runs: list[Run | SectionRun] = []
    comparisons = []
    for pair in PAIRS:
        cells = [Run(p.name, p.scene(*PRESSING, PUSHED), grid) for p in (pair.exchanged, pair)]
        rings = [
            SectionRun(f"{p.name}, elements", p.scene(*PRESSING), elements)
            for p in (pair.exchanged, pair)
        ]
        for labels, difference in ((cells, _on_cells), (rings, _on_rings)):
            runs += labels
            comparisons.append(_same(pair.name, labels, difference))
    return Case(
        name="exchanged_bodies",
        title="Bodies exchanged",
        problem="A rigid ball is pressed with friction on an elastic body and pushed, and an "
        "elastic ball on a rigid body; a ball on its own material under a coating, and a coated "
        "ball on the bare material. Finite elements and rings press alone. A mirror makes one of "
        "the other.",
        runs=tuple(runs),
        quantities=(),
        comparisons=tuple(comparisons),
        checks=(_by_radial_solver(PAIRS[0]),),
        limits=("Both of a pair could be wrong alike: frictional_indentation judges one of them.",),
    )


def _same(name: str, runs: list[Any], difference: Callable[[Any, Any], float]) -> Comparison:
    one, other = runs
    return Comparison(
        "exchanged", f"{name}: {SAME}", (one.label, other.label), difference,
        10 * SOLVER_TOLERANCE, BECAUSE, SOURCE,
    )  # fmt: skip


def _by_radial_solver(pair: _Pair) -> Check:
    def difference() -> float:
        rings = RadialDiscretisation(rings=RINGS)
        one, other = (radial.solve(p.scene(*PRESSING), rings) for p in (pair.exchanged, pair))
        return _on_rings(one, other)

    return Check(
        "exchanged", f"{pair.name}, by the radial solver: {SAME}", "", f"{pair.name}, rings",
        difference, identity(0.0, SOURCE), Required(10 * SOLVER_TOLERANCE, BECAUSE), 1.0,
        "the other's",
    )  # fmt: skip


def _on_cells(one: Any, other: Any) -> float:
    """Σ|Δp|/Σp, Σ|Δq|/Σp, approach, and shift over approach, in any increment."""

    def apart(a: Any, b: Any) -> float:
        return worst(
            float(np.sum(np.abs(a.pressure - b.pressure[::-1, ::-1])) / np.sum(b.pressure)),
            float(np.sum(np.abs(shear_of(a) - shear_of(b)[:, ::-1, ::-1])) / np.sum(b.pressure)),
            abs(a.approach / b.approach - 1),
            float(np.max(np.abs(_shift(a) - _shift(b)))) / b.approach,
        )

    return worst(*map(apart, one.increments, other.increments))


def _on_rings(one: Any, other: Any) -> float:
    """The same of shear along the radius, which points outward on one of the two and inward on the
    other."""

    def apart(a: Any, b: Any) -> float:
        r = b.radii
        total = np.trapezoid(b.pressure * r, r)
        return worst(
            float(np.trapezoid(np.abs(a.pressure - b.pressure) * r, r) / total),
            float(np.trapezoid(np.abs(_outward(a) + _outward(b)) * r, r) / total),
            abs(a.approach / b.approach - 1),
        )

    return worst(*map(apart, one.increments, other.increments))


def _outward(increment: Any) -> Any:
    shear = increment.shear_radial
    return np.zeros_like(increment.radii) if shear is None else shear


def _shift(increment: Any) -> Any:
    shift = increment.tangential_shift
    return np.zeros(2) if shift is None else np.asarray(shift)
