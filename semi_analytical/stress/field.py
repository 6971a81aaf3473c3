"""Displacement and stress below the surface, under tractions on the cells of a grid."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from contact_scene import Body, Scene
from contact_scene.array_types import Field
from contact_scene.free_memory import available_bytes
from contact_scene.solver_errors import ResourceRefused
from semi_analytical.frf.depth import Level
from semi_analytical.frf.stack import Stack, stack_of
from semi_analytical.grid import SurfaceGrid
from semi_analytical.stress.cells import depth_coefficients
from semi_analytical.stress.components import DISPLACEMENT, FIELDS, STRESS, TRACTIONS
from semi_analytical.stress.convolution import Convolution, plane_convolution, row_convolution
from semi_analytical.stress.levels import levels_of, line_weights

DOUBLE = 8
# Arrays of the size of the window at the peak besides the fields: two sets of coefficients,
# the closed form's potentials, spectra of the padded grid.
WORK = 3 * len(FIELDS) * len(TRACTIONS) + 40
FIXED = 100 << 20


@dataclass(frozen=True)
class SubsurfaceField:
    """Fields in one body, z into it; at an interface each side is a level of its own.

    x, y          positions, shapes (nx,) and (ny,) [length]
    levels        depth and layer of each level, as asked for
    displacement  (u_x, u_y, u_z), zero far away, shape (nz, 3, nx, ny) [length]
    stress        tension positive, shape (nz, 6, nx, ny), order xx, yy, zz, yz, xz, xy
    """

    x: Field
    y: Field
    levels: tuple[Level, ...]
    displacement: Field
    stress: Field

    @property
    def depths(self) -> Field:
        """Depth of each level, shape (nz,) [length]."""
        return np.array([level.depth for level in self.levels])

    def along_x(self, y: float = 0.0) -> SubsurfaceField:
        """The section at y, by cubic interpolation between rows of cells; shapes (…, nx, 1)."""
        weights = line_weights(self.y, y)[:, None]
        return SubsurfaceField(
            self.x, np.array([y]), self.levels, self.displacement @ weights, self.stress @ weights
        )

    def below(self, x: float = 0.0, y: float = 0.0) -> tuple[Field, Field]:
        """Displacement (nz, 3) and stress (nz, 6) on the vertical line at (x, y)."""
        section = self if len(self.y) == 1 and self.y[0] == y else self.along_x(y)
        weights = line_weights(self.x, x)
        return (
            np.einsum("zcx,x->zc", section.displacement[..., 0], weights),
            np.einsum("zcx,x->zc", section.stress[..., 0], weights),
        )


def subsurface(
    body: Body | Scene | Stack,
    grid: SurfaceGrid,
    pressure: Field,
    shear: Field | None,
    depths: Sequence[float | Level],
) -> SubsurfaceField:
    """Fields of the lower body at all cell centres of some depths.

    The tractions are constant on every cell and nothing else is approximated: no periodic images,
    no truncated spectrum; the fields are those of these tractions to about 1e-12.

    Parameters
    ----------
    body
        Layers on a half-space or a rigid base. Of a scene, the lower body. For the upper body
        pass it and -shear: z then points up into it, u_z and the stresses yz, xz change sign.
    grid
        Cells that carry the tractions.
    pressure, shear
        (nx, ny) and (2, nx, ny), traction on the body [force/length^2]; None is no shear.
    depths
        Depths [length], or levels where the side of an interface matters.

    Raises
    ------
    ValueError
        A depth is not in the body, or the tractions do not fit the grid.
    ResourceRefused
        The fields do not fit into the memory.
    """
    tractions = _tractions(grid, pressure, shear)
    stack = _stack(body)
    levels = levels_of(stack, depths)
    refuse_beyond_memory(grid.cells, len(levels))
    return _field(stack, grid, levels, plane_convolution(tractions), grid.cells, grid.y)


def subsurface_section(
    body: Body | Scene | Stack,
    grid: SurfaceGrid,
    pressure: Field,
    shear: Field | None,
    depths: Sequence[float | Level],
    y: float = 0.0,
) -> SubsurfaceField:
    """The same on the section at y alone: a fraction of the time and memory of whole planes.

    Between rows of cells it is interpolated cubically, which costs 0.02 dy^4 of the fourth
    derivative. Raises what `subsurface` raises.
    """
    tractions = _tractions(grid, pressure, shear)
    stack = _stack(body)
    levels = levels_of(stack, depths)
    weights = line_weights(grid.y, y)
    rows = np.flatnonzero(weights)
    farthest = int(max(rows[-1], grid.cells[1] - 1 - rows[0])) + 1
    refuse_beyond_memory((grid.cells[0], farthest), 0)
    convolve = row_convolution(tractions, rows)
    shape = (grid.cells[0], farthest)
    near = _field(stack, grid, levels, convolve, shape, grid.y[rows])
    return near.along_x(y)


def _field(
    stack: Stack,
    grid: SurfaceGrid,
    levels: tuple[Level, ...],
    convolve: Convolution,
    shape: tuple[int, int],
    y: Field,
) -> SubsurfaceField:
    """Fields at some levels. shape: number of offsets that the convolution reads."""
    fields = np.empty((len(levels), len(FIELDS), grid.cells[0], len(y)))
    for index, coefficients in enumerate(_each_level(stack, levels, grid, shape)):
        fields[index] = convolve(coefficients)
    return SubsurfaceField(grid.x, y, levels, fields[:, DISPLACEMENT], fields[:, STRESS])


def _each_level(
    stack: Stack, levels: tuple[Level, ...], grid: SurfaceGrid, shape: tuple[int, int]
) -> Iterator[Field]:
    return depth_coefficients(stack, levels, grid.spacing, shape)


def _stack(body: Body | Scene | Stack) -> Stack:
    """Raises ValueError for a rigid body."""
    if isinstance(body, Scene):
        body = body.body
    stack = body if isinstance(body, Stack) else stack_of(body)
    if stack.is_rigid:
        raise ValueError("the body is rigid: there are no fields in it")
    return stack


def _tractions(grid: SurfaceGrid, pressure: Field, shear: Field | None) -> Field:
    """(q_x, q_y, p) on the cells."""
    tractions = np.zeros((3, *grid.cells))
    for name, given, target in (
        ("pressure", pressure, tractions[2]),
        ("shear", shear, tractions[:2]),
    ):
        if given is None:
            continue
        if given.shape != target.shape:
            raise ValueError(
                f"{name} has shape {given.shape}, expected {target.shape} for {grid.cells} cells"
            )
        target[...] = given
    return tractions


def required_bytes(cells: tuple[int, int], levels: int, numbers: int = 0) -> int:
    """Peak memory of fields on whole planes [byte].

    numbers  largest count of numbers per point that follow from the fields, these included
    """
    arrays = max(WORK + len(FIELDS) * levels, numbers * levels)
    return DOUBLE * cells[0] * cells[1] * arrays + FIXED


def refuse_beyond_memory(cells: tuple[int, int], levels: int, numbers: int = 0) -> None:
    """Raise ResourceRefused if fields at so many levels, and the numbers that follow from them, do
    not fit into the free memory."""
    required, available = required_bytes(cells, levels, numbers), available_bytes()
    if required > available:
        raise ResourceRefused(
            f"fields at {levels} depths on {cells[0]} x {cells[1]} cells need "
            f"{required / 2**30:.2g} GiB of memory, {available / 2**30:.2g} GiB are available; "
            "take fewer cells or depths, or the section alone"
        )
