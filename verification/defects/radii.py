"""Defects of the radial solver."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

import radial
from contact_scene import CoulombFriction
from radial.frictional.coupling import Coupling
from verification.defects.defect import Defect, Patches

WEAKER = 0.99  # coupling of pressure and shear


def _returned(*names: str, factor: float) -> Callable[[Patches], None]:
    """Multiply fields or numbers of every increment that the solver returns."""

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


def _friction(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def solve(scene: Any, *given: Any, **named: Any) -> Any:
            if scene.friction is None:
                return whole(scene, *given, **named)
            rougher = CoulombFriction(coefficient=np.sqrt(2) * scene.friction.largest)
            result = whole(scene.model_copy(update={"friction": rougher}), *given, **named)
            return replace(result, scene=scene)

        return solve

    patches.function(radial, "solve", wrap)


def _coupling(patches: Patches) -> None:
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
        ("radial_tangential",), _friction,
    ),
    Defect(
        "radial-coupling-0p99", "The radial solver's coupling of pressure and shear is too weak by "
        "1 %.", ("radial_indentation",), _coupling,
    ),
)  # fmt: skip
