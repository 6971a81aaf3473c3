"""Tests of the tests: every test has an assertion, and no tolerance accepts everything."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

TESTS = sorted(Path(__file__).parent.glob("test_*.py"))
LIMITS = {"rel": 1.0, "rtol": 1.0, "abs": 2.0, "atol": 2.0}


def asserts(node: ast.AST) -> bool:
    """An assertion, or a call of assert_..., refused..., raises, warns or fail."""
    called = node.func if isinstance(node, ast.Call) else None
    name = getattr(called, "attr", getattr(called, "id", ""))
    known = name.startswith(("assert", "refused")) or name in ("raises", "warns", "fail")
    return isinstance(node, ast.Assert) or known


def without_assertion(tree: ast.Module) -> Iterator[str]:
    for node in tree.body:
        a_test = isinstance(node, ast.FunctionDef) and node.name.startswith("test_")
        if a_test and not any(map(asserts, ast.walk(node))):
            yield node.name


def admitting(tree: ast.Module) -> Iterator[int]:
    """Lines of relative tolerances of one and more, and of absolute ones of two and more."""
    for node in ast.walk(tree):
        for option in node.keywords if isinstance(node, ast.Call) else ():
            value = getattr(option.value, "value", 0)
            if isinstance(value, int | float) and value >= LIMITS.get(option.arg or "", 1e99):
                yield node.lineno


@pytest.mark.parametrize("file", TESTS, ids=lambda file: file.stem)
def test_every_test_asserts_and_no_tolerance_admits_all(file):
    tree = ast.parse(file.read_text(encoding="utf-8"))
    assert [*without_assertion(tree)] == []
    assert [*admitting(tree)] == []


def test_what_may_pass_unseen_is_found():
    tree = ast.parse(
        "def test_none():\n  for x in (1, 2):\n    found(x)\n"
        "def test_sure():\n  assert 1 == approx(1, rel=2)\n"
        "def test_each():\n  assert 1 == approx(2, abs=1e9)\n"
    )
    assert [*without_assertion(tree)] == ["test_none"]
    assert [*admitting(tree)] == [5, 7]
