"""Warnings about a result: implausible input, large strains, unresolved roughness."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

import numpy as np

from contact_scene import HeightMap
from contact_scene.checks.expected_contact import beyond_linear_theory
from contact_scene.checks.plausibility import unlikely_numbers
from contact_scene.friction_limit import undefined_motion_warning
from contact_scene.quantities.cycles import load_cycles
from contact_scene.stepping.increment_error import (
    NEAR_GROSS_SLIP,
    has_increment_error,
    near_gross_slip,
)

if TYPE_CHECKING:
    import semi_analytical
    from contact_results.surface import Result


# Unresolved pressure, relative to the peak pressure, below which no warning is given.
NEGLIGIBLE = 1e-3
NOT_CORRECTED = (
    "the edge of the contact is not corrected: {}; the tractions there are constant on cells"
)
NO_BORDER = (
    "the edge of the contact is corrected, but the border of stick is not: it is rough, too thin, "
    "or does not follow from the preceding step"
)


def warnings_of(result: Result) -> tuple[str, ...]:
    """Return all warnings about a result of any solver, one clause each.

    They concern implausible input, large strains, the path of the loads, and unresolved details.
    """
    found = (
        *unlikely_numbers(result.scene),
        *beyond_linear_theory(result.scene, result.steps),
        *_warn_of_gross_slip(result),
        *_warn_of_first_cycle(result),
    )
    if not hasattr(result, "grid"):
        return found
    on_cells = cast("semi_analytical.Result", result)
    return (*found, *_warn_of_roughness(on_cells), *_warn_of_edges(on_cells))


def _warn_of_gross_slip(result: Result) -> Iterator[str]:
    """Yield a warning if a tangential force is prescribed close to the friction limit.

    Close to gross slip, the tangential shift and the dissipated energy depend on the increments. At
    the limit they are undefined.
    """
    near, last = near_gross_slip(result.scene), result.steps[-1]
    pushes, twists = last.tangential_force is not None, last.torque is not None
    slips = last.tangential_shift is None
    if last.is_line:  # without a reference length no shift is stated
        slips = slips and last.dissipated_energy is None
    if (pushes and slips) or (twists and last.twist is None):
        remedy = "tangential_shift" if pushes and np.any(last.tangential_force) else "twist"
        yield undefined_motion_warning(last.step, remedy)
    elif any(near):
        yield (
            f"step {near.index(True) + 1} pushes beyond {NEAR_GROSS_SLIP:.0%} of the friction "
            "limit: tangential shift and dissipated energy grow like (1 - T/µW)^-1/2 and depend on "
            "the increments; prescribe the shift, or compare increments"
        )


def _warn_of_first_cycle(result: Result) -> Iterator[str]:
    """Warn that the first cycle may dissipate several times the energy of later ones,
    unless its end does not depend on the increments."""
    path = result.scene.load_path()
    cycles = load_cycles(path)
    if cycles and has_increment_error(result.scene)[cycles[0].end - 1]:
        first = cycles[0]
        yield (
            f"the load cycle of steps {first.start + 1} to {first.end} is the first one and starts "
            "from the virgin state: it may dissipate several times the energy of later cycles; "
            "repeat the steps for a steady cycle"
        )


def _warn_of_roughness(result: semi_analytical.Result) -> Iterator[str]:
    """Warn of unresolved roughness, with the pressure that would flatten it."""
    from semi_analytical.resolution import unresolved_pressure

    share, indenter = unresolved_pressure(result), result.scene.indenter
    if share > NEGLIGIBLE and isinstance(indenter, HeightMap):
        nx, ny = (int(np.ceil(n)) for n in np.divide(result.grid.window, indenter.spacing))
        yield (
            "the cells are wider than the spacing of the height map: to flatten the heights "
            f"between cells takes a pressure of {share:.2g} of the peak (root mean square); "
            f"use --set semi_analytical.cells=[{nx},{ny}]"
        )


def _warn_of_edges(result: semi_analytical.Result) -> Iterator[str]:
    """Yield a warning for each cause that prevented the edge correction at the end of a load step.

    Load steps with equal cause share a warning. The edge correction resolves the border of the
    contact and of the stick zone below the cell size.
    """
    if result.plan.edge == "off":
        return
    left: dict[str, list[str]] = {}
    for end in result.steps:
        report = end.edge_report
        if report is not None and report.cause is not None:
            left.setdefault(NOT_CORRECTED.format(report.cause), []).append(str(end.step))
        elif report is not None and report.stick is None:
            left.setdefault(NO_BORDER, []).append(str(end.step))
    for text, steps in left.items():
        yield f"at the end of step {', '.join(steps)} {text}"
