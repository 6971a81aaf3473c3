"""One method at one setting on one contact: what it errs, and what it costs."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

import radial
from contact_scene import FiniteElementDiscretisation, RadialDiscretisation
from fem_reference import Method as Enforcement
from fem_reference import Result as Section
from fem_reference import solve as solve_section
from semi_analytical import Result as Surface
from semi_analytical import SurfaceGrid, plan, solve
from verification.judging.run import SOLVER_TOLERANCE
from verification.running.cold_cache import timed
from verification.running.row import CaseRecord, parameters_of
from verification.studies.work_precision import counted_work
from verification.studies.work_precision.contacts import CONTACTS, PreciseContact

NO_INCREMENTS = 1
# Of the radial solver the fineness is in twelfths of what it chooses; fields are told at so many
# radii, between which a table is interpolated.
OWN, TOLD = 12, 512
OPERATIONS = "operations"  # counted work, by the name of its measure


class Method(StrEnum):
    """How a contact is solved."""

    SURFACE = "semi-analytical"
    EDGES = "semi-analytical, edges inside cells"
    EXTRAPOLATED = "semi-analytical, extrapolated"
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
        """What is solved."""
        return CONTACTS[self.contact]

    @property
    def by_sections(self) -> bool:
        """Whether finite elements solve it."""
        return self.method in (Method.ELEMENTS, Method.PENALTY)

    @property
    def text(self) -> str:
        """The setting for people."""
        n = self.fineness
        words = [f"{n} x {n}"]
        if self.by_sections:
            words = [f"{n} elements per radius"]
        elif self.method is Method.RADIAL:
            words = ["its own rings" if n == OWN else f"{n / OWN:g} times its own rings"]
        words += [f"tolerance {self.tolerance:g}"] if self.tolerance != SOLVER_TOLERANCE else []
        words += [f"c = {self.penalty:g}"] if self.penalty else []
        if self.increments:
            words += ["1 increment" if self.increments == 1 else f"{self.increments} increments"]
        return ", ".join(words)

    def compute(self) -> CaseRecord:
        """Solve, compare and count; raises what the solvers raise.

        Measures are the errors by name, relative, signed where the quantity is one number, and
        counted work (see `counted_work`); unknowns are tractions of the surface grid or
        displacements of the section.
        """
        contact, components = self.solved, 1 if self.solved.problem.scene.friction is None else 3
        if self.by_sections:
            section, seconds, repeats = timed(self._section)
            errors, operations = contact.errors_of(section), counted_work.of_section(section)
            counters = {
                "factorisations": counted_work.factorisations(section),
                "systems": counted_work.systems(section),
                "unknowns": counted_work.unknowns(section),
                "increments": len(section.increments),
            }
        elif self.method is Method.RADIAL:
            rings, seconds, repeats = timed(self._rings)
            errors, operations = contact.errors_of(rings), counted_work.of_rings(rings, self._finer)
            counters = {
                "systems": counted_work.systems(rings),
                "unknowns": counted_work.ring_unknowns(rings, self._finer),
                "increments": len(rings.increments),
            }
        else:
            surface, seconds, repeats = timed(self._surface)
            errors = contact.errors_of(surface)
            convolutions = counted_work.convolutions(surface)
            operations = counted_work.of_convolutions(self._grid.cells, convolutions)
            counters = {
                "convolutions": convolutions,
                "unknowns": components * self.fineness**2,
                "increments": len(surface.increments),
            }
        return CaseRecord(
            parameters=parameters_of(self),
            measures={**errors, OPERATIONS: operations},
            counters=counters,
            words={"setting": self.text},
            seconds=seconds,
            repeats=repeats,
        )

    @property
    def _steps(self) -> int:
        return self.increments or self.solved.increments or NO_INCREMENTS

    @property
    def _grid(self) -> SurfaceGrid:
        return self.solved.grid(self.fineness)

    def _surface(self) -> Surface:
        scene = self.solved.posed(self._steps).scene
        decided = plan(scene, edge="last" if self.method is Method.EDGES else "off")
        return solve(scene, self._grid, self.tolerance, plan=decided)

    @property
    def _finer(self) -> float:
        return self.fineness / OWN

    def _rings(self) -> radial.Result:
        scene = self.solved.posed(self._steps).scene
        plan = replace(radial.plan(scene), fineness=self._finer)
        return radial.solve(scene, RadialDiscretisation(rings=TOLD), plan=plan)

    def _section(self) -> Section:
        discretisation = FiniteElementDiscretisation(
            elements_per_radius=self.fineness,
            # The edge of the contact lies in the middle of an element on every mesh.
            contact_radius=self.solved.problem.radius * self.fineness / (self.fineness + 0.5),
            tolerance=self.tolerance,
        )
        if self.penalty:
            discretisation = discretisation.model_copy(update={"penalty": self.penalty})
        by = Enforcement.PENALTY if self.method is Method.PENALTY else Enforcement.COMPLEMENTARITY
        return solve_section(self.solved.posed(self._steps).scene, discretisation, by)
