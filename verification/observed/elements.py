"""States of the contact surface from finite element results, for the evaluation of the laws.

The stated gap contains no overlap (penetration of a penalty method). Gap and relative motion are
therefore computed again from the tractions. After an augmentation of a penalty the pressure at a
Gauss point is p = ⟨λ + εv⟩, with v the overlap and λ the pressure of the preceding pass, which the
result does not contain. For every λ ≥ 0 the overlap is at most p/ε. With λ = p - εv the change of
the shear between the passes is at most the sum of the friction limits of p and λ.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from contact_scene.array_types import Field
from contact_scene.body_pair import contact_modulus
from fem_reference import Increment, Path, Result
from fem_reference.compliance.gauss_points import gauss_points
from fem_reference.elasticity.hat_functions import TractionBasis
from fem_reference.elasticity.motion import (
    LINE_PRESSING,
    LINE_SHEARING,
    PRESSING,
    SHEARING,
    TORSION,
    motion,
)
from fem_reference.model import ContactModel, outermost_modulus
from fem_reference.scales import Scales
from verification.observed.contact_state import (
    BISECTED,
    UNDEFINED,
    ContactState,
)
from verification.observed.ring_points import (
    RingPoints,
    angle_weights,
    displacement_by_harmonics,
    displacement_per_motion,
    gap_difference,
    loads_and_motions,
)

ANGULAR = (Path.HARMONICS, Path.WHOLE_CIRCLE)

# Gauss points of an element, exact for the product of r and a linear function.
PLACES, PARTS = np.polynomial.legendre.leggauss(2)


def model_of(result: Result, length: float) -> ContactModel:
    """Create the finite element contact model of the bodies of a result, without the test rig.

    Used to compute surface displacements again from the tractions.

    result  finite element result
    length  unit of length of the sections [length]
    """
    scales = Scales(length, outermost_modulus(result.scene))
    bodies = result.scene.model_copy(
        update={"rig": None}
    )  # motions of the contact, without the rig
    return ContactModel(bodies, scales, result.sections)


@dataclass(frozen=True)
class Rings:
    """Represent the points of a contact surface on rings and angles, with the compliance of the
    bodies.

    Used to compute displacements, gaps and loads again from the tractions of a finite element
    result. Scalar fields have the shape (rings, angles), vector fields (2, rings, angles) with
    components along r and θ.

    model   finite element contact model
    path    kind of load history of the result
    basis   functions that carry the tractions over the radius
    angles  angles of the half circle, ends included, or of the whole circle; one angle for
            axisymmetric fields [radian]
    """

    model: ContactModel
    path: Path
    basis: TractionBasis
    angles: Field

    @classmethod
    def of(cls, result: Result, *, on_points: bool) -> Rings:
        """Create the rings and angles that carry the tractions of a finite element result.

        on_points  True if the tractions are those of a penalty at Gauss points
        """
        last, nodes = (
            result.increments[-1],
            next(np.asarray(s.radii) for s in result.sections if s is not None),
        )
        if on_points:
            model = model_of(result, float(last.radii[0] + last.radii[2]) / 2 / float(nodes[1]))
            basis: TractionBasis = gauss_points(model.radii, model.rim, model.power)
        else:
            model = model_of(result, float(last.radii[-1] / nodes[::2][len(last.radii) - 1]))
            basis = model.hats
        angles = np.zeros(1) if last.angles is None else last.angles
        return cls(model, result.plan.path, basis, angles)

    @cached_property
    def driven(self) -> Field:
        """Displacement of the points (3, 2, rings, angles) per unit motion of the indenter."""
        along = self.path is Path.SHEARING or len(self.angles) > 1
        return displacement_per_motion(self.arms, self.angles, along=along)

    @property
    def arms(self) -> Field:
        """Mean distance of each ring from the axis, weighted with the hat function of the ring
        [length].
        """
        return np.asarray(self.basis.arms / self.basis.weights)

    @cached_property
    def weights(self) -> Field:
        """Area of the contact surface that each point (rings, angles) represents [length^2]."""
        return np.outer(self.basis.weights, self._angle_weights)

    @cached_property
    def undeformed(self) -> Field:
        """Gap of the undeformed surfaces at the points (rings, angles) [length]."""
        return self.on_grid(self.basis.integrate(self.model.gap) / self.basis.weights)

    def on_grid(self, values: Field | None) -> Field:
        """Extend values of the rings to all angles (rings, angles); None becomes zero."""
        if values is None:
            return np.zeros(self._shape)
        return np.broadcast_to(values if values.ndim == 2 else values[:, None], self._shape)

    def vector(self, increment: Increment, name: str) -> Field:
        """Return the shear or the slip of a finite element increment as a vector field (2, rings,
        angles).

        name  "shear" or "slip"
        """
        along = getattr(increment, f"{name}_along_load")
        if along is not None:
            return np.stack([self.on_grid(along), self.on_grid(None)])
        around = (getattr(increment, f"{name}_{part}") for part in ("radial", "circumferential"))
        return np.stack([self.on_grid(component) for component in around])

    def integral(self, values: Field) -> float:
        """Integrate a scalar field (rings, angles) over the contact surface.

        Between rings the field is linear in the radius; at Gauss points the values are weighted.
        """
        if self.basis is not self.model.hats:
            return float(np.sum(self.weights * values))
        radii, on_ring = self.basis.radii, values @ self._angle_weights
        share, width = 0.5 * (1 + PLACES), np.diff(radii)[:, None]
        r = radii[:-1, None] + width * share
        at_points = on_ring[:-1, None] * (1 - share) + on_ring[1:, None] * share
        weight = 1.0 if self._on_strips else r
        return float(np.sum(0.5 * width * PARTS * weight * at_points))

    def displacement(self, p: Field, q: Field) -> tuple[Field, Field]:
        """Compute the surface displacements of the lower body relative to the indenter from
        tractions.

        Returns u (2, rings, angles) along the surface and u_z (rings, angles) [length].

        p  pressure (rings, angles) [force/length²]
        q  shear (2, rings, angles) [force/length²]
        """
        if self._on_strips or self.path is Path.SHEARING:
            pressing = LINE_PRESSING if self._on_strips else PRESSING
            u = np.zeros((3, *self._shape))
            u[2, :, 0] = self._ring_means(self.model.compliance(pressing).matrix[1, :, 1], p[:, 0])
            if self.path is Path.SHEARING:
                u[0, :, 0] = self._ring_means(self._compliance_along_load(), q[0, :, 0])
            return u[:2], u[2]
        tractions = np.stack([*q, p])
        u = displacement_by_harmonics(tractions, self.angles, self._highest, self._of_harmonic)
        if len(self.angles) > 1:
            self._join_on_axis(u)
        return u[:2], u[2]

    def _compliance_along_load(self) -> Field:
        """Return the nodal compliance (n, n) along the load, as a mean around the axis."""
        if self._on_strips:
            return self.model.compliance(LINE_SHEARING).matrix[0, :, 0]
        C, sign = self.model.compliance(SHEARING).matrix[:2, :, :2], np.array([1.0, -1.0])
        return np.asarray(0.5 * np.einsum("i,j,iajb->ab", sign, sign, C))

    def _of_harmonic(self, m: int, turned: bool, loads: Field) -> Field:
        """Compute the amplitudes (3, rings) of the displacement by those of the tractions."""
        condensed = self.model.compliance(TORSION if turned and m == 0 else motion(m))
        found = np.zeros_like(loads)
        for i, a in enumerate(condensed.motion.components):
            for j, b in enumerate(condensed.motion.components):
                found[a] += self._ring_means(condensed.matrix[i, :, j], loads[b])
        return found

    @property
    def _shape(self) -> tuple[int, int]:
        return len(self.basis.radii), len(self.angles)

    @property
    def _on_strips(self) -> bool:
        """True for a line contact, whose fields are equal at x and -x, per unit length."""
        return self.model.plane

    @property
    def _highest(self) -> int:
        """Highest angular harmonic of the fields."""
        whole = self.path is Path.WHOLE_CIRCLE
        return len(self.angles) // 2 if whole else len(self.angles) - 1

    @cached_property
    def _angle_weights(self) -> Field:
        """Integration weights (angles,) of the trapezium rule over the full circle [radian].

        In a line contact the weight is 2, for both sides.
        """
        return 2.0 * np.ones(1) if self._on_strips else 2 * np.pi * angle_weights(self.angles)

    def _ring_means(self, nodal: Field, amplitude: Field) -> Field:
        displaced = nodal @ (self.basis.products @ amplitude)
        return np.asarray(self.basis.products.T @ displaced) / self.basis.weights

    def _join_on_axis(self, u: Field) -> None:
        """Replace the displacements of the points on the axis by their common mean, in place.

        All angles of the ring of radius zero are one point of the surface.

        u  displacements (3, rings, angles) along r, θ and z [length]
        """
        share, shifts = self._angle_weights / (2 * np.pi), self.driven[:2, :, 0]
        means = np.sum(share * u[:2, 0] * shifts, axis=(1, 2))
        u[:2, 0] = np.tensordot(means, shifts, axes=1)
        u[2, 0] = np.sum(share * u[2, 0])


def states_on_elements(result: Result) -> list[ContactState]:
    """Collect the state of the contact surface at the end of each increment of a finite element
    result.

    Raises ValueError for a penalty method with augmentation and angular harmonics: the result does
    not contain the deformation of the contact springs.
    """
    last = result.increments[-1]
    penalty, harmonics = last.overlap is not None, result.plan.path in ANGULAR
    if penalty and harmonics and any(i.augmentations for i in result.increments):
        raise ValueError("springs on harmonics were augmented: take augmentations = 0")
    rings = Rings.of(result, on_points=penalty and not harmonics)
    element = last.radii[1] - last.radii[0] if harmonics else float(rings.model.radii[2])
    give = 1 / _spring_stiffness(result, element) if penalty else 0.0
    return [_state_on_elements(increment, rings, result, give) for increment in result.increments]


def _spring_stiffness(result: Result, element: float) -> float:
    """Compute the penalty stiffness ε = c E*/h of a finite element result [force/length^3].

    c is the penalty factor of the discretisation, E* the contact modulus of the outermost
    materials.

    element  length h of a contact edge of an element [length]
    """
    return float(result.discretisation.penalty * contact_modulus(result.scene) / element)


def _state_on_elements(
    increment: Increment, rings: Rings, result: Result, give: float
) -> ContactState:
    p, q = rings.on_grid(increment.pressure), rings.vector(increment, "shear")
    along, u_z = rings.displacement(p, q)
    if result.plan.path in ANGULAR:  # contact springs are treated as part of the bodies
        along, u_z, give = along + give * q, u_z + give * p, 0.0
    points = RingPoints(rings.weights, rings.arms, rings.driven, rings.undeformed)
    friction = rings.model.friction.at_radii(rings.basis.radii[:, None])
    limit, slip = friction.limit(p), rings.vector(increment, "slip")
    state = points.state(
        increment,
        result.plan.direction,
        p,
        q,
        slip,
        limit,
        force=rings.integral(p),
        turning=float(np.sum(rings.weights * limit * rings.driven[2, 1])),
    )
    gap, passed = points.gap(increment, u_z), points.passed(state, along)
    stated = [gap_difference(p, gap, rings.on_grid(increment.gap), state.depth)]
    loose: Field | float = 0.0
    if give:
        assert increment.overlap is not None
        overlap = float(np.max(np.abs(gap), where=p > 0, initial=0.0))
        stated.append(abs(overlap - increment.overlap) / state.depth)
        loose = (limit + friction.limit(np.maximum(p + gap / give, 0.0))) * give
    if increment.angles is None and result.plan.path is not Path.SHEARING and not give:
        passed[:, 0] = slip[:, 0]  # on the axis there is neither shear nor slip
    loads, motions = loads_and_motions(increment, result.plan.direction)
    undefined = (motions is None and bool(np.any(loads))) or (
        bool(np.any(q)) and increment.dissipated_energy is None
    )
    skipped = BISECTED if increment.halvings else UNDEFINED if undefined else ""
    return replace(
        state,
        gap=gap,
        passed=None if undefined else passed,
        stated=tuple(stated),
        give=give,
        loose=loose,
        unseen=skipped,
        open=skipped,
    )
