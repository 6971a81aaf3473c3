"""What finite elements know of the half-space beyond their box: force, push and torque far away."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from contact_scene import LoadStep
from verification.judging.case import Case, Comparison, Level
from verification.judging.run import SectionRun, per_radius
from verification.problems.paper_scene import pressing
from verification.problems.reference import ReferenceKind
from verification.problems.torsion import PUNCH_RADIUS, STUCK

NEAR, FAR = 5.0, 100.0  # box over radius
ELEMENTS = {Level.QUICK: 16, Level.STANDARD: 32, Level.FULL: 64}
PUSH = 100.0  # a tenth of the force: with µ = 1 nothing slips
SOURCE = "the same contact in a box that is farther away"
# Power of radius over box that is left once the resultant is known at the edge of the box.
LEFT = {"approach": 3, "shift": 3, "twist": 5}


def _shift(end: Any) -> float:
    return float(end.tangential_shift[0])


def fem_far_field(level: Level = Level.QUICK) -> Case:
    """The case, on finer meshes at higher levels."""
    pushed = STUCK.scene.model_copy(
        update={
            "title": "Flat punch pushed without slip",
            "loading": (pressing(1), LoadStep(tangential_force=(PUSH, 0.0), increments=1)),
        }
    )
    runs = {
        (what, box): SectionRun(
            f"{what}, box of {box:g} radii",
            scene,
            per_radius(ELEMENTS[level], PUNCH_RADIUS).model_copy(update={"box": box}),
        )
        for what, scene in (("pushed", pushed), ("twisted", STUCK.scene))
        for box in (NEAR, FAR)
    }

    def one(name: str, what: str, number: Callable[[Any], float]) -> Comparison:
        power = LEFT[name]
        return Comparison(
            name, f"{name} of the punch, {what}: relative difference",
            (runs[what, NEAR].label, runs[what, FAR].label),
            lambda near, far: abs(number(near.steps[-1]) / number(far.steps[-1]) - 1),
            NEAR**-power,
            f"the resultant is known on the box; what follows it falls with the power {power} of "
            "the radius over the box", SOURCE, ReferenceKind.OWN_REFINEMENT,
        )  # fmt: skip

    return Case(
        name="fem_far_field",
        title="Finite elements: the half-space beyond the box",
        problem=f"A flat punch that sticks, pressed and pushed, and pressed and twisted, in a box "
        f"of {NEAR:g} of its radii and in one of {FAR:g}. On the outline of a box bodies move as a "
        "half-space does under the resultant; if they did not, the punch would move less.",
        runs=tuple(runs.values()),
        quantities=(),
        comparisons=(
            one("approach", "pushed", lambda end: float(end.approach)),
            one("shift", "pushed", _shift),
            one("twist", "twisted", lambda end: float(end.twist)),
        ),
    )
