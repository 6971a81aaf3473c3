"""Seeded defects of the elastic surface response (influence coefficients) of the semi-analytical
method.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from semi_analytical.frf import stack, surface
from semi_analytical.influence import layered_response
from semi_analytical.influence.closed_form import HalfSpaceCoefficients
from semi_analytical.influence.coefficients import Composite
from semi_analytical.influence.layered_response import Components
from semi_analytical.operator import operator, spectra
from semi_analytical.operator.operator import DisplacementOperator
from semi_analytical.operator.spectra import KernelSpectrum
from verification.defects.defect import Defect, Patches

# Components of displacement and traction.
NORMAL: tuple[str, ...] = ("zz",)
TANGENTIAL: tuple[str, ...] = ("xx", "yy", "xy")
COUPLING: tuple[str, ...] = ("xz", "yz")


def scaled(patches: Patches, pairs: tuple[str, ...], factor: float) -> None:
    """Plant a wrong factor in components of the influence coefficients (traction to displacement).

    pairs   components, named by displacement and traction, such as "zz" or "xz"
    factor  wrong factor; 1 is correct
    """

    def wrap(whole: Any) -> Any:
        def spectrum(coefficients: Any, pair: str, reach: Any) -> KernelSpectrum:
            found: KernelSpectrum = whole(coefficients, pair, reach)
            return replace(found, quarter=factor * found.quarter) if pair in pairs else found

        return spectrum

    patches.function(operator, "kernel_spectrum", wrap)


def _periodic(patches: Patches) -> None:
    def images(self: DisplacementOperator, pressure: Any) -> Any:
        self.transforms.counter.count += 1
        unpadded = KernelSpectrum(self.spectrum("zz").quarter[::2, ::2], 1)
        entries = {"zz": operator.response(self.transforms, "zz", unpadded)}
        return operator.Product(self.transforms, entries, "z", "z", padded=False)(pressure[None])[0]

    patches.attribute(DisplacementOperator, "normal", images)


def _without_mean(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def transform(coefficients: Any) -> Any:
            spectrum = whole(coefficients)
            spectrum.quarter[0, 0] = 0.0
            return spectrum

        return transform

    patches.function(spectra, "even_transform", wrap)


def _with_nyquist_row(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def transform(coefficients: Any, odd_axis: int) -> Any:
            spectrum = whole(coefficients, odd_axis)
            along = np.moveaxis(spectrum.quarter, 1 - odd_axis, 0)
            along[-1] = along[-2]
            return spectrum

        return transform

    patches.function(spectra, "mixed_transform", wrap)


def _without_cross_term(patches: Patches) -> None:
    patches.attribute(Composite, "xy", property(lambda self: np.zeros_like(self.xx)))


def _one_body(patches: Patches, components: tuple[str, ...]) -> None:
    def wrap(whole: Any) -> Any:
        def added(self: Composite, component: str) -> Any:
            if component in components and self.lower and self.upper:
                return np.asarray(getattr(self.lower[0], component))
            return whole(self, component)

        return added

    patches.method(Composite, "_added", wrap)


def _coupling_added(patches: Patches) -> None:
    patches.attribute(Composite, "_mirrored", Composite._added)


def _kappa_for_chi(patches: Patches) -> None:
    """Plant the reflection coefficient κ = (k-1)/(k+3-4ν) for shear waves instead of χ =
    (k-1)/(k+1).

    k is the stiffness below the layer over that of the layer, ν its Poisson's ratio.
    """

    def wrap(whole: Any) -> Any:
        def underside(body: stack.Stack, alpha: Any) -> Any:
            y, k = whole(body, alpha)
            if not body.layers:
                return y, k
            kappa = (k - 1) / (k + 3 - 4 * body.layers[0].poisson_ratio)
            return y, (1 + kappa) / (1 - kappa)

        return underside

    patches.function(surface, "_underside", wrap)


def _plane_stress(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def underside(body: stack.Stack, alpha: Any) -> Any:
            y, k = whole(body, alpha)
            if body.base is None or len(body.layers) != 1:
                return y, k
            nu = body.base.poisson_ratio
            return (y[0] * (3 - nu) / (1 + nu) / (3 - 4 * nu), *y[1:]), k

        return underside

    patches.function(surface, "_underside", wrap)


def _substrate_ratio_in_layer(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def of(body: Any) -> stack.Stack:
            right = whole(body)
            if right.base is None:
                return right
            nu = right.base.poisson_ratio
            films = [(film.shear_modulus, nu, film.thickness) for film in right.layers]
            return stack.Stack(films, right.base)

        return of

    patches.function(stack, "stack_of", wrap)


def _half_space_only(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def remainder(body: stack.Stack, alpha: Any) -> Any:
            return surface.SurfaceScalars(*(0.0 * value for value in whole(body, alpha)))

        return remainder

    patches.function(surface, "remainder_scalars", wrap)


def _parity(patches: Patches) -> None:
    right = layered_response.COUPLING
    wrong = Components(
        right.names, right.radial, right.parity, lambda *given: right.turned(*given)[::-1]
    )
    patches.function(layered_response, "COUPLING", lambda _: wrong)


def _minus_ratio(patches: Patches) -> None:
    patches.attribute(
        HalfSpaceCoefficients,
        "xy",
        property(lambda self: -self._c * self.poisson_ratio * self.integrals.xy_r3),
    )


SURFACE_RESPONSE = (
    Defect(
        "coupling-sign", "Pressure moves the surface away from the load instead of towards the "
        "load.",
        ("frictional_indentation",), lambda patches: scaled(patches, COUPLING, -1.0),
    ),
    Defect(
        "coupling-0p99", "The coupling of pressure and shear is too weak by 1 %.",
        ("no_slip_indentation", "frictional_indentation"),
        lambda patches: scaled(patches, COUPLING, 0.99),
    ),
    Defect(
        "coupling-of-bodies-added", "The coupling of the upper body is added, not subtracted.",
        ("forced_effects",), _coupling_added,
    ),
    Defect(
        "nyquist-row-kept", "Odd kernels keep the Nyquist row, which must vanish.",
        ("coupled_history",), _with_nyquist_row,
    ),
    Defect(
        "zero-wavenumber", "The kernel vanishes at wavenumber zero: mean displacements are lost.",
        ("dissimilar_bodies",), _without_mean,
    ),
    Defect(
        "padding-removed", "Convolutions are not padded: the contact sees its periodic images.",
        ("dissimilar_bodies",), _periodic,
    ),
    Defect(
        "normal-bias", "Normal displacements are too large by 0.3 %.",
        ("dissimilar_bodies", "hertz_approach_control"),
        lambda patches: scaled(patches, NORMAL, 1.003),
    ),
    Defect(
        "normal-bias-stiff", "Normal displacements are too small by 0.3 %.",
        ("dissimilar_bodies", "hertz_approach_control"),
        lambda patches: scaled(patches, NORMAL, 1 / 1.003),
    ),
    Defect(
        "tangential-bias", "Tangential displacements are too large by 0.3 %.",
        ("cattaneo_mindlin",),
        lambda patches: scaled(patches, TANGENTIAL, 1.003),
    ),
    Defect(
        "shear-across-omitted", "Shear along y does not move the surface along x.",
        ("torsion",), _without_cross_term,
    ),
    Defect(
        "shear-across-sign", "Shear along y moves the surface along x the wrong way.",
        ("torsion",), _minus_ratio,
    ),
    Defect(
        "upper-body-sheared-not", "The tangential compliance of the upper body is omitted.",
        ("cattaneo_mindlin",), lambda patches: _one_body(patches, ("xx", "yy", "xy")),
    ),
    Defect(
        "upper-body-pressed-not", "The normal compliance of the upper body is omitted.",
        ("hertz_approach_control",), lambda patches: _one_body(patches, ("zz",)),
    ),
    Defect(
        "kappa-for-chi", "Shear waves reflect at the interface by κ instead of χ.",
        ("layered_reference", "torsion_coated"), _kappa_for_chi,
    ),
    Defect(
        "plane-stress", "The substrate has Kolosov's constant of plane stress.",
        ("layered_reference", "layered_identities"), _plane_stress,
    ),
    Defect(
        "substrate-ratio-in-layer", "Layers of a scene get the substrate's Poisson's ratio.",
        ("coated_unlike_ratios",), _substrate_ratio_in_layer,
    ),
    Defect(
        "layer-far-only", "Near the load a layered body has the response of its outermost "
        "material.",
        ("layered_reference",), _half_space_only,
    ),
    Defect(
        "layered-coupling-axes", "The coupling of a layered body has its axes exchanged.",
        ("layered_reference",), _parity,
    ),
)  # fmt: skip
