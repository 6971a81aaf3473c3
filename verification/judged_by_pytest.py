"""Plugin of pytest that judges a solver on challenges, with one test per challenge.

`pytest --slipstick` collects files `challenge_*.py`. They define `solve` and `CASES`, optionally
`LEVELS`, `CLASS`, `SOLVER` and `SECONDS`, as `verification.judge` expects them, `PARTIAL = True` if
required numbers may be omitted, and `AGAINST`, the file of `slipstick judge --save` with which the
answers are compared, relative to the file of the solver.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from verification.challenge.python_api import Judgement


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options --slipstick and --slipstick-strict of this plugin to the command line of
    pytest.

    Each option enables the collection of files `challenge_*.py`, which contain a solver.

    parser  command line parser of pytest
    """
    group = parser.getgroup("slipstick")
    for name, words in (
        ("--slipstick", "collect files challenge_*.py and judge the solvers in them"),
        ("--slipstick-strict", "fail where something is inconclusive or cannot be done"),
    ):
        group.addoption(name, action="store_true", help=words)


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Collect a file `challenge_*.py` with a solver, if pytest runs with an option of this plugin.

    Returns None for all other files.
    """
    asked = parent.config.getoption("slipstick") or parent.config.getoption("slipstick_strict")
    named = file_path.suffix == ".py" and file_path.name.startswith("challenge_")
    return SolverFile.from_parent(parent, path=file_path) if named and asked else None


class SolverFile(pytest.File):
    """File `challenge_*.py` with a contact solver that pytest judges on problems with known
    solutions.
    """

    def collect(self) -> Iterator[pytest.Item]:
        """Yield one test for every challenge (problem with a known solution) that the file names.

        Raises Refused for a file without a solver, or for an unknown challenge.
        """
        from contact_results.directory.atomic_file import Refused
        from verification.challenge.cases import challenges
        from verification.challenge.solver_process import module_of

        module = module_of(self.path)
        for name in ("solve", "CASES"):
            if not hasattr(module, name):
                raise Refused(f"{self.path}: no {name}; expected solve(problem, level) and CASES")
        for case in module.CASES:
            if case not in challenges():
                raise Refused(f"{self.path}: no challenge {case!r}: slipstick challenge list")
            yield ChallengeItem.from_parent(self, name=case, module=module)


class ChallengeItem(pytest.Item):
    """Test of pytest that judges a solver on one challenge (a problem with a known solution)."""

    def __init__(self, *, module: Any, **more: Any) -> None:
        super().__init__(**more)
        self.module = module

    def runtest(self) -> None:
        """Test the solver of the file on one problem with a known solution.

        The test fails with the failed verdicts as message, and is skipped if the solver cannot
        solve the problem. With --slipstick-strict, inconclusive verdicts and unsolvable problems
        fail as well. With `AGAINST`, numbers that are worse than the saved ones fail.
        """
        from contact_results.directory.atomic_file import Refused
        from verification.challenge.python_api import judge
        from verification.challenge.solver_process import FORKS, CannotDo, SolverFailed

        keywords = {
            "LEVELS": "levels",
            "CLASS": "at_least",
            "SOLVER": "solver",
            "SECONDS": "seconds",
        }
        given = {
            key: vars(self.module)[one] for one, key in keywords.items() if one in vars(self.module)
        }
        strict = bool(self.config.getoption("slipstick_strict"))
        solve = self.module.solve if FORKS else f"{self.path}:solve"
        try:
            found = judge(self.name, solve, **given)
            worse = self._worse_than_saved(found)
        except CannotDo as reason:
            (pytest.fail if strict or self._worse_than_saved(None) else pytest.skip)(
                f"cannot: {reason}"
            )
        except SolverFailed as reason:
            pytest.fail(f"{self.name}: solve {reason}", pytrace=False)
        except Refused as reason:
            pytest.fail(f"{self.name}: {reason}", pytrace=False)
        told = worse + [
            f"{row.quantity}, step {row.step} (error {row.error}): {row.because}"
            for row in found.rows
            if row.status.value == "fail" or (strict and row.status.value != "pass")
        ]
        told += [
            f"{name}, step {step}: omitted" for name, step, required in found.omitted if required
        ]
        partial = getattr(self.module, "PARTIAL", False)
        if worse or found.exit_code(strict=strict, partial=partial):
            pytest.fail("\n".join([found.line, *told]), pytrace=False)

    def _worse_than_saved(self, found: Judgement | None) -> list[str]:
        """Return one line for each number that is worse than in the file `AGAINST` of the solver.

        The result is empty without such a file. Raises Refused for a file that cannot be read.

        found  judgement of the challenge; None if the solver cannot do the challenge
        """
        from verification.challenge.saved_judgements import judgement_changes

        if not hasattr(self.module, "AGAINST"):
            return []
        rows = judgement_changes(self.name, found, self.path.parent / self.module.AGAINST)
        return [row.line for row in rows if row.kind.regresses]

    def reportinfo(self) -> tuple[Path, int | None, str]:
        return self.path, None, self.name
