"""Seeded defects of load histories, energies and derived results, to test the verification.

The wrong functions concern load reversals, unloading, prescribed motions, and stresses.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from contact_results import cycles, loop
from contact_scene import CoulombFriction, HeightMap, Scene, rig
from contact_scene.checks import axisymmetric
from contact_scene.quantities import ring_increment
from contact_scene.stepping.load_path import (
    Control,
    ControlKind,
)
from contact_solver import admissible_pressure, admissible_shear, pressure, residuals
from fem_reference.contact import increment_report
from fem_reference.elasticity import compliance
from fem_reference.elasticity.factored_section import FactoredSection
from fem_reference.elasticity.motion import TORSION
from semi_analytical import history, surface_tensile_stress
from semi_analytical.coupled import coupled_increment
from semi_analytical.increments import (
    energy,
    increment,
    stick_slip,
    tangential_solve,
)
from semi_analytical.increments import (
    tangential_state as sheared,
)
from semi_analytical.increments.tangential_state import (
    TangentialState,
    untouched_state,
)
from semi_analytical.influence.coefficients import Composite
from semi_analytical.model import ContactModel
from semi_analytical.stress import field
from verification.defects.defect import Defect, Replacement, Replacements, replaces

LESS = 1 - 1e-9


@replaces(coupled_increment, "solve_coupled_increment")
def _reversal_forgotten(
    whole: Any, model: Any, before: Any, normal: Any, tangential: Any, *rest: Any
) -> Any:
    last = None if before is None else before.sheared
    force = tangential.force
    if last is None or force is None or np.hypot(*force) >= LESS * np.hypot(*last.force):
        return whole(model, before, normal, tangential, *rest)
    blank = replace(last, displacement=0 * last.displacement, shift=np.zeros(2))
    before = replace(before, sheared=blank)
    return whole(model, before, normal, tangential, *rest)


def _zero_residuals(*names: str) -> Replacements:
    """Return a seeded defect by which the named residuals of the semi-analytical solver are always
    zero."""
    return tuple(Replacement(residuals, name, lambda *given: 0.0) for name in names)


NO_CONTACT_RESIDUALS = _zero_residuals("complementarity", "penetration")
NO_FRICTION_RESIDUALS = _zero_residuals("friction_cone", "slip_direction")


@replaces(history, "_reported_increment")
def _approach_when_unloading(whole: Any, model: Any, before: Any, *rest: Any, **named: Any) -> Any:
    increment = whole(model, before, *rest, **named)
    falls = before is not None and increment.normal_force < LESS * before.normal_force
    return replace(increment, approach=0.95 * increment.approach) if falls else increment


def _scaled_slip_increase(name: str, factor: float) -> Replacements:
    """Return a seeded defect: an increment adds a wrong amount to a field that accumulates slip.

    name    field of the tangential state, such as "dissipation" or "slip_distance"
    factor  factor of the amount that an increment adds; 1 is correct
    """

    @replaces(stick_slip, "end_state")
    def advanced(whole: Any, model: Any, pressure: Any, bound: Any, last: Any, *rest: Any) -> Any:
        after = whole(model, pressure, bound, last, *rest)
        start = getattr(last, name)
        return replace(after, **{name: start + factor * (getattr(after, name) - start)})

    return advanced


@replaces(coupled_increment._Trial, "_tangential_state")
def _loss_with_coupling(whole: Any, self: Any, *given: Any) -> Any:
    after, last = whole(self, *given), self.last
    if after.dissipated_energy is None:
        return after
    lost = after.dissipated_energy - last.dissipated_energy
    return replace(after, dissipated_energy=last.dissipated_energy + 1.01 * lost)


@replaces(ContactModel, "friction")
def _map_transposed(whole: Any, self: Any) -> Any:
    friction = whole(self)
    if friction.coefficient_map is None:
        return friction
    turned = {"map": friction.coefficient_map.map.values.T, "spacing": self.grid.spacing}
    return CoulombFriction.model_validate({"coefficient": turned})


@replaces(increment_report, "_elastic_energy")
def _stored_by_elements(whole: Any, *given: Any) -> Any:
    return 1.05 * whole(*given)


@replaces(ring_increment, "input_work")
def _work_on_elements(whole: Any, before: Any, increment: Any) -> Any:
    work, start = whole(before, increment), before.trapezoidal_work if before else 0.0
    return None if work is None else start + 0.8 * (work - start)


@replaces(rig, "add_contact_displacements")
def _energy_of_springs(whole: Any, increment: Any, given: Any) -> Any:
    found, (_, along) = whole(increment, given), rig.compliances(given)
    force = increment.tangential_force
    if not along or force is None or increment.elastic_energy is None:
        return found
    stored = increment.elastic_energy + 0.5 * along * float(np.dot(force, force))
    return replace(found, elastic_energy=stored)


@replaces(rig, "add_contact_displacements")
def _shift_of_actuator(whole: Any, increment: Any, given: Any) -> Any:
    return replace(whole(increment, given), tangential_shift=increment.tangential_shift)


@replaces(loop, "_components_along")
def _contact_for_actuator(whole: Any, path: Any, name: str, direction: Any) -> Any:
    return whole(path, name.replace("actuator", "tangential"), direction)


HISTORIES = (
    Defect(
        "spring-energy",
        "The energy of a rig's springs is added to that of the bodies.",
        ("series_spring",),
        _energy_of_springs,
    ),
    Defect(
        "actuator-shift",
        "The shift of the actuator is returned as that of the contact.",
        ("series_spring",),
        _shift_of_actuator,
    ),
    Defect(
        "contact-for-actuator",
        "The shift δ* of a loop is that of the contact instead of the actuator.",
        ("series_spring",),
        _contact_for_actuator,
    ),
    Defect(
        "strain-work",
        "The work of a bulk strain is omitted from the energy balance.",
        ("eccentric_contact",),
        replaces(sheared, "strain_moments")(lambda whole, *given: np.zeros(3)),
    ),
    Defect(
        "reversal-forgotten",
        "Coupled bodies lose their tangential displacement when the tangential force is reversed.",
        ("coupled_history",),
        _reversal_forgotten,
    ),
    Defect(
        "limit-by-direction",
        "The friction limit is 1 % smaller along y, and its residuals are zero.",
        ("same_surface",),
        replaces(admissible_shear, "magnitude")(
            lambda whole, v: whole(np.stack([v[0], 1.01 * v[1]]))
        )
        + NO_FRICTION_RESIDUALS,
    ),
    Defect(
        "approach-when-unloading",
        "The approach is 5 % too small while the force falls.",
        ("led_histories",),
        _approach_when_unloading,
    ),
    Defect(
        "dissipation-map",
        "The map of the dissipated energy is 5 % too large, its sum is not.",
        ("led_histories",),
        _scaled_slip_increase("dissipation", 1.05),
    ),
    Defect(
        "slip-before-touch",
        "Slip is counted from the start of the increment instead of first contact.",
        ("coupled_history",),
        replaces(stick_slip, "touching_share")(lambda whole, *given: 1.0),
    ),
    Defect(
        "way-slipped",
        "The accumulated slip is doubled.",
        ("led_histories",),
        _scaled_slip_increase("slip_distance", 2.0),
    ),
    Defect(
        "loss-with-coupling",
        "The dissipated energy of coupled bodies is 1 % too large.",
        ("coupled_history",),
        _loss_with_coupling,
    ),
    Defect(
        "friction-map-transposed",
        "The map of friction is transposed.",
        ("same_surface",),
        _map_transposed,
    ),
    Defect(
        "elements-stored-energy",
        "The elastic energy by finite elements is 5 % too large.",
        ("led_histories",),
        _stored_by_elements,
    ),
    Defect(
        "elements-work",
        "The input work by finite elements is 20 % too small.",
        ("fem_partial_slip",),
        _work_on_elements,
    ),
)


@replaces(stick_slip, "slip_and_stick")
def _history_dropped(whole: Any, model: Any, pressure: Any, last: Any, *rest: Any) -> Any:
    return whole(model, pressure, untouched_state(model.grid.cells), *rest)


@replaces(stick_slip, "end_state")
def _slip_reversed(whole: Any, model: Any, pressure: Any, bound: Any, last: Any, *rest: Any) -> Any:
    after = whole(model, pressure, bound, last, *rest)
    return replace(after, slip=2 * last.slip - after.slip)


@replaces(ContactModel, "from_scene")
def _deep_gap(whole: Any, *given: Any, **more: Any) -> Any:
    model = whole(*given, **more)
    model.gap = 1.003 * model.gap
    return model


@replaces(TangentialState, "__init__")
def _dissipation_halved(whole: Any, self: TangentialState, *given: Any, **named: Any) -> None:
    whole(self, *given, **named)
    if self.dissipated_energy is not None:
        object.__setattr__(self, "dissipated_energy", 0.5 * self.dissipated_energy)


@replaces(increment, "normal_target")
def _reduced_normal_force(whole: Any, *given: Any) -> Any:
    right = whole(*given)
    return right if right.force is None else replace(right, force=0.997 * right.force)


@replaces(field, "_checked_tractions")
def _shear_stress_sign(whole: Any, grid: Any, pressure: Any, shear: Any) -> Any:
    return whole(grid, pressure, None if shear is None else -shear)


def _wrong_stress(change: Callable[[Any], Any]) -> Replacements:
    """Return a seeded defect that changes the stress below the surface.

    change  function of the correct components (nz, 6, nx, ny) that returns the wrong ones
    """
    return (
        Replacement(
            field,
            "fields_by_level",
            lambda whole, *given: (
                replace(level, stress=change(level.stress)) for level in whole(*given)
            ),
        ),
    )


def _wrong_increments(change: Callable[[int], int]) -> Replacements:
    """Return a seeded defect: load steps have another number of increments than prescribed.

    change  function of the prescribed number of increments that returns the wrong number
    """

    @replaces(Scene, "load_path")
    def load_path(whole: Any, self: Scene) -> Any:
        return tuple(
            replace(ramp, increments=ramp.increments and change(ramp.increments))
            for ramp in whole(self)
        )

    return load_path


LOOP = ("fretting_loop",)

CONTACT_AND_FRICTION = (
    Defect(
        "gap-too-deep",
        "The undeformed gap is too deep by 0.3 %.",
        ("hertz_approach_control",),
        _deep_gap,
    ),
    Defect(
        "force-scaled",
        "The normal force of an increment is 0.3 % below the prescribed force.",
        ("led_histories",),
        _reduced_normal_force,
    ),
    Defect(
        "force-not-met",
        "Pressures add up to 0.1 % less than the normal force.",
        ("hertz_approach_control",),
        replaces(admissible_pressure, "admissible_pressure")(
            lambda whole, *given: 0.999 * whole(*given)
        ),
    ),
    Defect(
        "residual-zero-of-contact",
        "The residuals of contact are zero, and pressures are inaccurate.",
        # The repeated solves of an edge correction would make the pressure accurate again.
        ("hertz_approach_control",),
        replaces(pressure, "solve_pressure")(
            lambda whole, *given: whole(*given[:-1], max(given[-1], 1e-2))
        )
        + NO_CONTACT_RESIDUALS,
    ),
    Defect(
        "residual-zero-of-friction",
        "The residuals of friction are zero, and shears are inaccurate.",
        ("cattaneo_mindlin",),
        replaces(tangential_solve, "shear")(
            lambda whole, *given: whole(*given[:-1], max(given[-1], 3e-2))
        )
        + NO_FRICTION_RESIDUALS,
    ),
    Defect(
        "friction-root-two",
        "The friction coefficient is too large by √2.",
        ("cattaneo_mindlin", "near_sliding"),
        replaces(ContactModel, "friction")(
            lambda _, self: CoulombFriction(coefficient=np.sqrt(2) * self.scene.friction.largest)
        ),
    ),
    Defect(
        "history-dropped",
        "Every increment starts from surfaces without history.",
        LOOP,
        _history_dropped,
    ),
    Defect(
        "one-increment",
        "A load step has one increment, instead of the requested number.",
        ("led_histories",),
        _wrong_increments(lambda n: 1),
    ),
    Defect(
        "slip-reversed",
        "Slip is added up with the wrong sign.",
        ("cattaneo_mindlin",),
        _slip_reversed,
    ),
    Defect(
        "dissipation-halved",
        "Only half of the dissipated energy is counted.",
        LOOP,
        _dissipation_halved,
    ),
    Defect(
        "work-halved",
        "The work of the loads is halved.",
        LOOP,
        replaces(energy, "_load_work")(
            lambda whole, before, after: 0.5 * (whole(before, after) or 0.0)
        ),
    ),
    Defect(
        "tilt-axes",
        "Tilts about the two axes are exchanged.",
        ("tilted_punch", "eccentric_ball"),
        replaces(ContactModel, "arms")(lambda _, self: np.stack(self.grid.coordinates())),
    ),
    Defect(
        "twist-form",
        "The indenter twists as [y, x] instead of [-y, x].",
        ("torsion",),
        replaces(ContactModel, "rotation")(lambda _, self: np.stack(self.grid.coordinates()[::-1])),
    ),
    Defect(
        "slip-range",
        "The slip amplitude is the whole range of slip, not half of it.",
        LOOP,
        replaces(cycles, "_slip_amplitude")(lambda whole, slips: 2 * whole(slips)),
    ),
    Defect(
        "tension-across",
        "The tensile stress of Ruiz's parameter is taken across the tangential force.",
        LOOP,
        replaces(surface_tensile_stress, "_in_plane_stress")(
            lambda whole, *given: whole(*given)[[1, 0, 2]]
        ),
    ),
    Defect(
        "stress-by-shear-sign",
        "Stress below the surface is that of the reversed shear.",
        ("subsurface_stress",),
        _shear_stress_sign,
    ),
    Defect(
        "stress-planes-exchanged",
        "Below the surface σ_yz and σ_xz are exchanged.",
        ("subsurface_stress",),
        _wrong_stress(lambda stress: stress[:, [0, 1, 2, 4, 3, 5]]),
    ),
    Defect(
        "in-plane-shear-halved",
        "Below the surface σ_xy is halved.",
        ("subsurface_stress",),
        _wrong_stress(lambda stress: np.concatenate([stress[:, :5], 0.5 * stress[:, 5:]], axis=1)),
    ),
)


@replaces(Composite, "_combined")
def _indenter_couples_as_the_body(whole: Any, self: Composite, component: str) -> Any:
    right = whole(self, component)
    return right if self.lower or component not in ("zx", "zy") else -right


@replaces(compliance, "composite")
def _indenter_couples_in_elements(whole: Any, lower: Any, upper: Any, motion: Any) -> Any:
    return whole(lower, upper, motion) if lower else whole(upper, None, motion)


@replaces(axisymmetric, "coupling", local=True)
def _elements_look_at_bases(whole: Any, scene: Scene) -> Any:
    """Plant a wrong test of elastic coupling of bodies of revolution, which ignores the coating.

    A coated indenter on a body of its base material is then treated as equal to the body. Equal
    bodies have no coupling of pressure and shear.
    """
    body, indenter = scene.body, scene.indenter
    if indenter.layers and not body.layers and body.material == indenter.material:
        return False, "the bases are alike"
    return whole(scene)


@replaces(ContactModel, "arms")
def _no_tilt_about_y(_: Any, self: ContactModel) -> Any:
    x, y = self.grid.coordinates()
    return np.stack([y, 0 * x])


def _wrong_start_of_step(kind: ControlKind) -> Replacements:
    """Return a seeded defect: the ramp of a load step starts at a value 2 % above that of the
    preceding step.

    kind  affected load steps: those that prescribe a force, or those that prescribe a displacement
    """

    @replaces(Control, "prescribed")
    def prescribed(whole: Any, self: Control[Any], fraction: float, reached: Any) -> Any:
        if self.kind is kind and isinstance(self.end, float):
            force, displacement = reached
            reached = 1.02 * force, 1.02 * displacement
        return whole(self, fraction, reached)

    return prescribed


@replaces(FactoredSection, "_far_displacements")
def _torque_far_away(whole: Any, self: FactoredSection, basis: Any) -> Any:
    return (0.5 if self.motion == TORSION else 1.0) * whole(self, basis)


@replaces(HeightMap, "initial_gap")
def _half_a_cell_off(whole: Any, self: HeightMap, x: Any, y: Any) -> Any:
    reach = 0.5 * (self.extent[0] - self.spacing[0])
    return whole(self, np.minimum(np.asarray(x) + 0.5 * self.spacing[0], reach), y)


CONTROLS_AND_BODIES = (
    Defect(
        "coupling-of-the-indenter",
        "A deformable indenter on a rigid body has the coupling of a lower body.",
        ("exchanged_bodies",),
        _indenter_couples_as_the_body,
    ),
    Defect(
        "fe-coupling-of-the-indenter",
        "In finite elements a deformable indenter on a rigid body "
        "has the coupling of a lower body.",
        ("exchanged_bodies",),
        _indenter_couples_in_elements,
    ),
    Defect(
        "fe-coated-indenter-uncoupled",
        "Finite elements and radial treat a coated indenter on a body of its base material as "
        "equal bodies.",
        ("exchanged_bodies",),
        _elements_look_at_bases,
    ),
    Defect(
        "tilt-about-y",
        "A tilt about y has no effect.",
        ("tilted_punch", "eccentric_ball"),
        _no_tilt_about_y,
    ),
    Defect(
        "approach-taken-over",
        "A step of prescribed approach starts at an approach 2 % above "
        "the end of the force step before it.",
        ("led_histories",),
        _wrong_start_of_step(ControlKind.DISPLACEMENT),
    ),
    Defect(
        "force-taken-over",
        "A step of prescribed force starts at a force 2 % above the end of "
        "the approach step before it.",
        ("led_histories",),
        _wrong_start_of_step(ControlKind.FORCE),
    ),
    Defect(
        "torque-far-field",
        "The far-field rotation by a torque is halved.",
        ("fem_far_field",),
        _torque_far_away,
    ),
    Defect(
        "heights-half-a-cell-off",
        "A map of heights is shifted by half a spacing.",
        ("same_surface",),
        _half_a_cell_off,
    ),
    Defect(
        "increments-halved",
        "A step has half of its prescribed increments.",
        ("led_histories",),
        _wrong_increments(lambda n: -(-n // 2)),
    ),
)
