"""Result of a finite-element contact solve: fields over the radius for all increments.

Names and signs of the fields follow CONVENTIONS.
"""

from dataclasses import dataclass
from enum import Enum

from contact_scene import FiniteElementDiscretisation, Scene
from contact_scene.quantities.load_history import LoadHistory
from contact_scene.quantities.ring_increment import RingIncrement
from fem_reference.mesh.section_mesh import SectionMesh
from fem_reference.plan import Plan


class Method(Enum):
    """Methods that enforce the contact law and Coulomb's friction law.

    COMPLEMENTARITY enforces both laws exactly. PENALTY places springs between the surfaces and
    reduces the overlap by augmented-Lagrangian updates.
    """

    COMPLEMENTARITY = "complementarity"
    PENALTY = "penalty"


@dataclass(frozen=True, kw_only=True)
class Increment(RingIncrement):
    """Converged contact state at the end of one increment of the load history.

    Pressure and shear are values at the rings, with linear interpolation between the rings. A ring
    is a circle around the axis on the surface, through a corner node of the mesh. Gap and slip are
    means over each ring, weighted with the hat function of the ring. The exact law therefore gives
    a gap of exactly zero in contact and a slip of exactly zero in stick.

    factorizations  number of sparse factorisations
    sweeps          number of outer iterations of the coupled problem; 1 without coupling
    iterations      number of linear iterations of the contact algorithm
    path            name of the algorithm that solved the coupled normal and tangential problems;
                    None if these problems are not coupled
    edge_radius     radius of the circle of the area inside the outer contact edge [length], which
                    exceeds `contact_radius` if the surfaces separate within the contact
    """

    factorizations: int = 0
    sweeps: int = 1
    path: str | None = None
    edge_radius: float = 0.0


@dataclass(frozen=True, repr=False)
class Result(LoadHistory[Increment]):
    """Result of a finite-element contact solve: the converged states of all increments.

    The scene, the discretisation, the meshes and the contact method of the solve are included.

    sections    meshes of the lower body and of the indenter, in units of `radius`; None for a rigid
                body
    radius      contact radius for which the meshes are laid out [length]
    increments  converged states in the order of the load history
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
        """Name of the solver with its contact method, such as "fem_reference.penalty"."""
        return f"fem_reference.{self.method.value}"

    @property
    def tolerance(self) -> float:
        """Upper limit of every residual at the end of every increment [1]."""
        return self.discretisation.tolerance
