"""Which solver a command uses."""

from typing import Annotated, TypeAlias

import typer

from slipstick.solvers.names import SolverName

SolverOption: TypeAlias = Annotated[
    SolverName,
    typer.Option(
        "--solver",
        metavar="NAME",
        help="'semi-analytical', or finite elements, 'fem' with a penalty and "
        "'fem-complementarity' without one; these read the table fem_reference and ignore "
        "semi_analytical.",
    ),
]
