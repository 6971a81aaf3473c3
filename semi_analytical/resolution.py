"""Resolution of a result: contact, stick zone, layers and surface waves in cells.

Residuals do not measure resolution: a contact of one cell fulfils the equations of the grid.
"""

from dataclasses import dataclass
from math import pi

import numpy as np

from contact_scene import HeightMap
from contact_scene.array_types import Field, Indices, Mask
from contact_scene.body_pair import contact_modulus
from contact_scene.height_map import interpolate
from contact_scene.solver_errors import ContactNotResolved, SolverError
from semi_analytical.default_grid import fit_window
from semi_analytical.fields import Increment, Result

# Cells per contact radius from which peak pressure and approach are meaningful.
ENOUGH = 8


@dataclass(frozen=True)
class Resolution:
    """Sizes of contact, stick zone, layers and roughness at the end of a load step, in cells.

    The sizes determine if the grid resolves the contact. None stands for a feature that does not
    exist.

    contact  smaller semi-axis of the contact; for several patches the mean weighted by their loads.
             Patches without a cell that has four neighbours in contact count half, as so few cells
             may carry the load of a much smaller contact. 0 without contact
    stick    smaller semi-axis of the stick zone, computed like that of the contact; 0 in gross
             slip; None without shear
    annulus  width of the slip zone around the stick zone, `contact` - `stick`; None in full stick
    layer    thickness of the thinnest layer; layers of nearly equal material count as one
    wave     mean wavelength of the heights of a height map around the contact
    """

    contact: float
    stick: float | None = None
    annulus: float | None = None
    layer: float | None = None
    wave: float | None = None


def resolution(result: Result) -> tuple[Resolution, ...]:
    """Measure contact, stick zone, layers and roughness of a result in cells, for each load step.

    The sizes are those at the end of the load step. They determine if the grid resolves the
    contact.
    """
    return tuple(resolution_at(result, end) for end in result.steps)


def resolution_at(result: Result, end: Increment) -> Resolution:
    """Measure contact, stick zone, layers and roughness in cells at the end of a load step.

    result  result of the semi-analytical solver
    end     increment at the end of the load step
    """
    grid, load, contact = result.grid, end.pressure, _contact_size(result, end)
    stick = annulus = None
    if end.in_stick is not None and end.stick_area is not None:
        stick = _semi_axis(end.in_stick, load, end.stick_area / grid.cell_area)
        if np.any(end.in_contact & ~end.in_stick):
            annulus = max(contact - stick, 0.0)
    return Resolution(
        contact, stick, annulus, _layer_cells(result), _wavelength_cells(result, end.in_contact)
    )


def _contact_size(result: Result, end: Increment) -> float:
    """Compute the smaller semi-axis of the contact, in cells."""
    return _semi_axis(end.in_contact, end.pressure, end.contact_area / result.grid.cell_area)


def refuse_unresolved(result: Result) -> None:
    """Raise ContactNotResolved if the grid of a result has less than one cell per contact radius.

    The largest contact of the load history is tested.
    """
    end = max(result.steps, key=lambda step: step.contact_area)
    if end.edge_change is not None:  # the fits of an edge need a contact of several cells
        return
    found = _contact_size(result, end)
    if found >= 1:
        return
    raise ContactNotResolved(
        f"the contact is smaller than the cells: at its largest, at the end of step {end.step}, "
        f"{np.count_nonzero(end.in_contact)} of them carry the load, so that its size and pressure "
        f"are determined by the cells. {_remedy_text(result, found)}"
    )


def _remedy_text(result: Result, found: float) -> str:
    """Return a sentence for an error message: settings with which the cells resolve the contact.

    result  result with too large cells
    found   radius of the contact in cells
    """
    (nx, ny), (L_x, L_y) = result.grid.cells, result.grid.window
    more = int(np.ceil(ENOUGH / max(found, 0.5)))
    line = result.grid.of_strips
    wanted = f"{more * nx}" if line else f"[{more * nx},{more * ny}]"
    cells = f"--set semi_analytical.cells={wanted}"
    if isinstance(result.scene.indenter, HeightMap):
        return f"Use {cells} and a map of this spacing (heights in between are interpolated)"
    try:
        window = fit_window(result.scene)
    except SolverError:
        window = L_x / more, L_y / more
    if max(window[0] / L_x, 0.0 if line else window[1] / L_y) > 0.5:
        return f"Use {cells}"
    sides = ",".join(f"{1.005 * side:.3g}" for side in window)
    sides = f"{1.005 * window[0]:.3g}" if line else f"[{sides}]"
    return f"Use --set semi_analytical.window={sides}, or omit the window to have it chosen"


