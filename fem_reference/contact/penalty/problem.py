"""The penalty model of one scene: which components it has, and what drives them."""

from dataclasses import dataclass, replace
from math import pi
from typing import Self

import numpy as np
from numpy.typing import NDArray

from contact_scene.friction import FRICTIONLESS, CoulombFriction
from contact_scene.pair import contact_modulus
from fem_reference.contact.augmentation import Penalty
from fem_reference.contact.one_component import target_of
from fem_reference.contact.penalty.fitted_edge import edge_radius
from fem_reference.contact.penalty.gauss_points import GaussPoints, gauss_points
from fem_reference.contact.penalty.law import penalty_stiffness
from fem_reference.contact.penalty.surface import ElasticSurface, Target
from fem_reference.loads import Loads
from fem_reference.model import ContactModel
from fem_reference.plan import Path

Field = NDArray[np.float64]

# A corner this much beyond a rim, relatively, is at it.
SAME = 1e-9


@dataclass(frozen=True)
class PenaltyProblem:
    """All that the penalty method needs.

    points      radii in [length]
    surface     pressure, and the one component of shear that the path has
    stiffness   ε [force/length^3]
    friction    between the surfaces
    element     length of a contact edge [length]
    reach       outer end of the last edge [length]
    path        which tractions there are
    open_end    whether the mesh ends at the last point but the contact may go on
    """

    points: GaussPoints
    surface: ElasticSurface
    stiffness: float
    friction: CoulombFriction
    element: float
    reach: float
    path: Path
    open_end: bool

    @property
    def driven(self) -> bool:
        """Whether the indenter moves in the direction of the shear."""
        return self.path in (Path.TWISTING, Path.SHEARING)

    def target(self, loads: Loads) -> Target:
        """What is prescribed of each component."""
        force, approach = loads.normal.force, loads.normal.approach
        pairs = [(None if force is None else force / (2 * pi), approach)]
        if len(self.surface.motion) > 1:
            sideways = target_of(loads)
            pairs.append((sideways.resultant, sideways.motion or 0.0))
        values = [motion if load is None else load for load, motion in pairs]
        free = [load is not None for load, _ in pairs]
        return Target(np.array(free), np.array(values, dtype=float))

    def pressing_alone(self) -> Self:
        """The pressure without any shear."""
        surface = self.surface.part(slice(0, 1), np.zeros_like(self.surface.gap))
        return replace(self, surface=surface, friction=FRICTIONLESS, path=Path.PRESSING)

    def contact_radius(self, pressure: Field) -> float:
        """Where a pressure (n,) ends: at the rim of a flat punch if its last point carries any; 0
        without contact."""
        touching = np.flatnonzero(pressure > 0)
        if len(touching) == 0:
            return 0.0
        last = int(touching[-1])
        if last == len(pressure) - 1:
            return self.reach
        return edge_radius(self.points.radii, pressure, last, self.element)

    def capacity(self, pressure: Field) -> float:
        """The largest shear load over 2π that friction carries under a pressure (n,)."""
        limit = self.friction.limit(pressure)
        return float(np.sum(self.surface.weights * self.surface.motion[1] * limit))


def penalty_problem(model: ContactModel, path: Path, penalty: Penalty) -> PenaltyProblem:
    """The problem of a path other than Path.HARMONICS; condenses only the harmonics it needs."""
    nodes = _nodes_under(model)
    points = gauss_points(nodes)
    pressing = model.compliance(0).matrix
    blocks = {(0, 0): pressing[1, :, 1]}
    motion = [np.ones_like(points.radii)]
    if path is Path.PRESSING_WITH_FRICTION:
        blocks |= {
            (0, 1): pressing[1, :, 0],
            (1, 0): pressing[0, :, 1],
            (1, 1): pressing[0, :, 0],
        }
        motion.append(np.zeros_like(points.radii))
    elif path is Path.TWISTING:
        blocks[1, 1] = model.torsion().matrix[0, :, 0]
        motion.append(points.radii)
    elif path is Path.SHEARING:
        blocks[1, 1] = model.along_load()
        motion.append(np.ones_like(points.radii))
    c, n = len(motion), len(points.radii)
    compliance = np.zeros((c, n, c, n))
    for (row, column), block in blocks.items():
        used = block[: len(nodes), : len(nodes)]
        compliance[row, :, column] = points.trace @ used @ points.trace.T
    gap = np.zeros((c, n))
    gap[0] = model.gap(points.radii)
    element = float(nodes[2] - nodes[0])
    return PenaltyProblem(
        points=points,
        surface=ElasticSurface(points.weights, compliance, np.array(motion), gap),
        # Of the outermost materials: it is them that an overlap as short as an edge presses.
        stiffness=penalty_stiffness(penalty, contact_modulus(model.scene), element),
        friction=model.friction if c > 1 else FRICTIONLESS,
        element=element,
        reach=float(nodes[-1]),
        path=path,
        open_end=not model.ends_at_rim,
    )


def _nodes_under(model: ContactModel) -> Field:
    """Corner and midside nodes that the indenter can touch."""
    rim = model.scene.indenter.rim
    return model.radii if rim is None else model.radii[model.radii <= rim * (1 + SAME)]
