"""A plugin of pytest: a solver judged on challenges, one test per case and quantity.

`pytest --slipstick` collects files `challenge_*.py`, which have `solve`, `CASES` and, if they like,
`LEVELS`, `CLASS` and `SOLVER`, as `verification.judge` takes them, and `PARTIAL = True`
where required numbers may be omitted.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from verification.challenge.judgement import Judgement
    from verification.challenge.verdicts import Row

OPTIONS = {
    "slipstick": "collect files challenge_*.py and judge the solvers in them",
    "slipstick_strict": "fail where something is inconclusive, omitted, or cannot be done",
}
TIMES, PART_OF_BOUND = 1.5, 0.05  # worse: an error half as large again, by a part of its bound


def pytest_addoption(parser: pytest.Parser) -> None:
    """Three options beside --slipstick, each of which collects, too."""
    group = parser.getgroup("slipstick")
    for name, words in OPTIONS.items():
        group.addoption(f"--{name.replace('_', '-')}", action="store_true", help=words)
    group.addoption("--slipstick-baseline", metavar="FILE", help="fail where an error is worse "
                    "than recorded in FILE: half as large again, though allowed")  # fmt: skip
    group.addoption("--slipstick-record", metavar="FILE", help="write the errors to FILE")


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Files of solvers, if they are asked for."""
    named = file_path.suffix == ".py" and file_path.name.startswith("challenge_")
    wanted = (*OPTIONS, "slipstick_baseline", "slipstick_record")
    if not named or not any(parent.config.getoption(name) for name in wanted):
        return None
    return SolverFile.from_parent(parent, path=file_path)


class SolverFile(pytest.File):
    """A file with a solver."""

    def collect(self) -> Iterator[pytest.Item]:
        """A test for every quantity of every case; raises Refused for a file without a solver."""
        from contact_results.directory.refusal import Refused
        from verification.challenge.cases import challenges
        from verification.challenge.named_solver import module_of

        module = module_of(self.path)
        for name in ("solve", "CASES"):
            if not hasattr(module, name):
                raise Refused(f"{self.path}: no {name}; expected solve(problem, level) and CASES")
        for case in module.CASES:
            if case not in challenges():
                raise Refused(f"{self.path}: no challenge {case!r}: slipstick challenge list")
            judged = JudgedOnce(module, case)
            asked = (*challenges()[case].numbers, *challenges()[case].fields)
            for quantity in dict.fromkeys(one.quantity for one in asked):
                name = f"{case}::{quantity}"
                yield QuantityItem.from_parent(self, name=name, judged=judged, quantity=quantity)


class JudgedOnce:
    """The judgement of a case, made by the first of its tests."""

    def __init__(self, module: Any, case: str) -> None:
        self.module, self.case = module, case

    @cached_property
    def judgement(self) -> Judgement | str:
        """Or why the solver cannot do it."""
        from verification.challenge.door import LEVELS, CannotDo, judge

        given = {name: getattr(self.module, name, None) for name in ("CLASS", "SOLVER")}
        levels = getattr(self.module, "LEVELS", LEVELS)
        try:
            return judge(self.case, self.module.solve, levels, given["CLASS"], given["SOLVER"])
        except CannotDo as reason:
            return str(reason)


class Failed(Exception):
    """Verdicts that fail, in words."""


class QuantityItem(pytest.Item):
    """All verdicts on one quantity of one case, over its loading steps."""

    def __init__(self, *, judged: JudgedOnce, quantity: str, **more: Any) -> None:
        super().__init__(**more)
        self.judged, self.quantity = judged, quantity

    def runtest(self) -> None:
        """Raises Failed; skips where there is nothing to judge."""
        found = self.judged.judgement
        if isinstance(found, str):
            self._open(f"cannot: {found}")
            return
        rows = [r for r in found.rows if r.quantity.partition(":")[0] in (self.quantity, "solved")]
        errors = {f"{r.quantity} {r.step}": r.error for r in rows if r.error is not None}
        worst = max(errors.values(), default=None)
        self.user_properties += [("error", worst), ("class", found.grade)]
        failed = [f"{_words(r)}: {r.because}" for r in rows if r.status.value == "fail"]
        if not getattr(self.judged.module, "PARTIAL", False):
            failed += [
                f"{quantity}, step {step}: required and omitted; PARTIAL = True accepts it"
                for quantity, step, required in found.omitted
                if required and quantity == self.quantity
            ]
        key, config = f"{self.parent.name if self.parent else ''}::{self.name}", self.config
        if baseline := config.getoption("slipstick_baseline"):
            failed += _worse(rows, config.stash[BASELINE].get(key), baseline)
        if failed:
            raise Failed("\n".join(failed))
        if config.getoption("slipstick_record"):
            config.stash.setdefault(ERRORS, {})[key] = errors
        undecided = [f"{_words(r)}: {r.because}" for r in rows if r.status.value != "pass"]
        if undecided or not rows:
            self._open("\n".join(undecided) or "omitted")

    def _open(self, reason: str) -> None:
        if self.config.getoption("slipstick_strict"):
            raise Failed(reason)
        pytest.skip(reason)

    def repr_failure(self, excinfo: Any, style: Any = None) -> Any:
        """Verdicts alone; a solver's own exception with where it was raised."""
        if isinstance(excinfo.value, Failed):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        return self.path, None, self.name


Errors = dict[str, dict[str, float]]
ERRORS, BASELINE = pytest.StashKey[Errors](), pytest.StashKey[Errors]()


def pytest_configure(config: pytest.Config) -> None:
    """Read the record; raises UsageError where it is none."""
    path = config.getoption("slipstick_baseline", None)
    if not path:
        return
    try:
        content = json.loads(Path(path).read_text(encoding="utf-8"))
        config.stash[BASELINE] = {
            key: {name: float(error) for name, error in errors.items()}
            for key, errors in content.items()
        }
    except (OSError, ValueError, TypeError, AttributeError) as error:
        told = f"{path}: no record ({error}); write one with --slipstick-record"
        raise pytest.UsageError(told) from None


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Write the record, if one is asked for."""
    path = session.config.getoption("slipstick_record")
    if path and (errors := session.config.stash.get(ERRORS, None)):
        Path(path).write_text(json.dumps(errors, indent=1) + "\n", encoding="utf-8")


def _worse(rows: list[Row], recorded: Mapping[str, float] | None, baseline: str) -> Iterator[str]:
    """In words: what is not recorded, no longer answered, or worse than recorded."""
    if not rows:
        if recorded:
            yield f"recorded in {baseline}, and no longer answered"
        return
    if recorded is None:
        yield f"not in {baseline}; record it: --slipstick-record"
        return
    for row in rows:
        if row.error is None or row.bound is None:
            continue
        before = recorded.get(f"{row.quantity} {row.step}")
        if before is None:
            yield f"{_words(row)} is not in {baseline}; record it: --slipstick-record"
        elif not row.error <= max(TIMES * before, before + PART_OF_BOUND * row.bound):
            yield f"{_words(row)}: error {row.error:.3g}, recorded {before:.3g}: worse"


def _words(row: Row) -> str:
    step = "" if row.step is None else f", step {row.step}"
    error = "" if row.error is None else f" (error {row.error:.3g})"
    return f"{row.quantity}{step}{error}"
