"""Defects of contact, friction, history and report, in the semi-analytical method."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from contact_results import cycles
from contact_scene import CoulombFriction
from contact_scene.stepping import load_stepping
from semi_analytical import (
    residuals,
    surface_tensile_stress,
)
from semi_analytical.increments import (
    energy,
    increment,
    stick_slip,
    tangential_solve,
)
from semi_analytical.increments.tangential_state import (
    TangentialState,
    untouched,
)
from semi_analytical.model import ContactModel
from semi_analytical.normal import normal_problem
from semi_analytical.normal.normal_load import PressureSum
from semi_analytical.stress import field
from verification.defects.defect import Defect, Patches


def _friction(patches: Patches) -> None:
    patches.attribute(
        ContactModel,
        "friction",
        property(
            lambda self: CoulombFriction(coefficient=np.sqrt(2) * self.scene.friction.largest)
        ),
    )


def _forgetful(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def slip_and_stick(model: Any, pressure: Any, last: Any, *rest: Any) -> Any:
            return whole(model, pressure, untouched(model.grid.cells), *rest)

        return slip_and_stick

    patches.function(stick_slip, "slip_and_stick", wrap)


def _slip_reversed(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def advanced(model: Any, pressure: Any, bound: Any, last: Any, *rest: Any) -> Any:
            after = whole(model, pressure, bound, last, *rest)
            return replace(after, slip=2 * last.slip - after.slip)

        return advanced

    patches.function(stick_slip, "advanced", wrap)


def _deeper(patches: Patches) -> None:
    whole = vars(ContactModel)["of"].__func__

    def of(cls: Any, *given: Any, **more: Any) -> Any:
        model = whole(cls, *given, **more)
        model.gap = 1.003 * model.gap
        return model

    patches.attribute(ContactModel, "of", classmethod(of))


def _cold(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def cold(self: TangentialState, *given: Any, **named: Any) -> None:
            whole(self, *given, **named)
            if self.dissipated_energy is not None:
                object.__setattr__(self, "dissipated_energy", 0.5 * self.dissipated_energy)

        return cold

    patches.method(TangentialState, "__init__", wrap)


def _half_work(patches: Patches) -> None:
    patches.function(
        energy,
        "_work",
        lambda whole: lambda before, after: 0.5 * (whole(before, after) or 0.0),
    )


def _lighter(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def target(*given: Any) -> Any:
            right = whole(*given)
            return right if right.force is None else replace(right, force=0.997 * right.force)

        return target

    patches.function(increment, "normal_target", wrap)


def _force_not_met(patches: Patches) -> None:
    patches.method(
        PressureSum,
        "admissible",
        lambda whole: lambda self, p: whole(replace(self, total=0.999 * self.total), p),
    )


def _blind(patches: Patches) -> None:
    """Pressures are found to 1 %, and nobody notices."""
    for name in ("complementarity", "penetration"):
        patches.function(residuals, name, lambda whole: lambda *given: 0.0)
    patches.function(
        normal_problem,
        "solve_normal",
        lambda whole: lambda *given: whole(*given[:-1], max(given[-1], 1e-2)),
    )


def _blind_to_friction(patches: Patches) -> None:
    """Shears are found to 3 %, and nobody notices."""
    for name in ("friction_cone", "slip_direction"):
        patches.function(residuals, name, lambda whole: lambda *given: 0.0)
    patches.function(
        tangential_solve,
        "shear",
        lambda whole: lambda *given: whole(*given[:-1], max(given[-1], 3e-2)),
    )


def _few_increments(patches: Patches) -> None:
    patches.function(load_stepping, "fractions", lambda whole: lambda *given: whole(*given)[-1:])


def _arms_exchanged(patches: Patches) -> None:
    patches.attribute(
        ContactModel, "arms", property(lambda self: np.stack(self.grid.coordinates()))
    )


def _twist_not_conjugate(patches: Patches) -> None:
    patches.attribute(
        ContactModel, "rotation", property(lambda self: np.stack(self.grid.coordinates()[::-1]))
    )


def _whole_range(patches: Patches) -> None:
    patches.function(cycles, "_half_diameter", lambda whole: lambda path: 2 * whole(path))


def _tension_across(patches: Patches) -> None:
    patches.function(
        surface_tensile_stress,
        "_in_plane_stress",
        lambda whole: lambda *given: whole(*given)[[1, 0, 2]],
    )


def _shear_stress_sign(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def tractions(grid: Any, pressure: Any, shear: Any) -> Any:
            return whole(grid, pressure, None if shear is None else -shear)

        return tractions

    patches.function(field, "_tractions", wrap)


def _stress(patches: Patches, change: Callable[[Any], Any]) -> None:
    """Change the components of stress (nz, 6, nx, ny) below the surface."""
    patches.function(
        field,
        "fields_by_level",
        lambda whole: (
            lambda *given: (replace(level, stress=change(level.stress)) for level in whole(*given))
        ),
    )


def _planes_exchanged(stress: Any) -> Any:
    return stress[:, [0, 1, 2, 4, 3, 5]]


def _in_plane_halved(stress: Any) -> Any:
    return np.concatenate([stress[:, :5], 0.5 * stress[:, 5:]], axis=1)


LOOP = ("fretting_loop",)

CONTACT_AND_FRICTION = (
    Defect(
        "gap-too-deep", "The undeformed gap is too deep by 0.3 %.",
        ("dissimilar_bodies", "hertz_approach_control"), _deeper,
    ),
    Defect(
        "force-scaled", "The normal force that is led to is 0.3 % below the one prescribed.",
        ("dissimilar_bodies",), _lighter,
    ),
    Defect(
        "force-not-met", "Pressures add up to 0.1 % less than the normal force.",
        ("dissimilar_bodies",), _force_not_met,
    ),
    Defect(
        "residual-zero-of-contact", "The residuals of contact are always zero, pressures rough.",
        # Where edges are corrected, the repeated solves leave no rough pressure.
        ("hertz_approach_control",), _blind,
    ),
    Defect(
        "residual-zero-of-friction", "The residuals of friction are always zero, shears rough.",
        ("cattaneo_mindlin",), _blind_to_friction,
    ),
    Defect(
        "friction-root-two", "The friction coefficient is too large by √2.",
        ("cattaneo_mindlin", "near_sliding"), _friction,
    ),
    Defect(
        "history-dropped", "Every increment starts from surfaces that remember nothing.",
        LOOP, _forgetful,
    ),
    Defect(
        "one-increment", "A loading step takes one increment, whatever is asked for.",
        ("goodman_indentation",), _few_increments,
    ),
    Defect(
        "slip-reversed", "Slip is added up with the wrong sign.",
        ("cattaneo_mindlin",), _slip_reversed,
    ),
    Defect(
        "dissipation-halved", "Only half of the energy that friction takes is counted.",
        LOOP, _cold,
    ),
    Defect(
        "work-halved", "The work of the loads is half of what it is.", LOOP, _half_work,
    ),
    Defect(
        "tilt-axes", "Tilts about the two axes are exchanged.",
        ("tilted_punch", "eccentric_ball"), _arms_exchanged,
    ),
    Defect(
        "twist-form", "The indenter twists as [y, x] instead of [-y, x].",
        ("torsion",), _twist_not_conjugate,
    ),
    Defect(
        "slip-range", "The slip amplitude is the whole range of slip, not half of it.",
        LOOP, _whole_range,
    ),
    Defect(
        "tension-across", "Ruiz's tension is taken across the tangential force.",
        LOOP, _tension_across,
    ),
    Defect(
        "stress-by-shear-sign", "Stress below the surface is that of the reversed shear.",
        ("subsurface_stress",), _shear_stress_sign,
    ),
    Defect(
        "stress-planes-exchanged", "Below the surface σ_yz and σ_xz are exchanged.",
        ("subsurface_stress",), lambda patches: _stress(patches, _planes_exchanged),
    ),
    Defect(
        "in-plane-shear-halved", "Below the surface σ_xy is half of what it is.",
        ("subsurface_stress",), lambda patches: _stress(patches, _in_plane_halved),
    ),
)  # fmt: skip
