"""Displacement and stress in the lower body by tractions on the cells of a surface grid.

The subsurface stress of a contact result is computed by this module.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from contact_scene import Body, Scene
from contact_scene.array_types import Field, Indices
from contact_scene.machine import require_memory
from semi_analytical.frf.depth import Level, material_at
from semi_analytical.frf.stack import Stack, stack_of
from semi_analytical.grid import SurfaceGrid
from semi_analytical.stress.components import DISPLACEMENT, FIELDS, STRESS, TRACTIONS
from semi_analytical.stress.convolution import (
    offsets_between,
    plane_convolution,
)
from semi_analytical.stress.depths import (
    levels_of,
    line_weights,
)
from semi_analytical.stress.rectangle import half_space_response

DOUBLE = 8
# Arrays of the size of the window at the peak, in addition to the fields: coefficients, potentials
# of the closed form, spectra. Measured with shear at 90² and 176² cells: 222.
WORK = 9 * len(FIELDS) * len(TRACTIONS)
FIXED = 100 << 20
# Half width of the window in half extents of the contact. It includes the contact edge, where the
# tensile stress is largest, and the deflection of a coating outside the contact.
MARGIN = 1.6


@dataclass(frozen=True)
class SubsurfaceField:
    """Displacement and stress in one body below the cell centres of a grid, at several levels.

    A level is a depth in one layer. Each side of an interface is a separate level. z points into
    the body.

    x, y          positions of the cell centres, shapes (nx,) and (ny,) [length]
    levels        depth and layer of each level, in the order of the request
    displacement  (u_x, u_y, u_z), zero far away, shape (nz, 3, nx, ny) [length]; NaN for strips
    stress        order xx, yy, zz, yz, xz, xy, tensile stress positive, shape (nz, 6, nx, ny)
                  [force/length^2]
    """

    x: Field
    y: Field
    levels: tuple[Level, ...]
    displacement: Field
    stress: Field

    @classmethod
    def joined(cls, parts: Iterable[SubsurfaceField]) -> SubsurfaceField:
        """Combine fields at different levels into one field.

        parts  fields at equal positions x, y, in the order of their levels
        """
        each = list(parts)
        return cls(
            each[0].x,
            each[0].y,
            tuple(level for part in each for level in part.levels),
            np.concatenate([part.displacement for part in each]),
            np.concatenate([part.stress for part in each]),
        )

    @property
    def depths(self) -> Field:
        """Depth of each level below the surface, shape (nz,) [length]."""
        return np.array([level.depth for level in self.levels])

    def along_x(self, y: float = 0.0) -> SubsurfaceField:
        """Interpolate displacement and stress to the vertical section y = const.

        Cubic interpolation between rows of cells is used. The arrays of the result have the shape
        (…, nx, 1).

        y  coordinate of the section [length]
        """
        if len(self.y) == 1 and self.y[0] == y:
            return self
        weights = line_weights(self.y, y)[:, None]
        return SubsurfaceField(
            self.x, np.array([y]), self.levels, self.displacement @ weights, self.stress @ weights
        )

    def below(self, x: float = 0.0, y: float = 0.0) -> tuple[Field, Field]:
        """Interpolate displacement (nz, 3) and stress (nz, 6) to the vertical line below a point.

        Cubic interpolation between cell centres is used. The rows are the levels.

        x, y  coordinates of the surface point [length]
        """
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
    """Compute displacement and stress of the lower body below all cell centres at some depths.

    The tractions are uniform in each cell. There is no other approximation (no periodic images, no
    truncated spectrum): the relative error of the fields of these tractions is about 1e-12.

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
    levels = levels_of(_deformable_stack(body), depths)
    refuse_beyond_memory(grid.cells, len(levels))
    return SubsurfaceField.joined(fields_by_level(body, grid, pressure, shear, levels))


def fields_by_level(
    body: Body | Scene | Stack,
    grid: SurfaceGrid,
    pressure: Field,
    shear: Field | None,
    depths: Sequence[float | Level],
    rows: Indices | None = None,
) -> Iterator[SubsurfaceField]:
    """Iterate over displacement and stress in the lower body, one depth at a time.

    The computation of one depth at a time limits the memory.

    body             body, or scene whose lower body is used
    grid             cells that carry the tractions
    pressure, shear  tractions on the body, (nx, ny) and (2, nx, ny) [force/length^2]; None is no
                     shear
    depths           depths [length], or levels where the side of an interface matters
    rows             indices along y of the required rows of cells; None for all
    """
    tractions = _checked_tractions(grid, pressure, shear)
    stack = _deformable_stack(body)
    levels = levels_of(stack, depths)
    if grid.of_strips:
        from semi_analytical.stress.strips import strip_stresses

        for level, stress in zip(
            levels, strip_stresses(stack, grid, tractions, levels), strict=True
        ):
            unknown = np.full((1, 3, *grid.cells), np.nan)
            yield SubsurfaceField(grid.x, grid.y, (level,), unknown, stress[None])
        return
    rows = np.arange(grid.cells[1]) if rows is None else rows
    offsets = offsets_between(tractions, rows)
    refuse_beyond_memory(grid.cells, 1)
    convolve = plane_convolution(tractions, offsets)
    each = depth_coefficients(stack, levels, grid.spacing, offsets, sheared=len(tractions) > 1)
    for level, coefficients in zip(levels, each, strict=True):
        fields = np.take(convolve(coefficients)[None], rows, axis=-1)
        yield SubsurfaceField(
            grid.x, grid.y[rows], (level,), fields[:, DISPLACEMENT], fields[:, STRESS]
        )


