"""The discrete contact model: gap, friction limit and operators on one grid, and a coarser one."""

from collections.abc import Callable
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from contact_scene import CoulombFriction, Scene
from contact_scene.friction import FRICTIONLESS
from contact_scene.solver_errors import UnsupportedScene
from semi_analytical.bearing import modulus_of
from semi_analytical.coupled_operator import CoupledOperator
from semi_analytical.grid import SurfaceGrid
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.influence.coefficients import InfluenceCoefficients
from semi_analytical.mirrored_coupling import MirroredCoupledOperator
from semi_analytical.mirrored_inverse import MirroredPeriodicInverse
from semi_analytical.mirrored_operator import MirroredNormalOperator
from semi_analytical.mirrored_shear import MirroredTangentialOperator
from semi_analytical.mirrored_transform import mirrored_offsets
from semi_analytical.on_boxes import OnBoxes, Shape
from semi_analytical.operator import CouplingOperator, NormalOperator, TangentialOperator
from semi_analytical.padded_transform import Convolutions, offsets_for
from semi_analytical.part import WHOLE, Pair, Part, part_of
from semi_analytical.periodic_inverse import PeriodicInverse

Field = NDArray[np.float64]
Operator = TypeVar("Operator")

# A grid of no more cells along a side is not halved: from a pressure by Hertz's law it is solved in
# less than its coarser grids would take.
COARSEST = 64


