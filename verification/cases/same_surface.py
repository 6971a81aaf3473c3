"""Surfaces told in another way: by maps, on cells that are not square, as one material twice."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from contact_scene import RIGID, Body, CoulombFriction, FrictionMap, HeightMap, LoadStep, Scene
from contact_scene.residuals import worst
from semi_analytical import SurfaceGrid
from verification.cases.turned import difference_after_quarter, turned
from verification.judging.case import Case, Comparison, Level
from verification.judging.run import SOLVER_TOLERANCE, Run
from verification.problems.layered_scene import coated, film, rigid_ball
from verification.problems.paper_scene import HERTZ, NORMAL_FORCE, pressing
from verification.problems.reference import ROUNDING, ReferenceKind
from verification.quantities import largest_difference, shear_of

if TYPE_CHECKING:
    from semi_analytical import Result

Field = NDArray[np.float64]

FRICTION, PART = 0.2, 0.6  # and part of µW that pushes
MARGIN = 1.2  # half the window over Hertz's radius
# An odd count of cells has one in the middle, where the lowest height of the ball is zero.
CELLS = {Level.QUICK: 33, Level.STANDARD: 65, Level.FULL: 129}
LONGER = 4 / 3  # cells along one side over those along the other
WINDOW = 2 * MARGIN * HERTZ.contact_radius
BODY = coated(film(2.0, 1.0))
HARD = BODY.layers[0].material
LOADING = (
    pressing(3),
    LoadStep(tangential_force=(PART * FRICTION * NORMAL_FORCE, 0.0), increments=2),
)
NOT_SQUARE = 1.5e-3  # on the quick grid


def same_surface(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids at higher levels."""
    return same_surface_on(CELLS[level])


def same_surface_on(cells: int) -> Case:
    """The case on grids with so many cells along their shorter side."""
    square = SurfaceGrid((cells, cells), (WINDOW, WINDOW))
    long = SurfaceGrid((cells, cells), (WINDOW, LONGER * WINDOW))
    across = SurfaceGrid((cells, cells), (LONGER * WINDOW, WINDOW))
    patchy, mirrored_patches = _map(_patchy(square), square), _map(_patchy(square)[::-1], square)
    told = Run("told by numbers", _scene("numbers"), square)
    heights = Run("ball as a map of heights", _scene("heights", heights_on=square), square)
    everywhere = Run(
        "the same friction in every cell",
        _scene("friction", friction=_map(np.full(square.cells, FRICTION), square)), square,
    )  # fmt: skip
    patches = Run("patchy friction", _scene("patches", friction=patchy), square)
    mirrored = Run(
        "patchy friction mirrored",
        _scene("mirrored patches", friction=mirrored_patches, degrees=180.0), square,
    )  # fmt: skip
    narrow = Run("cells longer along y", _scene("long cells"), long)
    wide = Run("cells longer along x", _scene("wide cells", degrees=90.0), across)
    whole = Run("homogeneous body", _scene("homogeneous body", body=Body(material=HARD)), square)
    through = Run(
        "coating on its own material",
        _scene("coating on its own material", body=Body(material=HARD, layers=BODY.layers)), square,
    )  # fmt: skip
    exact = 10 * SOLVER_TOLERANCE
    answered = "residuals of two solves, which tractions answer a few times over"
    return Case(
        name="same_surface",
        title="The same surface told in another way",
        problem=(
            "The rigid ball on a coated body, pressed with friction and pushed by 0.6 of µW: with "
            "the ball as a map of heights, with friction as a map that is the same everywhere, "
            "with patches of friction and their mirror image, and on cells that are longer than "
            "wide; and on the coating's own material under the same coating. Each says the same as "
            "another run, or the same seen in a mirror or turned."
        ),
        runs=(told, heights, everywhere, patches, mirrored, narrow, wide, whole, through),
        quantities=(),
        comparisons=(
            Comparison(
                "heights", "ball as a map of heights: difference of all fields",
                (heights.label, told.label), largest_difference, ROUNDING,
                "heights at the centres of cells are the gap there, bit for bit",
                "the same surface",
            ),
            Comparison(
                "friction", "constant map of friction: difference of all fields",
                (everywhere.label, told.label), largest_difference, exact, answered,
                "the same surface",
            ),
            Comparison(
                "mirror", "patchy friction in a mirror: difference of pressure and shear",
                (mirrored.label, patches.label), _mirrored_difference, exact, answered,
                "a mirror at x = 0 turns one into the other",
            ),
            Comparison(
                "turned_by_90", "cells that are not square, turned with the load: difference of "
                "pressure, shear and shift",
                (wide.label, narrow.label), difference_after_quarter, exact, answered,
                "isotropic bodies and friction",
            ),
            Comparison(
                "square_cells", "cells that are not square: difference of approach, shift and "
                "energy from those of square ones, relative",
                (narrow.label, told.label), _difference_of_scalars,
                NOT_SQUARE * CELLS[Level.QUICK] / cells,
                "set by hand: about three times what cells longer by a third leave on 33 x 33 of "
                "them, in proportion to the cell on others",
                "the same contact", ReferenceKind.OWN_REFINEMENT,
            ),
            Comparison(
                "one_material", "coating on its own material: difference of all fields from those "
                "of a homogeneous body",
                (through.label, whole.label), largest_difference, exact, answered,
                "the same body",
            ),
        ),
    )  # fmt: skip


