"""Laws that hold of any problem, tried on drawn ones."""

from __future__ import annotations

import gc
import math
import random
import re
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from contact_results.directory.checkpoint_file import pack, unpacked
from contact_scene import (
    Body,
    CoulombFriction,
    Ellipsoid,
    HeightMap,
    IsotropicMaterial,
    LoadStep,
    Scene,
)
from semi_analytical import SurfaceGrid, plan, solve
from semi_analytical.history import marked
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.model import ContactModel
from verification.studies.promises.promise import Attempt

TOLERANCE = 1e-8
# Pressure and shear that do not act on each other are found to rounding, whatever path the
# arithmetic takes. Where they do, iterations stop at the tolerance, and rounding decides where
# within it: two answers are as far apart as it leaves open.
ROUNDING = 1e-12
MU, YOUNG, NU, LOAD, RADIUS = 0.1, 420e9, 0.3, 1e3, 0.018
CELLS, WINDOW = (24, 20), (1.4e-3, 1.6e-3)
DRIFT, GROWTH = 1e-6, 0.01
Pair = tuple[float, float]


def _scene(
    force: Pair, then: Pair, radii: Pair, nu: float, length: float = 1.0, stress: float = 1.0
) -> Scene:
    """Pressed, then pushed twice by so many friction limits."""
    limit = MU * LOAD * stress * length**2
    pushes = [(limit * f[0], limit * f[1]) for f in (force, then)]
    return _described(pushes, radii, nu, length, stress, increments=2)


def _described(
    pushes: list[Pair],
    radii: Pair,
    nu: float = NU,
    length: float = 1.0,
    stress: float = 1.0,
    increments: int = 1,
) -> Scene:
    material = IsotropicMaterial(young_modulus=YOUNG * stress, poisson_ratio=NU)
    below = IsotropicMaterial(young_modulus=YOUNG * stress, poisson_ratio=nu)
    pressed = LoadStep(normal_force=LOAD * stress * length**2, increments=1)
    return Scene(
        indenter=Ellipsoid(radii=(radii[0] * length, radii[1] * length), material=material),
        body=Body(material=below),
        friction=CoulombFriction(coefficient=MU),
        loading=(
            pressed,
            *(LoadStep(tangential_force=push, increments=increments) for push in pushes),
        ),
    )


def _drawn(chance: random.Random) -> tuple[Pair, Pair, Pair, float]:
    """Two pushes below the limit, radii, and Poisson's ratio below: half of the bodies couple."""
    pushes = [
        (size * math.cos(angle), size * math.sin(angle))
        for size, angle in [
            (chance.uniform(0.2, 0.9), chance.uniform(0, 2 * math.pi)) for _ in "ab"
        ]
    ]
    return (
        pushes[0],
        pushes[1],
        (RADIUS, RADIUS * chance.uniform(0.7, 1.4)),
        chance.choice((NU, 0.0)),
    )


def _allowed(nu: float) -> float:
    """How far apart two answers may be, by Poisson's ratio of the lower body."""
    return ROUNDING if nu == NU else TOLERANCE


def _end(
    described: Scene,
    cells: tuple[int, int] = CELLS,
    window: Pair = WINDOW,
    tolerance: float = TOLERANCE,
) -> Any:
    return solve(described, SurfaceGrid(cells, window), tolerance).steps[-1]


def symmetric(count: int) -> Iterator[Attempt]:
    """Everything mirrored, turned by a right angle or by two, in turn."""
    chance = random.Random(11)
    for number in range(count):
        one, two, radii, nu = _drawn(chance)
        kind = ("mirrored", "turned", "turned twice")[number % 3]
        plain = _end(_scene(one, two, radii, nu))
        if kind == "turned":  # (x, y) -> (-y, x): the new x runs against the old y
            turned = _scene((-one[1], one[0]), (-two[1], two[0]), radii[::-1], nu)
            other = _end(turned, CELLS[::-1], WINDOW[::-1])
            pressure = plain.pressure.T[::-1]
            shear = np.stack([-plain.shear[1].T[::-1], plain.shear[0].T[::-1]])
        else:
            signs = (1.0, -1.0) if kind == "mirrored" else (-1.0, -1.0)
            changed = [(signs[0] * f[0], signs[1] * f[1]) for f in (one, two)]
            other = _end(_scene(changed[0], changed[1], radii, nu))
            flip = (slice(None, None, int(signs[0])), slice(None, None, -1))
            pressure = plain.pressure[flip]
            shear = np.stack([signs[i] * plain.shear[i][flip] for i in range(2)])
        peak = np.max(plain.pressure)
        apart = max(
            float(np.max(np.abs(other.pressure - pressure)) / peak),
            float(np.max(np.abs(other.shear - shear)) / (MU * peak)),
        )
        allowed = _allowed(nu)
        yield Attempt(apart <= allowed, f"{kind}, ν = {nu:g}: {apart:.1e}", apart / allowed)


