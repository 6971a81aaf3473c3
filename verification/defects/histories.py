"""Defects that show only where a history turns, unloads, or leaves the x axis, and of what is told
beside tractions and motions."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

import fem_reference.energy
from contact_scene import CoulombFriction, bulk_strain, rig
from contact_scene.friction import FRICTIONLESS
from semi_analytical import (
    history,
    residuals,
)
from semi_analytical.coupled import coupled_increment
from semi_analytical.increments import (
    stick_slip,
)
from semi_analytical.increments import (
    tangential_state as sheared,
)
from semi_analytical.model import ContactModel
from semi_analytical.tangential import admissible_shear
from verification.defects.defect import Defect, Patches

LESS = 1 - 1e-9


def _reversal_forgotten(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def forgetting(model: Any, before: Any, normal: Any, tangential: Any, *rest: Any) -> Any:
            last = None if before is None else before.sheared
            force = tangential.force
            if last is None or force is None or np.hypot(*force) >= LESS * np.hypot(*last.force):
                return whole(model, before, normal, tangential, *rest)
            blank = replace(last, displacement=0 * last.displacement, shift=np.zeros(2))
            before = replace(before, sheared=blank)
            return whole(model, before, normal, tangential, *rest)

        return forgetting

    patches.function(coupled_increment, "solve_coupled_increment", wrap)


def _limit_by_direction(patches: Patches) -> None:
    """The limit is an ellipse, and the residuals know no better."""
    patches.function(
        admissible_shear, "magnitude", lambda whole: lambda v: whole(np.stack([v[0], 1.01 * v[1]]))
    )
    for name in ("friction_cone", "slip_direction"):
        patches.function(residuals, name, lambda whole: lambda *given: 0.0)


def _approach_when_unloading(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def told(model: Any, before: Any, state: Any, *place: Any) -> Any:
            increment = whole(model, before, state, *place)
            falls = before is not None and state.normal_force < LESS * before.normal_force
            return replace(increment, approach=0.95 * increment.approach) if falls else increment

        return told

    patches.function(history, "_increment", wrap)


def _grown(patches: Patches, name: str, factor: float) -> None:
    """What slip adds to a field is multiplied."""

    def wrap(whole: Any) -> Any:
        def advanced(model: Any, pressure: Any, bound: Any, last: Any, *rest: Any) -> Any:
            after = whole(model, pressure, bound, last, *rest)
            start = getattr(last, name)
            return replace(after, **{name: start + factor * (getattr(after, name) - start)})

        return advanced

    patches.function(stick_slip, "advanced", wrap)


def _dissipation_map(patches: Patches) -> None:
    _grown(patches, "dissipation", 1.05)


def _way_slipped(patches: Patches) -> None:
    _grown(patches, "slip_distance", 2.0)


def _before_touch(patches: Patches) -> None:
    patches.function(stick_slip, "touching_share", lambda whole: lambda *given: 1.0)


def _loss_with_coupling(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def sheared(self: Any, *given: Any) -> Any:
            after, last = whole(self, *given), self.last
            if after.dissipated_energy is None:
                return after
            lost = after.dissipated_energy - last.dissipated_energy
            return replace(after, dissipated_energy=last.dissipated_energy + 1.01 * lost)

        return sheared

    patches.method(coupled_increment._Trial, "_sheared", wrap)


def _map_transposed(patches: Patches) -> None:
    def transposed(self: Any) -> Any:
        friction = (self.scene.friction or FRICTIONLESS).on(self.grid.cells, self.grid.spacing)
        if friction.varying is None:
            return friction
        turned = {"map": friction.varying.map.values.T, "spacing": self.grid.spacing}
        return CoulombFriction.model_validate({"coefficient": turned})

    patches.attribute(ContactModel, "friction", property(transposed))


def _stored_by_elements(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def stored(*given: Any) -> Any:
            energy = whole(*given)
            return None if energy is None else 1.05 * energy

        return stored

    patches.function(fem_reference.energy, "elastic_energy", wrap)


def _work_on_elements(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def worked(before: Any, increment: Any) -> Any:
            work, start = whole(before, increment), before.trapezoidal_work if before else 0.0
            return None if work is None else start + 0.8 * (work - start)

        return worked

    patches.function(fem_reference.energy, "input_work", wrap)


def _energy_of_springs(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def told(increment: Any, given: Any) -> Any:
            found, (_, along) = whole(increment, given), rig.compliances(given)
            force = increment.tangential_force
            if not along or force is None or increment.elastic_energy is None:
                return found
            stored = increment.elastic_energy + 0.5 * along * float(np.dot(force, force))
            return replace(found, elastic_energy=stored)

        return told

    patches.function(rig, "of_contact", wrap)


def _shift_of_actuator(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def told(increment: Any, given: Any) -> Any:
            return replace(whole(increment, given), tangential_shift=increment.tangential_shift)

        return told

    patches.function(rig, "of_contact", wrap)


def _work_of_strain(patches: Patches) -> None:
    patches.function(sheared, "strain_moments", lambda whole: lambda *given: np.zeros(3))


def _strain_of_wrong_layer(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        return lambda strain, body, layer: whole(strain, body, len(body.layers) - layer)

    patches.function(bulk_strain, "stress_by", wrap)


HISTORIES = (
    Defect(
        "spring-energy", "The energy of a rig's springs is counted as that of the bodies.",
        ("series_spring",), _energy_of_springs,
    ),
    Defect(
        "actuator-shift", "The shift of the actuator is told for that of the contact.",
        ("series_spring",), _shift_of_actuator,
    ),
    Defect(
        "strain-work", "The work of a bulk strain is left out of the balance.",
        ("eccentric_contact",), _work_of_strain,
    ),
    Defect(
        "strain-of-wrong-layer", "The stress by a bulk strain is that of another layer.",
        ("strained_ball",), _strain_of_wrong_layer,
    ),
    Defect(
        "reversal-forgotten", "Coupled bodies forget where they were when the shear turns back.",
        ("coupled_history",), _reversal_forgotten,
    ),
    Defect(
        "limit-by-direction", "Friction carries 1 % less along y, and its residuals are zero.",
        ("load_paths",), _limit_by_direction,
    ),
    Defect(
        "approach-when-unloading", "The approach is told 5 % too small while the force falls.",
        ("hertz_unloading",), _approach_when_unloading,
    ),
    Defect(
        "dissipation-map", "The map of the energy lost is 5 % too large, its sum is not.",
        ("load_paths",), _dissipation_map,
    ),
    Defect(
        "slip-before-touch", "Slip counts from the start of the increment, not from the touch.",
        ("coupled_history",), _before_touch,
    ),
    Defect("way-slipped", "The way slipped is twice what it is.", ("load_paths",), _way_slipped),
    Defect(
        "loss-with-coupling", "Coupled bodies tell 1 % too much of the energy lost.",
        ("coupled_history",), _loss_with_coupling,
    ),
    Defect(
        "friction-map-transposed", "The map of friction is transposed.",
        ("same_surface",), _map_transposed,
    ),
    Defect(
        "elements-stored-energy", "Finite elements tell 5 % too much of the energy stored.",
        ("hertz_unloading",), _stored_by_elements,
    ),
    Defect(
        "elements-work", "Finite elements tell 20 % too little of the work put in.",
        ("fem_partial_slip",), _work_on_elements,
    ),
)  # fmt: skip
