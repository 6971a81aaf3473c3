"""Tests of the tests: every test has an assertion, and no tolerance accepts everything."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

TESTS = sorted(Path(__file__).parent.glob("test_*.py"))
IMPORTED = ast.Constant("imported")


def asserts(node: ast.AST, known: dict[str, ast.expr]) -> bool:
    """An assertion itself: a statement, a context that expects an error, a call of assert_...

    One that holds for no entries, all(...) or not any(...), needs entries.
    """
    match node:
        case (
            ast.Assert(test=ast.Call(func=ast.Name(id="all"), args=[of]))
            | ast.Assert(test=ast.UnaryOp(operand=ast.Call(func=ast.Name(id="any"), args=[of])))
        ):
            return runs(of, known)
        case ast.Assert():
            return True
    called = node.func if isinstance(node, ast.Call) else None
    name = getattr(called, "attr", getattr(called, "id", ""))
    return name.startswith(("assert", "refused")) or name in ("raises", "fail")


def runs(loop: ast.expr, known: dict[str, ast.expr]) -> bool:
    """The iterable has entries: a literal, a constant of the module or an imported one, the
    increments of a result (`test_stick_slip`), or a function of these."""
    match loop:
        case ast.Name(id=name):
            return name in known and (known[name] is IMPORTED or runs(known[name], {}))
        case ast.Tuple(elts=entries) | ast.List(elts=entries) | ast.Dict(values=entries):
            return bool(entries)
        case ast.Attribute(attr="increments" | "steps"):
            return True
        case ast.Call(func=ast.Attribute(attr="items" | "values", value=table)):
            return runs(table, known)
        case ast.Call(func=ast.Name(id="zip"), args=zipped, keywords=[_, *_]):  # strict
            return any(runs(one, known) for one in zipped)
        case ast.Call(func=ast.Name(id="enumerate"), args=[table, *_]):
            return runs(table, known)
        case ast.Call(func=ast.Name(id="sorted" | "map"), args=[*_, last]):
            return runs(last, known)
        case (
            ast.ListComp(generators=all_of)
            | ast.DictComp(generators=all_of)
            | ast.GeneratorExp(generators=all_of)
        ):
            return all(not one.ifs and runs(one.iter, known) for one in all_of)
        case ast.Call(func=function) if ast.unparse(loop) != "range(0)":
            return getattr(function, "id", getattr(function, "attr", "")) in ("range", "linspace")
    return isinstance(loop, ast.Constant)


def certain(body: list[ast.stmt], known: dict[str, ast.expr]) -> bool:
    """Some statement of the body asserts whenever the body runs."""
    for statement in body:
        if isinstance(statement, ast.For):
            if runs(statement.iter, known) and certain(statement.body, known):
                return True
        elif isinstance(statement, ast.If):
            if certain(statement.body, known) and certain(statement.orelse, known):
                return True
        elif isinstance(statement, ast.With | ast.Try):
            heads = statement.items if isinstance(statement, ast.With) else ()
            if any(asserts(node, known) for item in heads for node in ast.walk(item)) or certain(
                statement.body, known
            ):
                return True
        elif isinstance(statement, ast.FunctionDef | ast.ClassDef | ast.While):
            continue
        elif any(asserts(node, known) for node in ast.walk(statement)):
            return True
    return False


def constants(tree: ast.Module | ast.FunctionDef) -> dict[str, ast.expr]:
    """What names stand for: assigned in the body, or imported."""
    found: dict[str, ast.expr] = {}
    for node in tree.body:
        if isinstance(node, ast.ImportFrom):  # constants and enumerations have capitals
            found |= {one.name: IMPORTED for one in node.names if one.name[0].isupper()}
        elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            found[node.targets[0].id] = node.value
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.value:
            found[node.target.id] = node.value
    return found


def uncertain(tree: ast.Module) -> Iterator[str]:
    """Names of the tests that may pass without an assertion."""
    known = constants(tree)
    for node in ast.walk(tree):
        a_test = isinstance(node, ast.FunctionDef) and node.name.startswith("test_")
        if a_test and not certain(node.body, known | constants(node)):
            yield node.name


LIMITS = {"rel": 1.0, "rtol": 1.0, "abs": 2.0, "atol": 2.0}


def admitting(tree: ast.Module) -> Iterator[int]:
    """Lines of relative tolerances of one and more, and of absolute ones of two and more."""
    for node in ast.walk(tree):
        for option in node.keywords if isinstance(node, ast.Call) else ():
            value = getattr(option.value, "value", 0)
            if isinstance(value, int | float) and value >= LIMITS.get(option.arg or "", 1e99):
                yield node.lineno


@pytest.mark.parametrize("file", TESTS, ids=lambda file: file.stem)
def test_every_test_asserts_and_no_tolerance_admits_all(file: Path) -> None:
    tree = ast.parse(file.read_text(encoding="utf-8"))
    assert [*uncertain(tree)] == []
    assert [*admitting(tree)] == []


def test_what_may_pass_unseen_is_found() -> None:
    tree = ast.parse(
        "def test_loop():\n  for x in found():\n    assert x\n"
        "def test_branch():\n  if found():\n    assert 1\n"
        "def test_sure():\n  for x in (1, 2):\n    assert x == approx(1, rel=2)\n"
        "def test_none():\n  for x in range(0):\n    assert x\n"
        "def test_all():\n  assert all(x for x in found())\n  assert not any(found())\n"
        "def test_each():\n  assert all(x for x in (1, 2))\n  assert 1 == approx(2, abs=1e9)\n"
    )
    assert [*uncertain(tree)] == ["test_loop", "test_branch", "test_none", "test_all"]
    assert {*admitting(tree)} == {9, 18}