class ContactModel:
    """What the solvers need of a scene on one grid. Everything is built when first asked for.

    gap           undeformed gap (nx, ny) [length]
    convolutions  counter shared by all operators of this model and its coarser ones
    even          whether pressures without shear are even about x = 0 and y = 0
    told          part of the window that tells shear, and pressure below it, where pressures
                  without shear are even
    """

    def __init__(
        self,
        scene: Scene,
        grid: SurfaceGrid,
        gap: Field,
        convolutions: Convolutions,
        *,
        even: bool = False,
        told: Part = WHOLE,
    ) -> None:
        self.scene = scene
        self.grid = grid
        self.gap = gap
        self.convolutions = convolutions
        self.even = even
        self._told = told

    @classmethod
    def of(
        cls, scene: Scene, grid: SurfaceGrid, *, even: bool = False, told: Part = WHOLE
    ) -> "ContactModel":
        """The model of a scene, its gap taken at the cell centres.

        even, told  see the class
        """
        x, y = grid.coordinates()
        gap = scene.indenter.initial_gap(x, y)
        return cls(scene, grid, gap, Convolutions(), even=even and grid.even, told=told)

    @cached_property
    def part(self) -> Part:
        """The part of the window that tells pressures without shear."""
        return part_of(self.gap, even=self.even)

    @cached_property
    def shear_part(self) -> Part:
        """The part of the window that tells shear."""
        return self._told if self.part.quarter else WHOLE

    @property
    def shear_cells(self) -> tuple[int, int]:
        """How many it has along its sides."""
        return self.shear_part.cells(self.grid.cells)

    @property
    def shear_area(self) -> float:
        """Area of a cell with its images [length^2]."""
        return self.grid.cell_area * self.shear_part.images

    @cached_property
    def shear_gap(self) -> Field:
        """The undeformed gap there [length]."""
        return self.shear_part.of(self.gap)

    def friction_limit(self, pressure: Field, first: Pair = (0, 0)) -> Field:
        """Friction limit under a pressure there, or on a box of cells that begins with this one
        [force/length^2]."""
        return self.friction.limit(pressure, self._cells_from(first, pressure.shape))

    def friction_slope(self, pressure: Field, first: Pair = (0, 0)) -> Field:
        """Derivative of the friction limit with respect to the pressure, there [1]."""
        return self.friction.slope(pressure, self._cells_from(first, pressure.shape))

    def _cells_from(self, first: Pair, shape: tuple[int, ...]) -> tuple[slice, slice]:
        """The cells of the window that a box of cells of the part that tells shear is on."""
        part = self.shear_part.slices(self.grid.cells)
        begins = (some.start + i for some, i in zip(part, first, strict=True))
        x, y = (slice(i, i + count) for i, count in zip(begins, shape, strict=True))
        return x, y

    @cached_property
    def friction(self) -> CoulombFriction:
        """Between the two bodies, with a coefficient for every cell where it varies; raises
        UnsupportedScene for a map that does not cover the window."""
        friction = self.scene.friction or FRICTIONLESS
        try:
            return friction.on(self.grid.cells, self.grid.spacing)
        except ValueError as error:
            raise UnsupportedScene(f"of the coefficient of friction {error}") from None

    @cached_property
    def coefficients(self) -> InfluenceCoefficients:
        """Influence coefficients at all offsets that an operator on this grid reads."""
        cells = self.part.cells(self.grid.cells)
        offsets = mirrored_offsets(cells) if self.part.quarter else offsets_for(cells)
        return influence_coefficients(
            self.scene.body, self.scene.indenter, self.grid.spacing, offsets
        )

    @cached_property
    def arms(self) -> Field:
        """(y, x) of the cells (2, nx, ny): by what unit tilts close the gap [length]."""
        x, y = self.grid.coordinates()
        return np.stack([y, x])

    @cached_property
    def rotation(self) -> Field:
        """(-y, x) of the cells (2, nx, ny): how a unit twist moves them [length]."""
        x, y = self.grid.coordinates()
        return np.stack([-y, x])

    @property
    def self_compliance(self) -> float:
        """Tangential displacement of a cell by its own unit shear [length^3/force]."""
        return float(0.5 * (self.coefficients.xx[0, 0] + self.coefficients.yy[0, 0]))

    @property
    def bearing_modulus(self) -> float:
        """E* as a contact half as wide as the window feels it [force/length^2]."""
        nx, ny = self.grid.cells
        return modulus_of(self.coefficients.zz[: nx // 4 + 1, : ny // 4 + 1], self.grid.spacing)

    def normal_operator(self, shape: Shape) -> NormalOperator:
        """Pressure to normal displacement on a box of cells."""
        return self._normal(shape)

    def pressure_operator(self, shape: Shape) -> NormalOperator | MirroredNormalOperator:
        """The same on a box of cells of the part that tells pressures without shear."""
        return self._mirrored(shape) if self.part.quarter else self._normal(shape)

    def tangential_operator(self, shape: Shape) -> TangentialOperator:
        """Shear to tangential displacement on a box of cells."""
        return self._tangential(shape)

    def shear_operator(self, shape: Shape) -> TangentialOperator | MirroredTangentialOperator:
        """The same on a box of cells of the part that tells shear."""
        return self._tangential(shape) if self.shear_part == WHOLE else self._mirrored_shear(shape)

    def coupling_operator(self, shape: Shape) -> CouplingOperator:
        """Shear to normal and pressure to tangential displacement on a box of cells."""
        return self._coupling(shape)

    def coupled_operator(self, shape: Shape) -> CoupledOperator | MirroredCoupledOperator:
        """All tractions to all displacements on a box of cells of the part that tells shear."""
        return self._coupled(shape) if self.shear_part == WHOLE else self._mirrored_coupled(shape)

    def periodic_inverse(self, shape: Shape) -> PeriodicInverse | MirroredPeriodicInverse:
        """Roughly all displacements to all tractions on such a box, slip graded."""
        return self._inverse(shape)

    def shear_inverse(self, shape: Shape) -> PeriodicInverse:
        """Roughly tangential displacements to shear on a box of cells, slip graded."""
        return self._shear_inverse(shape)

    def shear_preconditioner(self, shape: Shape) -> PeriodicInverse | MirroredPeriodicInverse:
        """The same on a box of cells of the part that tells shear."""
        if self.shear_part == WHOLE:
            return self._shear_inverse(shape)
        return self._mirrored_inverse(shape)

    @cached_property
    def _normal(self) -> OnBoxes[NormalOperator]:
        return self._on_window(NormalOperator)

    @cached_property
    def _mirrored(self) -> OnBoxes[MirroredNormalOperator]:
        return OnBoxes(
            lambda shape: MirroredNormalOperator(self.coefficients, shape, self.convolutions),
            self.part.cells(self.grid.cells),
        )

    @cached_property
    def _tangential(self) -> OnBoxes[TangentialOperator]:
        return self._on_window(TangentialOperator)

    @cached_property
    def _mirrored_shear(self) -> OnBoxes[MirroredTangentialOperator]:
        return OnBoxes(
            lambda shape: MirroredTangentialOperator(
                self.coefficients, shape, self.shear_part, self.convolutions
            ),
            self.shear_cells,
        )

    @cached_property
    def _coupling(self) -> OnBoxes[CouplingOperator]:
        return self._on_window(CouplingOperator)

    @cached_property
    def _coupled(self) -> OnBoxes[CoupledOperator]:
        return OnBoxes(
            lambda shape: CoupledOperator(
                self._normal(shape), self._tangential(shape), self._coupling(shape)
            ),
            self.grid.cells,
        )

    @cached_property
    def _mirrored_coupled(self) -> OnBoxes[MirroredCoupledOperator]:
        return OnBoxes(
            lambda shape: MirroredCoupledOperator(self._mirrored_shear(shape)), self.shear_cells
        )

    @cached_property
    def _inverse(self) -> OnBoxes[PeriodicInverse] | OnBoxes[MirroredPeriodicInverse]:
        if self.shear_part == WHOLE:
            return OnBoxes(
                lambda shape: PeriodicInverse(
                    self._tangential(shape), self.self_compliance, self._normal(shape), np.float32
                )
            )
        return OnBoxes(
            lambda shape: MirroredPeriodicInverse(
                self._mirrored_shear(shape),
                self.self_compliance,
                self._mirrored_coupled(shape).normal,
                np.dtype(np.float32),
            )
        )

    @cached_property
    def _shear_inverse(self) -> OnBoxes[PeriodicInverse]:
        return OnBoxes(lambda shape: PeriodicInverse(self._tangential(shape), self.self_compliance))

    @cached_property
    def _mirrored_inverse(self) -> OnBoxes[MirroredPeriodicInverse]:
        return OnBoxes(
            lambda shape: MirroredPeriodicInverse(self._mirrored_shear(shape), self.self_compliance)
        )

    def _on_window(
        self, kind: Callable[[InfluenceCoefficients, Shape, Convolutions], Operator]
    ) -> OnBoxes[Operator]:
        """Those of a kind on boxes of cells of the window."""
        return OnBoxes(
            lambda shape: kind(self.coefficients, shape, self.convolutions), self.grid.cells
        )

    @cached_property
    def coarse(self) -> "ContactModel | None":
        """The same window with half the cells; None where that is not possible or not worth it."""
        nx, ny = self.grid.cells
        if nx % 2 or ny % 2 or min(nx, ny) <= COARSEST:
            return None
        gap = halved(self.gap)
        return ContactModel(
            self.scene, self.grid.coarsened(), gap, self.convolutions, even=self.even
        )


def halved(values: Field) -> Field:
    """Means over two by two cells, (..., nx, ny) to (..., nx/2, ny/2)."""
    # In pairs: means of mirror images are mirror images to the last bit.
    along = values[..., ::2, :] + values[..., 1::2, :]
    return np.asarray((along[..., ::2] + along[..., 1::2]) / 4)


def doubled(values: Field) -> Field:
    """Every value four times, (..., nx, ny) to (..., 2 nx, 2 ny)."""
    return np.repeat(np.repeat(values, 2, axis=-2), 2, axis=-1)
