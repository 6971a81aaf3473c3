"""Discretisations and short solve functions for tests of the finite-element solver."""

from contact_scene import FiniteElementDiscretisation, Scene
from fem_reference import Increment, Method, Result, solve

EXACT = Method.COMPLEMENTARITY


def elements(per_radius: int = 16, **more) -> FiniteElementDiscretisation:
    return FiniteElementDiscretisation(elements_per_radius=per_radius, **more)


def solved(scene: Scene, per_radius: int = 16, law: Method = EXACT, **more) -> Result:
    return solve(scene, elements(per_radius, **more), law)


def end(scene: Scene, per_radius: int = 16, law: Method = EXACT, **more) -> Increment:
    """The last increment."""
    return solved(scene, per_radius, law, **more).increments[-1]
