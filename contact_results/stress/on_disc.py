"""Stress below the radial solver's pressure and shear, in a plane through the axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from contact_results.stress.body_regions import BodyRegions
from contact_results.stress.circle_body import CircleBody
from contact_results.stress.disc_body import DiscBody
from contact_results.stress.extremes import extremes
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.points import StressField, StressPoints
from contact_results.surface import Rings
from contact_scene.geometry import ShapedBody
from contact_scene.one_thread import one_thread
from contact_scene.solver_errors import UnsupportedScene

SHOWN = 3.0  # contact radii to the sides and in depth
NAMES = ("x", "y", "depth", "material", "displacement", "stress", "at_edge")


@one_thread()
def stress_on_disc(
    state: LoadedBodies, *, indenter: bool = False, depths: Sequence[float] | None = None
) -> StressField:
    """Stress on levels, and at the places where it is largest.

    depths  both sides of every interface come on top, and nothing else [length]; None for what fits
            contact and layers
    Raises ValueError for a depth that is not in the body, UnsupportedScene where there is shear
    below infinite pressure, or a tangential load that turns or is beside torsion.
    """
    if is_sheared(state):
        return _below_shear(state, indenter, depths)
    body = DiscBody.of(state, indenter)
    grid = body.points(tuple(body.parts.levels(depths)), body.radii)
    section, points = _both_sides(grid), grid.chosen(np.ones(grid.x.shape, dtype=bool))
    field = _field(section, points, body.parts, "x at y = 0", {})
    if depths is not None:
        return field
    found = extremes(field, state.indenter if indenter else state.body)
    nearer = [body.largest(extreme) for extreme in found if extreme.region in body.parts.named]
    return replace(field, points=_joined([points, *nearer]))


def _below_shear(
    state: LoadedBodies, indenter: bool, depths: Sequence[float] | None
) -> StressField:
    """The same in the plane of the load; the largest also beside it."""
    assert state.pressed is not None
    refuse_infinite(*state.pressed[:2])
    if isinstance(state.surface, Rings) and state.surface.whole:
        refuse_turned()
    body = CircleBody.of(state, indenter)
    levels, x = tuple(body.parts.levels(depths)), body.section
    grid = body.points(levels, x, np.zeros_like(x))
    section = _both_sides(grid) if body.is_round else _with_cells(grid)
    points, beside = section.chosen(np.ones(section.x.shape, dtype=bool)), body.beside(levels)
    if beside is not None:
        points = _joined([points, beside.chosen(np.ones(beside.x.shape, dtype=bool))])
    label = "x at y = 0" if body.is_round else "x along the load"
    how: dict[str, object] = {"edge_from": body.below.circle.centre - body.parts.radius,
           "edge_to": body.below.circle.centre + body.parts.radius}  # fmt: skip
    field = _field(section, points, body.parts, label, how, body.direction)
    if depths is not None:
        return field
    found = extremes(field, state.indenter if indenter else state.body)
    nearer = [body.largest(extreme) for extreme in found if extreme.region in body.parts.named]
    return replace(field, points=_joined([points, *nearer]))


def _field(
    section: StressPoints, points: StressPoints, parts: BodyRegions, label: str,
    how: dict[str, object], direction: tuple[float, float] = (1.0, 0.0),
) -> StressField:  # fmt: skip
    return StressField(
        points,
        None,
        section,
        section.chosen(section.x == 0),
        None,
        label,
        (SHOWN * parts.radius, min(SHOWN * parts.radius, float(np.max(section.depth)))),
        {"contact_radius": parts.radius, "first_depth": parts.first, **how},
        direction,
    )


def is_sheared(state: LoadedBodies) -> bool:
    """Whether there is shear beside the pressure."""
    return any(np.any(t) for name, t in state.tractions.items() if name != "pressure")


def refuse_infinite(indenter: ShapedBody, radius: float) -> None:
    """Raises UnsupportedScene for shear where the pressure is infinite.

    radius  about that of the contact [length]: a ball has no gap of its own beyond its equator
    """
    from radial.profile import profile

    if indenter.rim is not None or profile(indenter, radius).apex:
        where = "a tip" if indenter.rim is None else "a rim"
        raise UnsupportedScene(
            f"there is shear, and the pressure is infinite at {where}: this solver has the stress "
            "below shear where tractions are finite; solve the scene with another solver"
        )


def refuse_turned() -> None:
    """Raises UnsupportedScene: shear that is not its own mirror image."""
    raise UnsupportedScene(
        "the tangential load turns, or there is torsion beside it: this solver has the stress "
        "below loads along one line, or torsion alone; solve the scene with the semi-analytical "
        "solver"
    )


def _joined(parts: Sequence[StressPoints]) -> StressPoints:
    """Places, materials, fields and edges one after the other, along the last index, without
    cells."""

    def together(name: str) -> Any:
        return np.concatenate([getattr(part, name) for part in parts], axis=-1)

    return StressPoints(**{name: together(name) for name in NAMES})


def _both_sides(right: StressPoints) -> StressPoints:
    """From behind the axis, where r and x, θ and y point away from each other, to ahead of it."""
    behind = replace(
        right,
        x=-right.x,
        displacement=right.displacement * np.array([-1.0, -1, 1])[:, None, None],
        stress=right.stress * np.array([1.0, 1, 1, -1, -1, 1])[:, None, None],
    )
    return _with_cells(_joined([_columns(behind, slice(None, 0, -1)), right]))


def _with_cells(whole: StressPoints) -> StressPoints:
    """With quadrilaterals between the levels of one material."""
    index = np.arange(whole.x.size).reshape(whole.x.shape)
    above = np.flatnonzero(whole.material[:-1, 0] == whole.material[1:, 0])
    top, bottom = index[above], index[above + 1]
    corners = [top[:, :-1], top[:, 1:], bottom[:, 1:], bottom[:, :-1]]
    return replace(whole, cells=("quad", np.stack(corners, axis=-1).reshape(-1, 4)))


def _columns(points: StressPoints, which: slice) -> StressPoints:
    """Those of some radii, (levels, n)."""
    return replace(points, **{name: getattr(points, name)[..., which] for name in NAMES})
