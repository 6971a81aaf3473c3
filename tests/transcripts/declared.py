"""Print the numbers that the program declares, without a solve unless it is cheap.

    python declared.py LEVEL   in cases, challenges, studies and the closures of their functions
    python declared.py DRAWN   in the scenes of the stability map and in scenes drawn at random

Each number counts by its logarithm, so that a small number counts as much as a large one.
"""

import re
import sys
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import partial
from itertools import product
from types import FunctionType, MethodType
from zlib import crc32

import numpy as np
from pydantic import BaseModel

from verification.cases.catalogue import choose
from verification.challenge.cases import challenges
from verification.defects.registry import DEFECTS
from verification.judging.case import Level
from verification.problems.drawn.families import FAMILIES, drawn
from verification.running.study import Settings
from verification.studies.catalogue import STUDIES
from verification.studies.stability.contacts import LoadingPath, StabilityCell, Surface, pose

ROUND_OFF = 1e-13  # of computed references
LEAST = 1e-6  # of the largest of an array: round-off changes the logarithms of smaller ones
DIGEST = re.compile("^[0-9a-f]{64}$")  # of the heights of a map, whose last digits are round-off
SCENES = 4  # of each family
# One family of each rule, and of each solver.
ANSWERED = """
    balls shapes tilted pushed near-sliding sliding twisted gross-slip oblique friction-maps
    elements-pushed elements-twisted
"""


def parts(value: object) -> Iterator[str | float]:
    """Numbers and texts within a declared object."""
    if isinstance(value, str | Enum):
        yield str(value)
    elif isinstance(value, int | float):
        yield float(value)
    elif isinstance(value, np.ndarray):
        least = LEAST * np.max(np.abs(value), initial=0.0)
        yield from parts(np.where(np.abs(value) > least, value, 0.0).ravel().tolist())
    else:
        for one in held(value):
            yield from parts(one)


def held(value: object) -> list[object]:
    """Return what a record, a collection or a function with its closure consists of."""
    if isinstance(value, BaseModel):
        return [value.__dict__]
    if isinstance(value, type):
        return [value.__qualname__]
    if is_dataclass(value):
        return [getattr(value, one.name) for one in fields(value)]
    if isinstance(value, FunctionType):
        cells = [cell.cell_contents for cell in value.__closure__ or ()]
        return [value.__qualname__, value.__defaults__, value.__kwdefaults__, *cells]
    if isinstance(value, MethodType):
        return [value.__func__, value.__self__]
    if isinstance(value, partial):
        return [value.func, value.args, value.keywords]
    if isinstance(value, dict):
        return [*value.keys(), *value.values()]
    return list(value) if isinstance(value, list | tuple) else []


def weighted(values: list[object], least: float) -> tuple[int, float]:
    """Number of the numbers among values, and a sum of their logarithms."""
    numbers = np.array([one for one in values if isinstance(one, float)])
    numbers = numbers[np.isfinite(numbers)]
    sizes = np.sign(numbers) * np.log(np.maximum(np.abs(numbers) / least, 1.0))
    return sizes.size, sizes @ np.sin(1 + 1.7 * np.arange(sizes.size))


def show(kind: str, name: str, *values: object) -> None:
    """Print a digest of the texts and a sum of the numbers of a declared object."""
    found = list(parts(values))
    words = [DIGEST.sub("digest", one) for one in found if isinstance(one, str)]
    digest = crc32("\n".join(words).encode()) % 1000
    print(kind, name, len(words), digest, *weighted(found, ROUND_OFF))


def show_level(level: Level) -> None:
    """Print the cases, studies, challenges and defects of a level."""
    for case in choose(level):
        show("runs", case.name, case.runs)
        show("judged", case.name, case.quantities, case.orders, case.charts)
        show("sheet", case.name, case.title, case.problem, case.equations, case.limits, case.shows)
    for name, study in STUDIES.items():
        show("study", name, study.cases(Settings(level)))
    if level is Level.QUICK:
        for name, challenge in challenges().items():
            show("challenge", name, challenge)
        show("defects", "", DEFECTS)


def show_drawn() -> None:
    """Print posed scenes of all kinds, and the answers of those that take little time."""
    for surface, path in product(Surface, LoadingPath):
        cell = StabilityCell(surface=surface, path=path)
        show("posed", cell.name, pose(cell))
    for name, family in FAMILIES.items():
        posed = [family.posed(np.random.default_rng(seed)) for seed in range(SCENES)]
        show("drawn", name, posed)
    for name in ANSWERED.split():
        truths = drawn(name, 2, 0).truths
        bounds = [one.value + one.uncertainty for one in truths]
        show("answer", name, bounds, [(one.step, one.quantity) for one in truths])


if sys.argv[1] == "DRAWN":
    show_drawn()
else:
    show_level(Level[sys.argv[1]])
