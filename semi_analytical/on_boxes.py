"""Operators on boxes of cells, built when first asked for and kept while they may come again."""

from collections.abc import Callable
from typing import Generic, TypeVar

Operator = TypeVar("Operator")
Shape = tuple[int, int]


class OnBoxes(Generic[Operator]):
    """Of one kind. Kept are that on all cells and one more: a contact that grows passes through
    many boxes and hardly ever returns to one."""

    def __init__(self, build: Callable[[Shape], Operator], cells: Shape | None = None) -> None:
        """cells  shape of the box of all cells; None where only one is worth its memory"""
        self._build, self._cells = build, cells
        self._kept: dict[Shape, Operator] = {}

    def __len__(self) -> int:
        """How many are kept."""
        return len(self._kept)

    def __call__(self, shape: Shape) -> Operator:
        """The operator on a box of this shape."""
        if shape not in self._kept:
            if shape != self._cells:
                for other in self._kept.keys() - {self._cells}:
                    del self._kept[other]
            self._kept[shape] = self._build(shape)
        return self._kept[shape]
