"""Conversion of a contact state at the points of the surface to an increment of the result."""

from collections.abc import Sequence
from dataclasses import replace
from math import hypot, pi, sqrt
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field
from contact_scene.quantities.summary import ContactStatus
from contact_scene.stepping.load_stepping import IncrementPosition
from fem_reference.compliance.ring_edge import area_of_holes, area_within, stick_area
from fem_reference.contact.point_contact import PointContact
from fem_reference.contact.point_state import PointState
from fem_reference.fields import Increment
from fem_reference.loads import TWIST
from fem_reference.plan import Path, Plan

Scalar = TypeVar("Scalar", np.float64, np.bool_)


def report_increment(
    contact: PointContact,
    state: PointState,
    plan: Plan,
    place: IncrementPosition,
) -> Increment:
    """Convert a contact state at the points of the surface to an increment of the result.

    The fields of the result have the shape (rings, angles), or (rings,) if the state is
    axisymmetric.

    contact  contact problem at the points of the surface
    state    converged state at the end of the increment
    plan     path, and unit vector (x, y) of the tangential load, from which angles are counted
    place    load step, and index of the increment in the load step
    """
    compliance, rings = contact.compliance, contact.rings
    p = _result_field(contact, state.pressure)
    gap = np.where(state.pressure > 0, 0.0, np.maximum(state.gap, 0.0))
    edges = _contact_edges(contact, state)
    pressed = Increment(
        step=place.step,
        index=place.index,
        increments_in_step=place.increments_in_step,
        radii=rings.radii,
        angles=None if contact.axisymmetric else compliance.grid.angles,
        pressure=p,
        gap=_result_field(contact, gap),
        normal_force=state.normal_force,
        approach=state.approach,
        contact_radius=_radius_of(contact, _contact_area(contact, state, edges)),
        edge_radius=_radius_of(contact, _area_within_edges(contact, edges)),
        peak_pressure=float(np.max(p)),
        elastic_energy=_elastic_energy(contact, state),
        residuals=state.residuals,
        iterations=state.solves,
        sweeps=state.outer_iterations,
        overlap=state.overlap if contact.penalty else None,
        augmentations=state.augmentations if contact.penalty else None,
        path=state.algorithm,
        strips=rings.plane,
    )
    return (
        pressed if rings.path is Path.PRESSING else _add_shear(pressed, contact, state, plan, edges)
    )


def _add_shear(
    pressed: Increment,
    contact: PointContact,
    state: PointState,
    plan: Plan,
    edges: Field,
) -> Increment:
    """Add shear, slip, stick zone and tangential load to an increment of the result.

    Without coupling of pressure and shear, shear and slip are circumferential in torsion, and along
    the load under tangential loads on one line. Otherwise they have a radial and, under a
    tangential load or torsion, a circumferential component.

    pressed  increment with pressure and gap
    contact  contact problem at the points of the surface
    state    converged contact state at the points
    plan     path, and unit vector (x, y) of the tangential load
    edges    radius of the contact edge on every ray, the set of points at one angle (angles,)
             [length]
    """
    path, (x, y) = plan.path, plan.direction
    components = {"radial": 0, "circumferential": 1}
    if contact.axisymmetric and not plan.twists:
        components = {"radial": 0}
    single = {Path.TWISTING: {"circumferential": 1}, Path.SHEARING: {"along_load": 0}}
    fields: dict[str, Any] = {
        f"{field}_{name}": _drop_angle_axis(contact, on_grid[component])
        for field, vectors in (("shear", state.shear), ("slip", state.slip))
        for on_grid in [contact.compliance.vector_on_grid(vectors)]
        for name, component in single.get(path, components).items()
    }
    if plan.twists:
        twist = state.twist if state.motions is None else state.motions[TWIST]
        fields |= {"torque": state.loads[TWIST], "twist": twist}
    force, shift = (
        None if parts is None else (parts[0] * x - parts[1] * y, parts[0] * y + parts[1] * x)
        for parts in (state.loads, state.motions)
    )
    return replace(
        pressed,
        tangential_force=force,
        tangential_shift=shift,
        status=state.status,
        in_stick=_result_field(contact, state.in_stick),
        stick_radius=_radius_of(contact, _stick_area(contact, state, edges)),
        dissipated_energy=state.dissipated_energy,
        **fields,
    )


