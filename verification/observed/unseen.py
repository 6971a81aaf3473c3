"""Numbers of increments whose results are insufficient for some of the laws."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

import semi_analytical

SHEAR = "shear", "shear_radial", "shear_along_load", "shear_circumferential"


@dataclass(frozen=True)
class Unseen:
    """Numbers of increments that are excluded from a law, out of `increments`.

    slip    slip not compared with the shear: the increment was bisected, so that slip may have
            turned, or the motion of the indenter is undefined
    energy  energy balance not evaluated: the increment was bisected, or follows an increment with
            shear of undefined motion
    told    stored energy and unresolved work taken as stated, because a contact with friction has
            grown: on a surface grid, and for coupled bodies by the radial solver
    small   radial solver: too few rings in the contact for integrals
    edges   with the edge correction, or after such an increment: energies are those before the
            correction
    shear   with corrected shear: slip is that before the correction
    """

    increments: int = 0
    slip: int = 0
    energy: int = 0
    told: int = 0
    small: int = 0
    edges: int = 0
    shear: int = 0

    def __add__(self, other: Unseen) -> Unseen:
        return Unseen(
            self.increments + other.increments,
            self.slip + other.slip,
            self.energy + other.energy,
            self.told + other.told,
            self.small + other.small,
            self.edges + other.edges,
            self.shear + other.shear,
        )

    @property
    def of_slip(self) -> str:
        """Text on increments without comparison of slip; empty if there are none."""
        return _words(
            (self.slip, "slip is not held against shear"),
            (self.shear, "slip is that before the edge correction"),
            (self.small, "the contact has too few rings for sums over it"),
            of=self.increments,
        )

    @property
    def of_energy(self) -> str:
        """Text on increments without energy balance; empty if there are none."""
        return _words(
            (self.energy, "this is not looked at"),
            (self.told, "a contact with friction has grown, and what is stored and left open is "
             "taken as told"),
            (self.small, "the contact has too few rings for sums over it"),
            (self.edges, "energies are those before the edge correction"),
            of=self.increments,
        )  # fmt: skip


def unseen(result: Any) -> Unseen:
    """Count the excluded increments in a result of any solver."""
    increments = result.increments
    if getattr(result, "solver", None) == "radial":
        from verification.observed.radii import is_small

        halved = sum(has_shear(now) and now.halvings > 0 for now in increments)
        told = len(increments) * result.plan.coupled
        small = sum(is_small(now, result) for now in increments)
        return Unseen(len(increments), slip=halved, energy=halved, told=told, small=small)
    on_grid = isinstance(result, semi_analytical.Result)
    grown = list(has_grown(increments)) if on_grid else [False] * len(increments)
    found, undefined = Unseen(), False
    edges = [on_grid and is_corrected(now) for now in increments]
    after_edges = [now or before for now, before in zip(edges, [False, *edges], strict=False)]
    for now, has, edge, corrected in zip(increments, grown, after_edges, edges, strict=True):
        lost = has_shear(now) and now.dissipated_energy is None
        undefined |= lost
        halved = now.halvings > 0
        skipped = halved or undefined
        slip = has_shear(now) and (halved or lost)
        told = has and not skipped and not edge
        shear = corrected and has_shear(now) and not slip
        found += Unseen(
            1, int(slip), int(skipped), told=int(told), edges=int(edge), shear=int(shear)
        )
    return found


def is_corrected(now: semi_analytical.Increment) -> bool:
    """Return true if the increment has the edge correction."""
    return now.edge_report is not None and now.edge_report.cause is None


def has_shear(told: Any) -> bool:
    """Return true if an increment of any solver contains a shear."""
    return any(getattr(told, name, None) is not None for name in SHEAR)


def has_grown(increments: Iterable[semi_analytical.Increment]) -> Iterator[bool]:
    """Yield, for each increment, true if a contact with friction has grown since the first
    increment.

    A bisected first increment counts as growth.
    """
    before, grown = None, False
    for now in increments:
        if now.shear is not None:
            halved = now.halvings > 0
            grown |= halved if before is None else _grows(before, now)
        yield grown
        before = now


def _grows(before: semi_analytical.Increment, now: semi_analytical.Increment) -> bool:
    return bool(np.any((now.pressure > 0) & (before.pressure == 0)))


def _words(*found: tuple[int, str], of: int) -> str:
    return "".join(f"; in {count} of {of} increments {what}" for count, what in found if count)
