"""Solvers by their names on the command line and by their results; all are listed here alone."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from pkgutil import resolve_name
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from contact_scene.discretised import DiscretisedSolver


class SolverName(StrEnum):
    """Name of a solver, as given to the option `--solver`."""

    SEMI_ANALYTICAL = "semi-analytical"
    FEM = "fem"
    FEM_COMPLEMENTARITY = "fem-complementarity"
    RADIAL = "radial"

    @property
    def is_fem(self) -> bool:
        """True for the two finite-element solvers."""
        return self in (SolverName.FEM, SolverName.FEM_COMPLEMENTARITY)

    @property
    def solver(self) -> type[DiscretisedSolver]:
        """Class of the solver of this name. Its package is imported on access."""
        found: type[DiscretisedSolver] = resolve_name(SOLVERS[self])
        return found


# Class of each solver, with the package that is imported for it.
SOLVERS: Mapping[SolverName, str] = MappingProxyType(
    {
        SolverName.SEMI_ANALYTICAL: "semi_analytical.discretised:CellSolver",
        SolverName.FEM: "fem_reference.discretised:PenaltySolver",
        SolverName.FEM_COMPLEMENTARITY: "fem_reference.discretised:ElementSolver",
        SolverName.RADIAL: "radial.discretised:RingSolver",
    }
)


# Solver of each name in a result.
NAMES_IN_RESULTS: Mapping[str, SolverName] = MappingProxyType(
    {
        "semi_analytical": SolverName.SEMI_ANALYTICAL,
        "fem_reference.penalty": SolverName.FEM,
        "fem_reference.complementarity": SolverName.FEM_COMPLEMENTARITY,
        "radial": SolverName.RADIAL,
    }
)


def solver_of(result: Any) -> DiscretisedSolver:
    """Return the solver of a result, with the plan of the result and its settings.

    Raises TypeError for other objects.
    """
    if not all(hasattr(result, name) for name in ("solver", "plan", "increments")):
        kind = type(result).__name__
        raise TypeError(f"got a {kind}, expected the result that slipstick.solve returns")
    return NAMES_IN_RESULTS[result.solver].solver.of(result)