def depth_coefficients(
    stack: Stack,
    levels: tuple[Level, ...],
    spacing: tuple[float, float],
    shape: tuple[int, int],
    *,
    sheared: bool = True,
) -> Iterator[Field]:
    """Yield displacement and stress in a body by unit tractions on a cell, for each depth.

    A closed form is used in the outermost material, to which layers add their contribution. Below
    the outermost material the whole response is tabulated. Entry (i, j) belongs to the offset (i
    dx, j dy) with i, j >= 0; other quadrants follow by `components.parity`. Displacements are in
    [length^3/force], stresses are dimensionless.

    stack    layers and base of the body
    levels   depths, each with the index of its layer
    spacing  cell sides dx, dy [length]
    shape    number of offsets nx, ny along x and y, including zero
    sheared  include the responses to the shear components, before those to pressure
    yields   shape (9, tractions, nx, ny): 3 displacements and 6 stresses, by each traction
             component
    """
    if not stack.layers:
        for level in levels:
            yield _half_space_coefficients(stack, level, spacing, shape, sheared)
        return
    from semi_analytical.stress.radial_table import layered_coefficients

    by_layers = layered_coefficients(stack, levels, spacing, shape, sheared=sheared)
    for level, result in zip(levels, by_layers, strict=True):
        if level.layer == 0:
            result += _half_space_coefficients(stack, level, spacing, shape, sheared)
        yield result


def _half_space_coefficients(
    stack: Stack,
    level: Level,
    spacing: tuple[float, float],
    shape: tuple[int, int],
    sheared: bool,
) -> Field:
    """Compute 3 displacements and 6 stresses by unit tractions on a cell (9, tractions, nx, ny),
    at offsets >= 0 in a half-space of the material at the depth."""
    x = (np.arange(shape[0] + 1, dtype=np.float64) - 0.5) * spacing[0]
    y = (np.arange(shape[1] + 1, dtype=np.float64) - 0.5) * spacing[1]
    return half_space_response(x, y, level.depth, material_at(stack, level), sheared=sheared)


def _deformable_stack(body: Body | Scene | Stack) -> Stack:
    """Return the layers and base of a body that is not rigid.

    body  body, its layers and base, or a scene, of which the lower body is used

    Raises ValueError for a rigid body, which has no subsurface stress.
    """
    if isinstance(body, Scene):
        body = body.body
    stack = body if isinstance(body, Stack) else stack_of(body)
    if stack.is_rigid:
        raise ValueError("the body is rigid and has no subsurface fields")
    return stack


def _checked_tractions(grid: SurfaceGrid, pressure: Field, shear: Field | None) -> Field:
    """Check the shapes of pressure and shear, and combine both into one array of tractions.

    The array has the components (q_x, q_y, p), shape (3, nx, ny). It has the pressure alone, shape
    (1, nx, ny), if the shear is zero.

    grid             cells that carry the tractions
    pressure, shear  tractions on the body, (nx, ny) and (2, nx, ny); None is no shear
    """
    for name, field, expected in (
        ("pressure", pressure, grid.cells),
        ("shear", shear, (2, *grid.cells)),
    ):
        if field is not None and field.shape != expected:
            raise ValueError(
                f"{name} has shape {field.shape}, expected {expected} for {grid.cells} cells"
            )
    if shear is None or not shear.any():
        return pressure[None]
    return np.concatenate([shear, pressure[None]])


def required_bytes(cells: tuple[int, int], levels: int, numbers: int = 0) -> int:
    """Estimate the peak memory of displacement and stress at several depths on whole planes [byte].

    cells    number of cells along x and y
    levels   number of depths
    numbers  values per point that the caller stores of each depth, fields included; 0 for the
             fields alone
    """
    arrays = max(WORK + len(FIELDS) * levels, numbers * levels)
    return DOUBLE * cells[0] * cells[1] * arrays + FIXED


def bytes_below_contact(grid: SurfaceGrid) -> int:
    """Estimate the peak memory of the stress below a contact that fills the grid [byte].

    The memory is that of one level, without the fixed memory of the program.
    """
    nx, ny = (round(MARGIN * cells) for cells in grid.cells)
    return required_bytes((nx, ny), 1) - FIXED


def refuse_beyond_memory(cells: tuple[int, int], levels: int, numbers: int = 0) -> None:
    """Raise ResourceRefused if displacement and stress at several depths exceed the free memory.

    cells    number of cells along x and y
    levels   number of depths
    numbers  values per point that the caller stores of each depth, fields included; 0 for the
             fields alone
    """
    require_memory(
        required_bytes(cells, levels, numbers),
        f"fields at {levels} depths on {cells[0]} x {cells[1]} cells",
        "Use fewer cells or depths, or the section alone",
    )
