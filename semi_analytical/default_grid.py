"""Default number of cells and default window of a scene."""

from dataclasses import replace
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from contact_scene import FrictionMap, HeightMap, Scene, SurfaceDiscretisation
from contact_scene.body_pair import contact_modulus
from contact_scene.checks.line_contact import wrong_dimension
from contact_scene.normal_form import normal_form
from contact_scene.reading.scene_text import shape_text
from contact_scene.solver_errors import (
    ContactAtWindowEdge,
    ContactNotResolved,
    SolverError,
    UnsupportedScene,
)
from semi_analytical.grid import SurfaceGrid
from semi_analytical.increments.increment import normal_target
from semi_analytical.increments.normal_solve import press
from semi_analytical.increments.normal_target import NormalTarget
from semi_analytical.model import ContactModel
from semi_analytical.plan import plan

Pair = tuple[float, float]

# Length of strips along y: forces on them are forces per unit length.
STRIP_LENGTH = 1.0

# Errors of a smooth contact: about 1e-4 for the peak pressure, a few 1e-3 for fields.
DEFAULT_CELLS = (128, 128)
# Strips of a line contact: errors of 1e-5 of the peak pressure and 2e-4 of the half-width.
DEFAULT_STRIPS = 1024
# Limit of the total number for maps with few points along one side.
MAX_DEFAULT_CELLS = 512**2
# Window in contact diameters; with 10 % the edge of the contact lies within it.
MARGIN = 1.1
ROUND_OFF = 1e-9  # of the number of values of a map in a window
# Uniform tractions on strips, with their centres as collocation points, solve the problem of a
# punch that ends this part of a strip inside the border of the outermost one: measured, the error
# of pressure and tilt is then of second order, and otherwise of first order.
EDGE_INSET = 0.175
SCOUT_CELLS = 64
SCOUT_TOLERANCE = 1e-3
MAX_ENLARGEMENTS = 40
# Fraction of the load whose uncoupled contact lies within the coupled one of the full load: it
# changes the radius by 3.5 %, more than coupling does.
SURELY = 0.9
GROWTH = 1.6


def discretise(scene: Scene, asked: SurfaceDiscretisation) -> SurfaceGrid:
    """Choose the number of cells and the window of a scene that the settings do not prescribe.

    The window is fitted to the largest contact of the load history, found on a coarse grid under
    the largest normal load. It lies within the extent of height and friction maps. The spacing of a
    map (of heights, if there are two) is an integer multiple of the cell side, with one multiple
    along x and y. Cells are not wider than the spacing of the other map.

    scene  scene to solve
    asked  settings of the scene file, with prescribed cells and window if any
    """
    scene = normal_form(scene)
    for problem in wrong_dimension(scene.indenter, asked):
        raise UnsupportedScene(str(problem))
    window = asked.window or _within_maps(scene, fit_window(scene))
    if isinstance(window, float):
        window = window, STRIP_LENGTH
    return _grid_on_window(scene, asked, window)


def enlarge_window(scene: Scene, asked: SurfaceDiscretisation, grid: SurfaceGrid) -> SurfaceGrid:
    """Return a grid with a window GROWTH times wider, for a contact that reaches the window border.

    The window stays within the extent of the height and friction maps of the scene.

    scene  scene to solve
    asked  settings of the scene file, with prescribed cells and window if any
    grid   grid whose window is too small
    """
    return _grid_on_window(scene, asked, _within_maps(scene, _scaled(grid.window, GROWTH, scene)))


def _scaled(window: Pair, factor: float, scene: Scene) -> Pair:
    """Multiply the sides of a window; the length of strips along y does not change."""
    return factor * window[0], window[1] if scene.indenter.is_line else factor * window[1]


