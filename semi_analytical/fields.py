"""Result of the semi-analytical solver: fields and loads of each increment.

Scalars have the shape (nx, ny) and vectors (2, nx, ny). Entry (i, j) belongs to the cell at (x_i,
y_j).
"""

from dataclasses import dataclass, field
from typing import Annotated

import numpy as np

from contact_scene import Scene
from contact_scene.array_types import Field, Mask, Vector, VectorField
from contact_scene.quantities.field_metadata import (
    Kind,
    Reported,
)
from contact_scene.quantities.increment import ReportedIncrement
from contact_scene.quantities.load_history import LoadHistory
from contact_scene.quantities.summary import ContactStatus
from semi_analytical.edge.corrected import EdgeReport
from semi_analytical.grid import SurfaceGrid
from semi_analytical.plan import Plan

F = Kind.FIELD


@dataclass(frozen=True, kw_only=True)
class Increment(ReportedIncrement):
    """Converged state at the end of one increment of the load history, as reported in the results.

    Slip is that of the lower body relative to the indenter, opposite to the shear. Fields of shear
    are None without friction.

    moment                           (Σ p y Δ, Σ p x Δ) with the pressure p and the area Δ of a cell
                                     [force length]
    iterations                       iterations of the normal and tangential solvers on all grids
    convolutions                     number of convolutions of scalars on all grids
    slip_before, dissipation_before  slip and dissipation at the start of the increment
    in_stick                         contact cells without slip in this increment
    edge_report                      outcome of the edge correction; None where it was not attempted
    """

    pressure: Annotated[Field, Reported("Pa", "Normal traction, positive in contact.", F)]
    gap: Annotated[
        Field, Reported("m", "Gap of the deformed surfaces; inf where contact is impossible.", F)
    ]
    status: ContactStatus = ContactStatus.FRICTIONLESS
    contact_radius: float = field(init=False)
    stick_radius: float | None = field(init=False)
    elastic_energy: float | None
    convolutions: int
    rounds: int = 0
    tangential_force: Vector | None = None
    tangential_shift: Vector | None = None
    moment: Vector | None = None
    tilt: Vector | None = None
    shear: Annotated[
        VectorField | None,
        Reported("Pa", "Tangential traction (x, y) on the lower body.", F),
    ] = None
    slip: Annotated[
        VectorField | None,
        Reported(
            "m", "Slip (x, y) of the lower body relative to the indenter since the start.", F, True
        ),
    ] = None
    in_stick: Annotated[
        Mask | None, Reported("", "Whether the cell is in contact and sticks.", F)
    ] = None
    slip_distance: Annotated[
        Field | None, Reported("m", "Path length of slip since the start.", F)
    ] = None
    dissipation: Annotated[
        Field | None,
        Reported("J/m^2", "Energy per area dissipated by friction since the start.", F),
    ] = None
    edge_report: EdgeReport | None = None
    slip_before: VectorField | None = None
    dissipation_before: Field | None = None

    def __post_init__(self) -> None:
        for name, area in (("contact", self.contact_area), ("stick", self.stick_area)):
            radius = None
            if area is not None:
                radius = area / 2 if self.is_line else float(np.sqrt(area / np.pi))
            object.__setattr__(self, f"{name}_radius", radius)
        super().__post_init__()

    @property
    def is_line(self) -> bool:
        """True for a line contact, on one row of strips."""
        return self.pressure.shape[1] == 1

    @property
    def in_contact(self) -> Annotated[Mask, Reported("", "Whether the cell carries pressure.", F)]:
        """Cells in contact (nx, ny): those that carry pressure."""
        return np.asarray(self.pressure > 0)

    @property
    def slip_increment(
        self,
    ) -> Annotated[VectorField | None, Reported("m", "Slip (x, y) within the increment.", F)]:
        """Slip of the lower body relative to the indenter within the increment [length].

        The field has the shape (2, nx, ny). None without friction.
        """
        if self.slip is None or self.slip_before is None:
            return None
        return np.asarray(self.slip - self.slip_before)

    @property
    def dissipation_increment(
        self,
    ) -> Annotated[
        Field | None,
        Reported("J/m^2", "Energy per area dissipated by friction within the increment.", F),
    ]:
        """Energy per area dissipated by friction within the increment (nx, ny) [force/length].

        The field is nowhere negative; None without friction.
        """
        if self.dissipation is None or self.dissipation_before is None:
            return None
        return np.asarray(self.dissipation - self.dissipation_before)


@dataclass(frozen=True, repr=False)
class Result(LoadHistory[Increment]):
    """Result of the semi-analytical solver: all increments of a load history on one grid.

    scene, grid  solved scene, and cells and window of the solution
    tolerance    limit of the dimensionless residuals
    plan         physical effects that were computed, and increments of each load step
    increments   converged increments of all load steps
    """

    scene: Scene
    grid: SurfaceGrid
    tolerance: float
    plan: Plan
    increments: tuple[Increment, ...]

    @property
    def solver(self) -> str:
        """Name of the solver."""
        return "semi_analytical"
