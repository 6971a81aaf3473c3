"""How long solves on cells take: a part for every convolution, and one beside them.

A convolution on n cells takes o + c n log₂ √n, and a solve as many of them as it has increments,
times the square root of the cells along a side. o and c are those of the machine, measured once
and kept; the counts are those of a coarse solve of the same scene.
"""

from __future__ import annotations

import contextlib
import json
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import cache
from hashlib import sha256
from math import inf, log2, sqrt
from pathlib import Path

import semi_analytical
from contact_results.directory.atomic_file import atomic_file
from contact_results.directory.code_digest import SOLVERS, code_digest
from contact_results.directory.machine import machine
from contact_scene import Body, CoulombFriction, IsotropicMaterial, LoadStep, Paraboloid, Scene
from contact_scene.kept_arrays import cache_directory
from contact_scene.own_file import open_own

Cells = tuple[int, int]

# Of the convolutions of an increment with the cells along a side.
GROWTH_OF_CONVOLUTIONS = 0.5
# On the first the fixed part of a convolution is measured, on the other what grows with cells.
FEW, MANY = 24, 128
# Of the least of three measurements nothing is left that other programs have taken.
REPEATED = 3


@dataclass(frozen=True)
class Speed:
    """Of a machine.

    per_convolution  o, seconds
    per_point        c, seconds per n log₂ √n
    """

    per_convolution: float
    per_point: float

    def seconds(self, cells: Cells, convolutions: float) -> float:
        """Of so many convolutions."""
        return convolutions * (self.per_convolution + self.per_point * _points(cells))


@dataclass(frozen=True)
class Solved:
    """Cells of a solve, and the convolutions that it took."""

    cells: Cells
    convolutions: float

    def finer(self, finer: float, more: float) -> Solved:
        """With so many times the cells along a side, and the increments."""
        nx, ny = (round(finer * n) for n in self.cells)
        return Solved((nx, ny), self.convolutions * more * finer**GROWTH_OF_CONVOLUTIONS)


def seconds_like(
    solved: Sequence[Solved],
    seconds: float,
    finer: float,
    more: float,
    speed: Speed,
    edges: bool = False,
) -> float:
    """How long finer solves of a scene will take.

    solved   coarse ones, which took `seconds` together
    finer    factor of the cells along a side
    more     of the increments
    edges    whether they are put inside the cells: what is no convolution is mostly that, and goes
             with the cells along them
    """

    def model(of: Sequence[Solved]) -> float:
        return sum(speed.seconds(each.cells, each.convolutions) for each in of)

    fixed = max(0.0, seconds - model(solved))
    along = finer if edges else 1.0
    return along * fixed + model([each.finer(finer, more) for each in solved])


@cache
def machine_speed() -> Speed:
    """Of this machine, measured within a second where the cache has not kept it."""
    directory = cache_directory()
    identity = repr(machine()).encode() + code_digest(SOLVERS)
    name = f"{sha256(identity).hexdigest()}.speed"
    if directory is not None:
        with contextlib.suppress(OSError, ValueError, TypeError, AttributeError, OverflowError):
            return _kept(directory / name)
    speed = measured_speed()
    if directory is not None:
        with contextlib.suppress(OSError):
            directory.mkdir(mode=0o700, parents=True, exist_ok=True)
            with atomic_file(directory / name) as temporary:
                temporary.write_text(json.dumps(asdict(speed)), encoding="utf-8")
    return speed


def _kept(path: Path) -> Speed:
    """Raises OSError for a file of somebody else's, and what damage raises."""
    with open_own(path) as file:
        numbers = {name: float(number) for name, number in json.load(file).items()}
    if not all(0 < number < inf for number in numbers.values()):
        raise ValueError(f"{path}: expected positive seconds, got {numbers}")
    return Speed(**numbers)


def measured_speed() -> Speed:
    """By a ball pressed and pushed sideways, on few and on many cells."""
    few, many = (_per_convolution(cells) for cells in (FEW, MANY))
    points = _points((MANY, MANY)) - _points((FEW, FEW))
    per_point = max(many - few, 0.1 * many) / points
    return Speed(max(few - per_point * _points((FEW, FEW)), 0.1 * few), per_point)


def _per_convolution(cells: int) -> float:
    """Seconds of the processor."""
    steel = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
    ball = Scene(
        indenter=Paraboloid(radius=0.01, material=steel),
        body=Body(material=steel),
        friction=CoulombFriction(coefficient=0.1),
        loading=(LoadStep(normal_force=1e3), LoadStep(tangential_force=(70.0, 0.0))),
    )
    grid = semi_analytical.SurfaceGrid((cells, cells), (1.4e-3, 1.4e-3))
    taken = []
    for _ in range(REPEATED):
        began = time.process_time()
        result = semi_analytical.solve(ball, grid, 1e-8)
        taken.append(time.process_time() - began)
    return min(taken) / sum(increment.convolutions for increment in result.increments)


def _points(cells: Cells) -> float:
    n = cells[0] * cells[1]
    return n * log2(sqrt(n))
