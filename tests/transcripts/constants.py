"""Print the named numbers of the program as its source states them, without a run.

A constant of a module or of a class, or a default of a parameter, has a line with its numbers.
Tests compare results, which many limits, thresholds, first guesses and estimates do not change. A
change of such a number is accepted with its reason, as a change of a result is.
"""

import ast
from collections.abc import Iterator
from pathlib import Path

import contact_scene

PACKAGES = (
    "contact_scene contact_solver semi_analytical fem_reference radial contact_errors "
    "contact_results slipstick verification"
)
TERM = ast.BinOp | ast.UnaryOp | ast.Constant | ast.Name | ast.Attribute
WITHIN = ast.operator | ast.unaryop | ast.expr_context


def is_number(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, int | float)


def numbers(value: ast.AST) -> Iterator[str]:
    """Numbers and terms with numbers within an expression, in the order of the source."""
    parts = list(ast.walk(value))
    if all(isinstance(part, TERM | WITHIN) for part in parts):
        if any(map(is_number, parts)):
            yield ast.unparse(value)
    else:
        for part in ast.iter_child_nodes(value):
            yield from numbers(part)


def named(scope: ast.AST) -> Iterator[tuple[str, ast.expr | None]]:
    """Names and values that a module or a class assigns, and defaults of a function."""
    if isinstance(scope, ast.Module | ast.ClassDef):
        for one in scope.body:
            if isinstance(one, ast.Assign | ast.AnnAssign):
                target = one.targets[0] if isinstance(one, ast.Assign) else one.target
                yield ast.unparse(target), one.value
    if isinstance(scope, ast.FunctionDef | ast.Lambda):
        given = [*scope.args.posonlyargs, *scope.args.args]
        with_default = given[len(given) - len(scope.args.defaults) :]
        for one, value in zip(with_default, scope.args.defaults, strict=True):
            yield one.arg, value
        for one, value in zip(scope.args.kwonlyargs, scope.args.kw_defaults, strict=True):
            yield one.arg, value


def listed(source: str) -> Iterator[str]:
    """One line per name with a number, in the order of the scopes of a module."""
    for scope in ast.walk(ast.parse(source)):
        within = f"{scope.name}." if hasattr(scope, "name") else ""
        for name, value in named(scope):
            if shown := " ".join(numbers(value) if value else ()):
                yield f"constant {within}{name} = {shown}"


root = Path(contact_scene.__file__).parents[1]
for package in PACKAGES.split():
    for path in sorted((root / package).rglob("*.py")):
        if lines := list(listed(path.read_text(encoding="utf-8"))):
            print(path.relative_to(root).as_posix(), *lines, sep="\n")
