"""Result with Cattaneo-Mindlin fields on a small grid, made without a solver, for tests of
output."""

from dataclasses import replace
from typing import Any

import numpy as np

from contact_scene import Body as LowerBody
from contact_scene import CoulombFriction, IsotropicMaterial, LoadStep, Paraboloid, Scene
from contact_scene.array_types import Field
from contact_scene.effect import Effect
from contact_scene.quantities.residuals import Residuals
from contact_scene.quantities.stated_error import StatedError, StatedErrors
from contact_scene.quantities.summary import ContactStatus
from semi_analytical.fields import Increment, Result
from semi_analytical.grid import SurfaceGrid
from semi_analytical.increment_counts import StepIncrements
from semi_analytical.plan import Coupling, Plan

STEEL = IsotropicMaterial(young_modulus=420e9, poisson_ratio=0.3)
MU = 0.1
RADIUS = 0.4e-3
PEAK = 3e9
FORCES = (0.0, 30.0, 60.0, 90.0, 0.0, -90.0)  # at the end of the increments
STEPS = ((1, 1, 1), (2, 1, 3), (2, 2, 3), (2, 3, 3), (3, 1, 2), (3, 2, 2))  # step, index, of
ITERATIONS = 7
CONVOLUTIONS = 9
WORST_RESIDUAL = 3e-9


def synthetic_scene(*, friction: bool) -> Scene:
    """The scene whose loading the increments follow."""
    tangential = (
        LoadStep(tangential_force=(90.0, 0.0), increments=3),
        LoadStep(tangential_force=(-90.0, 0.0), increments=2),
    )
    return Scene(
        title="synthetic",
        indenter=Paraboloid(radius=18e-3, material=STEEL),
        body=LowerBody(material=STEEL),
        friction=CoulombFriction(coefficient=MU) if friction else None,
        loading=(LoadStep(normal_force=1000.0), *(tangential if friction else ())),
    )


def synthetic_result(cells: tuple[int, int] = (24, 20), *, friction: bool = True) -> Result:
    """Partial slip back and forth, or the mere indentation."""
    grid = SurfaceGrid(cells, (1.2e-3, 1.0e-3))
    increments = [_indentation(grid)]
    if friction:
        increments = [_partial_slip(grid, increments[0], n) for n in range(len(FORCES))]
    counts = tuple(i.increments_in_step for i in increments if i.index == i.increments_in_step)
    effect = Effect("friction", friction, "because the scene says so")
    path = tuple(StepIncrements(count, False, "as it is") for count in counts)
    plan = Plan(
        shear=friction,
        coupling=Coupling.NONE,
        tilt=False,
        torsion=False,
        path=path,
        effects=(effect,),
    )
    return Result(synthetic_scene(friction=friction), grid, 1e-8, plan, tuple(increments))


def synthetic_errors(result: Result) -> StatedErrors:
    """Errors that differ from step to step."""
    return StatedErrors(
        tuple(
            {
                name: StatedError(error=10.0 ** (-9 - end.step), parts={}, status="estimated")
                for name in ("approach", "normal_force", "dissipated_energy")
            }
            for end in result.steps
        ),
        (),
    )


def _indentation(grid: SurfaceGrid) -> Increment:
    radius = np.hypot(*grid.coordinates())
    return Increment(
        step=1,
        index=1,
        increments_in_step=1,
        pressure=_hertz(radius, RADIUS),
        gap=np.maximum(radius - RADIUS, 0.0),
        normal_force=1000.0,
        approach=8e-6,
        contact_area=np.pi * RADIUS**2,
        peak_pressure=PEAK,
        elastic_energy=3.2e-3,
        input_work=4e-3,
        unresolved_work=8e-4,
        energy_imbalance=0.0,
        residuals=Residuals(complementarity=1e-10, penetration=2e-10, normal_equilibrium=0.0),
        iterations=ITERATIONS,
        convolutions=CONVOLUTIONS,
    )


def _partial_slip(grid: SurfaceGrid, indentation: Increment, number: int) -> Increment:
    x, y = grid.coordinates()
    radius, force = np.hypot(x, y), FORCES[number]
    stick_radius = RADIUS * np.cbrt(1 - abs(force) / (MU * indentation.normal_force))
    shear = MU * np.sign(force) * (indentation.pressure - _hertz(radius, stick_radius))
    in_stick = indentation.in_contact & (radius < stick_radius)
    slips = indentation.in_contact & ~in_stick
    slip = np.where(slips, -np.sign(force) * 1e-7, 0.0)
    step, index, of = STEPS[number]
    changes: dict[str, Any] = {
        "step": step,
        "index": index,
        "increments_in_step": of,
        "shear": np.stack([shear, 1e-3 * x * y / RADIUS**2 * shear]),
        "slip": np.stack([slip, 0.0 * slip]),
        "in_stick": in_stick,
        "tangential_force": np.array([force, 0.0]),
        "tangential_shift": np.array([0.9e-8 * force, 0.0]),
        "stick_area": float(np.pi * stick_radius**2),
        "dissipated_energy": 1e-6 * number,
        "input_work": 4e-3 + 1e-6 * number,
        "dissipation": np.where(slips, 2.0 * number, 0.0),
        "dissipation_before": np.where(slips, 2.0 * max(number - 1, 0), 0.0),
        "slip_distance": np.where(slips, 1e-7 * number, 0.0),
        "slip_before": np.zeros((2, *grid.cells)),
        "residuals": replace(indentation.residuals, friction_cone=WORST_RESIDUAL / index),
        "status": ContactStatus.PARTIAL_SLIP if force else ContactStatus.FULL_STICK,
    }
    return replace(indentation, **changes)


def _hertz(radius: Field, contact_radius: float) -> Field:
    """Pressure of a smaller contact of the same bodies: its peak grows with its radius."""
    peak = PEAK * contact_radius / RADIUS
    return np.asarray(peak * np.sqrt(np.maximum(1 - (radius / contact_radius) ** 2, 0.0)))