def moved(count: int) -> Iterator[Attempt]:
    """The whole surface by some cells along x and y: a rough one, whose heights are given there.

    A window does not move along, and iterations begin with a pressure on all of it: on coarser
    cells, into which an odd move does not even fit. They so stop elsewhere within the tolerance
    (even moves 3e-10 apart at 1e-8, odd ones 3e-8), and the promise is what that leaves open: see
    `left_open`.
    """
    chance, spacing, cells = random.Random(16), WINDOW[0] / CELLS[0], (32, 30)
    x, y = (spacing * (np.arange(n) - 0.5 * (n - 1)) for n in cells)
    window = (cells[0] * spacing, cells[1] * spacing)
    for number in range(count):
        tolerance = (1e-8, 1e-10, 1e-12)[number % 3]
        one, two, radii, nu = _drawn(chance)
        waves = [chance.uniform(1e4, 4e4) for _ in "xy"]
        rough = 1e-8 * np.sin(waves[0] * x[:, None]) * np.cos(waves[1] * y)
        heights = x[:, None] ** 2 / (2 * radii[0]) + y**2 / (2 * radii[1]) + rough
        shift = (chance.randint(-3, 3), chance.choice((-2, -1, 1, 2)))
        ends = []
        for by in ((0, 0), shift):
            moved_by = np.roll(heights, by, (0, 1))
            described = _scene(one, two, radii, nu)
            surface = HeightMap.model_validate(
                {"file": moved_by, "spacing": spacing, "material": described.indenter.material}
            )
            described = described.model_copy(update={"indenter": surface})
            ends.append(_end(described, cells, window, tolerance))
        plain, other = ends
        peak = np.max(plain.pressure)
        apart = max(
            float(np.max(np.abs(other.pressure - np.roll(plain.pressure, shift, (0, 1)))) / peak),
            float(np.max(np.abs(other.shear - np.roll(plain.shear, shift, (1, 2)))) / (MU * peak)),
        )
        allowed = left_open(described, plain, tolerance)
        told = f"moved by {shift}, ν = {nu:g}, tolerance {tolerance:g}: {apart:.1e}"
        yield Attempt(apart <= allowed, told, apart / allowed)


def left_open(described: Scene, end: Any, tolerance: float) -> float:
    """How far apart the tractions of two answers within the tolerance may be, over the largest.

    The tolerance bounds gaps, over the approach δ. A cell answers a gap by the pressure gap/K, K
    its displacement by its own unit pressure, which are δ/(K p₀) tolerances: more on smaller cells.
    """
    spacing = WINDOW[0] / CELLS[0], WINDOW[0] / CELLS[0]
    own = influence_coefficients(described.body, described.indenter, spacing, (1, 1)).zz[0, 0]
    return tolerance * float(end.approach / (own * np.max(end.pressure)))


def scaled(count: int) -> Iterator[Attempt]:
    """Lengths and moduli times powers of ten between 1e-6 and 1e6."""
    chance = random.Random(12)
    for _ in range(count):
        pose = _drawn(chance)
        length, stress = (10.0 ** chance.randint(-6, 6) for _ in range(2))
        plain = _end(_scene(*pose))
        window = (WINDOW[0] * length, WINDOW[1] * length)
        other = _end(_scene(*pose, length, stress), CELLS, window)
        units = {
            "approach": length, "peak_pressure": stress, "contact_area": length**2,
            "stick_area": length**2, "dissipated_energy": stress * length**3,
        }  # fmt: skip
        apart = max(
            abs(getattr(other, name) / (unit * getattr(plain, name)) - 1.0)
            for name, unit in units.items()
        )
        allowed = _allowed(pose[-1])
        yield Attempt(apart <= allowed, f"{length:g}, {stress:g}: {apart:.1e}", apart / allowed)


def soak(count: int) -> Iterator[Attempt]:
    """So many cycles of fretting, with a checkpoint after each; of each its loss of energy."""
    pushes = [(sign * 0.6 * MU * LOAD, 0.0) for sign in (1, -1)] * count
    described = _described(pushes, (RADIUS, RADIUS))
    model, early = ContactModel.of(described, SurfaceGrid((16, 16), WINDOW)), max(2, count // 10)
    lost, memory = [0.0], 0.0
    with TemporaryDirectory() as folder:
        kept = Path(folder) / "mark"
        for number, (increment, mark) in enumerate(marked(model, plan(described), TOLERANCE)):
            cycle, rest = divmod(number, 2)
            if rest or not cycle:
                continue
            pack(mark, "soak", kept)
            unpacked(kept, "soak")
            assert increment.dissipated_energy is not None
            lost.append(increment.dissipated_energy)
            loss = lost[-1] - lost[-2]
            if cycle == early:
                first, memory = loss, _resident()
            if cycle <= early:
                yield Attempt(loss > 0, "nothing lost")
                continue
            drift, growth = abs(loss / first - 1) / (cycle - early), _resident() / memory - 1
            good = drift <= DRIFT and growth <= GROWTH
            yield Attempt(good, f"cycle {cycle}: {drift:.1e}, {growth:.1e}", 1e2 * growth)


def _resident() -> float:
    gc.collect()
    found = re.search(
        r"^VmRSS:\s+(\d+)", Path("/proc/self/status").read_text("ascii"), re.MULTILINE
    )
    assert found is not None
    return float(found[1])
