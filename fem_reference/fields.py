"""Result of a solve: fields over the radius, with the names and signs of CONVENTIONS."""

from dataclasses import dataclass
from enum import Enum

from contact_scene import FiniteElementDiscretisation, Scene
from contact_scene.quantities.ring_increment import RingIncrement
from fem_reference.mesh.section_mesh import SectionMesh
from fem_reference.plan import Plan


class Method(Enum):
    """Enforcement of the contact and friction laws."""

    COMPLEMENTARITY = "complementarity"
    PENALTY = "penalty"


@dataclass(frozen=True, kw_only=True)
class Increment(RingIncrement):
    """Converged state at the end of one increment of the load history.

    Pressure and shear are values at the rings, with linear interpolation. Gap and slip are means
    weighted with the ring's hat function, so that they are exactly zero in contact and stick.

    iterations  linear systems of the contact solver
    path        algorithm used, for a method with several; else None
    """

    factorizations: int = 0
    sweeps: int = 1
    path: str | None = None


@dataclass(frozen=True)
class Result:
    """All increments of a load history on one mesh, with scene, discretisation and plan.

    sections  meshes of lower body and indenter, in units of `radius`; None if rigid
    radius    contact radius for which the meshes are laid out [length]
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
        """Name of the solver in a summary."""
        return f"fem_reference.{self.method.value}"

    @property
    def tolerance(self) -> float:
        """Limit of every residual at the end of every increment."""
        return self.discretisation.tolerance

    @property
    def steps(self) -> tuple[Increment, ...]:
        """Last increment of every load step."""
        return tuple(i for i in self.increments if i.index == i.increments_in_step)
