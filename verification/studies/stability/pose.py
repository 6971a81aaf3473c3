"""Scene of a contact of the stability map: bodies, indenter, friction, loads and discretisation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene import (
    RIGID,
    Body,
    Cone,
    CoulombFriction,
    FlatPunch,
    FrictionMap,
    HeightMap,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from semi_analytical.grid import SurfaceGrid
from verification.closed_forms.coated_indentation import (
    LayeredIndentation,
    LayeredSurface,
    flat_punch,
    paraboloid,
)
from verification.problems.paper_scene import surface_of
from verification.studies.stability.cell import LoadingPath, StabilityCell, Surface

PRESSING = 3  # increments; large increments are the difficult ones
LEAST = 0.01  # remaining fraction of the normal force after unloading
REVERSED_AT = 0.85  # of the normal force
NEARLY_ALL = 0.98  # T/µW where falling W ends
ONCE_ROUND = 6  # increments of a circle
SLIDES_FAR = 20.0  # multiple of µδ, which is about the shift at gross slip


@dataclass(frozen=True)
class Loads:
    """Loads of a contact of the stability map, from which its load steps are built.

    normal_force  W [force]
    approach      rigid approach under W without friction [length]
    friction      coefficient of friction µ
    push          tangential force T over µW
    """

    normal_force: float
    approach: float
    friction: float
    push: float


def load_steps_of_path(path: LoadingPath, loads: Loads) -> tuple[LoadStep, ...]:
    """Return the load steps of a contact of the stability map for one kind of loading path.

    The increments are few and large, because the map studies if such increments converge.

    path   kind of loading path
    loads  normal force, approach, coefficient of friction, and tangential force over µW
    """
    full = loads.push * loads.friction * loads.normal_force

    def to(increments: int, *, W: float | None = None, T: float | None = None) -> LoadStep:
        """Create a load step that ramps the normal or tangential force to a fraction of its full
        value.

        increments  number of increments
        W           fraction of the full normal force; None keeps the force of the preceding step
        T           fraction of the full tangential force; None keeps the force of the preceding
                    step
        """
        return LoadStep(
            normal_force=None if W is None else W * loads.normal_force,
            tangential_force=None if T is None else (T * full, 0.0),
            increments=increments,
        )

    def shift(increments: int, by: float) -> LoadStep:
        return LoadStep(tangential_shift=(by, 0.0), increments=increments)

    press, push = to(PRESSING, W=1.0), to(1, T=1.0)
    match path:
        case LoadingPath.PRESS:
            return (press,)
        case LoadingPath.PUSH:
            return press, push
        case LoadingPath.LOOP:
            return press, push, to(2, T=-1.0), to(2, T=1.0)
        case LoadingPath.CIRCLE:
            angles = np.linspace(0, 2 * np.pi, ONCE_ROUND + 1)
            turns = ((full * float(np.cos(t)), full * float(np.sin(t))) for t in angles)
            return press, *(LoadStep(tangential_force=force, increments=1) for force in turns)
        case LoadingPath.REVERSED:
            part = min(1.0, REVERSED_AT / max(loads.push, REVERSED_AT))
            return press, push, to(3, T=-0.99 * part, W=REVERSED_AT)
        case LoadingPath.RELOADED:
            return press, to(4, W=LEAST), to(3, W=1.0)
        case LoadingPath.SHEARED_RELOAD:
            return press, push, to(4, T=0.0, W=LEAST), to(3, T=1.0, W=1.0)
        case LoadingPath.FALLING:
            return press, push, to(3, W=min(1.0, loads.push / NEARLY_ALL))
        case LoadingPath.SLIDE:
            unit = max(loads.friction, LEAST) * loads.approach
            return press, shift(2, 0.5 * unit), shift(2, SLIDES_FAR * unit), shift(2, 0.0)
        case LoadingPath.APPROACH:
            return (
                LoadStep(approach=loads.approach, increments=PRESSING),
                shift(1, loads.push * loads.friction * loads.approach),
                LoadStep(approach=0.5 * loads.approach, increments=2),
            )


Field = NDArray[np.float64]

RADIUS = 46.4  # of the ball, over the contact radius: the paper's
SLOPE = 0.02
MARGIN, ROUGH_MARGIN = 1.3, 1.6  # half the window over the contact radius
SPOTS = 0.55  # distance of a spot from the middle, over the contact radius
SPOTS_FORCE = 0.15  # over that of one ball, so that the spots do not touch
ROUGHNESS = 0.02  # standard deviation over the approach
GREASE = 0.5  # radius of the greased disc over the contact radius
BARE = 0.3  # fraction of µ; smaller values become 0 on a patchy surface
SURELY = 0.97
SEED = 3
TOLERANCE = 1e-8
CELLS_PER_ELEMENT = 4  # along a side of the window, per element along a contact radius
# Gaps are rounded relative to the largest in the window, residuals are relative to the approach.
GAP_ROUNDING = 10 * float(np.finfo(float).eps)

Indenter = Paraboloid | FlatPunch | Cone | HeightMap


@dataclass(frozen=True)
class Posed:
    """Scene and discretisations of a contact of the stability map, as the solvers require them.

    scene      bodies, friction and load steps
    grid       surface grid for the semi-analytical solver, whose window should contain the contact
    elements   elements per contact radius, for finite elements
    tolerance  largest allowed residual, relative
    """

    scene: Scene
    grid: SurfaceGrid
    elements: int
    tolerance: float


def pose(cell: StabilityCell) -> Posed:
    """Build the scene and the discretisation of a contact of the stability map.

    The stability map shows which contacts the solvers can solve. Raises SceneError for an invalid
    scene.

    cell  values that define the contact
    """
    a = cell.length
    both = (_coated_body(cell),) * (2 if cell.surface is Surface.ALIKE_BALL else 1)
    answer = surface_of(*both)
    ball = paraboloid(answer, RADIUS * a, a)
    half_width = a * (ROUGH_MARGIN if cell.surface is Surface.ROUGH else MARGIN)
    grid = SurfaceGrid((cell.cells, cell.cells), (2 * half_width, 2 * half_width))
    indenter = _indenter(cell, ball.approach, grid)
    W = cell.load * _estimated_force(cell, answer, ball)
    approach = cell.load ** (2 / 3) * ball.approach
    friction = _friction_coefficients(cell, grid)
    scene = Scene(
        title=f"Stability map: {cell.name}",
        indenter=indenter,
        body=_lower_body(cell),
        friction=CoulombFriction(coefficient=friction),
        loading=load_steps_of_path(
            cell.path, Loads(W, approach, _mean_friction(friction, cell, grid), cell.push)
        ),
    )
    gap = indenter.initial_gap(*grid.coordinates())
    rounding = GAP_ROUNDING * float(np.max(gap, where=np.isfinite(gap), initial=0.0)) / approach
    # The mesh of a section is adapted to the contact, so that its gaps have no such round-off.
    tolerance = TOLERANCE if cell.solver.by_elements else max(TOLERANCE, rounding)
    return Posed(scene, grid, cell.cells // CELLS_PER_ELEMENT, tolerance)


def _coating_and_substrate(cell: StabilityCell) -> tuple[IsotropicMaterial, IsotropicMaterial]:
    """Return the elastic materials of coating and substrate of a contact of the stability map."""
    E, ratio = cell.modulus, cell.modulus_ratio
    return (
        IsotropicMaterial(young_modulus=ratio * E, poisson_ratio=cell.poisson_ratio),
        IsotropicMaterial(young_modulus=E, poisson_ratio=cell.base_ratio),
    )


def _coated_body(cell: StabilityCell) -> Body:
    film, base = _coating_and_substrate(cell)
    return Body(
        material=base, layers=(Layer(thickness=cell.thickness * cell.length, material=film),)
    )


def _lower_body(cell: StabilityCell) -> Body:
    """Return the lower body of a contact of the stability map, with its coating.

    The coating is left out if its material equals that of the substrate.
    """
    film, base = _coating_and_substrate(cell)
    return Body(material=base) if film == base else _coated_body(cell)


def _indenter(cell: StabilityCell, approach: float, grid: SurfaceGrid) -> Indenter:
    a, R = cell.length, RADIUS * cell.length
    match cell.surface:
        case Surface.ALIKE_BALL:
            body = _lower_body(cell)
            return Paraboloid(radius=R, material=body.material, layers=body.layers)
        case Surface.FLAT_PUNCH:
            return FlatPunch(radius=a, material=RIGID)
        case Surface.CONE:
            return Cone(slope_angle=float(np.arctan(SLOPE)), material=RIGID)
        case Surface.TWO_SPOTS:
            return _height_map(
                np.minimum(_parabolic_gap(grid, R, -SPOTS * a), _parabolic_gap(grid, R, SPOTS * a)),
                grid,
            )
        case Surface.ROUGH:
            noise = np.random.default_rng(SEED).standard_normal(grid.cells)
            return _height_map(_parabolic_gap(grid, R) + ROUGHNESS * approach * noise, grid)
        case _:
            return Paraboloid(radius=R, material=RIGID)


def _parabolic_gap(grid: SurfaceGrid, radius: float, x0: float = 0.0) -> Field:
    x, y = grid.coordinates()
    return np.asarray(((x - x0) ** 2 + y**2) / (2 * radius))


def _height_map(heights: Field, grid: SurfaceGrid) -> HeightMap:
    return HeightMap.model_validate(
        {"shape": "height_map", "file": heights, "spacing": grid.spacing, "material": RIGID}
    )


def _estimated_force(
    cell: StabilityCell, answer: LayeredSurface, ball: LayeredIndentation
) -> float:
    """Estimate the normal force under which a contact of the stability map has its prescribed
    radius.

    cell    values that define the contact
    answer  elastic response of the surface of the layered body
    ball    frictionless contact of the ball with that contact radius
    """
    match cell.surface:
        case Surface.FLAT_PUNCH:
            return flat_punch(answer, cell.length).load * ball.approach
        case Surface.CONE:
            # On the half-space that the ball would press as deep as this body.
            return ball.load * 3 * np.pi * RADIUS * SLOPE / 8
        case Surface.TWO_SPOTS:
            return SPOTS_FORCE * ball.load
        case _:
            return ball.load


def _mean_friction(friction: float | FrictionMap, cell: StabilityCell, grid: SurfaceGrid) -> float:
    """Return the mean coefficient of friction of a contact, which determines its tangential force.

    Nonuniform coefficients are weighted by the Hertz pressure. Their mean is reduced by 3 %,
    because the actual pressure differs from the Hertz pressure.

    friction  uniform coefficient, or map of coefficients
    cell      values that define the contact
    grid      surface grid
    """
    if not isinstance(friction, FrictionMap):
        return friction
    x, y = grid.coordinates()
    p = np.sqrt(np.maximum(1 - (x**2 + y**2) / cell.length**2, 0.0))
    coefficients = friction.on_grid(grid.cells, grid.spacing).map.values
    return float(SURELY * np.sum(coefficients * p) / np.sum(p))


def _friction_coefficients(cell: StabilityCell, grid: SurfaceGrid) -> float | FrictionMap:
    """Return the coefficient of friction of a contact, or a map of coefficients on the surface
    grid.

    A patchy surface has random coefficients between 0 and 2µ; those below 0.3µ are set to zero. A
    greased surface has no friction in a disc of half the contact radius. Others have the uniform µ.
    """
    if cell.surface is Surface.PATCHY:
        values = np.random.default_rng(SEED).uniform(0, 2 * cell.friction, grid.cells)
        return _reflected_friction_map(np.where(values < BARE * cell.friction, 0.0, values), grid)
    if cell.surface is Surface.GREASED:
        outside = np.hypot(*grid.coordinates()) > GREASE * cell.length
        return _reflected_friction_map(np.where(outside, cell.friction, 0.0), grid)
    return cell.friction


def _reflected_friction_map(values: Field, grid: SurfaceGrid) -> FrictionMap:
    """Build a friction map that continues coefficients on the grid by reflection beyond the window.

    The continuation is needed if the contact requires a wider window.

    values  coefficients of friction at the cells (nx, ny)
    """
    values = np.pad(values, [(count, count) for count in grid.cells], mode="symmetric")
    return FrictionMap.model_validate({"map": values, "spacing": grid.spacing})
