"""What families of scenes are drawn from: materials, sizes, histories and grids."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from contact_scene import (
    Body,
    FiniteElementDiscretisation,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    SurfaceDiscretisation,
)
from verification.problems.drawn.known_scene import (
    APPROACH,
    CELLS,
    ELEMENTS,
    MOMENT,
    NORMAL,
    TILT,
    Fineness,
)

Rng = np.random.Generator
Array = NDArray[np.float64]

FEWEST, MOST = 16, 128  # cells along a side
PER_RADIUS = (4.0, 60.0)  # cells over a contact radius
WIDTHS = (2.3, 3.4)  # window over the contact radius
ELEMENTS_PER_RADIUS = (8, 32)
STRAINS = (3e-3, 3e-2)  # contact radius over radius of curvature
BY_MOTION = 0.3  # of the scenes are led by motions, not by forces
ROOM = 1.5  # cells between a contact beside the centre and the edge of the window


def logarithmic(rng: Rng, low: float, high: float) -> float:
    """A number whose logarithm is spread evenly."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def material(rng: Rng, poisson_ratio: float | None = None) -> IsotropicMaterial:
    """E from 5 to 400 GPa, ν from 0 to 0.49 unless given."""
    nu = float(rng.uniform(0.0, 0.49)) if poisson_ratio is None else poisson_ratio
    return IsotropicMaterial(young_modulus=logarithmic(rng, 5e9, 4e11), poisson_ratio=nu)


def sizes(rng: Rng) -> tuple[float, float]:
    """Radius of curvature and contact radius [length]."""
    radius = logarithmic(rng, 1e-3, 0.1)
    return radius, radius * logarithmic(rng, *STRAINS)


def friction(rng: Rng) -> float:
    """µ."""
    return logarithmic(rng, 0.05, 0.8)


def coated_body(rng: Rng, contact_radius: float, most_layers: int = 1) -> Body:
    """h/a from 0.2 to 3 of every layer, E over that of the base from 1/10 to 10, of several layers
    from 1/3 to 3: neighbours differ by no more than 10."""
    base, count = material(rng), int(rng.integers(1, most_layers + 1))
    most = 10.0 ** (1 / count)
    layers = tuple(
        Layer(
            thickness=contact_radius * logarithmic(rng, 0.2, 3.0),
            material=IsotropicMaterial(
                young_modulus=base.young_modulus * logarithmic(rng, 1 / most, most),
                poisson_ratio=float(rng.uniform(0.0, 0.49)),
            ),
        )
        for _ in range(count)
    )
    return Body(material=base, layers=layers)


def ball_like(body: Body, radius: float) -> Paraboloid:
    """A paraboloid of the same materials: nothing couples."""
    return Paraboloid(radius=radius, material=body.material, layers=body.layers)


def fineness(
    rng: Rng, reach: tuple[float, float], sections: bool, finest: float = PER_RADIUS[1]
) -> Fineness:
    """A grid around a contact, odd or even along each side, or elements over a contact radius that
    is left to the solver to find.

    reach   semi-axes of the contact [length]
    finest  cells per contact radius, at most
    """
    if sections:
        count = round(logarithmic(rng, *ELEMENTS_PER_RADIUS))
        asked = FiniteElementDiscretisation(elements_per_radius=count)
        return Fineness(ELEMENTS, asked, float(count))
    width = float(rng.uniform(*WIDTHS))
    nx = round(logarithmic(rng, PER_RADIUS[0], finest) * width)
    nx = int(np.clip(nx, FEWEST, MOST - 1))
    window = (width * reach[0], width * float(rng.uniform(0.97, 1.1)) * reach[1])
    grid = SurfaceDiscretisation(cells=(nx, nx + int(rng.integers(0, 2))), window=window)
    return Fineness(CELLS, grid, nx / width)


class Pressed(Protocol):
    """A contact of revolution that was pressed."""

    @property
    def load(self) -> float: ...
    @property
    def approach(self) -> float: ...
    @property
    def contact_radius(self) -> float: ...


def pressing(
    rng: Rng, contact: Pressed, radius: float, fine: Fineness
) -> tuple[LoadStep, dict[str, float]]:
    """A paraboloid pressed on by force or by approach, on a grid beside the centre of its contact
    by tilt or by moment, and those of the four that follow.

    x²/2R - φx = (x - Rφ)²/2R - Rφ²/2: a tilted paraboloid is a shifted one.
    """
    given = (NORMAL, APPROACH)[by_motion(rng)], (TILT, MOMENT)[int(rng.integers(2))]
    values: dict[str, Any] = {NORMAL: contact.load, APPROACH: contact.approach}
    grid = fine.asked
    if isinstance(grid, SurfaceDiscretisation):
        assert grid.window is not None
        assert grid.cells is not None
        side = np.divide(grid.window, grid.cells)
        room = np.array(grid.window) / 2 - contact.contact_radius - ROOM * side
        x, y = rng.uniform(-1, 1, 2) * np.maximum(room, side / 2)
        values[APPROACH] -= (x**2 + y**2) / (2 * radius)
        values |= {TILT: (y / radius, x / radius), MOMENT: (contact.load * y, contact.load * x)}
    step = LoadStep(**{name: value for name, value in values.items() if name in given})
    return step, {n: float(np.ravel(v)[0]) for n, v in values.items() if n not in given}


def by_motion(rng: Rng) -> bool:
    """Whether motions are prescribed, not forces."""
    return bool(rng.random() < BY_MOTION)


def closes(forces: Sequence[float]) -> bool:
    """Tell whether the last of the forces or torques of `parts` closes a cycle."""
    return len(forces) > 1 and forces[-1] == forces[0]


def parts(rng: Rng) -> tuple[float, ...]:
    """Tangential forces or torques over the sliding one, at the ends of steps: a push with a stop,
    a push and a way back, or a loop with a stop."""
    most = float(rng.uniform(0.3, 0.95))
    between = most * float(rng.uniform(-0.9, 0.9))
    histories = (
        (most * float(rng.uniform(0.3, 0.8)), most),
        (most, between),
        (most, between, -most, most),
        (most, -most, most),
    )
    return histories[int(rng.integers(len(histories)))]
