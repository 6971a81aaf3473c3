"""Contact in several patches under a moment: bumps of a height map, pressed off their middle.

The force acts at (My, Mx)/W; with as many bumps as a stool has legs, balance alone says what
each of them carries.
"""

from typing import Any

import numpy as np
import pytest
from scipy import ndimage

import slipstick
from contact_scene.geometry import HeightMap

STEEL = slipstick.IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
SPACING, CELLS = 10e-6, 64
RADIUS = 2e-3  # of a bump
FORCE = 20.0
TOLERANCE = 1e-8
LEGS = np.array([[-1.5e-4, -1.5e-4], [1.5e-4, -1.5e-4], [0.0, 1.8e-4]])


def bumps(places: np.ndarray) -> HeightMap:
    """The lowest of paraboloids at these places, which all touch first."""
    middle = SPACING * (np.arange(CELLS) - (CELLS - 1) / 2)
    x, y = np.meshgrid(middle, middle, indexing="ij")
    heights = np.min([((x - a) ** 2 + (y - b) ** 2) / (2 * RADIUS) for a, b in places], axis=0)
    return HeightMap(file=heights, spacing=SPACING, material="rigid")  # type: ignore[arg-type]


def solved(places: np.ndarray, moment: tuple[float, float], **more: Any) -> Any:
    scene = slipstick.Scene(
        indenter=bumps(places),
        body=slipstick.Body(material=STEEL),
        friction=more.pop("friction", None),
        loading=(slipstick.LoadStep(normal_force=FORCE, moment=moment), *more.pop("then", ())),
    )
    window = (CELLS * SPACING, CELLS * SPACING)
    return slipstick.solve(
        scene,
        discretisation=slipstick.SurfaceDiscretisation(
            cells=(CELLS, CELLS), window=window, tolerance=TOLERANCE, edge="off"
        ),
    )


def carried(result: Any, places: np.ndarray) -> np.ndarray:
    """Force on the patch nearest to each place [N]."""
    p, grid = result.steps[-1].pressure, result.grid
    patches, count = ndimage.label(p > 0)
    assert count == len(places)
    forces = np.array(ndimage.sum(p, patches, range(1, count + 1))) * grid.cell_area
    i, j = np.transpose(ndimage.center_of_mass(p, patches, range(1, count + 1)))
    centres = np.transpose([np.interp(i, range(CELLS), grid.x), np.interp(j, range(CELLS), grid.y)])
    nearest = np.argmin(np.linalg.norm(places[:, None] - centres, axis=-1), axis=1)
    assert sorted(nearest) == [*range(count)]
    return forces[nearest]


def balance(result: Any, moment: tuple[float, float]) -> None:
    """Force and moment of the pressure are those that were asked for."""
    p, grid = result.steps[-1].pressure, result.grid
    arm = CELLS * SPACING
    assert np.sum(p) * grid.cell_area == pytest.approx(FORCE, rel=10 * TOLERANCE)
    m_x, m_y = np.sum(p * grid.y) * grid.cell_area, np.sum(p * grid.x[:, None]) * grid.cell_area
    assert (m_x, m_y) == pytest.approx(moment, abs=10 * TOLERANCE * FORCE * arm)
    assert np.all(p >= 0)


BEYOND = 4e-5
# Where the force acts, within the legs.
ACTING = [(0.0, -0.4e-4), (0.5e-4, -0.8e-4), (-0.3e-4, 0.6e-4), (0.0, -1.2e-4)]


@pytest.mark.parametrize("at", ACTING)
def test_each_leg_of_a_stool_carries_its_share_of_the_balance(at: tuple[float, float]) -> None:
    """A tilted bump of radius R is lowest by R times the tilt off its middle, and pressed there to
    a twentieth of a cell."""
    x, y = at
    moment = (FORCE * y, FORCE * x)
    result = solved(LEGS, moment)
    balance(result, moment)
    legs = LEGS + RADIUS * np.array(result.steps[-1].tilt)[::-1]
    share = np.linalg.solve(np.vstack([legs.T, np.ones(3)]), [x, y, 1.0])
    assert np.all(share > 0)
    assert carried(result, LEGS) == pytest.approx(FORCE * share, abs=1.7e-3 * FORCE)


def test_a_leg_that_the_force_leaves_lifts_off() -> None:
    """Beyond the line between two legs the third carries nothing; the contact is two patches."""
    moment = (FORCE * (LEGS[0, 1] - BEYOND), 0.0)
    result = solved(LEGS, moment)
    balance(result, moment)
    assert carried(result, LEGS[:2]) == pytest.approx([FORCE / 2, FORCE / 2], rel=1e-6)
    assert not np.any(result.steps[-1].pressure[:, result.grid.y > 0])
