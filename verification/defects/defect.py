"""Defects of the program for tests of the verification: temporary replacements of its functions."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import ModuleType
from typing import Any

PRODUCT = (
    *("contact_scene", "semi_analytical", "fem_reference", "radial"),
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

Wrap = Callable[[Any], Any]


class Patches:
    """Temporary replacements of attributes and functions of the program, undone by `restore`."""

    def __init__(self) -> None:
        self._undo: list[Callable[[], None]] = []

    def attribute(self, owner: type | ModuleType, name: str, value: Any) -> None:
        """Replace an attribute of a class, or a name in one module only.

        The attribute of a class is a method, a property or a class method.
        """
        here, before = name in vars(owner), vars(owner).get(name)
        setattr(owner, name, value)
        self._undo.append(lambda: setattr(owner, name, before) if here else delattr(owner, name))

    def method(self, owner: type, name: str, wrap: Wrap) -> None:
        """Replace a method of a class by `wrap(method)`."""
        self.attribute(owner, name, wrap(getattr(owner, name)))

    def function(self, module: ModuleType, name: str, wrap: Wrap) -> None:
        """Replace a function by `wrap(function)` in all modules of the program that have imported
        it.
        """
        before = getattr(module, name)
        after = wrap(before)
        _exchange(before, after)
        # A module that is loaded meanwhile has imported the replacement.
        self._undo.append(lambda: _exchange(after, before))

    def restore(self) -> None:
        """Undo all replacements of functions and attributes in reverse order."""
        while self._undo:
            self._undo.pop()()


@dataclass(frozen=True)
class Defect:
    """Seeded error of the program, for tests of the verification.

    name    letters, digits and hyphens
    broken  one sentence that describes the error
    cases   inexpensive cases of the catalogue that must detect the error
    plant   function that applies the replacements
    """

    name: str
    broken: str
    cases: tuple[str, ...]
    plant: Callable[[Patches], None]


@contextmanager
def planted(defect: Defect) -> Iterator[None]:
    """Run a block of code with an error planted in the solvers on purpose, to test the
    verification.

    The caches of the solver functions are cleared before and after the block.
    """
    patches = Patches()
    try:
        defect.plant(patches)
        forget_remembered()
        yield
    finally:
        patches.restore()
        forget_remembered()


def forget_remembered() -> None:
    """Clear the caches of all program functions whose results may depend on a planted defect."""
    for module in product_modules():
        if not module.__name__.startswith(REMEMBERING):
            continue
        for value in list(vars(module).values()):
            clear = getattr(value, "cache_clear", None)
            if clear is not None:
                clear()


def product_modules() -> list[ModuleType]:
    """Return all loaded modules of the program, except those that run studies.

    A planted defect replaces functions in these modules.
    """
    return [
        module
        for name, module in list(sys.modules.items())
        if name.partition(".")[0] in PRODUCT and not name.startswith(LEFT_ALONE)
    ]


def _exchange(before: Any, after: Any) -> None:
    for module in product_modules():
        for name, value in list(vars(module).items()):
            if value is before:
                setattr(module, name, after)
