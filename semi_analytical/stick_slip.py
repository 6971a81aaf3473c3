"""The tangential half of an increment: stick, slip, and what the surfaces remember."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from contact_scene.summary import ContactStatus
from semi_analytical.admissible_shear import AT_LIMIT
from semi_analytical.errors import GrossSliding, NotConverged
from semi_analytical.model import ContactModel
from semi_analytical.residuals import friction_cone, slip_direction
from semi_analytical.shearing import Shearing, TangentialTarget, shear

Field = NDArray[np.float64]
VectorField = NDArray[np.float64]
Mask = NDArray[np.bool_]
Vector = NDArray[np.float64]

MOST_ATTEMPTS = 3
SLIDING = 1e-6


@dataclass(frozen=True)
class ShearResiduals:
    """See residuals.Residuals; None where the control or the state leaves them undefined."""

    friction_cone: float
    slip_direction: float | None
    tangential_equilibrium: float | None

    @property
    def worst(self) -> float:
        """The largest of those that apply."""
        return max(self.friction_cone, self.slip_direction or 0, self.tangential_equilibrium or 0)


@dataclass(frozen=True)
class Sheared:
    """The tangential part of a state, all fields on the whole window.

    displacement       u_t by the shear; less the shift it remembers where particles met
    shift              of the indenter; None at the friction limit under force control
    slip               u_t - shift accumulated while in contact (paper, eq. (4))
    dissipated_energy  since the start; None where the shift is
    """

    shear: VectorField
    displacement: VectorField
    shift: Vector | None
    slip: VectorField
    in_stick: Mask
    dissipated_energy: float | None
    status: ContactStatus
    force: Vector
    residuals: ShearResiduals
    iterations: int


def untouched(cells: tuple[int, int]) -> Sheared:
    """Before first touch: no shear, no shift, no slip."""
    nothing = np.zeros((2, *cells))
    return Sheared(
        shear=nothing,
        displacement=nothing,
        shift=np.zeros(2),
        slip=nothing,
        in_stick=np.zeros(cells, dtype=bool),
        dissipated_energy=0.0,
        status=ContactStatus.FULL_STICK,
        force=np.zeros(2),
        residuals=ShearResiduals(0.0, 0.0, 0.0),
        iterations=0,
    )


def slip_and_stick(
    model: ContactModel,
    pressure: Field,
    last: Sheared,
    load: TangentialTarget,
    tolerance: float,
) -> Sheared:
    """Shear the contact from the state `last` to a force or shift, at a given pressure.

    raises  NotConverged; GrossSliding if a force exceeds what friction can carry
    """
    bound = model.friction_coefficient * pressure
    if last.shift is None:
        raise GrossSliding(
            "the increment before reached the friction limit under force control, where the "
            "shift is undefined, so the history cannot go on; prescribe tangential_shift instead"
        )
    if load.force is not None:
        if not any(np.any(a) for a in (load.force, last.shear, last.shift)):
            return replace(last, in_stick=bound > 0, iterations=0)
        if reaches_limit(load.force, float(np.sum(bound)) * model.grid.cell_area):
            if np.any(bound):
                return at_limit(model, bound, last, load.force)
            return unresisted(pressure, np.zeros_like(last.shear), last, last.shift)
    elif not np.any(bound):
        assert load.shift is not None
        return unresisted(pressure, np.zeros_like(last.shear), last, load.shift)
    target = last.displacement - last.shift[:, None, None]
    aim, iterations = tolerance, 0
    for _ in range(MOST_ATTEMPTS):
        solution = shear(model, bound, target, load, last.shear, last.shift, 0.5 * aim)
        iterations += solution.iterations
        # How far the indenter's particles moved past the body's in this increment.
        passed = solution.shift[:, None, None] + target - solution.displacement
        residuals = shear_residuals(model, solution, bound, passed, load, last)
        if residuals.worst <= tolerance:
            return advanced(model, pressure, bound, last, load, solution, passed, residuals)
        aim *= 0.1
    raise NotConverged("the shear", iterations, residuals.worst, tolerance)


def reaches_limit(force: Vector, limit: float) -> bool:
    """Whether a force is at the friction limit; GrossSliding if it is beyond."""
    magnitude = float(np.hypot(*force))
    if magnitude > limit * (1 + AT_LIMIT):
        raise GrossSliding(
            f"tangential force {magnitude:.6g} N exceeds the friction limit {limit:.6g} N: gross "
            f"sliding; prescribe tangential_shift instead"
        )
    return magnitude >= limit * (1 - AT_LIMIT)


def shear_residuals(
    model: ContactModel,
    solution: Shearing,
    bound: Field,
    passed: VectorField,
    load: TangentialTarget,
    last: Sheared,
) -> ShearResiduals:
    """How well a solution obeys friction and carries its load.

    passed  how far the indenter's particles moved past the body's (2, nx, ny)
    last    the state before; where the load returns to nothing only that one shows a scale
    """
    q = solution.shear
    equilibrium = None
    if load.force is not None:
        defect = np.sum(q, axis=(1, 2)) - load.force / model.grid.cell_area
        equilibrium = float(np.hypot(*defect) / np.sum(bound))
    moved = np.maximum(np.abs(solution.displacement), np.abs(last.displacement))
    return ShearResiduals(
        friction_cone(q, bound),
        slip_direction(q, bound, passed, moved),
        equilibrium,
    )


def advanced(
    model: ContactModel,
    pressure: Field,
    bound: Field,
    last: Sheared,
    load: TangentialTarget,
    solution: Shearing,
    passed: VectorField,
    residuals: ShearResiduals,
) -> Sheared:
    """The accepted state: slip and dissipation are added to those of the state before."""
    q, cell = solution.shear, model.grid.cell_area
    in_stick = (bound > 0) & ~solution.in_slip
    slipped = np.where((pressure > 0) & ~in_stick, passed, 0.0)
    force = np.sum(q, axis=(1, 2)) * cell
    assert last.dissipated_energy is not None
    return Sheared(
        shear=q,
        displacement=solution.displacement,
        shift=solution.shift,
        slip=last.slip - slipped,
        in_stick=in_stick,
        dissipated_energy=last.dissipated_energy + float(np.sum(q * slipped)) * cell,
        status=_status(in_stick, bound, float(np.hypot(*force)) / cell),
        force=force if load.force is None else load.force,
        residuals=residuals,
        iterations=solution.iterations,
    )


def _status(in_stick: Mask, bound: Field, shear_sum: float) -> ContactStatus:
    if np.any(in_stick):
        everything = np.count_nonzero(in_stick) == np.count_nonzero(bound)
        return ContactStatus.FULL_STICK if everything else ContactStatus.PARTIAL_SLIP
    if shear_sum >= np.sum(bound) * (1 - SLIDING):
        return ContactStatus.GROSS_SLIDING
    return ContactStatus.NO_STICK_AREA_LEFT


def at_limit(model: ContactModel, bound: Field, last: Sheared, force: Vector) -> Sheared:
    """Force control at the friction limit: the traction is known, the shift is not."""
    q = bound * (force / np.hypot(*force))[:, None, None]
    defect = np.sum(q, axis=(1, 2)) - force / model.grid.cell_area
    return replace(
        last,
        shear=q,
        displacement=model.tangential_operator(model.grid.cells)(q),
        shift=None,
        in_stick=np.zeros_like(bound, dtype=bool),
        dissipated_energy=None,
        status=ContactStatus.GROSS_SLIDING,
        force=force,
        residuals=ShearResiduals(
            friction_cone(q, bound), None, float(np.hypot(*defect) / np.sum(bound))
        ),
        iterations=0,
    )


def unresisted(pressure: Field, displacement: VectorField, last: Sheared, shift: Vector) -> Sheared:
    """Friction vanishes all over the contact: all of it slips, for nothing.

    displacement  u_t (2, nx, ny) without shear, by the pressure alone
    """
    assert last.shift is not None
    passed = (shift - last.shift)[:, None, None] + last.displacement - displacement
    return replace(
        last,
        shear=np.zeros_like(last.shear),
        displacement=displacement,
        shift=shift,
        slip=last.slip - np.where(pressure > 0, passed, 0.0),
        in_stick=np.zeros_like(last.in_stick),
        status=ContactStatus.GROSS_SLIDING,
        force=np.zeros(2),
        residuals=ShearResiduals(0.0, 0.0, 0.0),
        iterations=0,
    )
