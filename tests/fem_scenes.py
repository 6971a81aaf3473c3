"""Discretisations and short ways for the tests of the finite-element reference."""

from contact_scene import FiniteElementDiscretisation, Scene
from fem_reference import Increment, Result, solve


def elements(per_radius: int = 16, **more) -> FiniteElementDiscretisation:
    return FiniteElementDiscretisation(elements_per_radius=per_radius, **more)


def solved(scene: Scene, per_radius: int = 16, **more) -> Result:
    return solve(scene, elements(per_radius, **more))


def end(scene: Scene, per_radius: int = 16, **more) -> Increment:
    """The last increment."""
    return solved(scene, per_radius, **more).increments[-1]
