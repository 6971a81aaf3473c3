"""Which solver a command uses."""

from typing import Annotated, TypeAlias

import typer

from slipstick.solvers.names import SolverName

_OPTION = typer.Option(
    "--solver",
    metavar="NAME",
    help="'semi-analytical', or finite elements, 'fem' with a penalty and "
    "'fem-complementarity' without one; these read the table fem_reference and ignore "
    "semi_analytical; or 'radial', for bodies of revolution that are pressed: nearly exact, in "
    "milliseconds; with friction, pushed, turned or twisted, in seconds.",
    show_default=SolverName.SEMI_ANALYTICAL.value,
)

SolverOption: TypeAlias = Annotated[SolverName, _OPTION]
# Where it matters whether one was named.
AskedSolver: TypeAlias = Annotated[SolverName | None, _OPTION]
