"""Cells and window for a scene that leaves them open."""

from dataclasses import replace
from functools import partial
from itertools import product
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from contact_scene import FrictionMap, HeightMap, Scene, SurfaceDiscretisation
from contact_scene.body_pair import contact_modulus
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
from semi_analytical.increments.normal_solve import (
    NormalTarget,
    press,
)
from semi_analytical.model import ContactModel
from semi_analytical.plan import plan

Pair = tuple[float, float]

# Peak pressure to about 1e-4 and fields to a few 1e-3 for a smooth contact.
DEFAULT_CELLS = (128, 128)
# In all, of maps with few points along one side.
MAX_DEFAULT_CELLS = 512**2
# Window in contact diameters; ten per cent let the bodies part within it.
MARGIN = 1.1
ROUND_OFF = 1e-9  # of the number of values of a map in a window
SCOUT_CELLS = 64
SCOUT_TOLERANCE = 1e-3
MAX_ENLARGEMENTS = 40
# Coupling changes the radius of a contact by less than this part of the load does (3.5 %).
SURELY = 0.9
GROWTH = 1.6


def discretise(scene: Scene, asked: SurfaceDiscretisation) -> SurfaceGrid:
    """The grid that was asked for, with what was left open chosen.

    A window that is not given is fitted to the largest contact of the history, scouted on a
    coarse grid under the largest normal load, as far as maps of heights and friction reach. Cells
    that are not given divide the spacing of a map (of heights, if there are two) by the same whole
    number along x and y, and are no wider than the spacing of the other.
    """
    scene = normal_form(scene)
    return _grid(scene, asked, asked.window or _within_maps(scene, fitted_window(scene)))


def enlarged(scene: Scene, asked: SurfaceDiscretisation, grid: SurfaceGrid) -> SurfaceGrid:
    """A grid of a larger window; the same where that is all that the maps of the scene cover."""
    L_x, L_y = grid.window
    return _grid(scene, asked, _within_maps(scene, (GROWTH * L_x, GROWTH * L_y)))


