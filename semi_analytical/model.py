"""Discrete contact model: gap, friction limit and operators on a grid; coarser models."""

from functools import cached_property
from math import asinh, pi

import numpy as np

from contact_scene import CoulombFriction, Scene
from contact_scene.array_types import Field, Vector, VectorField
from contact_scene.friction import FRICTIONLESS
from contact_scene.geometry import LineShape
from contact_scene.rig import compliances
from contact_scene.solver_errors import UnsupportedScene
from semi_analytical.grid import SurfaceGrid
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.influence.coefficients import InfluenceCoefficients
from semi_analytical.operator.domain import WINDOW, Pair, ReducedDomain, ReducedGrid
from semi_analytical.operator.operator import DisplacementOperator
from semi_analytical.operator.transforms import Convolutions, offsets_for

# Largest number of cells per side for which no coarser model is used: from an initial pressure by
# Hertz theory the solution takes less time than the coarser grids.
COARSEST = 64


class ContactModel:
    """Discrete contact model of a scene on one grid: gap, friction limit and operators.

    Operators compute surface displacements from tractions. Properties are computed at first use.

    scene         scene with bodies, friction and loads
    grid          cells of the reduced domain; their area includes the mirror images
    domain        symmetry reduction: domain of all fields
    window        grid of the full window
    gap           undeformed gap on the reduced domain (nx, ny) [length]
    convolutions  counter shared by all operators of this model and its coarser models
    """

    def __init__(
        self, scene: Scene, grid: ReducedGrid, gap: Field, convolutions: Convolutions
    ) -> None:
        self.scene, self.grid, self.gap, self.convolutions = scene, grid, gap, convolutions
        self.domain, self.window = grid.domain, grid.window
        self._operators: dict[Pair, DisplacementOperator] = {}

    @classmethod
    def from_scene(
        cls, scene: Scene, window: SurfaceGrid, symmetry: ReducedDomain = WINDOW
    ) -> "ContactModel":
        """Build the contact model of a scene, with the undeformed gap at the cell centres.

        scene     scene with bodies, friction and loads
        window    grid of the full window
        symmetry  symmetry reduction of the plan; the full window is used if cells lie on a mirror
                  plane
        raises    ValueError if the gap is not even about the mirror planes
        """
        domain = symmetry if window.even else WINDOW
        gap = scene.indenter.initial_gap(*window.coordinates())
        domain.require_even(gap)
        return cls(scene, ReducedGrid(window, domain), domain.restrict(gap), Convolutions())

    def friction_limit(self, pressure: Field, first: Pair = (0, 0)) -> Field:
        """Compute the largest shear that friction can carry in each cell [force/length^2].

        pressure  p on the reduced domain, or on a box of its cells (nx, ny)
        first     indices of the first cell of the box
        """
        return self.friction.limit(pressure, self._window_slices(first, pressure.shape))

    def friction_slope(self, pressure: Field, first: Pair = (0, 0)) -> Field:
        """Compute the derivative of the friction limit of each cell by its pressure [1].

        The derivative is the coefficient of friction, if the limit is proportional to the pressure.

        pressure  p on the reduced domain, or on a box of its cells (nx, ny)
        first     indices of the first cell of the box
        """
        return self.friction.slope(pressure, self._window_slices(first, pressure.shape))

    def _window_slices(self, first: Pair, shape: tuple[int, ...]) -> tuple[slice, slice]:
        """Return the slices of the full window that contain a box of the reduced domain."""
        cells = zip(self.window.cells, self.grid.cells, first, strict=True)
        begins = (whole - n + i for whole, n, i in cells)
        x, y = (slice(i, i + count) for i, count in zip(begins, shape, strict=True))
        return x, y

    @cached_property
    def friction(self) -> CoulombFriction:
        """Friction law of the scene on this grid.

        A coefficient of friction that varies has one value per cell of the window. Raises
        UnsupportedScene for a map of the coefficient that does not cover the window.
        """
        friction = self.scene.friction or FRICTIONLESS
        try:
            return friction.on_grid(self.window.cells, self.window.spacing)
        except ValueError as error:
            raise UnsupportedScene(f"coefficient of friction: {error}") from None

    @cached_property
    def coefficients(self) -> InfluenceCoefficients:
        """Influence coefficients: displacements of a cell by unit tractions on another cell.

        They are stored at all cell offsets that occur on the full window [length^3/force].
        """
        offsets = offsets_for(self.window.cells)
        scene = self.scene
        indenter, reference = scene.indenter, None
        if isinstance(indenter, LineShape):  # without a reference, motions are not stated
            reference = indenter.reference_length or 1.0
        return influence_coefficients(
            scene.body, indenter, self.grid.spacing, offsets, scene.rig, reference
        )

    @property
    def springs(self) -> tuple[float, float]:
        """Compliances of the test rig's springs, normal and tangential [length^3/force].

        A compliance is the displacement of a spring per sum of the pressure or shear over the cells
        of the reduced domain. It is 0 without a spring.
        """
        down, along = compliances(self.scene.rig)
        return down * self.grid.cell_area, along * self.grid.cell_area

    @cached_property
    def arms(self) -> Field:
        """Coordinates (y, x) of the cells (2, nx, ny) [length]: closure of the gap by unit tilts.

        They are also the lever arms of the pressure for the moments (M_x, M_y).
        """
        x, y = self.grid.coordinates()
        return np.stack([y, x])

    @cached_property
    def rotation(self) -> Field:
        """Displacement of the cells by a unit twist: vector field (-y, x) (2, nx, ny) [length]."""
        x, y = self.grid.coordinates()
        return np.stack([-y, x])

    @cached_property
    def reach(self) -> float:
        """Length that makes tilt and twist comparable with approach and shift [length].

        It is the largest |x| or |y| of a cell.
        """
        return float(np.max(np.abs(self.arms)))

    @property
    def self_compliance(self) -> float:
        """Tangential displacement of a cell by unit shear in this cell [length^3/force].

        The value is the mean of the directions x and y.
        """
        return self.operator(self.grid.cells).self_compliance

    @property
    def bearing_modulus(self) -> float:
        """Modulus E* of a homogeneous half-space that represents the bodies [force/length^2].

        It applies to a contact of half the width of the window, and is used for the initial guess
        of the pressure.
        """
        nx, ny = self.window.cells
        spring = self.springs[0] / self.domain.images
        zz = self.coefficients["zz"][: nx // 4 + 1, : ny // 4 + 1] - spring
        return _modulus_of(zz, self.grid.spacing)

    def operator(self, shape: Pair) -> DisplacementOperator:
        """Return the map from tractions to surface displacements (operator) on a box of cells.

        Operators on the whole domain and on one other shape are stored: growing contacts rarely
        return to an earlier shape.

        shape  number of cells of the box along x and y
        """
        if shape not in self._operators:
            if shape != self.grid.cells:
                for other in self._operators.keys() - {self.grid.cells}:
                    del self._operators[other]
            self._operators[shape] = DisplacementOperator(
                self.coefficients, shape, self.domain, self.convolutions
            )
        return self._operators[shape]

    @cached_property
    def on_window(self) -> "ContactModel":
        """Contact model with equal cells on the full window, without symmetry reduction.

        The influence coefficients are shared.
        """
        if self.domain == WINDOW:
            return self
        gap = self.domain.extend(self.gap)
        found = ContactModel(self.scene, ReducedGrid(self.window), gap, self.convolutions)
        found.coefficients = self.coefficients
        return found

    @cached_property
    def coarse(self) -> "ContactModel | None":
        """Contact model on the same domain with half the cells per side, for initial guesses.

        The pressure solved on the coarser cells is the initial guess on the finer cells. The value
        is None if a number of cells is odd or the window has too few cells to save time.
        """
        if any(n % 2 for n in self.grid.cells) or min(self.window.cells) <= COARSEST:
            return None
        grid = ReducedGrid(self.window.coarsened(), self.domain)
        return ContactModel(self.scene, grid, coarsen_field(self.gap), self.convolutions)


def everywhere(v: Vector) -> VectorField:
    """Return a vector (2,) as a uniform vector field (2, 1, 1), which broadcasts with (2, nx, ny).

    v  vector, such as the shift of the indenter
    """
    return v[:, None, None]


def coarsen_field(values: Field) -> Field:
    """Compute the mean of a field over two by two cells: (..., nx, ny) to (..., nx/2, ny/2).

    Used for the undeformed gap of a coarser grid.
    """
    # Sums of pairs: means of mirror images are bitwise mirror images.
    along = values[..., ::2, :] + values[..., 1::2, :]
    return np.asarray((along[..., ::2] + along[..., 1::2]) / 4)


def refine_field(values: Field) -> Field:
    """Repeat each cell value of a field on two by two cells: (..., nx, ny) to (..., 2 nx, 2 ny).

    Used to transfer a pressure from a coarse grid to the next finer grid.
    """
    return np.repeat(np.repeat(values, 2, axis=-2), 2, axis=-1)


def _modulus_of(compliance: Field, spacing: tuple[float, float]) -> float:
    """Compute E* [force/length^2] of the half-space with equal central displacement under a
    uniform pressure on a rectangle (Johnson 1985, eq. 3.25), from compliances to half its sides."""
    at_middle = 4 * np.sum(compliance) - 2 * np.sum(compliance[0]) - 2 * np.sum(compliance[:, 0])
    a, b = ((2 * n - 1) * side for n, side in zip(compliance.shape, spacing, strict=True))
    mean_inverse_distance = 2 * (a * asinh(b / a) + b * asinh(a / b))
    return mean_inverse_distance / (pi * float(at_middle + compliance[0, 0]))