def _grid_on_window(scene: Scene, asked: SurfaceDiscretisation, window: Pair) -> SurfaceGrid:
    """Choose the number of cells on a window that the settings do not prescribe.

    The default is 128 cells per side. With maps, the numbers of cells are multiples of the numbers
    of points of the height map in the window, or of the friction map without a height map.

    scene   scene to solve
    asked   settings of the scene file, with prescribed cells if any
    window  sides of the window [length]
    """
    if scene.indenter.is_line:
        strips = DEFAULT_STRIPS if asked.cells is None else asked.cells
        assert isinstance(strips, int)
        return align_to_edges(scene, SurfaceGrid((strips, 1), window))
    if asked.cells is not None:
        assert not isinstance(asked.cells, int)
        return SurfaceGrid(asked.cells, window)
    cells = np.array(DEFAULT_CELLS)
    if points := [
        np.ceil(np.divide(window, map_.spacing) * (1 - ROUND_OFF)).astype(int)
        for map_ in _scene_maps(scene)
    ]:
        most = sqrt(MAX_DEFAULT_CELLS / np.prod(points[0], dtype=float))
        usual = min(-(-cells[0] // int(np.min(points[0]))), int(most))
        cells = points[0] * max(
            1, usual, *(int(np.max(-(-other // points[0]))) for other in points)
        )
    return SurfaceGrid((int(cells[0]), int(cells[1])), window)


def align_to_edges(scene: Scene, grid: SurfaceGrid) -> SurfaceGrid:
    """Change the window of strips so that sharp edges of the indenter have their best position.

    Other indenters and grids are returned unchanged.

    scene  scene with the indenter
    grid   grid with the numbers of cells and about the window
    """
    rim = scene.indenter.rim
    if rim is None or not grid.of_strips:
        return grid
    inside = max(1, round(rim / grid.spacing[0] + EDGE_INSET))
    width = rim / (inside - EDGE_INSET)
    return SurfaceGrid(grid.cells, (grid.cells[0] * width, grid.window[1]))


def _scene_maps(scene: Scene) -> list[HeightMap | FrictionMap]:
    friction = scene.friction.coefficient_map if scene.friction else None
    maps = (scene.indenter, friction)
    return [map_ for map_ in maps if isinstance(map_, HeightMap | FrictionMap)]


def _within_maps(scene: Scene, window: Pair) -> Pair:
    """Reduce the sides of a window [length] to the extent of height map,
    line profile and friction map."""
    known = [scene.indenter.extent, scene.friction.extent if scene.friction else None]
    if scene.indenter.is_line:
        known.append((2 * scene.indenter.known_radius, np.inf))
    L_x, L_y = np.min([window, *filter(None, known)], axis=0)
    return float(L_x), float(L_y)


def fit_window(scene: Scene) -> Pair:
    """Determine the sides of a window that fits the largest contact of the load history [length].

    The contact is found without friction on a coarse grid. The window is larger than the contact by
    the factor MARGIN. For a height map it is the extent of the map.

    raises  ContactAtWindowEdge if no window contains the contact; UnsupportedScene for a shape
            without a law for the contact size
    """
    if scene.indenter.extent is not None:
        return scene.indenter.extent
    decided = plan(scene)
    loads = _largest_loads(scene, decided.tilt)
    semi_axes = _guessed_semi_axes(scene, loads[0])
    line = scene.indenter.is_line
    window = (2 * MARGIN * semi_axes[0], STRIP_LENGTH if line else 2 * MARGIN * semi_axes[1])
    for _ in range(MAX_ENLARGEMENTS):
        grid = SurfaceGrid((SCOUT_CELLS, 1 if line else SCOUT_CELLS), window)
        model = ContactModel.from_scene(scene, grid, decided.symmetry)
        try:
            marked = np.any([_contact_cells(model, load) for load in loads], axis=0)
        except ContactAtWindowEdge:
            window = _scaled(window, GROWTH, scene)
            continue
        if not np.any(marked):
            window = (window[0] / GROWTH, window[1] if line else window[1] / GROWTH)
            continue
        extents = _contact_extents(marked, grid)
        fitted = _scaled(extents, MARGIN, scene)
        if min(fitted[0] / window[0], fitted[1] / window[1]) > 0.5:
            return fitted
        window = fitted
    raise ContactAtWindowEdge(
        "no window was found that contains the contact: it extends to the end of the shape (a "
        "sphere pressed to its equator) or is far larger than expected. Set window in "
        "[semi_analytical]"
    )


def refuse_small_window(scene: Scene, grid: SurfaceGrid) -> None:
    """Raise ContactAtWindowEdge if the contact under a load of the history reaches the border.

    Used before a long solution. The loads are those of `_largest_loads`. The frictionless contact
    under `SURELY` of a load is tested, because it is smaller than the contact with friction under
    the full load.
    """
    decided = plan(scene)
    model = ContactModel.from_scene(scene, grid, decided.symmetry)
    for load in _largest_loads(scene, decided.tilt):
        force, approach = (None if x is None else SURELY * x for x in (load.force, load.approach))
        try:
            press(model, replace(load, force=force, approach=approach), SCOUT_TOLERANCE)
        except ContactAtWindowEdge as error:
            if load.approach is None:
                unit = "N/m" if scene.indenter.is_line else "N"
                prescribed = f"normal_force {load.force:.4g} {unit}"
            else:
                prescribed = f"approach {load.approach:.4g} m"
            raise ContactAtWindowEdge(f"under {prescribed}, {error}") from None
        except SolverError:  # on too few cells; left to the solution of the history
            return


def _contact_cells(model: ContactModel, load: NormalTarget) -> NDArray[np.bool_]:
    """Find the cells in frictionless contact on the full window (nx, ny);
    none if the grid is too coarse."""
    try:
        return model.domain.extend(press(model, load, SCOUT_TOLERANCE).pressure > 0)
    except ContactNotResolved:
        return np.zeros(model.window.cells, dtype=bool)


def _contact_extents(contact: NDArray[np.bool_], grid: SurfaceGrid) -> tuple[float, float]:
    """Compute the sides of the smallest window about the origin that contains the cells
    [length]."""
    x, y = grid.coordinates()
    return (
        2 * float(np.max(np.abs(x[contact]))) + grid.spacing[0],
        2 * float(np.max(np.abs(y[contact]))) + grid.spacing[1],
    )


def _largest_loads(scene: Scene, tilts: bool) -> list[NormalTarget]:
    """Select the normal loads of a history whose contact may extend farthest from the origin.

    These are the largest force and the largest approach; all loads if the indenter tilts. The
    window is fitted to these contacts.

    tilts  True if the indenter tilts
    """
    pressing = (ramp for ramp in scene.load_path() if ramp.normal.end)
    ends = dict.fromkeys(normal_target(ramp, None, 1.0, tilts) for ramp in pressing)
    if tilts:
        return list(ends)
    kinds = [load for load in ends if load.force], [load for load in ends if load.approach]
    return [
        max(kind, key=lambda load: load.force or load.approach or 0.0) for kind in kinds if kind
    ]


def _guessed_semi_axes(scene: Scene, load: NormalTarget) -> tuple[float, float]:
    """Estimate the semi-axes of the contact along x and y to an order of magnitude [length].

    The fit of the window starts with this estimate.

    scene   scene with the shape of the indenter
    load    prescribed normal load
    raises  UnsupportedScene for a shape without a law for the contact size
    """
    indenter = scene.indenter
    if indenter.rim is not None:
        return indenter.rim, indenter.rim
    if load.approach is not None:
        powers, degree = indenter.contact_at(load.approach), indenter.gap_exponent
    else:
        assert load.force is not None
        powers = indenter.contact_under(load.force, contact_modulus(scene))
        degree = indenter.load_exponent
    if powers is None or degree is None:
        raise UnsupportedScene(
            f"the contact size of this indenter ({shape_text(indenter)}) cannot be estimated. Set "
            f"window in [semi_analytical]"
        )
    return _nth_root(powers[0], degree), _nth_root(powers[1], degree)


def _nth_root(power: float, exponent: float) -> float:
    if exponent == 3:
        return float(np.cbrt(power))
    return sqrt(power) if exponent == 2 else power ** (1 / exponent)
