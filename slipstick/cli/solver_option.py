"""Which solver a command uses."""

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated, TypeAlias

import typer

if TYPE_CHECKING:
    from fem_reference import Method


class SolverName(StrEnum):
    """The solvers by the names of the command line."""

    SEMI_ANALYTICAL = "semi-analytical"
    FEM = "fem"
    FEM_COMPLEMENTARITY = "fem-complementarity"

    @property
    def is_fem(self) -> bool:
        """Whether it solves on a section, by finite elements."""
        return self is not SolverName.SEMI_ANALYTICAL


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


def method_of(solver: SolverName) -> "Method":
    """How a finite-element solver enforces contact and friction."""
    from fem_reference import Method

    return Method.PENALTY if solver is SolverName.FEM else Method.COMPLEMENTARITY