def _elastic_energy(contact: PointContact, state: PointState) -> float:
    """Compute ½ ∫ (p u_z + q·u) dA [force length],
    without the springs of a penalty and of a test rig."""
    normal = state.gap - contact.gap + state.approach
    work = state.pressure * normal + np.sum(state.shear * state.displacement, axis=0)
    down, along = contact.rig
    in_rig = down * state.normal_force**2 + along * hypot(*state.loads[:TWIST]) ** 2
    return 0.5 * float(np.sum(contact.compliance.areas * work) - in_rig)


def _result_field(contact: PointContact, values: NDArray[Scalar]) -> NDArray[Scalar]:
    """Convert a scalar field to rings and angles; (rings,) if the contact is axisymmetric."""
    return _drop_angle_axis(contact, contact.compliance.scalar_on_grid(values))


def _drop_angle_axis(contact: PointContact, on_grid: NDArray[Scalar]) -> NDArray[Scalar]:
    return on_grid[:, 0] if contact.axisymmetric else on_grid


def _contact_edges(contact: PointContact, state: PointState) -> Field:
    """Compute the edge radius on every ray (angles,) [length]:
    the end of the last element if the last ring carries pressure, 0 without contact."""
    p = contact.compliance.scalar_on_grid(state.pressure)
    outward = contact.compliance.vector_on_grid(state.shear)[0]
    return np.array([contact.rings.contact_edge(*ray) for ray in zip(p.T, outward.T, strict=True)])


def _contact_area(contact: PointContact, state: PointState, edges: Field) -> float:
    """Compute the contact area [length^2], a width in plane strain: that inside the edge radii of
    all rays, without the holes."""
    rings, rays = contact.rings, contact.compliance.scalar_on_grid(state.pressure).T
    parts = [area_of_holes(rings.radii, ray, rings.edge, plane=rings.plane) for ray in rays]
    return _area_within_edges(contact, edges) - _mean_over_rays(contact, parts)


def _area_within_edges(contact: PointContact, edges: Field) -> float:
    """Compute ½∫a² dθ with the edge radius a of every ray [length^2]; 2a in plane strain."""
    return _mean_over_rays(
        contact, [area_within(edge, plane=contact.rings.plane) for edge in edges]
    )


def _mean_over_rays(contact: PointContact, values: Sequence[float]) -> float:
    weights = contact.compliance.grid.weights
    return float(np.sum(weights * values) / np.sum(weights))


def _radius_of(contact: PointContact, area: float) -> float:
    """Return the radius of the circle of an area, or half of the width of a strip [length]."""
    return area / 2 if contact.rings.plane else sqrt(area / pi)


def _stick_area(contact: PointContact, state: PointState, edges: Field) -> float:
    """Compute the area of the stick zone, at most the contact area: ½∫c² dθ [length^2].

    c is the radius of the edge of the stick zone on every ray.
    """
    if state.motions is None:
        # At the friction limit the shear may differ from it by round-off, which is no stick zone.
        return 0.0
    contact_area = _contact_area(contact, state, edges)
    if state.status is ContactStatus.FULL_STICK and contact.at_gauss_points:
        return contact_area
    compliance, rings = contact.compliance, contact.rings
    p = state.pressure
    bound = contact.friction.limit(p) * compliance.carries_shear
    slips = (p > 0) & ~state.in_stick
    rays = zip(
        compliance.scalar_on_grid(bound).T,
        compliance.vector_on_grid(state.shear).transpose(2, 0, 1),
        compliance.scalar_on_grid(slips).T,
        edges,
        strict=True,
    )
    areas = [stick_area(rings.radii, *ray, rings.edge, plane=rings.plane) for ray in rays]
    return min(_mean_over_rays(contact, areas), contact_area)
