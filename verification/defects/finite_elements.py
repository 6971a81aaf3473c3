"""Seeded defects of the finite-element solver and of the radial solver, to test the
verification."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

import radial
from contact_scene import CoulombFriction
from fem_reference.compliance import ring_compliance
from fem_reference.contact import increment
from fem_reference.contact.augmented_lagrangian import Penalty
from fem_reference.elasticity import compliance, hat_functions, section_basis, weak_form
from fem_reference.elasticity.factored_section import FactoredSection
from fem_reference.elasticity.motion import SHEARING
from fem_reference.model import ContactModel
from radial.frictional.coupling import Coupling
from verification.defects.defect import (
    Defect,
    Replacements,
    changed_results,
    replaces,
    scaled_increments,
)

# Inward displacement of surface points in a Hertz contact of the paper's data, over their radius:
# (1-2ν)(1+ν) p₀/2E.
DRAWN_IN = 4e-3


@replaces(section_basis, "displacement_basis")
def _weight_of_element(whole: Any, section: Any, *more: Any) -> Any:
    """Plant a wrong weight in the axisymmetric energies of the finite elements: the radius of the
    centre.

    The correct weight is the radius of each integration point.
    """
    right = whole(section, *more)
    corners = section.points[0, section.quads]
    r = np.asarray(right.global_coordinates())[0]
    right.dx = right.dx / r * corners.mean(axis=0)[:, None]
    return right


@replaces(hat_functions, "hats_on")
def _resultant_weight(whole: Any, *nodes_and_more: Any) -> Any:
    """Plant a wrong weight in the resultant forces on finite elements: each ring counts with its
    outer radius.
    """
    right = whole(*nodes_and_more)
    lengths = np.zeros_like(right.radii)
    lengths[:-1] += np.diff(right.radii) / 2
    lengths[1:] += np.diff(right.radii) / 2
    return replace(right, weights=lengths * (right.radii + lengths / 2))


@replaces(ContactModel, "along_load")
def _circumferential_shear(_: Any, model: Any) -> Any:
    C = model.compliance(SHEARING).matrix
    return 0.5 * (C[0, :, 0] + C[0, :, 1] + C[1, :, 0] + C[1, :, 1])


@replaces(weak_form, "strains")
def _hoop_strain(whole: Any, u: Any, component: int, n: int) -> Any:
    right = whole(u, component, n)
    return {k: e for k, e in right.items() if (component, k) != (1, "tt")}


def _weak_coupling(factor: float) -> Replacements:
    @replaces(ring_compliance, "ring_compliance")
    def compliance(whole: Any, *given: Any, **more: Any) -> Any:
        right = whole(*given, **more)
        for A in right.harmonics:
            A[:2, :, 2] *= factor
            A[2, :, :2] *= factor
        return right

    return compliance


@replaces(increment, "advance")
def _history_dropped(whole: Any, contact: Any, before: Any, *more: Any) -> Any:
    if before is not None:
        first = contact.state_before_contact()
        forgotten = {
            name: getattr(first, name)
            for name in ("shear", "displacement", "slip", "motions", "dissipated_energy")
        }
        before = replace(before, **forgotten)
    return whole(contact, before, *more)


@replaces(increment._Increment, "end_state")
def _slip_reversed(whole: Any, self: Any, passes: Any) -> Any:
    after, energy = whole(self, passes), self.before.dissipated_energy
    return replace(after, dissipated_energy=2 * energy - after.dissipated_energy)


FINITE_ELEMENTS = (
    Defect(
        "fe-weight",
        "Energies are weighted by the radius of the element's middle, not of the point.",
        ("fem_hertz",),
        _weight_of_element,
    ),
    Defect(
        "fe-resultant-weight",
        "The weight of a ring in the load is taken at its outer radius.",
        ("fem_hertz",),
        _resultant_weight,
    ),
    Defect(
        "fe-circumferential-sign",
        "The circumferential shear of a tangential load has the wrong sign.",
        ("fem_partial_slip",),
        _circumferential_shear,
    ),
    Defect(
        "fe-hoop-strain",
        "The circumferential displacement is omitted from the hoop strain.",
        ("fem_partial_slip",),
        _hoop_strain,
    ),
    Defect(
        "fe-far-field",
        "The far field is omitted: the outer boundary of the section is fixed.",
        ("fem_hertz",),
        replaces(FactoredSection, "_far_displacements")(
            lambda _, self, basis: np.zeros(self._numbering.size)
        ),
    ),
    Defect(
        "fe-deformed-radius",
        "The gap is taken at the deformed radius.",
        ("fem_hertz",),
        replaces(ContactModel, "gap")(lambda whole, self, r: whole(self, (1 - DRAWN_IN) * r)),
    ),
    Defect(
        "fe-upper-body",
        "The compliance of the indenter is omitted.",
        ("fem_hertz",),
        replaces(compliance, "composite")(
            lambda whole, lower, upper, motion: whole(lower, None if lower else upper, motion)
        ),
    ),
    Defect(
        "fe-coupling-sign",
        "Pressure moves the surface away from the axis.",
        ("fem_indentation",),
        _weak_coupling(-1.0),
    ),
    Defect(
        "fe-coupling-0p99",
        "The coupling of pressure and shear is too weak by 1 %.",
        ("fem_indentation", "fem_classical"),
        _weak_coupling(0.99),
    ),
    Defect(
        "fe-friction-root-two",
        "The friction coefficient is too large by √2.",
        ("fem_partial_slip",),
        replaces(ContactModel, "friction")(
            lambda whole, self: CoulombFriction(coefficient=np.sqrt(2) * whole(self).largest)
        ),
    ),
    Defect(
        "fe-history-dropped",
        "Every increment starts from surfaces without history.",
        ("fem_partial_slip",),
        _history_dropped,
    ),
    Defect(
        "fe-dissipation-sign",
        "The dissipated energy has the wrong sign.",
        ("fem_partial_slip",),
        _slip_reversed,
    ),
    Defect(
        "fe-penalty-soft",
        "The penalty is a tenth of the stated penalty.",
        ("fem_hertz",),
        replaces(Penalty, "stiffness")(lambda whole, self, *given: 0.1 * whole(self, *given)),
    ),
    Defect(
        "fe-penalty-not-augmented",
        "Augmentations have no effect.",
        ("fem_hertz",),
        replaces(increment._Increment, "next_pass")(lambda _, self, last: last),
    ),
)


WEAKER = 0.99  # coupling of pressure and shear


def _scaled_results(*names: str, factor: float) -> Replacements:
    return changed_results(lambda result: scaled_increments(result, factor, names), radial)


@replaces(radial, "solve")
def _radii_friction(whole: Any, scene: Any, *given: Any, **named: Any) -> Any:
    if scene.friction is None:
        return whole(scene, *given, **named)
    rougher = CoulombFriction(coefficient=np.sqrt(2) * scene.friction.largest)
    result = whole(scene.model_copy(update={"friction": rougher}), *given, **named)
    return replace(result, scene=scene)


@replaces(Coupling, "response")
def _radii_coupling(whole: Any, self: Coupling, *given: Any) -> Any:
    right = whole(self, *given)
    return right._replace(zr=WEAKER * right.zr, rz=WEAKER * right.rz)


RADII = (
    Defect(
        "radial-pressure",
        "The pressure that the radial solver returns is 0.5 % too large.",
        ("radial_tangential",),
        _scaled_results("pressure", factor=1.005),
    ),
    Defect(
        "radial-shear",
        "The shear that the radial solver returns is 2 % too small.",
        ("radial_tangential",),
        _scaled_results("shear_radial", "shear_circumferential", factor=0.98),
    ),
    Defect(
        "radial-slip-sign",
        "The slip that the radial solver returns has the wrong sign.",
        ("radial_tangential",),
        _scaled_results("slip_radial", "slip_circumferential", factor=-1.0),
    ),
    Defect(
        "radial-elastic-energy",
        "The elastic energy that the radial solver returns is 1 % too large.",
        ("radial_tangential",),
        _scaled_results("elastic_energy", factor=1.01),
    ),
    Defect(
        "radial-dissipated-energy",
        "The dissipated energy that the radial solver returns counts twice.",
        ("radial_tangential",),
        _scaled_results("dissipated_energy", factor=2.0),
    ),
    Defect(
        "radial-friction-root-two",
        "The radial solver's friction coefficient is too large by √2.",
        ("radial_tangential",),
        _radii_friction,
    ),
    Defect(
        "radial-coupling-0p99",
        "The radial solver's coupling of pressure and shear is too weak by 1 %.",
        ("radial_indentation",),
        _radii_coupling,
    ),
)