def _grid(scene: Scene, asked: SurfaceDiscretisation, window: Pair) -> SurfaceGrid:
    if asked.cells is not None:
        return SurfaceGrid(asked.cells, window)
    cells = np.array(DEFAULT_CELLS)
    if points := [
        np.ceil(np.divide(window, map_.spacing) * (1 - ROUND_OFF)).astype(int)
        for map_ in _maps(scene)
    ]:
        most = sqrt(MAX_DEFAULT_CELLS / np.prod(points[0], dtype=float))
        usual = min(-(-cells[0] // int(np.min(points[0]))), int(most))
        cells = points[0] * max(
            1, usual, *(int(np.max(-(-other // points[0]))) for other in points)
        )
    return SurfaceGrid((int(cells[0]), int(cells[1])), window)


def _maps(scene: Scene) -> list[HeightMap | FrictionMap]:
    friction = scene.friction.varying if scene.friction else None
    maps = (scene.indenter, friction)
    return [map_ for map_ in maps if isinstance(map_, HeightMap | FrictionMap)]


def _within_maps(scene: Scene, window: Pair) -> Pair:
    known = (scene.indenter.extent, scene.friction.extent if scene.friction else None)
    L_x, L_y = np.min([window, *filter(None, known)], axis=0)
    return float(L_x), float(L_y)


def fitted_window(scene: Scene) -> Pair:
    """Sides of a window that just holds the largest contact of the history [length].

    raises  ContactAtWindowEdge where none does; UnsupportedScene for a shape that says nothing of
            how far its contact will reach
    """
    if scene.indenter.extent is not None:
        return scene.indenter.extent
    decided = plan(scene)
    loads = _largest_loads(scene, decided.tilt)
    semi_axes = _guessed_semi_axes(scene, loads[0])
    window = (2 * MARGIN * semi_axes[0], 2 * MARGIN * semi_axes[1])
    for _ in range(MAX_ENLARGEMENTS):
        grid = SurfaceGrid((SCOUT_CELLS, SCOUT_CELLS), window)
        model = ContactModel.of(scene, grid, decided.symmetry)
        try:
            marked = np.any([_contact(model, load) for load in loads], axis=0)
        except ContactAtWindowEdge:
            window = (GROWTH * window[0], GROWTH * window[1])
            continue
        if not np.any(marked):
            window = (window[0] / GROWTH, window[1] / GROWTH)
            continue
        extents = _extents(marked, grid)
        fitted = (MARGIN * extents[0], MARGIN * extents[1])
        if min(fitted[0] / window[0], fitted[1] / window[1]) > 0.5:
            return fitted
        window = fitted
    raise ContactAtWindowEdge(
        "no window was found that holds the contact: either it goes on to the end of the shape (a "
        "sphere pressed to its equator) or it is far larger than expected; give a window in "
        "[semi_analytical]"
    )


def refuse_small_window(scene: Scene, grid: SurfaceGrid) -> None:
    """Raise ContactAtWindowEdge if the contact under the largest load of the history will reach the
    border of a window: that without friction does so under `SURELY` of the load."""
    decided = plan(scene)
    model = ContactModel.of(scene, grid, decided.symmetry)
    for load in _largest_loads(scene, decided.tilt):
        force, approach = (None if x is None else SURELY * x for x in (load.force, load.approach))
        try:
            press(model, replace(load, force=force, approach=approach), SCOUT_TOLERANCE)
        except ContactAtWindowEdge as error:
            raise ContactAtWindowEdge(f"under the largest load of the history {error}") from None
        except SolverError:  # of too few cells; the history meets it, or does not
            return


def _contact(model: ContactModel, load: NormalTarget) -> NDArray[np.bool_]:
    """Cells in contact, none where it is too small for the grid."""
    try:
        return model.domain.extend(press(model, load, SCOUT_TOLERANCE).pressure > 0)
    except ContactNotResolved:
        return np.zeros(model.window.cells, dtype=bool)


def _extents(contact: NDArray[np.bool_], grid: SurfaceGrid) -> tuple[float, float]:
    """Sides of the smallest window about the origin that holds the contact cells [length]."""
    x, y = grid.coordinates()
    return (
        2 * float(np.max(np.abs(x[contact]))) + grid.spacing[0],
        2 * float(np.max(np.abs(y[contact]))) + grid.spacing[1],
    )


def _largest_loads(scene: Scene, tilts: bool) -> list[NormalTarget]:
    """Loads among which is the one whose contact reaches farthest from the origin: the largest
    force and the largest approach of the history, and those that tilt or lean most."""
    pressing = (ramp for ramp in scene.load_path() if ramp.normal.end)
    ends = [normal_target(ramp, None, 1.0, tilts) for ramp in pressing]
    measures = (_size, *((partial(_lean, 0), partial(_lean, 1)) if tilts else ()))
    kinds = [[end for end in ends if _control(end) == kind] for kind in _CONTROLS]
    farthest = [max(kind, key=measure) for kind in kinds if kind for measure in measures]
    return list(dict.fromkeys(farthest))


_CONTROLS = list(product((True, False), repeat=2))


def _control(load: NormalTarget) -> tuple[bool, bool]:
    """Whether the force is given, and whether the moment is."""
    return load.force is not None, load.tilting is not None and load.tilting.moment is not None


def _size(load: NormalTarget) -> float:
    """Force or approach."""
    return load.force or load.approach or 0.0


def _lean(axis: int, load: NormalTarget) -> float:
    """How far a load leans along y (axis 0) or x (axis 1): by its tilt, or by its moment, over the
    force where that is given too."""
    assert load.tilting is not None
    if load.tilting.tilt is not None:
        return abs(load.tilting.tilt[axis])
    assert load.tilting.moment is not None
    return abs(load.tilting.moment[axis]) / (load.force or 1.0)


def _guessed_semi_axes(scene: Scene, load: NormalTarget) -> tuple[float, float]:
    """Reach of the contact along x and y, good to an order of magnitude.

    raises  UnsupportedScene for a shape that says nothing of it
    """
    indenter, exponent = scene.indenter, scene.indenter.gap_exponent
    if indenter.rim is not None:
        return indenter.rim, indenter.rim
    if load.approach is not None:
        powers = indenter.contact_at(load.approach)
    else:
        assert load.force is not None
        powers = indenter.contact_under(load.force, contact_modulus(scene))
    if powers is None or exponent is None:
        raise UnsupportedScene(
            f"how far the contact will reach is not known beforehand of this indenter "
            f"({shape_text(indenter)}); give a window in [semi_analytical]"
        )
    degree = exponent if load.approach is not None else exponent + 1
    return _root(powers[0], degree), _root(powers[1], degree)


def _root(power: float, exponent: float) -> float:
    if exponent == 3:
        return float(np.cbrt(power))
    return sqrt(power) if exponent == 2 else power ** (1 / exponent)
