"""One method at one setting on one contact, with its errors and its cost; all settings."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any

import fem_reference
import radial
from contact_scene import FiniteElementDiscretisation, RadialDiscretisation
from semi_analytical import plan, solve
from verification.judging.case import Level
from verification.judging.run import SOLVER_TOLERANCE
from verification.running.cold_cache import timed
from verification.running.row import CaseRecord, parameters_of
from verification.studies.work_precision.contacts import (
    CATTANEO,
    COATING,
    CONTACTS,
    HERTZIAN,
    INDENTATION,
    PreciseContact,
)

# Of the radial solver the fineness is in twelfths of its own; fields are given at so many radii,
# between which a table is interpolated.
OWN, TOLD = 12, 512
CELLS = {Level.QUICK: (16, 32, 64, 128), Level.STANDARD: (16, 32, 64, 128, 256)}
# More where a norm of the field means the edge: without correction the finest grids reach 0.1 %.
TO_THE_EDGE: dict[str, dict[Level, tuple[int, ...]]] = {
    HERTZIAN.name: {Level.QUICK: (256, 512), Level.STANDARD: (512,), Level.FULL: (512, 1024)},
    COATING.name: {Level.QUICK: (256, 512), Level.STANDARD: (512,), Level.FULL: (512, 1024)},
    CATTANEO.name: {Level.QUICK: (256,), Level.STANDARD: (512,), Level.FULL: (512,)},
}
ELEMENTS = {
    Level.QUICK: (8, 16, 32),
    Level.STANDARD: (8, 16, 32, 64),
    Level.FULL: (8, 16, 32, 64, 128),
}
LOOSE = {Level.QUICK: (1e-4,), Level.STANDARD: (1e-2, 1e-4)}  # tolerances of the solver
PENALTIES = {Level.QUICK: (1.0, 10.0), Level.STANDARD: (1.0, 10.0, 100.0)}
RINGS = {
    Level.QUICK: (OWN // 2, OWN),
    Level.STANDARD: (OWN // 2, OWN, 3 * OWN // 2),
    Level.FULL: (OWN // 2, OWN, 3 * OWN // 2, 2 * OWN),
}
# Energies and shifts of a loop stay those of cells without edges.
WITH_EDGES = (HERTZIAN.name, CATTANEO.name, COATING.name, INDENTATION.name)
INCREMENTS = {Level.QUICK: (5,), Level.STANDARD: (5, 10, 40)}  # beside the usual ones
MAX_SPRINGS = 64  # elements: finer penalty solves take longer than all the rest


class Method(StrEnum):
    """How a contact is solved."""

    SURFACE = "semi-analytical"
    EDGES = "semi-analytical, edges inside cells"
    ELEMENTS = "finite elements"
    PENALTY = "finite elements, penalty"
    RADIAL = "radial"


@dataclass(frozen=True)
class PrecisionCase:
    """A method at a setting.

    contact     one of CONTACTS
    fineness    cells per side of the window, elements per contact radius, or twelfths of the rings
                and orders that the radial solver chooses
    tolerance   of the solver
    penalty     stiffness factor c; 0 without penalty
    increments  0: those of the contact
    """

    contact: str
    method: Method
    fineness: int
    tolerance: float = SOLVER_TOLERANCE
    penalty: float = 0.0
    increments: int = 0

    @property
    def name(self) -> str:
        """For files."""
        parts = [self.contact, self.method.name.lower(), f"n{self.fineness}"]
        parts += [f"t{self.tolerance:.0e}"] if self.tolerance != SOLVER_TOLERANCE else []
        parts += [f"c{self.penalty:g}"] if self.penalty else []
        parts += [f"k{self.increments}"] if self.increments else []
        return "-".join(parts).replace(".", "p")

    @property
    def solved(self) -> PreciseContact:
        """The contact."""
        return CONTACTS[self.contact]

    @property
    def text(self) -> str:
        """The setting for people."""
        n = self.fineness
        words = [f"{n} x {n}"]
        if self.method in (Method.ELEMENTS, Method.PENALTY):
            words = [f"{n} elements per radius"]
        elif self.method is Method.RADIAL:
            words = [f"{n / OWN:g} times its own rings"]
        words += [f"tolerance {self.tolerance:g}"] if self.tolerance != SOLVER_TOLERANCE else []
        words += [f"c = {self.penalty:g}"] if self.penalty else []
        words += [f"{self.increments} increments"] if self.increments else []
        return ", ".join(words)

    def compute(self) -> CaseRecord:
        """Solve, compare and count; raises what the solvers raise. Measures are the relative errors
        by name."""
        result, seconds, repeats = timed(self._solve)
        names = ("iterations", "convolutions", "factorizations")
        found = {name: [getattr(i, name, 0) or 0 for i in result.increments] for name in names}
        counters = {"increments": len(result.increments)}
        counters |= {name: sum(counts) for name, counts in found.items() if any(counts)}
        return CaseRecord(
            parameters=parameters_of(self),
            measures={**self.solved.errors_of(result)},
            counters=counters,
            words={"setting": self.text},
            seconds=seconds,
            repeats=repeats,
        )

    def _solve(self) -> Any:
        contact, n = self.solved, self.fineness
        scene = contact.posed(self.increments or contact.increments or 1).scene
        if self.method is Method.RADIAL:
            finer = replace(radial.plan(scene), fineness=n / OWN)
            return radial.solve(scene, RadialDiscretisation(rings=TOLD), plan=finer)
        if self.method in (Method.SURFACE, Method.EDGES):
            decided = plan(scene, edge="last" if self.method is Method.EDGES else "off")
            return solve(scene, contact.grid(n), self.tolerance, plan=decided)
        # The edge of the contact lies in the middle of an element on every mesh.
        mesh = FiniteElementDiscretisation(
            elements_per_radius=n, contact_radius=contact.problem.radius * n / (n + 0.5),
            tolerance=self.tolerance,
        )  # fmt: skip
        of = fem_reference.Method
        if self.method is Method.ELEMENTS:
            return fem_reference.solve(scene, mesh, of.COMPLEMENTARITY)
        stiff = mesh.model_copy(update={"penalty": self.penalty})
        return fem_reference.solve(scene, stiff, of.PENALTY)


def all_cases(level: Level) -> tuple[PrecisionCase, ...]:
    """Return all settings of a level, each once."""
    return tuple(case for contact in CONTACTS for case in _of_contact(contact, level))


def _of_contact(contact: str, level: Level) -> Iterator[PrecisionCase]:
    upper = min(level, Level.STANDARD)
    for n in CELLS[upper]:
        for tolerance in (SOLVER_TOLERANCE, *LOOSE[upper]):
            yield PrecisionCase(contact, Method.SURFACE, n, tolerance)
        if contact in WITH_EDGES:
            yield PrecisionCase(contact, Method.EDGES, n)
    # The radial solver has the closed form of an uncoated ball, and one of a coated ball.
    if contact != HERTZIAN.name:
        for n in (OWN,) if contact == COATING.name else RINGS[level]:
            yield PrecisionCase(contact, Method.RADIAL, n)
    for n in ELEMENTS[level]:
        yield PrecisionCase(contact, Method.ELEMENTS, n)
        for penalty in PENALTIES[upper] if n <= MAX_SPRINGS else ():
            yield PrecisionCase(contact, Method.PENALTY, n, penalty=penalty)
    for increments in INCREMENTS[upper] if contact == INDENTATION.name else ():
        for n in CELLS[upper]:
            yield PrecisionCase(contact, Method.SURFACE, n, increments=increments)
        for n in ELEMENTS[max(level, Level.STANDARD)]:
            yield PrecisionCase(contact, Method.ELEMENTS, n, increments=increments)
        yield PrecisionCase(contact, Method.RADIAL, OWN, increments=increments)
    for n in TO_THE_EDGE.get(contact, {}).get(level, ()):
        yield PrecisionCase(contact, Method.SURFACE, n)
