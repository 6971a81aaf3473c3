"""States of self-similar contacts at points of the surface, dilated about the axis."""

from dataclasses import replace

import numpy as np

from contact_scene.array_types import Field, Vector
from contact_scene.stepping.self_similar_growth import Mixing, Rays, Similarity
from fem_reference.compliance.point_compliance import PointCompliance
from fem_reference.contact.point_state import PointState


def dilated_state(
    compliance: PointCompliance,
    state: PointState,
    similarity: Similarity,
    mixing: Mixing,
) -> PointState | None:
    """Return the state of a self-similar contact at another contact radius, at the same points.

    None is returned if the motion is undefined, or if few rings are in contact.

    compliance  points of the surface
    state       state of the contact, which has grown from nothing
    similarity  ratio of the contact radii, and powers of it
    mixing      acceleration of the solves
    """
    if state.motions is None:
        return None
    rays = Rays(compliance.rings.radii, compliance.scalar_on_grid(state.in_stick))
    if not rays.resolve(compliance.scalar_on_grid(state.pressure)):
        return None
    length, traction, factor = similarity.displacement, similarity.traction, similarity.factor

    def scalar(values: Vector) -> Vector:
        return _at_points(
            compliance, rays.dilated(compliance.scalar_on_grid(values), factor), values
        )

    def vector(values: Field) -> Field:
        return _at_points(
            compliance, rays.dilated(compliance.vector_on_grid(values), factor), values
        )

    def tractions(values: Field) -> Field:
        # The pressure falls like a root towards the edge.
        pressure = np.sqrt(scalar(np.maximum(values[2], 0.0) ** 2))
        # Interpolation would extend the contact by a ring.
        inside = scalar((values[2] > 0).astype(np.float64)) >= 0.5
        return traction * inside * np.concatenate([vector(values[:2]), pressure[None]])

    along, across, twist = (length * motion for motion in state.motions)
    moved = np.tensordot(state.motions, compliance.motions, axes=1)
    relative = state.displacement - moved
    locked = rays.locked(compliance.vector_on_grid(relative), similarity)
    nothing = np.zeros_like(relative)  # the axis is the point of first contact
    locked = mixing.next_field(_at_points(compliance, locked, nothing))
    smaller = tractions(state.tractions)
    force, aside, torque = state.loads
    lever = similarity.force * factor
    energy = state.dissipated_energy
    if energy is not None:
        energy *= similarity.energy
    return replace(
        state,
        pressure=smaller[2],
        shear=smaller[:2],
        displacement=locked + length * moved,
        multiplier=tractions(state.multiplier),
        edge_tractions=tractions(state.edge_tractions),
        gap=length * scalar(state.gap),
        slip=length * vector(state.slip),
        normal_force=similarity.force * state.normal_force,
        approach=length * state.approach,
        loads=(similarity.force * force, similarity.force * aside, lever * torque),
        motions=(along, across, twist),
        dissipated_energy=energy,
        moved=length * state.moved,
    )


def _at_points(compliance: PointCompliance, on_grid: Field, axis: Field) -> Field:
    """Convert a field on rings and angles to the points of the surface (..., points).

    compliance  points of the surface
    on_grid     field (..., rings, angles)
    axis        field at the points (..., points). On a grid of several angles, the axis is one
                point, and the result takes its value
    """
    if compliance.grid.highest == 0:
        return on_grid[..., 0]
    rest = on_grid[..., 1:, :].reshape(*on_grid.shape[:-2], -1)
    return np.concatenate([axis[..., :1], rest], axis=-1)
