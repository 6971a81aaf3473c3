"""Numbers that are none, planted where a transform or a factorisation gives back its values."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from contact_scene import FiniteElementDiscretisation
from contact_scene.solver_errors import SolverError
from fem_reference import Method
from fem_reference import solve as solve_on_rings
from fem_reference.elasticity.factored_section import FactoredSection
from semi_analytical import Plan, SurfaceGrid, plan, solve
from semi_analytical.operator.domain import WINDOW
from semi_analytical.operator.transforms import Transforms
from verification.running.cold_cache import cold_cache
from verification.studies.promises.promise import Attempt
from verification.studies.promises.scenes import CONTACT, fretting, read
from verification.studies.promises.solvers import TOLERANCE

Computed = Callable[[], Any]

# Tolerances by which two answers with residuals within the tolerance may differ: a solve that goes
# on from a spoilt number stops elsewhere.
OPEN = 10.0


def planted(count: int) -> Iterator[Attempt]:
    """NaN or infinity in one number, at some call."""
    chance, described = random.Random(13), read(fretting(pushes=2))
    window = (3e-3 * CONTACT, 3e-3 * CONTACT)
    coarse = FiniteElementDiscretisation(elements_per_radius=4, box=10.0, harmonics=2)

    def on_cells(told: Plan) -> Any:
        return solve(described, SurfaceGrid((20, 20), window), TOLERANCE, plan=told)

    def on_rings(method: Method) -> Any:
        return solve_on_rings(described, coarse, method)

    told = plan(described)
    on_quarter = partial(on_cells, told)
    on_window = partial(on_cells, replace(told, symmetry=WINDOW))
    ways: tuple[tuple[type, str, int, Computed], ...] = (
        (Transforms, "filtered", 60, on_window),
        (Transforms, "filtered", 60, on_quarter),
        (FactoredSection, "compliance", 1, partial(on_rings, Method.COMPLEMENTARITY)),
        (FactoredSection, "compliance", 1, partial(on_rings, Method.PENALTY)),
    )
    healthy = [compute().steps[-1].pressure for *_, compute in ways]
    for number in range(count):
        way = (1, 0, 2, 1, 1, 0, 3, 1)[number % 8]
        of, name, calls, compute = ways[way]
        value = chance.choice((math.nan, math.inf, -math.inf))
        with cold_cache():
            try:
                with _spoilt(of, name, chance.randint(1, calls), value, chance):
                    found = compute().steps[-1].pressure
            except SolverError as error:
                yield Attempt(True, str(error))
                continue
            except Exception as error:  # whatever it is, it does not say what is wrong
                yield Attempt(False, f"{name} with {value}: {type(error).__name__}: {error}")
                continue
        apart = np.max(np.abs(found - healthy[way])) / np.max(healthy[way])
        good = bool(apart <= OPEN * TOLERANCE)  # false of what is not a number
        yield Attempt(good, f"{name} with {value}: an answer that is off by {apart:.1e}")


@contextmanager
def _spoilt(of: type, name: str, at: int, value: float, chance: random.Random) -> Iterator[None]:
    """Some number that the method returns is this one, at that call of it."""
    sound, calls = getattr(of, name), [0]

    def spoilt(*given: Any) -> Any:
        values = np.array(sound(*given))
        calls[0] += 1
        if calls[0] == at:
            values.ravel()[chance.randrange(values.size)] = value
        return values

    setattr(of, name, spoilt)
    try:
        with np.errstate(all="ignore"):
            yield
    finally:
        setattr(of, name, sound)
