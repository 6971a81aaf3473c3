"""A state on points as an increment of the result."""

from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray

from contact_scene.friction import CoulombFriction
from contact_scene.march import Place
from contact_scene.summary import ContactStatus
from fem_reference.contact.harmonics.point_state import PointState
from fem_reference.contact.ring_edge import contact_edge, stick_area
from fem_reference.fields import Increment

Field = NDArray[np.float64]


def reported(
    state: PointState, friction: CoulombFriction, direction: tuple[float, float], place: Place
) -> Increment:
    """Fields on (rings, angles), or on (rings,) as long as nothing depends on θ.

    direction  of the tangential load, from which angles count
    """
    compliance, shift = state.compliance, state.tangential_shift
    axisymmetric = compliance.grid.highest == 0
    touching = state.pressure > 0
    p = compliance.scalar_on_grid(state.pressure)
    gap = compliance.scalar_on_grid(np.where(touching, 0.0, np.maximum(state.gap, 0.0)))
    q_r, q_theta = compliance.vector_on_grid(state.shear)
    s_r, s_theta = compliance.vector_on_grid(state.slip)
    in_stick = compliance.scalar_on_grid(state.in_stick)

    def shown(values: Field) -> Field:
        return values[:, 0] if axisymmetric else values

    edges = _edges(state, p)
    return Increment(
        step=place.step,
        index=place.index,
        increments_in_step=place.increments_in_step,
        radii=compliance.rings.radii,
        angles=None if axisymmetric else compliance.grid.angles,
        pressure=shown(p),
        gap=shown(gap),
        normal_force=state.normal_force,
        approach=state.approach,
        contact_radius=sqrt(_contact_area(state, edges) / pi),
        peak_pressure=float(np.max(p)),
        residuals=state.residuals,
        iterations=state.solves,
        sweeps=state.turns,
        status=state.status,
        shear_radial=shown(q_r),
        shear_circumferential=None if axisymmetric else q_theta,
        slip_radial=shown(s_r),
        slip_circumferential=None if axisymmetric else s_theta,
        in_stick=in_stick[:, 0] if axisymmetric else in_stick,
        stick_radius=sqrt(_stick_area(state, friction, edges) / pi),
        tangential_force=_along(direction, state.tangential_force),
        tangential_shift=None if shift is None else _along(direction, shift),
        dissipated_energy=state.dissipated_energy,
        overlap=state.overlap if any(compliance.springs) else None,
        augmentations=state.augmentations if any(compliance.springs) else None,
        path="springs" if any(compliance.springs) else None,
    )


def _along(direction: tuple[float, float], value: float) -> tuple[float, float]:
    x, y = direction
    return value * x, value * y


def _edges(state: PointState, p: Field) -> Field:
    """Radius of the contact's edge on every ray (angles,) [length]: on the last ring, the rim of a
    flat punch, the ring; 0 without contact."""
    rings = state.compliance.rings
    return np.array([contact_edge(rings.radii, ray, rings.edge) for ray in p.T])


def _contact_area(state: PointState, edges: Field) -> float:
    """½∫a² dθ with the radius a of the contact's edge on every ray [length^2]."""
    return float(0.5 * np.sum(state.compliance.grid.weights * np.square(edges)))


def _stick_area(state: PointState, friction: CoulombFriction, edges: Field) -> float:
    """½∫c² dθ with the radius c of the edge of stick on every ray, between the rings
    [length^2]."""
    contact_area = _contact_area(state, edges)
    if state.status is ContactStatus.FULL_STICK:
        return contact_area
    compliance = state.compliance
    bound = friction.limit(state.pressure) * compliance.carries_shear
    slips = (state.pressure > 0) & ~state.in_stick
    rays = zip(
        compliance.scalar_on_grid(bound).T,
        compliance.vector_on_grid(state.shear).transpose(2, 0, 1),
        compliance.scalar_on_grid(slips).T,
        edges,
        strict=True,
    )
    areas = [stick_area(compliance.rings.radii, *ray) for ray in rays]
    return min(float(np.sum(compliance.grid.weights * areas) / (2 * pi)), contact_area)
