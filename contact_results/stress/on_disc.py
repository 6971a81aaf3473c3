"""Stress below pressure that is known at every radius, in a plane through the axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from contact_results.stress.disc_body import DiscBody
from contact_results.stress.extremes import extremes
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.points import StressField, StressPoints
from contact_scene.solver_errors import UnsupportedScene

SHOWN = 3.0  # contact radii to the sides and in depth
NAMES = ("x", "y", "depth", "material", "displacement", "stress", "at_edge")


def stress_on_disc(
    state: LoadedBodies, *, indenter: bool = False, depths: Sequence[float] | None = None
) -> StressField:
    """Stress on levels, and at the places where it is largest.

    depths  both sides of every interface come on top, and nothing else [length]; None for what fits
            contact and layers
    Raises ValueError for a depth that is not in the body, UnsupportedScene where there is shear.
    """
    refuse_shear(len(state.tractions) > 1)
    body = DiscBody.of(state, indenter)
    grid = body.points(tuple(body.levels(depths)), body.radii)
    section, points = _both_sides(grid), grid.chosen(np.ones(grid.x.shape, dtype=bool))
    field = StressField(
        points,
        None,
        section,
        section.chosen(section.x == 0),
        None,
        "x at y = 0",
        (SHOWN * body.radius, min(SHOWN * body.radius, float(np.max(grid.depth)))),
        {"contact_radius": body.radius, "first_depth": body.first},
    )
    if depths is not None:
        return field
    found = extremes(field, state.indenter if indenter else state.body)
    nearer = [body.largest(extreme) for extreme in found if extreme.region in body.regions]
    return replace(field, points=_joined([points, *nearer]))


def refuse_shear(sheared: bool) -> None:
    """Raises UnsupportedScene where there is shear beside the pressure."""
    if sheared:
        raise UnsupportedScene(
            "the radial solver has the stress below pressure alone, and there is shear; solve the "
            "scene with another solver"
        )


def _joined(parts: Sequence[StressPoints]) -> StressPoints:
    """Places, materials, fields and edges one after the other, along the last index, without
    cells."""

    def together(name: str) -> Any:
        return np.concatenate([getattr(part, name) for part in parts], axis=-1)

    return StressPoints(**{name: together(name) for name in NAMES})


def _both_sides(right: StressPoints) -> StressPoints:
    """From behind the axis, where r and x point away from each other, to ahead of it, with
    quadrilaterals between the levels of one material."""
    behind = replace(
        right,
        x=-right.x,
        displacement=right.displacement * np.array([-1.0, 1, 1])[:, None, None],
        stress=right.stress * np.array([1.0, 1, 1, 1, -1, 1])[:, None, None],
    )
    parts = [_columns(behind, slice(None, 0, -1)), right]
    whole = _joined(parts)
    index = np.arange(whole.x.size).reshape(whole.x.shape)
    above = np.flatnonzero(whole.material[:-1, 0] == whole.material[1:, 0])
    top, bottom = index[above], index[above + 1]
    corners = [top[:, :-1], top[:, 1:], bottom[:, 1:], bottom[:, :-1]]
    return replace(whole, cells=("quad", np.stack(corners, axis=-1).reshape(-1, 4)))


def _columns(points: StressPoints, which: slice) -> StressPoints:
    """Those of some radii, (levels, n)."""
    return replace(points, **{name: getattr(points, name)[..., which] for name in NAMES})
