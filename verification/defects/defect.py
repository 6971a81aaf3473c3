"""Defects, which replace names of the product temporarily."""

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
    """Replacements of attributes and functions, undone by `restore`."""

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
        """Replace a method by `wrap(method)`."""
        self.attribute(owner, name, wrap(getattr(owner, name)))

    def function(self, module: ModuleType, name: str, wrap: Wrap) -> None:
        """Replace a function in all modules of the product that have imported it."""
        before = getattr(module, name)
        after = wrap(before)
        _exchange(before, after)
        # A module that is loaded meanwhile has imported the replacement.
        self._undo.append(lambda: _exchange(after, before))

    def restore(self) -> None:
        """Undo all replacements in reverse order."""
        while self._undo:
            self._undo.pop()()


@dataclass(frozen=True)
class Defect:
    """Seeded error of the product.

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
    """Run the product with a defect, and clear the caches of its functions before and after."""
    patches = Patches()
    try:
        defect.plant(patches)
        forget_remembered()
        yield
    finally:
        patches.restore()
        forget_remembered()


def forget_remembered() -> None:
    """Clear the caches of all functions that solve, judge or give references."""
    for module in product_modules():
        if not module.__name__.startswith(REMEMBERING):
            continue
        for value in list(vars(module).values()):
            clear = getattr(value, "cache_clear", None)
            if clear is not None:
                clear()


def product_modules() -> list[ModuleType]:
    """Return all loaded modules of the product."""
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
