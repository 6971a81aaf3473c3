"""The tangential part of a state, and what it means for the increment that starts from it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene.residuals import ShearResiduals
from contact_scene.summary import ContactStatus
from semi_analytical.admissible_shear import everywhere
from semi_analytical.model import ContactModel
from semi_analytical.shearing import TangentialTarget

Field = NDArray[np.float64]
VectorField = NDArray[np.float64]
Mask = NDArray[np.bool_]
Vector = NDArray[np.float64]


@dataclass(frozen=True)
class Sheared:
    """The tangential part of a state, all fields on the domain.

    pressure           p that the shear is below (nx, ny) [force/length^2]
    touching           part of the increment for which cells are in contact (nx, ny), of those that
                       are at either end
    displacement       u_t by the shear; less the motion it remembers where particles met
    shift              of the indenter; None at the friction limit under force control
    twist, torque      of the indenter; None where nothing twists
    slip               u_t - motion accumulated while in contact (paper, eq. (4))
    slip_distance      way slipped since the start (nx, ny), |slip increments| added up
    dissipation        energy dissipated per area since the start (nx, ny) [force/length]
    dissipated_energy  since the start; None where the shift is
    """

    shear: VectorField
    pressure: Field
    touching: Field
    displacement: VectorField
    shift: Vector | None
    slip: VectorField
    slip_distance: Field
    dissipation: Field
    in_stick: Mask
    dissipated_energy: float | None
    status: ContactStatus
    force: Vector
    residuals: ShearResiduals
    iterations: int
    twist: float | None = None
    torque: float | None = None

    @property
    def motion(self) -> Vector:
        """Shift, and twist where there is one."""
        assert self.shift is not None
        return self.shift if self.twist is None else np.array([*self.shift, self.twist])


def untouched(cells: tuple[int, int]) -> Sheared:
    """Before first touch: no shear, no shift, no slip."""
    nothing = np.zeros((2, *cells))
    return Sheared(
        shear=nothing,
        pressure=nothing[0],
        touching=nothing[0],
        displacement=nothing,
        shift=np.zeros(2),
        slip=nothing,
        slip_distance=nothing[0],
        dissipation=nothing[0],
        in_stick=np.zeros(cells, dtype=bool),
        dissipated_energy=0.0,
        status=ContactStatus.FULL_STICK,
        force=np.zeros(2),
        residuals=ShearResiduals(0.0, 0.0, 0.0),
        iterations=0,
    )


def rigid(model: ContactModel, motion: Vector) -> VectorField:
    """Displacement of the indenter's particles by a shift, or by a shift and a twist."""
    shift = everywhere(motion[:2])
    return shift if len(motion) == 2 else shift + motion[2] * model.rotation


def surface_target(model: ContactModel, last: Sheared, load: TangentialTarget) -> VectorField:
    """By what the surfaces have to be moved, beside the motion of the load, to stick (2, nx, ny):
    what they remember, and what a given twist adds."""
    target = last.displacement - rigid(model, last.motion)
    if load.torsion is None or load.torsion.twist is None:
        return target
    return target + load.torsion.twist * model.rotation


def first_motion(last: Sheared, load: TangentialTarget) -> Vector:
    """The motion of the state before, as the load counts it."""
    assert last.shift is not None
    if load.torsion is None or load.torsion.torque is None:
        return last.shift
    return np.array([*last.shift, last.twist or 0.0])


def torque_of(model: ContactModel, q: VectorField) -> float:
    """Σ(q_y x - q_x y) Δ [force length]."""
    return float(np.sum(q * model.rotation)) * model.grid.cell_area


def torsion_reached(
    model: ContactModel, load: TangentialTarget, motion: Vector, q: VectorField
) -> tuple[float | None, float | None]:
    """Twist and torque; None where nothing twists."""
    if load.torsion is None:
        return None, None
    if load.torsion.torque is not None:
        return float(motion[2]), load.torsion.torque
    return load.torsion.twist, torque_of(model, q)