def _scene(
    what: str,
    *,
    heights_on: SurfaceGrid | None = None,
    friction: float | FrictionMap = FRICTION,
    body: Body | None = None,
    degrees: float = 0.0,
) -> Scene:
    return Scene(
        title=f"Rigid ball on a coated body, pressed and pushed: {what}",
        indenter=rigid_ball() if heights_on is None else _height_map(heights_on),
        body=body or BODY,
        friction=CoulombFriction(coefficient=friction),
        loading=turned(LOADING, degrees),
    )


def _height_map(grid: SurfaceGrid) -> HeightMap:
    heights = rigid_ball().initial_gap(*grid.coordinates())
    given: Any = np.asarray(heights)
    return HeightMap(file=given, spacing=grid.spacing, material=RIGID)


def _map(coefficients: Field, grid: SurfaceGrid) -> FrictionMap:
    return FrictionMap.model_validate({"map": coefficients, "spacing": grid.spacing})


def _patchy(grid: SurfaceGrid) -> Field:
    """Friction that differs along x, along y and across the diagonal, with patches of none."""
    x, y = (c / HERTZ.contact_radius for c in grid.coordinates())
    waves = np.sin(3 * x + 0.4) + 0.6 * np.sin(5 * y - 1.1 * x)
    return np.asarray(np.maximum(FRICTION * (1.2 + 0.9 * waves), 0.0))


def _mirrored_difference(one: Result, other: Result) -> float:
    """Σ|Δp|/Σp and Σ|Δq|/Σp in any increment, once the second is mirrored at x = 0."""
    return worst(
        *(
            float(np.sum(np.abs(found - mirrored)) / np.sum(b.pressure))
            for a, b in zip(one.increments, other.increments, strict=True)
            for found, mirrored in (
                (a.pressure, b.pressure[::-1]),
                (shear_of(a), _mirrored(shear_of(b))),
            )
        )
    )


def _mirrored(vector: Field) -> Field:
    return np.stack([-vector[0][::-1], vector[1][::-1]])


def _difference_of_scalars(one: Result, other: Result) -> float:
    pairs = zip(_scalars(one), _scalars(other), strict=True)
    return worst(*(abs(a / b - 1) for a, b in pairs))


def _scalars(result: Result) -> tuple[float, float, float]:
    end = result.steps[-1]
    assert end.tangential_shift is not None
    assert end.dissipated_energy is not None
    return end.approach, float(end.tangential_shift[0]), end.dissipated_energy
