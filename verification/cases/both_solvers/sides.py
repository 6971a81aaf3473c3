"""A contact by all solvers, each coarse and fine, and how far two of these are apart."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from verification.cases.both_solvers.contacts import CheckedContact, Profiles
from verification.cases.both_solvers.left_out import (
    JUDGED_WITHIN,
    Field,
    Mask,
    away_from_kinks,
    clear_of_axis,
    radii,
    width,
)
from verification.judging.run import RadiiRun, Run, SectionRun
from verification.observed.ring_errors import judged_within
from verification.quantities import largest_residual
from verification.running.row import CaseRecord, Row
from verification.running.rules import RESIDUAL

if TYPE_CHECKING:
    import fem_reference
    import radial
    import semi_analytical

CELLS, ELEMENTS, RADIAL = SIDES = ("cells", "elements", "radial")
EDGE = "kept_edge_"
# Of the end of a run, as far as it has them.
NUMBERS = {"approach": "m", "contact_radius": "m", "stick_radius": "m", "dissipated_energy": "J"}


@dataclass(frozen=True)
class Sides:
    """A contact by all solvers, each coarse and fine.

    cells, elements  of the finer ones, even: along each side of the window, and over the contact
                     radius
    """

    contact: CheckedContact
    cells: int
    elements: int

    @property
    def on_cells(self) -> tuple[Run, Run]:
        """Coarse and fine."""
        coarse, fine = (
            Run(f"{self.contact.name}, {n} x {n} cells", self.contact.scene, self.contact.grid(n))
            for n in (self.cells // 2, self.cells)
        )
        return coarse, fine

    @property
    def on_elements(self) -> tuple[SectionRun, SectionRun]:
        """Coarse and fine."""
        coarse, fine = (
            SectionRun(
                f"{self.contact.name}, {n} elements", self.contact.scene, self.contact.mesh(n)
            )
            for n in (self.elements // 2, self.elements)
        )
        return coarse, fine

    @property
    def on_radii(self) -> tuple[RadiiRun, RadiiRun]:
        """Half the rings, and as many as the solver chooses; without friction, which has none and
        is exact, twice the orders and points stand for the coarse one."""
        beside, chosen = (
            RadiiRun(f"{self.contact.name}, on radii, {times:g} times as fine", scene, times)
            for scene in [self.contact.scene]
            for times in (0.5 if self.contact.friction else 2.0, 1.0)
        )
        return beside, chosen

    @property
    def runs(self) -> dict[str, tuple[Run | SectionRun | RadiiRun, ...]]:
        """By side, coarse and fine."""
        return {CELLS: self.on_cells, ELEMENTS: self.on_elements, RADIAL: self.on_radii}

    @property
    def resolution(self) -> float:
        """Of the coarser of the fine sides, over the contact radius."""
        return width(self.cells, self.elements)

    def edges(
        self, result: fem_reference.Result | semi_analytical.Result | radial.Result
    ) -> tuple[float, ...]:
        """Where the shear of a result has kinks, over the contact radius."""
        return self.contact.stick_edges(result, self.resolution)

    def judged(self, at: Field, edges: Sequence[float]) -> Mask:
        """At which of these radii the shear is judged."""
        return away_from_kinks(at, edges, self.resolution)

    def apart(self, one: Any, other: Any, at: Field, edges: Sequence[float]) -> dict[str, float]:
        """How far two results are apart at these radii: the largest difference of the pressure over
        the peak without friction, of the shear over µ times it, away from its kinks; and of the
        approach, relative."""
        p, q = self.contact.tractions(one, at), self.contact.tractions(other, at)
        return {
            **largest_apart(p, q, self.judged(at, edges)),
            "approach": abs(float(one.steps[-1].approach / other.steps[-1].approach) - 1),
        }

    def record(self, solved: Mapping[str, Sequence[Any]], rings: int) -> CaseRecord:
        """Solvers at the rings of a mesh, what none of them made, and what each owns up to.

        solved  the results by side, coarse and fine; cells and elements at least
        """
        edges, half = self.edges(solved[ELEMENTS][1]), self.elements // 2

        def clear(n: int, within: float = JUDGED_WITHIN) -> Field:
            return clear_of_axis(radii(n, self.cells, within), edges, width(self.cells, n))

        # Two meshes are compared where the ripple of the coarser one at the edge does not reach.
        smooth = clear(half, judged_within(half))
        own = {
            side: self.apart(coarse, fine, smooth if side == ELEMENTS else clear(half), edges)
            for side, (coarse, fine) in solved.items()
        }
        fine = {side: result for side, (_, result) in solved.items()}
        numbers = {
            f"{name}_{side}": (float(value), unit)
            for side, result in fine.items()
            for name, unit in NUMBERS.items()
            if (value := getattr(result.steps[-1], name)) is not None
        }
        if self.contact.reference_approach is not None:
            numbers["approach_reference"] = self.contact.reference_approach, "m"
        return CaseRecord(
            parameters={
                "modulus_ratio": self.contact.modulus_ratio, "thickness": self.contact.thickness,
                "friction": self.contact.friction, "cells": self.cells, "elements": self.elements,
            },
            measures={
                **{name: value for name, (value, _) in numbers.items()},
                **{f"own_{what}_{side}": own[side][what] for side in own for what in own[side]},
                **{f"{EDGE}{n}": edge for n, edge in enumerate(edges, 1)},
                RESIDUAL: float(np.max([largest_residual(result) for result in fine.values()])),
            },
            units={name: unit for name, (_, unit) in numbers.items()},
            parts=self._parts(fine, clear(rings), edges),
        )  # fmt: skip

    def _parts(self, fine: Mapping[str, Any], at: Field, edges: Sequence[float]) -> tuple[Row, ...]:
        """Tractions over the radius."""
        found: dict[str, Profiles | None] = {
            **{side: self.contact.tractions(result, at) for side, result in fine.items()},
            "reference": self.contact.reference(at),
        }
        columns = {
            f"{name}_{side}": getattr(profiles, name).tolist()
            for side, profiles in found.items()
            if profiles is not None
            for name in ("pressure", "shear")
        }
        judged = self.judged(at, edges).tolist()
        return tuple(
            Row(
                parameters={"r_over_a": r, "shear_judged": judged[n]},
                measures={name: values[n] for name, values in columns.items()},
            )
            for n, r in enumerate(at.tolist())
        )


def largest_apart(one: Profiles, other: Profiles, judged: Mask) -> dict[str, float]:
    """Largest differences of the pressure anywhere, and of the shear where it is judged."""
    return {
        "pressure": float(np.max(np.abs(one.pressure - other.pressure))),
        "shear": float(np.max(np.abs(one.shear - other.shear), where=judged, initial=0.0)),
    }


def sides_of(record: CaseRecord) -> tuple[str, ...]:
    """The sides that a record has."""
    return tuple(side for side in SIDES if f"approach_{side}" in record.measures)


def profiles(record: CaseRecord, side: str) -> Profiles:
    """Tractions of a side of a record, or of the reference."""
    return Profiles(column(record, f"pressure_{side}"), column(record, f"shear_{side}"))


def column(record: CaseRecord, name: str) -> Field:
    """What was measured at all radii."""
    return np.array([number(part, name) for part in record.parts])


def judged_radii(record: CaseRecord) -> tuple[Field, Mask]:
    """The radii over that of contact, and at which of them the shear is judged."""
    return column(record, "r_over_a"), column(record, "shear_judged").astype(bool)


def kept_edges(record: CaseRecord) -> tuple[float, ...]:
    """Where the shear has kinks: last the edge of stick."""
    return tuple(number(record, name) for name in record.measures if name.startswith(EDGE))


def number(row: Row, name: str) -> float:
    """A number that the row has; not one where it was not finite."""
    found = row.number(name)
    return np.nan if found is None else found
