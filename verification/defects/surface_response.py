"""Seeded defects of the elastic response of the surface in the semi-analytical method.

The wrong functions concern influence coefficients and the frequency response of layered bodies.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from semi_analytical.frf import stack, surface
from semi_analytical.influence import layered_response
from semi_analytical.influence.closed_form import HalfSpaceCoefficients
from semi_analytical.influence.coefficients import Composite
from semi_analytical.operator import operator, spectra
from semi_analytical.operator.operator import DisplacementOperator
from semi_analytical.operator.spectra import KernelSpectrum
from verification.defects.defect import Defect, Replacements, replaces

# Components of displacement and traction.
NORMAL: tuple[str, ...] = ("zz",)
TANGENTIAL: tuple[str, ...] = ("xx", "yy", "xy")
COUPLING: tuple[str, ...] = ("xz", "yz")


def scaled_coefficients(pairs: tuple[str, ...], factor: float) -> Replacements:
    """Return a seeded defect: influence coefficients (displacement per traction) have a wrong
    factor.

    pairs   affected components, named by displacement and traction, such as "zz" or "xz"
    factor  wrong factor; 1 is correct
    """

    @replaces(DisplacementOperator, "spectrum")
    def spectrum(whole: Any, self: DisplacementOperator, pair: str) -> KernelSpectrum:
        found: KernelSpectrum = whole(self, pair)
        return replace(found, quarter=factor * found.quarter) if pair in pairs else found

    return spectrum


@replaces(DisplacementOperator, "normal")
def _periodic_images(_: Any, self: DisplacementOperator, pressure: Any) -> Any:
    self.transforms.counter.count += 1
    unpadded = KernelSpectrum(self.spectrum("zz").quarter[::2, ::2], 1)
    entries = {"zz": operator.response(self.transforms, "zz", unpadded)}
    return operator.Product(self.transforms, entries, "z", "z", padded=False)(pressure[None])[0]


@replaces(spectra, "kernel_spectrum")
def _zero_mean_displacement(whole: Any, values: Any, parity: Any, reach: Any) -> Any:
    spectrum = whole(values, parity, reach)
    if parity == (1, 1):
        spectrum.quarter[0, 0] = 0.0
    return spectrum


@replaces(spectra, "kernel_spectrum")
def _with_nyquist_row(whole: Any, values: Any, parity: Any, reach: Any) -> Any:
    spectrum = whole(values, parity, reach)
    if parity[0] != parity[1]:
        along = np.moveaxis(spectrum.quarter, 1 - parity.index(-1), 0)
        along[-1] = along[-2]
    return spectrum


def _upper_body_omitted(components: tuple[str, ...]) -> Replacements:
    @replaces(Composite, "_combined")
    def combined(whole: Any, self: Composite, component: str) -> Any:
        if component in components and self.lower and self.upper:
            return np.asarray(self.lower[0][component])
        return whole(self, component)

    return combined


@replaces(Composite, "_combined")
def _coupling_added(whole: Any, self: Composite, component: str) -> Any:
    if component not in ("zx", "zy"):
        return whole(self, component)
    return sum(body[component] for body in self.lower + self.upper)


@replaces(surface, "_compliance_below_layer")
def _kappa_for_chi(whole: Any, body: stack.Stack, alpha: Any) -> Any:
    """Plant a wrong reflection of shear waves at the interface of a layer: κ in place of χ.

    χ = (k-1)/(k+1) and κ = (k-1)/(k+3-4ν), where k is the stiffness below the layer over that of
    the layer, and ν Poisson's ratio of the layer.
    """
    right = whole(body, alpha)
    if not body.layers:
        return right
    kappa = (right.shear - 1) / (right.shear + 3 - 4 * body.layers[0].poisson_ratio)
    return right._replace(shear=(1 + kappa) / (1 - kappa))


@replaces(surface, "_compliance_below_layer")
def _plane_stress(whole: Any, body: stack.Stack, alpha: Any) -> Any:
    right = whole(body, alpha)
    if body.base is None or len(body.layers) != 1:
        return right
    nu, (kolosov, *rows) = body.base.poisson_ratio, right.rows
    return right._replace(rows=(kolosov * (3 - nu) / (1 + nu) / (3 - 4 * nu), *rows))


@replaces(stack, "stack_of")
def _substrate_ratio_in_layer(whole: Any, body: Any) -> stack.Stack:
    right = whole(body)
    if right.base is None:
        return right
    nu = right.base.poisson_ratio
    films = [(film.shear_modulus, nu, film.thickness) for film in right.layers]
    return stack.Stack(films, right.base)


@replaces(surface, "remainder_scalars")
def _half_space_only(whole: Any, body: stack.Stack, alpha: Any) -> Any:
    return surface.SurfaceScalars(*(0.0 * value for value in whole(body, alpha)))


@replaces(layered_response, "point_response")
def _coupling_axes_exchanged(whole: Any, component: str, *given: Any) -> Any:
    return whole({"zx": "zy", "zy": "zx"}.get(component, component), *given)


@replaces(HalfSpaceCoefficients, "__getitem__")
def _minus_ratio(whole: Any, self: HalfSpaceCoefficients, component: str) -> Any:
    return (-1 if component == "xy" else 1) * whole(self, component)


SURFACE_RESPONSE = (
    Defect(
        "coupling-sign",
        "Pressure moves the surface away from the load instead of towards the load.",
        ("frictional_indentation",),
        scaled_coefficients(COUPLING, -1.0),
    ),
    Defect(
        "coupling-0p99",
        "The coupling of pressure and shear is too weak by 1 %.",
        ("no_slip_indentation", "frictional_indentation"),
        scaled_coefficients(COUPLING, 0.99),
    ),
    Defect(
        "coupling-of-bodies-added",
        "The coupling of the upper body is added, not subtracted.",
        ("forced_effects",),
        _coupling_added,
    ),
    Defect(
        "nyquist-row-kept",
        "Odd kernels keep the Nyquist row, which must vanish.",
        ("coupled_history",),
        _with_nyquist_row,
    ),
    Defect(
        "zero-wavenumber",
        "The kernel vanishes at wavenumber zero: mean displacements are lost.",
        ("hertz_approach_control",),
        _zero_mean_displacement,
    ),
    Defect(
        "padding-removed",
        "Convolutions are not padded: the contact sees its periodic images.",
        ("hertz_approach_control",),
        _periodic_images,
    ),
    Defect(
        "normal-bias",
        "Normal displacements are too large by 0.3 %.",
        ("hertz_approach_control",),
        scaled_coefficients(NORMAL, 1.003),
    ),
    Defect(
        "normal-bias-stiff",
        "Normal displacements are too small by 0.3 %.",
        ("hertz_approach_control",),
        scaled_coefficients(NORMAL, 1 / 1.003),
    ),
    Defect(
        "tangential-bias",
        "Tangential displacements are too large by 0.3 %.",
        ("cattaneo_mindlin",),
        scaled_coefficients(TANGENTIAL, 1.003),
    ),
    Defect(
        "shear-across-omitted",
        "Shear along y does not move the surface along x.",
        ("torsion",),
        replaces(Composite, "_combined")(
            lambda whole, self, component: (component != "xy") * whole(self, component)
        ),
    ),
    Defect(
        "shear-across-sign",
        "Shear along y moves the surface along x the wrong way.",
        ("torsion",),
        _minus_ratio,
    ),
    Defect(
        "upper-body-sheared-not",
        "The tangential compliance of the upper body is omitted.",
        ("cattaneo_mindlin",),
        _upper_body_omitted(("xx", "yy", "xy")),
    ),
    Defect(
        "upper-body-pressed-not",
        "The normal compliance of the upper body is omitted.",
        ("hertz_approach_control",),
        _upper_body_omitted(("zz",)),
    ),
    Defect(
        "kappa-for-chi",
        "Shear waves reflect at the interface by κ instead of χ.",
        ("layered_reference", "torsion"),
        _kappa_for_chi,
    ),
    Defect(
        "plane-stress",
        "The substrate has Kolosov's constant of plane stress.",
        ("layered_reference",),
        _plane_stress,
    ),
    Defect(
        "substrate-ratio-in-layer",
        "Layers of a scene get the substrate's Poisson's ratio.",
        ("compliant_bond",),
        _substrate_ratio_in_layer,
    ),
    Defect(
        "layer-far-only",
        "Near the load a layered body has the response of its outermost material.",
        ("layered_reference",),
        _half_space_only,
    ),
    Defect(
        "layered-coupling-axes",
        "The coupling of a layered body has its axes exchanged.",
        ("layered_reference",),
        _coupling_axes_exchanged,
    ),
)
