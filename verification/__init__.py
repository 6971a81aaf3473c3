"""Verification of the solvers: problems with known solutions, cases, studies and reports.

Only tests and, when needed, the command line import this package. Other solvers can be judged by
`verification.judge`, from Python or by files (`slipstick challenge`).
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from verification.challenge.answer import Answer, Field, Solver
    from verification.challenge.python_api import judge
    from verification.challenge.solver_process import CannotDo, SolverFailed

__all__ = ["Answer", "CannotDo", "Field", "Solver", "SolverFailed", "judge"]

_PLACES = {
    "verification.challenge.answer": ("Answer", "Field", "Solver"),
    "verification.challenge.python_api": ("judge",),
    "verification.challenge.solver_process": ("CannotDo", "SolverFailed"),
}


def __getattr__(name: str) -> Any:
    for place, names in _PLACES.items():
        if name in names:
            return getattr(import_module(place), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
