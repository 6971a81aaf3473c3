"""One step to just below gross sliding, and beyond it under a prescribed shift."""

from __future__ import annotations

from contact_scene import IsotropicMaterial, LoadStep, Scene
from verification.cases.cattaneo_mindlin import SLIDING_SHIFT, SOURCE
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.run import Run
from verification.observed.end_state import shift, tangential_force
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import NU_ZERO, STEEL
from verification.problems.reference import closed_form, identity

CELLS = 64
PARTS = (0.99, 0.999, 0.9999)
MATERIALS = {"ν = 0": NU_ZERO, "ν = 0.3": STEEL}
BEYOND = 5.0  # shifts at gross sliding


def near_sliding(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    return near_sliding_on(CELLS if level is Level.QUICK else 2 * CELLS)


def near_sliding_on(cells: int) -> Case:
    """The case on a square grid of this many cells per side."""
    grid = paper.hertz_grid(cells)
    steps = [
        Run(f"{name}, {part:g} µW", _one_step(material, part), grid)
        for name, material in MATERIALS.items()
        for part in PARTS
    ]
    slides = [
        Run(f"{name}, sliding", _sliding(material), grid) for name, material in MATERIALS.items()
    ]
    return Case(
        name="near_sliding",
        title="Up to gross sliding and beyond",
        problem=(
            "The paper's contact sheared in a single step to 0.99, 0.999 and 0.9999 of µW, with "
            "ν = 0 and ν = 0.3, and dragged to five times the shift at gross sliding. What is "
            "judged is that every solve ends within its tolerance, and that sliding takes µW: "
            "every particle then slips along x, whatever ν is."
        ),
        runs=(*steps, *slides),
        quantities=(
            *(_shift(run.label, part) for run, part in zip(steps, PARTS, strict=False)),
            *(_limit(run.label) for run in slides),
        ),
        limits=("Under force control at µW itself the shift is undefined; it is not a case.",),
    )


def _one_step(material: IsotropicMaterial, part: float) -> Scene:
    return paper.frictional(
        f"One step to {part:g} µW, ν = {material.poisson_ratio:g}",
        paper.paraboloid(material),
        material,
        paper.tangential_step(part, increments=1),
    )


def _sliding(material: IsotropicMaterial) -> Scene:
    sliding_shift = paper.partial_slip(material, 0.0).sliding_shift
    return paper.frictional(
        f"Dragged to {BEYOND:g} sliding shifts, ν = {material.poisson_ratio:g}",
        paper.paraboloid(material),
        material,
        LoadStep(tangential_shift=(0.8 * sliding_shift, 0.0), increments=2),
        LoadStep(tangential_shift=(BEYOND * sliding_shift, 0.0), increments=6),
    )


def _shift(run: str, part: float) -> Quantity:
    exact = paper.partial_slip(NU_ZERO, part * paper.FRICTION_LIMIT).shift
    return Quantity(
        "shift", f"tangential shift after one step to {part:g} µW", "m", run, shift,
        closed_form(exact, SOURCE, SLIDING_SHIFT),
        Required(1e-3, "the stick zone is a few cells wide or less: its force is known to a part "
                 "of a cell's, the shift with it"),
        SLIDING_SHIFT, "the shift at gross sliding",
    )  # fmt: skip


def _limit(run: str) -> Quantity:
    return Quantity(
        "sliding_force", "tangential force while sliding", "N", run, tangential_force,
        identity(paper.FRICTION_LIMIT, "at full slip along x the shear is µp everywhere: T = µW"),
        Required(1e-7, "ten times the solver's tolerance, for sums over all cells"),
    )  # fmt: skip
