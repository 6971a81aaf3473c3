"""Seeded defects of the finite-element solver and of the radial solver."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

import radial
from contact_scene import CoulombFriction
from fem_reference.compliance import ring_compliance
from fem_reference.contact import increment
from fem_reference.contact.augmented_lagrangian import Penalty
from fem_reference.contact.natural_map import Equations
from fem_reference.elasticity import compliance, hat_functions, section_basis, weak_form
from fem_reference.elasticity.factored_section import FactoredSection
from fem_reference.model import ContactModel
from radial.frictional.coupling import Coupling
from verification.defects.defect import Defect, Patches

# Inward displacement of surface points in a Hertz contact of the paper's data, over their radius:
# (1-2ν)(1+ν) p₀/2E.
DRAWN_IN = 4e-3


def _weight_of_element(patches: Patches) -> None:
    """Plant an error in the finite-element weak form: energies have the weight of the element's
    centre.

    The correct weight is the radius of each integration point.
    """

    def wrap(whole: Any) -> Any:
        def basis(section: Any, *more: Any) -> Any:
            right = whole(section, *more)
            corners = section.points[0, section.quads]
            r = np.asarray(right.global_coordinates())[0]
            right.dx = right.dx / r * corners.mean(axis=0)[:, None]
            return right

        return basis

    patches.function(section_basis, "displacement_basis", wrap)


def _resultant_weight(patches: Patches) -> None:
    """Plant an error in the resultant force: each ring of finite elements is weighted by its outer
    radius.
    """

    def wrap(whole: Any) -> Any:
        def on(nodes: Any, reach: float = np.inf) -> Any:
            right = whole(nodes, reach)
            lengths = np.zeros_like(right.radii)
            lengths[:-1] += np.diff(right.radii) / 2
            lengths[1:] += np.diff(right.radii) / 2
            return replace(right, weights=lengths * (right.radii + lengths / 2))

        return on

    patches.function(hat_functions, "hats_on", wrap)


def _circumferential_shear(patches: Patches) -> None:
    def along(model: Any) -> Any:
        C = model.compliance(1).matrix
        return 0.5 * (C[0, :, 0] + C[0, :, 1] + C[1, :, 0] + C[1, :, 1])

    patches.attribute(ContactModel, "along_load", along)


def _hoop_strain(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def strains(u: Any, component: int, n: int) -> Any:
            right = whole(u, component, n)
            return {k: e for k, e in right.items() if (component, k) != (1, "tt")}

        return strains

    patches.function(weak_form, "strains", wrap)


def _no_far_field(patches: Patches) -> None:
    patches.attribute(
        FactoredSection, "_prescribed", lambda self, basis: np.zeros(self._numbering.size)
    )


def _deformed_radius(patches: Patches) -> None:
    patches.method(
        ContactModel, "gap", lambda whole: lambda self, r: whole(self, (1 - DRAWN_IN) * r)
    )


def _upper_body_rigid(patches: Patches) -> None:
    patches.function(
        compliance,
        "composite",
        lambda whole: lambda lower, upper, motion: whole(lower, None if lower else upper, motion),
    )


def _coupling(patches: Patches, factor: float) -> None:
    def wrap(whole: Any) -> Any:
        def compliance(*given: Any, **more: Any) -> Any:
            right = whole(*given, **more)
            for A in right.harmonics:
                A[:2, :, 2] *= factor
                A[2, :, :2] *= factor
            return right

        return compliance

    patches.function(ring_compliance, "ring_compliance", wrap)


def _friction(patches: Patches) -> None:
    whole = ContactModel.friction.fget  # type: ignore[attr-defined]

    def rougher(self: ContactModel) -> CoulombFriction:
        return CoulombFriction(coefficient=np.sqrt(2) * whole(self).largest)

    patches.attribute(ContactModel, "friction", property(rougher))


def _forgetful(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def advance(contact: Any, before: Any, *more: Any) -> Any:
            if before is not None:
                first = contact.untouched()
                forgotten = {
                    name: getattr(first, name)
                    for name in ("shear", "displacement", "slip", "motion", "dissipated_energy")
                }
                before = replace(before, **forgotten)
            return whole(contact, before, *more)

        return advance

    patches.function(increment, "advance", wrap)


def _slip_reversed(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def state(self: Any, passes: Any) -> Any:
            after, energy = whole(self, passes), self.before.dissipated_energy
            return replace(after, dissipated_energy=2 * energy - after.dissipated_energy)

        return state

    patches.method(increment._Increment, "state", wrap)


class _Level(CoulombFriction):
    """Coulomb friction law with a wrong derivative: that of the friction limit by the pressure is
    zero.

    Plants the defect of an inconsistent tangent in the penalty method.
    """

    def slope(self, *given: Any, **more: Any) -> Any:
        return 0.0 * super().slope(*given, **more)


def _tangent(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def linearised(self: Equations, at: Any) -> Any:
            level = _Level(coefficient=self.problem.friction.coefficient)
            wrong = Equations(replace(self.problem, friction=level))
            return whole(wrong, at)

        return linearised

    patches.method(Equations, "linearised", wrap)


def _soft(patches: Patches) -> None:
    patches.method(
        Penalty, "stiffness", lambda whole: lambda self, *given: 0.1 * whole(self, *given)
    )


def _not_augmented(patches: Patches) -> None:
    patches.attribute(increment._Increment, "again", lambda self, last: last)


FINITE_ELEMENTS = (
    Defect(
        "fe-weight", "Energies are weighted by the radius of the element's middle, not of the "
        "point.", ("fem_hertz",), _weight_of_element,
    ),
    Defect(
        "fe-resultant-weight", "The weight of a ring in the load is taken at its outer radius.",
        ("fem_hertz",), _resultant_weight,
    ),
    Defect(
        "fe-circumferential-sign", "The circumferential shear of a tangential load has the wrong "
        "sign.", ("fem_partial_slip",), _circumferential_shear,
    ),
    Defect(
        "fe-hoop-strain", "The circumferential displacement is omitted from the hoop strain.",
        ("fem_partial_slip",), _hoop_strain,
    ),
    Defect(
        "fe-far-field", "The far field is omitted: the outer boundary of the section is fixed.",
        ("fem_hertz",), _no_far_field,
    ),
    Defect(
        "fe-deformed-radius", "The gap is taken at the deformed radius.", ("fem_hertz",),
        _deformed_radius,
    ),
    Defect(
        "fe-upper-body", "The compliance of the indenter is omitted.", ("fem_hertz",),
        _upper_body_rigid,
    ),
    Defect(
        "fe-coupling-sign", "Pressure moves the surface away from the axis.", ("fem_indentation",),
        lambda patches: _coupling(patches, -1.0),
    ),
    Defect(
        "fe-coupling-0p99", "The coupling of pressure and shear is too weak by 1 %.",
        ("fem_indentation", "fem_classical"), lambda patches: _coupling(patches, 0.99),
    ),
    Defect(
        "fe-friction-root-two", "The friction coefficient is too large by √2.",
        ("fem_partial_slip",), _friction,
    ),
    Defect(
        "fe-history-dropped", "Every increment starts from surfaces without history.",
        ("fem_partial_slip",), _forgetful,
    ),
    Defect(
        "fe-dissipation-sign", "The dissipated energy has the wrong sign.",
        ("fem_partial_slip",), _slip_reversed,
    ),
    Defect(
        "fe-penalty-tangent", "The tangent of slip lacks its dependence on the pressure.",
        ("fem_penalty_indentation",), _tangent,
    ),
    Defect(
        "fe-penalty-soft", "The penalty is a tenth of the stated penalty.",
        ("fem_penalty_hertz",), _soft,
    ),
    Defect(
        "fe-penalty-not-augmented", "Augmentations have no effect.", ("fem_penalty_hertz",),
        _not_augmented,
    ),
)  # fmt: skip


WEAKER = 0.99  # coupling of pressure and shear


def _returned(*names: str, factor: float) -> Callable[[Patches], None]:
    """Return a function that plants a wrong factor in the results of the radial solver.

    names   results of every increment that are multiplied, such as "pressure"
    factor  wrong factor; 1 is correct
    """

    def plant(patches: Patches) -> None:
        def wrap(whole: Any) -> Any:
            def solve(*given: Any, **named: Any) -> Any:
                result = whole(*given, **named)
                changed = (
                    replace(
                        increment,
                        **{
                            name: factor * value
                            for name in names
                            if (value := getattr(increment, name)) is not None
                        },
                    )
                    for increment in result.increments
                )
                return replace(result, increments=tuple(changed))

            return solve

        patches.function(radial, "solve", wrap)

    return plant


def _radii_friction(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def solve(scene: Any, *given: Any, **named: Any) -> Any:
            if scene.friction is None:
                return whole(scene, *given, **named)
            rougher = CoulombFriction(coefficient=np.sqrt(2) * scene.friction.largest)
            result = whole(scene.model_copy(update={"friction": rougher}), *given, **named)
            return replace(result, scene=scene)

        return solve

    patches.function(radial, "solve", wrap)


def _radii_coupling(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def response(self: Coupling, *given: Any) -> Any:
            right = whole(self, *given)
            return right._replace(zr=WEAKER * right.zr, rz=WEAKER * right.rz)

        return response

    patches.method(Coupling, "response", wrap)


RADII = (
    Defect(
        "radial-pressure", "The pressure that the radial solver returns is 0.5 % too large.",
        ("radial_tangential",), _returned("pressure", factor=1.005),
    ),
    Defect(
        "radial-shear", "The shear that the radial solver returns is 2 % too small.",
        ("radial_tangential",),
        _returned("shear_radial", "shear_circumferential", factor=0.98),
    ),
    Defect(
        "radial-slip-sign", "The slip that the radial solver returns has the wrong sign.",
        ("radial_tangential",),
        _returned("slip_radial", "slip_circumferential", factor=-1.0),
    ),
    Defect(
        "radial-elastic-energy", "The elastic energy that the radial solver returns is 1 % too "
        "large.", ("radial_tangential",), _returned("elastic_energy", factor=1.01),
    ),
    Defect(
        "radial-dissipated-energy", "The dissipated energy that the radial solver returns counts "
        "twice.", ("radial_tangential",), _returned("dissipated_energy", factor=2.0),
    ),
    Defect(
        "radial-friction-root-two", "The radial solver's friction coefficient is too large by √2.",
        ("radial_tangential",), _radii_friction,
    ),
    Defect(
        "radial-coupling-0p99", "The radial solver's coupling of pressure and shear is too weak by "
        "1 %.", ("radial_indentation",), _radii_coupling,
    ),
)  # fmt: skip
