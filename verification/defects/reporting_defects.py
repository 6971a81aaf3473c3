"""Defects of what is told: by files of a run, and by the harness of its own judgement."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from contact_results.files import tables
from contact_results.stress import stress_maxima
from contact_scene.quantities.increment import numbers
from verification.convergence import observed_order
from verification.defects.defect import Defect, Patches
from verification.judging import verdict_text, verdicts

SIDES = {"above": "below", "below": "above"}


def _shown_halved(patches: Patches, text: str, field: str) -> None:
    def wrap(whole: Any) -> Any:
        def halved(verdict: Any) -> Any:
            return whole(verdict.model_copy(update={field: 0.5 * getattr(verdict, field)}))

        return halved

    patches.function(verdict_text, text, wrap)


def _coverage(patches: Patches) -> None:
    patches.function(
        verdicts, "expanded_uncertainty", lambda whole: lambda *given: 2 * whole(*given)
    )


def _finest_exchanged(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def exchanged(h: Any, f: Any, order: float) -> Any:
            g = f.copy()
            g[:2] = f[1::-1]
            return whole(h, g, order)

        return exchanged

    patches.function(observed_order, "richardson", wrap)


def _one_sided(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def known(*given: Any) -> Any:
            order = whole(*given)
            return replace(order, half_width=order.margin)

        return known

    patches.function(observed_order, "_known_to", wrap)


def _weights_inverted(patches: Patches) -> None:
    patches.function(
        observed_order,
        "_line",
        lambda whole: lambda h, f, order, weight_order: whole(h, f, order, -weight_order),
    )


def _torque_for_twist(patches: Patches) -> None:
    def exchanged(increment: Any) -> Any:
        told = dict(numbers(increment))
        return told | {"torque": told["twist"], "twist": told["torque"]}

    patches.attribute(tables, "numbers", exchanged)


def _place_turned(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        def turned(*given: Any) -> Any:
            value, x, y = whole(*given)
            return value, y, x

        return turned

    patches.function(tables, "_largest", wrap)


def _sides_exchanged(patches: Patches) -> None:
    def wrap(whole: Any) -> Any:
        return lambda body: [(n, SIDES[side], *rest) for n, side, *rest in whole(body)]

    patches.function(stress_maxima, "interface_sides", wrap)


BY_HAND, BY_FILES = ("worked_examples",), ("written_files",)

TOLD = (
    Defect(
        "uncertainty-shown-halved", "The uncertainty of a reference is shown halved.", BY_HAND,
        lambda patches: _shown_halved(patches, "uncertainty_text", "reference_uncertainty"),
    ),
    Defect(
        "allowed-shown-halved", "What is allowed is shown halved.", BY_HAND,
        lambda patches: _shown_halved(patches, "_allowed_text", "allowed"),
    ),
    Defect("coverage-doubled", "Tolerances are U = 4u.", BY_HAND, _coverage),
    Defect(
        "finest-levels-exchanged", "Richardson's value takes the two finest levels for each other.",
        BY_HAND, _finest_exchanged,
    ),
    Defect("interval-one-sided", "95 % intervals leave out 5 % on either side.", BY_HAND,
           _one_sided),
    Defect("variance-inverted", "Fits weight levels by h^p instead of its inverse.", BY_HAND,
           _weights_inverted),
    Defect("torque-for-twist", "The columns of torque and twist are exchanged.", BY_FILES,
           _torque_for_twist),
    Defect("place-of-f1-turned", "Of the place of Ruiz's parameters x and y are exchanged.",
           BY_FILES, _place_turned),
    Defect("sides-exchanged", "Above and below an interface are exchanged.", BY_FILES,
           _sides_exchanged),
)  # fmt: skip
