"""Machinery of seeded defects: functions of the program are replaced by wrong ones for a test
run."""

from __future__ import annotations

import sys
from collections.abc import Callable, Collection, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from functools import cached_property
from types import ModuleType
from typing import Any

import numpy as np

from verification.running.cold_cache import clear_caches

PRODUCT = (
    *("contact_scene", "contact_solver", "semi_analytical", "fem_reference", "radial"),
    *("contact_results", "verification", "slipstick"),
)
# The modules that run studies have no caches that depend on a defect.
LEFT_ALONE = "verification.running"
# Packages with caches that depend on a defect.
REMEMBERING = (
    "semi_analytical",
    "fem_reference",
    "radial",
    "verification.cases",
    "verification.problems",
    "verification.judging",
    "verification.laws",
    "verification.closed_forms",
)

Change = Callable[..., Any]


@dataclass(frozen=True)
class Replacement:
    """Replacement of one function, method, property or constant of the program by a wrong one.

    Seeded defects consist of such replacements.

    owner   module or class that defines the original
    name    name of the original in the owner
    change  wrong function; it receives the original and the arguments of a call, or for a constant
            the original alone
    local   True if modules that have imported the original function keep it
    """

    owner: type | ModuleType
    name: str
    change: Change
    local: bool = False

    def plant(self) -> Callable[[], None]:
        """Put the wrong function in place of the original, and return the function that undoes the
        change."""
        module = isinstance(self.owner, ModuleType)
        before = getattr(self.owner, self.name) if module else vars(self.owner)[self.name]
        after = self._replacement_of(before)
        if module and not self.local:
            _exchange_everywhere(before, after)
            # A module that is loaded meanwhile has imported the replacement.
            return lambda: _exchange_everywhere(after, before)
        setattr(self.owner, self.name, after)
        return lambda: setattr(self.owner, self.name, before)

    def _replacement_of(self, before: Any) -> Any:
        if isinstance(before, property | cached_property):
            read = before.fget if isinstance(before, property) else before.func
            return property(lambda owner: self.change(read, owner))
        if isinstance(before, classmethod):
            whole = before.__func__
            return classmethod(lambda *given, **named: self.change(whole, *given, **named))
        if not callable(before):
            return self.change(before)

        def after(*given: Any, **named: Any) -> Any:
            return self.change(before, *given, **named)

        return after


Replacements = tuple[Replacement, ...]


def replaces(
    owner: type | ModuleType, name: str, *, local: bool = False
) -> Callable[[Change], Replacements]:
    """Return a decorator that turns a wrong function into the replacement of an original of the
    program.

    owner  module or class that defines the original
    name   name of the original in the owner
    local  True if modules that have imported the original function keep it
    """
    return lambda change: (Replacement(owner, name, change, local),)


@dataclass(frozen=True)
class Defect:
    """Seeded defect: an error of the program that is planted on purpose to test the verification.

    name          name, of letters, digits and hyphens
    broken        one sentence that describes the error
    cases         inexpensive verification cases that must detect the error
    replacements  wrong functions in place of the original ones
    """

    name: str
    broken: str
    cases: tuple[str, ...]
    replacements: Replacements


@contextmanager
def planted(defect: Defect) -> Iterator[None]:
    """Run a block of code with a seeded defect planted in the program.

    The caches of the solver functions are cleared before and after the block, because cached
    numbers depend on the defect.
    """
    with ExitStack() as undo:
        undo.callback(clear_caches, *REMEMBERING)
        for replacement in defect.replacements:
            undo.callback(replacement.plant())
        clear_caches(*REMEMBERING)
        yield


def product_modules() -> list[ModuleType]:
    """Return all loaded modules of the program, except those that run studies.

    A seeded defect is planted in these modules, wherever they have imported a replaced function.
    """
    return [
        module
        for name, module in list(sys.modules.items())
        if name.partition(".")[0] in PRODUCT and not name.startswith(LEFT_ALONE)
    ]


def _exchange_everywhere(before: Any, after: Any) -> None:
    for module in product_modules():
        for name, value in list(vars(module).items()):
            if value is before:
                setattr(module, name, after)


def changed_results(change: Callable[[Any], Any], *solvers: ModuleType) -> Replacements:
    """Return the defect that changes the results of solvers.

    change   function of the correct result that returns the wrong result
    solvers  packages with a function `solve`
    """

    def solve(whole: Any, *given: Any, **named: Any) -> Any:
        return change(whole(*given, **named))

    return tuple(Replacement(owner, "solve", solve) for owner in solvers)


def scaled_increments(result: Any, factor: float, names: Collection[str]) -> Any:
    """Return a result whose increments have numbers and fields multiplied by a wrong factor.

    names  names of the numbers and fields; absent ones are left out
    """

    def scaled(increment: Any) -> Any:
        found = {name: getattr(increment, name, None) for name in names}
        wrong = {
            name: (factor * np.asarray(value) if np.ndim(value) else factor * value)
            for name, value in found.items()
            if value is not None
        }
        return replace(increment, **wrong)

    return replace(result, increments=tuple(map(scaled, result.increments)))
