"""What a solve returns: fields over the radius, with the names and signs of CONVENTIONS."""

from dataclasses import dataclass
from enum import Enum

from contact_scene import FiniteElementDiscretisation, Scene
from contact_scene.quantities.ring_increment import RingIncrement
from fem_reference.mesh.section_mesh import SectionMesh
from fem_reference.plan import Plan


class Method(Enum):
    """How contact and friction are enforced."""

    COMPLEMENTARITY = "complementarity"
    PENALTY = "penalty"


@dataclass(frozen=True, kw_only=True)
class Increment(RingIncrement):
    """The converged state at the end of one increment of the load history.

    Pressure and shear are values at the rings, linear in between; gap and slip are means weighted
    with the ring's hat function, so that they vanish exactly where surfaces touch or stick.

    iterations  linear systems of the contact solver
    path        which way of solving was taken, where a method has several
    """

    factorizations: int = 0
    sweeps: int = 1
    path: str | None = None


@dataclass(frozen=True)
class Result:
    """All increments of a load history on one mesh, with what was asked for and decided.

    sections  meshes of lower body and indenter, in units of `radius`; None where rigid
    radius    contact radius that the meshes are laid out for [length]
    """

    scene: Scene
    discretisation: FiniteElementDiscretisation
    sections: tuple[SectionMesh | None, SectionMesh | None]
    radius: float
    plan: Plan
    increments: tuple[Increment, ...]
    method: Method = Method.COMPLEMENTARITY

    @property
    def solver(self) -> str:
        """What a summary calls the solver."""
        return f"fem_reference.{self.method.value}"

    @property
    def tolerance(self) -> float:
        """Bound of every residual at the end of every increment."""
        return self.discretisation.tolerance

    @property
    def steps(self) -> tuple[Increment, ...]:
        """The last increment of every loading step."""
        return tuple(i for i in self.increments if i.index == i.increments_in_step)
