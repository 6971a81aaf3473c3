"""Names of the solvers on the command line, and the solver that belongs to each name."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from contact_results.surface import Result
    from fem_reference import Method
    from slipstick.solvers.solver import Solver


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
    def method(self) -> Method | None:
        """Contact method of the finite elements, penalty or complementarity; else None."""
        if not self.is_fem:
            return None
        from fem_reference import Method

        return Method.PENALTY if self is SolverName.FEM else Method.COMPLEMENTARITY

    @property
    def solver(self) -> Solver:
        """Solver of this name. Its package is imported on access."""
        if self is SolverName.RADIAL:
            from slipstick.solvers.on_radii import OnRadii

            return OnRadii()
        if self.method is None:
            from slipstick.solvers.on_cells import OnCells

            return OnCells()
        from slipstick.solvers.on_elements import OnElements

        return OnElements(self.method)


def solver_of(result: Result) -> Solver:
    """Return the solver that computed a result; raises TypeError for other objects."""
    if not all(hasattr(result, name) for name in ("solver", "plan", "increments")):
        kind = type(result).__name__
        raise TypeError(f"got a {kind}, expected the result that slipstick.solve returns")
    if result.solver == "radial":
        return SolverName.RADIAL.solver
    method = getattr(result, "method", None)
    if method is None:
        return SolverName.SEMI_ANALYTICAL.solver
    return next(name for name in SolverName if name.method is method).solver
