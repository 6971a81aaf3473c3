"""Defects of what leads the indenter, of which body deforms, and of what is far away."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from typing import Any

import numpy as np

from contact_scene import HeightMap, Scene
from contact_scene.stepping.load_path import (
    Control,
    ControlKind,
)
from fem_reference.elasticity import compliance
from fem_reference.elasticity.factored_section import FactoredSection
from fem_reference.elasticity.motion import TORSION
from semi_analytical.influence.coefficients import Composite
from semi_analytical.model import ContactModel
from verification.defects.defect import Defect, Patches


def _indenter_couples_as_the_body(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def mirrored(self: Composite, component: str) -> Any:
            right = whole(self, component)
            return right if self.lower else -right

        return mirrored

    patches.method(Composite, "_mirrored", wrap)


def _indenter_couples_in_elements(patches: Patches) -> None:
    patches.function(
        compliance,
        "composite",
        lambda whole: (
            lambda lower, upper, motion: (
                whole(lower, upper, motion) if lower else whole(upper, None, motion)
            )
        ),
    )


def _elements_look_at_bases(patches: Patches) -> None:
    """Of a coated indenter finite elements see the base alone."""
    plan = import_module("fem_reference.plan")  # its function of this name hides it
    whole = plan.coupling

    def coupling(scene: Scene) -> tuple[bool, str]:
        body, indenter = scene.body, scene.indenter
        if indenter.layers and not body.layers and body.material == indenter.material:
            return False, "the bases are alike"
        decided: tuple[bool, str] = whole(scene)
        return decided

    patches.attribute(plan, "coupling", coupling)


def _no_tilt_about_y(patches: Patches) -> None:
    def arms(self: ContactModel) -> Any:
        x, y = self.grid.coordinates()
        return np.stack([y, 0 * x])

    patches.attribute(ContactModel, "arms", property(arms))


def _taken_over(patches: Patches, kind: ControlKind) -> None:
    """A step that takes over from the other control begins 2 % beside where that ended."""

    def wrap(whole: Any) -> Any:
        def led(self: Control[Any], fraction: float, reached: Any) -> Any:
            if self.kind is kind and isinstance(self.end, float):
                force, displacement = reached
                reached = 1.02 * force, 1.02 * displacement
            return whole(self, fraction, reached)

        return led

    patches.method(Control, "led", wrap)


def _torque_far_away(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def prescribed(self: FactoredSection, basis: Any) -> Any:
            return (0.5 if self.motion == TORSION else 1.0) * whole(self, basis)

        return prescribed

    patches.method(FactoredSection, "_prescribed", wrap)


def _half_a_cell_off(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def gap(self: HeightMap, x: Any, y: Any) -> Any:
            reach = 0.5 * (self.extent[0] - self.spacing[0])
            return whole(self, np.minimum(np.asarray(x) + 0.5 * self.spacing[0], reach), y)

        return gap

    patches.method(HeightMap, "initial_gap", wrap)


def _fewer_increments(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def path(self: Scene) -> Any:
            return tuple(
                replace(ramp, increments=ramp.increments and -(-ramp.increments // 2))
                for ramp in whole(self)
            )

        return path

    patches.method(Scene, "load_path", wrap)


CONTROLS_AND_BODIES = (
    Defect(
        "coupling-of-the-indenter", "A deformable indenter on a rigid body couples as if it lay "
        "below.", ("exchanged_bodies",), _indenter_couples_as_the_body,
    ),
    Defect(
        "fe-coupling-of-the-indenter", "In finite elements a deformable indenter on a rigid body "
        "couples as if it lay below.", ("exchanged_bodies",), _indenter_couples_in_elements,
    ),
    Defect(
        "fe-coated-indenter-uncoupled", "Finite elements take a coated indenter on a body of its "
        "base for alike bodies.", ("exchanged_bodies",), _elements_look_at_bases,
    ),
    Defect(
        "tilt-about-y", "A tilt about y changes nothing.", ("tilted_punch", "eccentric_ball"),
        _no_tilt_about_y,
    ),
    Defect(
        "approach-taken-over", "A step of approach begins 2 % deeper than the force before it "
        "pressed.", ("led_histories",),
        lambda patches: _taken_over(patches, ControlKind.DISPLACEMENT),
    ),
    Defect(
        "force-taken-over", "A step of force begins 2 % above the force that the approach before "
        "it took.", ("led_histories",), lambda patches: _taken_over(patches, ControlKind.FORCE),
    ),
    Defect(
        "torque-far-field", "Far away a torque turns the bodies half as much as it does.",
        ("fem_far_field",), _torque_far_away,
    ),
    Defect(
        "heights-half-a-cell-off", "A map of heights is read half a spacing beside its place.",
        ("same_surface",), _half_a_cell_off,
    ),
    Defect(
        "increments-halved", "A step takes half of the increments that it names.",
        ("led_histories",), _fewer_increments,
    ),
)  # fmt: skip
