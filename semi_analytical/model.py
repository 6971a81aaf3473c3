"""The discrete contact model: gap, friction limit and operators on one grid, and a coarser one."""

from dataclasses import replace
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
from semi_analytical.mirrored_operator import MirroredNormalOperator
from semi_analytical.mirrored_shear import MirroredPeriodicInverse, MirroredTangentialOperator
from semi_analytical.mirrored_transform import mirrored_offsets
from semi_analytical.operator import CouplingOperator, NormalOperator, TangentialOperator
from semi_analytical.padded_transform import Convolutions, offsets_for
from semi_analytical.part import WHOLE, Part, part_of
from semi_analytical.periodic_inverse import PeriodicInverse

Field = NDArray[np.float64]
Operator = TypeVar(
    "Operator",
    NormalOperator,
    MirroredNormalOperator,
    TangentialOperator,
    MirroredTangentialOperator,
    CouplingOperator,
    CoupledOperator,
)

# A grid of no more cells along a side is not halved: from a pressure by Hertz's law it is solved in
# less than its coarser grids would take.
COARSEST = 64


class ContactModel:
    """What the solvers need of a scene on one grid. Everything is built when first asked for.

    gap           undeformed gap (nx, ny) [length]
    convolutions  counter shared by all operators of this model and its coarser ones
    even          whether pressures without shear are even about x = 0 and y = 0
    along         component of shear that is even about both as well, the other being odd about
                  both; None where a quarter does not tell shear
    """

    def __init__(
        self,
        scene: Scene,
        grid: SurfaceGrid,
        gap: Field,
        convolutions: Convolutions,
        *,
        even: bool = False,
        along: int | None = None,
    ) -> None:
        self.scene = scene
        self.grid = grid
        self.gap = gap
        self.convolutions = convolutions
        self.even = even
        self._along = along
        self._normal: dict[tuple[int, int], NormalOperator] = {}
        self._mirrored: dict[tuple[int, int], MirroredNormalOperator] = {}
        self._tangential: dict[tuple[int, int], TangentialOperator] = {}
        self._mirrored_shear: dict[tuple[int, int], MirroredTangentialOperator] = {}
        self._coupling: dict[tuple[int, int], CouplingOperator] = {}
        self._coupled: dict[tuple[int, int], CoupledOperator] = {}
        self._inverse: dict[tuple[int, int], PeriodicInverse] = {}
        self._shear_inverse: dict[tuple[int, int], PeriodicInverse] = {}
        self._mirrored_inverse: dict[tuple[int, int], MirroredPeriodicInverse] = {}

    @classmethod
    def of(
        cls, scene: Scene, grid: SurfaceGrid, *, even: bool = False, along: int | None = None
    ) -> "ContactModel":
        """The model of a scene, its gap taken at the cell centres.

        even, along  see the class
        """
        x, y = grid.coordinates()
        gap = scene.indenter.initial_gap(x, y)
        return cls(scene, grid, gap, Convolutions(), even=even and grid.even, along=along)

    @cached_property
    def part(self) -> Part:
        """The part of the window that tells pressures without shear."""
        return part_of(self.gap, even=self.even)

    @cached_property
    def shear_part(self) -> Part:
        """The part of the window that tells shear."""
        told = self._along is not None and self.part.quarter
        return replace(self.part, along=self._along) if told else WHOLE

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

    def friction_limit(self, pressure: Field) -> Field:
        """µp under a pressure there [force/length^2]."""
        return self.friction.limit(pressure, self.shear_part.slices(self.grid.cells))

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

    def normal_operator(self, shape: tuple[int, int]) -> NormalOperator:
        """Pressure to normal displacement on a box of cells."""
        if shape not in self._normal:
            self._forget_other_boxes(self._normal, shape)
            self._normal[shape] = NormalOperator(self.coefficients, shape, self.convolutions)
        return self._normal[shape]

    def pressure_operator(self, shape: tuple[int, int]) -> NormalOperator | MirroredNormalOperator:
        """The same on a box of cells of the part that tells pressures without shear."""
        if not self.part.quarter:
            return self.normal_operator(shape)
        if shape not in self._mirrored:
            self._forget_other_boxes(self._mirrored, shape, self.part.cells(self.grid.cells))
            self._mirrored[shape] = MirroredNormalOperator(
                self.coefficients, shape, self.convolutions
            )
        return self._mirrored[shape]

    def tangential_operator(self, shape: tuple[int, int]) -> TangentialOperator:
        """Shear to tangential displacement on a box of cells."""
        if shape not in self._tangential:
            self._forget_other_boxes(self._tangential, shape)
            self._tangential[shape] = TangentialOperator(
                self.coefficients, shape, self.convolutions
            )
        return self._tangential[shape]

    def shear_operator(
        self, shape: tuple[int, int]
    ) -> TangentialOperator | MirroredTangentialOperator:
        """The same on a box of cells of the part that tells shear."""
        along = self.shear_part.along
        if along is None:
            return self.tangential_operator(shape)
        if shape not in self._mirrored_shear:
            self._forget_other_boxes(self._mirrored_shear, shape, self.shear_cells)
            self._mirrored_shear[shape] = MirroredTangentialOperator(
                self.coefficients, shape, along, self.convolutions
            )
        return self._mirrored_shear[shape]

    def _forget_other_boxes(
        self,
        operators: dict[tuple[int, int], Operator],
        shape: tuple[int, int],
        whole: tuple[int, int] | None = None,
    ) -> None:
        """Keep the operator on the whole window, or its part, and one more: a contact that grows
        passes through many boxes and hardly ever returns to one."""
        whole = whole or self.grid.cells
        if shape != whole:
            for other in operators.keys() - {whole}:
                del operators[other]

    def coupling_operator(self, shape: tuple[int, int]) -> CouplingOperator:
        """Shear to normal and pressure to tangential displacement on a box of cells."""
        if shape not in self._coupling:
            self._forget_other_boxes(self._coupling, shape)
            self._coupling[shape] = CouplingOperator(self.coefficients, shape, self.convolutions)
        return self._coupling[shape]

    def coupled_operator(self, shape: tuple[int, int]) -> CoupledOperator:
        """All tractions to all displacements on a box of cells."""
        if shape not in self._coupled:
            self._forget_other_boxes(self._coupled, shape)
            self._coupled[shape] = CoupledOperator(
                self.normal_operator(shape),
                self.tangential_operator(shape),
                self.coupling_operator(shape),
            )
        return self._coupled[shape]

    def periodic_inverse(self, shape: tuple[int, int]) -> PeriodicInverse:
        """Roughly all displacements to all tractions on a box of cells, slip graded."""
        if shape not in self._inverse:
            self._inverse.clear()
            together = self.coupled_operator(shape)
            self._inverse[shape] = PeriodicInverse(
                together.tangential, self.self_compliance, together.normal, np.float32
            )
        return self._inverse[shape]

    def shear_inverse(self, shape: tuple[int, int]) -> PeriodicInverse:
        """Roughly tangential displacements to shear on a box of cells, slip graded."""
        if shape not in self._shear_inverse:
            self._shear_inverse.clear()
            self._shear_inverse[shape] = PeriodicInverse(
                self.tangential_operator(shape), self.self_compliance
            )
        return self._shear_inverse[shape]

    def shear_preconditioner(
        self, shape: tuple[int, int]
    ) -> PeriodicInverse | MirroredPeriodicInverse:
        """The same on a box of cells of the part that tells shear."""
        operator = self.shear_operator(shape)
        if isinstance(operator, TangentialOperator):
            return self.shear_inverse(shape)
        if shape not in self._mirrored_inverse:
            self._mirrored_inverse.clear()
            self._mirrored_inverse[shape] = MirroredPeriodicInverse(operator, self.self_compliance)
        return self._mirrored_inverse[shape]

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
