"""What a solve returns. Fields are (nx, ny), vectors (2, nx, ny), index [i, j] = (x_i, y_j)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene import Scene
from contact_scene.residuals import Residuals
from contact_scene.summary import ContactStatus
from semi_analytical.grid import SurfaceGrid
from semi_analytical.plan import Plan

Field = NDArray[np.float64]
VectorField = NDArray[np.float64]
Mask = NDArray[np.bool_]
Vector = NDArray[np.float64]


@dataclass(frozen=True)
class Increment:
    """The converged state at the end of one increment of the load history.

    step, index            loading step and increment within it, both counted from 1
    increments_in_step     how many increments the step has
    pressure               p [force/length^2]
    gap                    distance of the surfaces [length]; infinite where they can never touch
    shear                  traction on the lower body [force/length^2]; None without friction
    slip                   slip since the start of the history, of the lower body's particles
                           relative to the indenter's, so that it opposes the shear [length]
    in_stick               contact cells that did not slip in this increment
    tangential_shift       of the indenter relative to the body [length]; None where undefined:
                           without friction, and at the friction limit under force control
    torque, twist          about z [force length], [radian]; None where nothing twists
    moment, tilt           (Σ p y Δ, Σ p x Δ) and the slopes that close the gap at positive y and x,
                           shape (2,); None where nothing tilts
    slip_distance          way slipped since the start, |slip increments| added up [length]
    dissipated_energy      by slip since the start of the history [force length]
    dissipation            the same per area (nx, ny) [force/length], nowhere negative
    slip_before, dissipation_before
                           slip and dissipation at the start of the increment
    elastic_energy         stored in both bodies [force length]
    input_work             of forces and moments since the start, by the trapezoidal rule over the
                           increments [force length]
    unresolved_work        part of the input work that is neither stored nor dissipated but is due
                           to finite increments (see `energy`) [force length]
    energy_imbalance       what is missing of the first law over the increment, relative to the
                           largest energy so far
    iterations             of the pressure and shear solvers, grids of all sizes
    convolutions           scalar convolutions, grids of all sizes
    halvings               how often the increment was cut in two to converge
    rounds                 of alternation between pressure and shear; 0 where one pass does it
    """

    step: int
    index: int
    increments_in_step: int
    pressure: Field
    gap: Field
    normal_force: float
    approach: float
    contact_area: float
    peak_pressure: float
    elastic_energy: float
    residuals: Residuals
    iterations: int
    convolutions: int
    halvings: int = 0
    rounds: int = 0
    status: ContactStatus = ContactStatus.FRICTIONLESS
    shear: VectorField | None = None
    slip: VectorField | None = None
    in_stick: Mask | None = None
    tangential_force: Vector | None = None
    tangential_shift: Vector | None = None
    torque: float | None = None
    twist: float | None = None
    moment: Vector | None = None
    tilt: Vector | None = None
    stick_area: float | None = None
    dissipated_energy: float | None = None
    input_work: float | None = None
    unresolved_work: float | None = None
    energy_imbalance: float | None = None
    slip_distance: Field | None = None
    dissipation: Field | None = None
    slip_before: VectorField | None = None
    dissipation_before: Field | None = None

    @property
    def in_contact(self) -> Mask:
        """Cells that carry pressure."""
        return np.asarray(self.pressure > 0)

    @property
    def slip_increment(self) -> VectorField | None:
        """Slip within the increment (2, nx, ny) [length]; None without friction."""
        if self.slip is None or self.slip_before is None:
            return None
        return np.asarray(self.slip - self.slip_before)

    @property
    def dissipation_increment(self) -> Field | None:
        """Energy per area dissipated within the increment (nx, ny) [force/length]; nowhere
        negative, None without friction."""
        if self.dissipation is None or self.dissipation_before is None:
            return None
        return np.asarray(self.dissipation - self.dissipation_before)

    @property
    def contact_radius(self) -> float:
        """Radius of the circle of the contact area [length]."""
        return float(np.sqrt(self.contact_area / np.pi))

    @property
    def stick_radius(self) -> float | None:
        """Radius of the circle of the stick area [length]; None without friction."""
        return None if self.stick_area is None else float(np.sqrt(self.stick_area / np.pi))


@dataclass(frozen=True)
class Result:
    """All increments of a load history on one grid, with what was asked for and decided."""

    scene: Scene
    grid: SurfaceGrid
    tolerance: float
    plan: Plan
    increments: tuple[Increment, ...]

    @property
    def steps(self) -> tuple[Increment, ...]:
        """The last increment of every loading step."""
        return tuple(i for i in self.increments if i.index == i.increments_in_step)