def _semi_axis(marked: Mask, load: Field, area: float) -> float:
    """Compute the smaller semi-axis of contact or stick patches in cells.

    The result is a mean over the patches, weighted by their loads. Each patch is replaced by the
    ellipse of equal area and equal ratio of second moments. Patches without interior cell count
    half. On strips the semi-axis is half the width.

    marked  cells of the patches (nx, ny)
    load    load of each cell (nx, ny)
    area    area of all patches in cells, with subcell accuracy
    """
    if not np.any(marked):
        return 0.0
    i, j = np.nonzero(marked)
    of = _patches(marked)
    count = np.bincount(of)
    weights = np.bincount(of, load[i, j])
    if marked.shape[1] == 1:
        return float(np.average(count * area / np.sum(count) / 2, weights=weights))
    x, y = (at - (np.bincount(of, at) / count)[of] for at in (i, j))
    # 1/12 is the second moment of a cell.
    xx, yy = (np.bincount(of, at**2) / count + 1 / 12 for at in (x, y))
    mean, apart = (xx + yy) / 2, np.hypot((xx - yy) / 2, np.bincount(of, x * y) / count)
    flattening = np.sqrt((mean - apart) / (mean + apart))
    axes = np.sqrt(count * area / np.sum(count) / pi * flattening)
    free = np.pad(~marked, 1, constant_values=True)
    rim = free[:-2, 1:-1] | free[2:, 1:-1] | free[1:-1, :-2] | free[1:-1, 2:]
    inner = np.bincount(of, ~rim[i, j]) > 0
    axes = np.where(inner, axes, axes / 2)
    return float(np.average(axes, weights=weights))


def _patches(marked: Mask) -> Indices:
    """Return the number of the patch of each marked cell, in the order of `np.nonzero`.

    Cells that share a side or a corner belong to one patch. Of two adjacent cells with different
    numbers, the cell whose index is the lower number takes the higher number, and with it all cells
    of the lower number.

    marked  cells of the patches (nx, ny)
    """
    framed = np.pad(marked, 1)
    across, cells, number = framed.shape[1], np.flatnonzero(framed), np.arange(framed.size)
    pairs = np.concatenate(
        [
            np.stack([cells, cells + step])[:, framed.flat[cells + step]]
            for step in (1, across - 1, across, across + 1)
        ],
        axis=1,
    )
    while pairs.size:
        first, second = number[pairs]
        np.maximum.at(number, np.minimum(first, second), np.maximum(first, second))
        while np.any(number != number[number]):
            number = number[number]
        pairs = pairs[:, number[pairs[0]] != number[pairs[1]]]
    return np.unique(number[cells], return_inverse=True)[1]


def _layer_cells(result: Result) -> float | None:
    """Compute the thickness of the thinnest layer of both bodies over the cell side;
    None without layers."""
    thinnest = min(result.scene.body.thinnest, result.scene.indenter.thinnest)
    return thinnest / result.grid.cell_side if np.isfinite(thinnest) else None


def _wavelength_cells(result: Result, touched: Mask) -> float | None:
    """Compute the mean wavelength 2π √(m₂/m₄) of a height map near the contact, in cells.

    The formula is that of Longuet-Higgins (1957). m₂ and m₄ are mean squares of slope and curvature
    in the bounding rectangle of the contact. The result is the wavelength for a sine.

    touched  cells in contact (nx, ny)
    """
    indenter = result.scene.indenter
    if not isinstance(indenter, HeightMap) or not np.any(touched):
        return None
    from scipy import ndimage  # the import takes as long as a contact

    gap = indenter.initial_gap(*result.grid.coordinates())
    about = ndimage.find_objects(touched.astype(int))[0]
    # Gradients of gradients would vanish for a wavelength of two cells.
    bends = [ndimage.correlate1d(gap, [1.0, -2.0, 1.0], axis)[about] for axis in (0, 1)]
    slopes = [np.gradient(gap, axis=axis) for axis in (0, 1)]
    twist = np.gradient(slopes[0], axis=1)[about]
    m_2 = np.mean(np.square([slope[about] for slope in slopes]))
    m_4 = np.mean(np.square([*bends, twist, twist]))
    return 2 * pi * float(np.sqrt(m_2 / m_4 / 2)) if m_4 > 0 else None


def unresolved_pressure(result: Result) -> float:
    """Estimate the pressure that flattens the roughness between the centres of the cells.

    The estimate is relative to the peak pressure. The roughness is the height map minus its
    interpolation from the cell centres, within the largest contact. The root mean square pressure
    is E* √(mean square slope) / 2 (Persson 2001) with the contact modulus E*: a wave of amplitude h
    and wavenumber k requires E* k h / 2 (Johnson 1985, eq. 13.7). Returns 0 if the cells are no
    wider than the spacing of the height map.
    """
    indenter, grid = result.scene.indenter, result.grid
    if not isinstance(indenter, HeightMap):
        return 0.0
    if all(np.less_equal(grid.spacing, np.multiply(indenter.spacing, 1 + 1e-9))):
        return 0.0
    end = max(result.steps, key=lambda step: step.contact_area)
    cells = grid.coordinates()
    x, y = (
        _map_coordinates(count, spacing, at[end.in_contact])
        for count, spacing, at in zip(indenter.file.shape, indenter.spacing, cells, strict=True)
    )
    if min(len(x), len(y)) < 2:
        return 0.0
    seen = interpolate(indenter.initial_gap(*cells), grid.spacing, x[:, None], y)
    lost = indenter.initial_gap(x[:, None], y) - seen
    # Differences of adjacent points: central differences miss the shortest waves.
    slopes = (np.diff(lost, axis=axis) / indenter.spacing[axis] for axis in (0, 1))
    steepness = float(np.sqrt(sum(np.mean(np.square(slope)) for slope in slopes)))
    return contact_modulus(result.scene) * steepness / 2 / end.peak_pressure


def _map_coordinates(count: int, spacing: float, within: Field) -> Field:
    """Return coordinates [length] of map points on an axis within the contact."""
    points = (np.arange(count) - (count - 1) / 2) * spacing
    return np.asarray(points[(points >= np.min(within)) & (points <= np.max(within))])
