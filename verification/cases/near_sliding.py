"""One step to just below gross sliding, and beyond it under a prescribed shift."""

from __future__ import annotations

from contact_scene import IsotropicMaterial, LoadStep
from verification.judging.case import Case, Level
from verification.judging.declared_case import Within, case, judged
from verification.judging.ladder import Ladder, named, on_cells
from verification.judging.observable import Observable
from verification.judging.observables import SHIFT
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import FRICTION_LIMIT, HERTZ, NU_ZERO, STEEL
from verification.problems.problem import Problem
from verification.problems.reference import ReferenceKind
from verification.problems.sheared import sheared
from verification.quantities import force_along_x

CELLS = 64
PARTS = (0.99, 0.999, 0.9999)
MATERIALS = {"ν = 0": NU_ZERO, "ν = 0.3": STEEL}
BEYOND = 5.0  # shifts at gross sliding
OF_SLIDING = (
    Within(
        Observable(
            "sliding_force", "tangential force while sliding", "N",
            lambda result, step, _: force_along_x(result.steps[step]), lambda limit: float(limit),
        ),
        1e-7, "ten times the solver's tolerance, for sums over all cells",
    ),
)  # fmt: skip
OF_STEP = (
    Within(
        SHIFT, 4e-4,
        "the stick zone is a few cells wide or less: its force is known to a part of a cell's, the "
        "shift with it; four times what the narrowest leaves",
    ),
)  # fmt: skip


def near_sliding(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    return near_sliding_on(CELLS if level is Level.QUICK else 2 * CELLS)


def near_sliding_on(cells: int) -> Case:
    """The case on a square grid of this many cells per side. For ν > 0 the closed form of the shift
    is no answer."""
    return case(
        "near_sliding",
        "Up to gross sliding and beyond",
        "The paper's contact sheared in a single step to 0.99, 0.999 and 0.9999 of µW, with "
        "ν = 0 and ν = 0.3, and dragged to five times the shift at gross sliding. What is "
        "judged is that every solve ends within its tolerance, and that sliding takes µW: "
        "every particle then slips along x, whatever ν is.",
        *(
            judged(_one_step(name, part, cells), OF_STEP if material is NU_ZERO else ())
            for name, material in MATERIALS.items()
            for part in PARTS
        ),
        *(
            judged(named(f"{name}, sliding", on_cells(_sliding(material), (cells,))), OF_SLIDING)
            for name, material in MATERIALS.items()
        ),
        limits=("Under force control at µW itself the shift is undefined; it is not a case.",),
    )


def _one_step(name: str, part: float, cells: int) -> Ladder:
    problem = sheared(f"One step to {part:g} µW, {name}", (part,), MATERIALS[name])
    return named(f"{name}, {part:g} µW", on_cells(problem, (cells,)))


def _sliding(material: IsotropicMaterial) -> Problem:
    sliding_shift = paper.partial_slip(material, 0.0).sliding_shift
    scene = paper.frictional(
        f"Dragged to {BEYOND:g} sliding shifts, ν = {material.poisson_ratio:g}",
        paper.paraboloid(material),
        material,
        LoadStep(tangential_shift=(0.8 * sliding_shift, 0.0), increments=2),
        LoadStep(tangential_shift=(BEYOND * sliding_shift, 0.0), increments=6),
    )
    return Problem(
        scene,
        (FRICTION_LIMIT,),
        HERTZ.contact_radius,
        "at full slip along x the shear is µp everywhere: T = µW",
        ReferenceKind.IDENTITY,
        uncertainty=0.0,
    )
