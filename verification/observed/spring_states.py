"""Springs of a penalty at Gauss points: what bodies answer to forces on them, and their states."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene import CoulombFriction, IsotropicMaterial
from fem_reference import Increment, Path, Result
from fem_reference.compliance.gauss_points import gauss_points
from verification.observed.rings import along_load, model_of, section_radii
from verification.observed.section_energy import EnergeticState

Field = NDArray[np.float64]


def spring_stiffness(result: Result, element: float) -> float:
    """ε = c E*/h, E* of the outermost materials [force/length^3].

    element  length of a contact edge [length]
    """
    softness = 0.0
    for body in (result.scene.body, result.scene.indenter):
        outermost = body.layers[0].material if body.layers else body.material
        if isinstance(outermost, IsotropicMaterial):
            softness += (1 - outermost.poisson_ratio**2) / outermost.young_modulus
    return result.discretisation.penalty / (softness * element)


@dataclass(frozen=True)
class SpringSurface:
    """Gauss points, what forces on them displace, and the springs.

    by_force  (n, n) per component of displacement and force, "z", "t": normal, tangential
    moves     how a unit of the indenter's shift or twist moves its points along the shear: 1, r
              [length], or 0
    twists    whether it is a twist
    along     unit vector of the load
    """

    weights: Field
    gap: Field
    by_force: dict[str, Field]
    moves: Field
    twists: bool
    along: tuple[float, float]
    stiffness: float
    friction: CoulombFriction

    @classmethod
    def of(cls, result: Result) -> SpringSurface:
        """Of the increments of a result."""
        radii, nodes = result.increments[-1].radii, section_radii(result)
        middle = float(radii[0] + radii[2]) / 2  # of the first element
        model = model_of(result, middle / float(nodes[1]))
        points = gauss_points(model.radii, model.rim)
        path = result.plan.path
        pressing = model.compliance(0).matrix
        blocks = {"zz": pressing[1, :, 1]}
        if path is Path.PRESSING_WITH_FRICTION:
            blocks |= {"zt": pressing[1, :, 0], "tz": pressing[0, :, 1], "tt": pressing[0, :, 0]}
        elif path is Path.SHEARING:
            blocks["tt"] = along_load(model)
        elif path is Path.TWISTING:
            blocks["tt"] = model.torsion().matrix[0, :, 0]
        moves = {Path.SHEARING: np.ones_like(points.radii), Path.TWISTING: points.radii}
        by_force = {
            name: points.compliance(block) / points.weights[:, None]
            for name, block in blocks.items()
        }
        return cls(
            weights=2 * np.pi * points.weights,
            gap=model.gap(points.radii),
            by_force=by_force,
            moves=moves.get(path, np.zeros_like(points.radii)),
            twists=path is Path.TWISTING,
            along=result.plan.direction,
            stiffness=spring_stiffness(result, float(model.radii[2])),
            friction=model.friction,
        )

    def displaced(self, component: str, p: Field, q: Field | None) -> Field:
        """By pressure and shear [length]."""
        nothing = np.zeros((len(p), len(p)))
        by_shear = 0.0 if q is None else self.by_force.get(component + "t", nothing) @ q
        return np.asarray(self.by_force.get(component + "z", nothing) @ p + by_shear)

    def motion(self, told: Increment) -> float | None:
        """Shift of the indenter along the load [length], or its twist; None where undefined."""
        if self.twists:
            return told.twist
        shift = told.tangential_shift
        return None if shift is None else float(np.dot(shift, self.along))

    def force(self, told: Increment) -> float:
        """Along the load [force], or the torque [force length]."""
        if self.twists:
            return told.torque or 0.0
        return float(np.dot(told.tangential_force or (0.0, 0.0), self.along))


@dataclass(frozen=True)
class SpringState:
    """An increment at the points.

    overlap  v [length]
    passed   how far the indenter's points have gone past the body's along the shear [length];
             None without shear, and where the motion of the indenter is undefined
    """

    told: Increment
    p: Field
    q: Field | None
    slip: Field | None
    overlap: Field
    passed: Field | None

    @classmethod
    def of(cls, told: Increment, surface: SpringSurface) -> SpringState:
        p = told.pressure
        sheared = (
            (told.shear_radial, told.slip_radial),
            (told.shear_along_load, told.slip_along_load),
            (told.shear_circumferential, told.slip_circumferential),
        )
        q, slip = next((pair for pair in sheared if pair[0] is not None), (None, None))
        overlap = told.approach - surface.gap - surface.displaced("z", p, q)
        motion = surface.motion(told)
        passed = None
        if q is not None and motion is not None:
            passed = surface.moves * motion - surface.displaced("t", p, q)
            if told.bulk_strain is not None:
                passed = passed - told.bulk_strain[0] * told.radii
        return cls(told, p, q, slip, overlap, passed)

    def energetic(self, surface: SpringSurface) -> EnergeticState:
        """What the first law is about."""
        p, q = self.p, np.zeros_like(self.p) if self.q is None else self.q
        u_z, u_t = (surface.displaced(component, p, self.q) for component in "zt")
        stored = 0.5 * float(np.sum(surface.weights * (p * u_z + q * u_t)))
        passed, slip = self.passed, self.slip
        if self.q is None:
            passed = np.zeros_like(p)
        slip = np.zeros_like(p) if slip is None else slip
        return EnergeticState(
            self.told, surface.weights, stored, surface.gap, p, -self.overlap, q[None],
            surface.friction.limit(p), None if passed is None else -passed[None],
            slip[None], yields=True,
        )  # fmt: skip
