"""Mutants of a source text: one operator exchanged for another, or undone."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

EXCHANGED: dict[type[ast.AST], tuple[type[ast.AST], ...]] = {
    ast.Add: (ast.Sub,), ast.Sub: (ast.Add,), ast.Mult: (ast.Div,), ast.Div: (ast.Mult,),
    ast.Pow: (ast.Mult,), ast.FloorDiv: (ast.Mult,), ast.Mod: (ast.Mult,),
    ast.BitAnd: (ast.BitOr,), ast.BitOr: (ast.BitAnd,), ast.And: (ast.Or,), ast.Or: (ast.And,),
    ast.Lt: (ast.LtE, ast.GtE), ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.LtE), ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq,), ast.NotEq: (ast.Eq,), ast.Is: (ast.IsNot,), ast.IsNot: (ast.Is,),
}  # fmt: skip
UNDONE = (ast.USub, ast.Not, ast.Invert)  # by being done twice
# No number depends on what is written there.
TYPES = ("annotation", "returns", "decorator_list")


@dataclass(frozen=True)
class Mutant:
    """A source text with one operator changed.

    line      of the operator, from 1
    old, new  the expression before and after
    """

    line: int
    old: str
    new: str
    text: str


def mutants(source: str) -> Iterator[Mutant]:
    """All of them, in the order of the text; their texts have no comments."""
    tree = ast.parse(source)
    for top in tree.body:
        for node in _nodes(top):
            for attribute, value in _changes(node, in_alias=isinstance(top, ast.Assign)):
                kept, old = getattr(node, attribute), ast.unparse(node)
                setattr(node, attribute, value)
                yield Mutant(node.lineno, old, ast.unparse(node), ast.unparse(tree))
                setattr(node, attribute, kept)


def _nodes(node: ast.AST) -> Iterator[Any]:
    yield node
    for name, value in ast.iter_fields(node):
        if name not in TYPES:
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST):
                    yield from _nodes(child)


def _changes(node: Any, *, in_alias: bool) -> Iterator[tuple[str, Any]]:
    """An attribute of the node, and what it becomes.

    in_alias  whether it may be a type by another name, with | between types
    """
    if isinstance(node, ast.BinOp | ast.BoolOp | ast.AugAssign):
        if not (in_alias and isinstance(node.op, ast.BitOr)):
            yield from (("op", other()) for other in EXCHANGED.get(type(node.op), ()))
    elif isinstance(node, ast.Compare):
        for place, operator in enumerate(node.ops):
            for other in EXCHANGED.get(type(operator), ()):
                yield "ops", [*node.ops[:place], other(), *node.ops[place + 1 :]]
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, UNDONE):
        yield "operand", ast.UnaryOp(node.op, node.operand)
