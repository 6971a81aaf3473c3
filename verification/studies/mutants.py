"""Mutants of kernels: the share that the tests of the kernels detect.

A mutant is the text of a kernel with one change: a sign, a factor, a constant, an index or a
comparison. Mutants are drawn at random from a fixed seed, equally many of each kind.
"""

from __future__ import annotations

import ast
import os
import random
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from verification.exhibits.chart import NONE, Table, table_of
from verification.judging.case import Level
from verification.running.study import (
    CaseRecord,
    Conclusion,
    Records,
    Settings,
    Statement,
    Study,
    found,
    judged,
    parameters_of,
    solved,
)

ROOT = Path(__file__).resolve().parents[2]
COPIED = (
    *("contact_scene", "semi_analytical", "fem_reference", "radial", "contact_results"),
    *("contact_errors", "verification", "slipstick", "tests", "scenes"),
)
# Kernels with the tests that belong to them.
KERNELS = {
    "semi_analytical/frf/surface.py": ("test_frf",),
    "semi_analytical/influence/closed_form.py": ("test_operator", "test_influence_layered"),
    "semi_analytical/edge/contact_area.py": ("test_stick_area",),
    "semi_analytical/increments/stick_slip.py": ("test_stick_slip", "test_torsion_load"),
    "semi_analytical/tangential/admissible_shear.py": ("test_normal", "test_stick_slip"),
    "semi_analytical/edge/kernels.py": ("test_edge_shape",),
    "semi_analytical/normal/normal_problem.py": ("test_normal",),
    "semi_analytical/operator/slip_compliance_bins.py": ("test_operator",),
    "fem_reference/contact/box_program.py": ("test_fem_edge",),
    "fem_reference/compliance/ring_edge.py": ("test_fem_edge",),
    "radial/tangential/ring_laws.py": ("test_radial_circle",),
    "contact_scene/stepping/load_path.py": ("test_scene_loading", "test_stick_slip"),
}  # fmt: skip
EACH = {Level.QUICK: 1, Level.STANDARD: 2, Level.FULL: 4}  # mutants of a kind in a kernel
PROMISED, ENOUGH = 0.9, 150
SEED, HEALTHY = 20261123, -1
LONGEST = 900.0  # seconds on the wall for one file of tests
FAILED, BROKEN, PASSED = 1, 2, 0  # exit codes of pytest; broken: not even collected
SAME_EXAMPLES = {"HYPOTHESIS_PROFILE": "ci"}

SIGNS: dict[type[ast.AST], tuple[type[ast.AST], ...]] = {ast.Add: (ast.Sub,), ast.Sub: (ast.Add,)}
FACTORS: dict[type[ast.AST], tuple[type[ast.AST], ...]] = {
    ast.Mult: (ast.Div,), ast.Div: (ast.Mult,), ast.Pow: (ast.Mult,), ast.FloorDiv: (ast.Mult,),
    ast.Mod: (ast.Mult,),
}  # fmt: skip
COMPARISONS: dict[type[ast.AST], tuple[type[ast.AST], ...]] = {
    ast.BitAnd: (ast.BitOr,), ast.BitOr: (ast.BitAnd,), ast.And: (ast.Or,), ast.Or: (ast.And,),
    ast.Lt: (ast.LtE, ast.GtE), ast.LtE: (ast.Lt, ast.Gt), ast.Gt: (ast.GtE, ast.LtE),
    ast.GtE: (ast.Gt, ast.Lt), ast.Eq: (ast.NotEq,), ast.NotEq: (ast.Eq,),
    ast.Is: (ast.IsNot,), ast.IsNot: (ast.Is,),
}  # fmt: skip
EXCHANGED = {"sign": SIGNS, "factor": FACTORS, "comparison": COMPARISONS}
KINDS = (*EXCHANGED, "constant", "index")
LARGER = 1.1  # factor of a changed floating-point constant
# Fields of a syntax tree on which no number depends.
TYPES = ("annotation", "returns", "decorator_list")


@dataclass(frozen=True)
class Mutant:
    """A source text with one change.

    line      of the change, from 1
    old, new  the expression before and after
    """

    kind: str
    line: int
    old: str
    new: str
    text: str


def mutants(source: str) -> Iterator[Mutant]:
    """Return all mutants of a source text, in its order; their texts have no comments."""
    tree = ast.parse(source)
    for top in tree.body:
        for node, in_index in _nodes(top, in_index=False):
            for kind, attribute, value in _changes(node, in_index, isinstance(top, ast.Assign)):
                kept, old = getattr(node, attribute), ast.unparse(node)
                setattr(node, attribute, value)
                yield Mutant(kind, node.lineno, old, ast.unparse(node), ast.unparse(tree))
                setattr(node, attribute, kept)


def _nodes(node: ast.AST, *, in_index: bool) -> Iterator[tuple[Any, bool]]:
    """Yield a node and all below it, each with its place inside or outside an index."""
    yield node, in_index
    for name, value in ast.iter_fields(node):
        if name not in TYPES:
            inside = in_index or (isinstance(node, ast.Subscript) and name == "slice")
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST):
                    yield from _nodes(child, in_index=inside)


def _changes(node: Any, in_index: bool, in_alias: bool) -> Iterator[tuple[str, str, Any]]:
    """Kind of a change, an attribute of the node and its new value.

    in_alias  whether | may stand between types
    """
    if isinstance(node, ast.BinOp | ast.BoolOp | ast.AugAssign):
        if not (in_alias and isinstance(node.op, ast.BitOr)):
            for kind, table in EXCHANGED.items():
                yield from ((kind, "op", other()) for other in table.get(type(node.op), ()))
    elif isinstance(node, ast.Compare):
        for place, operator in enumerate(node.ops):
            for other in COMPARISONS.get(type(operator), ()):
                changed = [*node.ops[:place], other(), *node.ops[place + 1 :]]
                yield "comparison", "ops", changed
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.Not | ast.Invert):
        kind = "sign" if isinstance(node.op, ast.USub) else "comparison"
        yield kind, "operand", ast.UnaryOp(node.op, node.operand)
    elif isinstance(node, ast.Constant) and type(node.value) is int:
        yield ("index" if in_index else "constant"), "value", node.value + 1
    elif isinstance(node, ast.Constant) and type(node.value) is float:
        yield "constant", "value", LARGER * node.value if node.value else 0.1


@dataclass(frozen=True)
class MutantRun:
    """The tests of a kernel on its mutant of this number, or on the unchanged kernel, HEALTHY."""

    kernel: str
    number: int

    @property
    def name(self) -> str:
        which = "healthy" if self.number == HEALTHY else f"{self.number:03d}"
        return f"{Path(self.kernel).stem.replace('_', '-')}-{which}"

    def compute(self) -> CaseRecord:
        """Run the tests in a copy of the tree.

        Raises FileNotFoundError without tests beside the packages, and ChildProcessError for tests
        that did not run.
        """
        if not (ROOT / "tests").is_dir():
            raise FileNotFoundError(f"no tests in {ROOT}: the study needs a clone")
        record = CaseRecord(parameters=parameters_of(self))
        if self.number == HEALTHY:
            return record.model_copy(update={"words": _outcome(self.kernel, None)})
        mutant = of_kernel(self.kernel)[self.number]
        words = {"kind": mutant.kind, "old": mutant.old, "new": mutant.new}
        words |= _outcome(self.kernel, mutant.text)
        return record.model_copy(update={"counters": {"line": mutant.line}, "words": words})


@cache
def of_kernel(kernel: str) -> tuple[Mutant, ...]:
    """Return all mutants of a kernel."""
    return tuple(mutants((ROOT / kernel).read_text(encoding="utf-8")))


def drawn(kernel: str, count: int) -> tuple[MutantRun, ...]:
    """Draw up to a number of mutants of each kind, the same ones at every call."""
    every, chosen = of_kernel(kernel), list[int]()
    for kind in KINDS:
        numbers = [number for number, mutant in enumerate(every) if mutant.kind == kind]
        choice = random.Random(f"{SEED} {kernel} {kind}").sample(numbers, min(count, len(numbers)))
        chosen += choice
    return tuple(MutantRun(kernel, number) for number in sorted(chosen))


def _outcome(kernel: str, text: str | None) -> dict[str, str]:
    """Name the file of tests that failed; nothing where all passed."""
    with TemporaryDirectory() as name:
        tree = Path(name)
        for folder in COPIED:
            shutil.copytree(
                ROOT / folder, tree / folder, ignore=shutil.ignore_patterns("__pycache__")
            )
        shutil.copy(ROOT / "pyproject.toml", tree)
        if text is not None:
            (tree / kernel).write_text(text, encoding="utf-8")
        killer = next((tests for tests in KERNELS[kernel] if _fail(tree, tests)), None)
        return {} if killer is None else {"killed_by": killer}


def _fail(tree: Path, tests: str) -> bool:
    command = (
        sys.executable, "-B", "-m", "pytest", "-q", "-x", "-n0", "-p", "no:cacheprovider",
        f"tests/{tests}.py",
    )  # fmt: skip
    try:
        done = subprocess.run(
            command, cwd=tree, env=os.environ | SAME_EXAMPLES, capture_output=True, text=True,
            timeout=LONGEST, check=False,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return True
    if done.returncode not in (PASSED, FAILED, BROKEN):
        raise ChildProcessError(f"tests/{tests}.py: {done.stdout[-300:]}{done.stderr[-300:]}")
    return done.returncode != PASSED


def cases(settings: Settings) -> tuple[MutantRun, ...]:
    """Return the runs of every kernel, unchanged and with its mutants."""
    count = EACH[settings.level]
    return tuple(
        run for kernel in KERNELS for run in (MutantRun(kernel, HEALTHY), *drawn(kernel, count))
    )


def is_killed(record: CaseRecord) -> bool:
    """Return True if a test failed."""
    return "killed_by" in record.words


def conclude(settings: Settings, records: Records) -> Conclusion:
    """State the share that is detected, by kernel and kind, and the mutants that are not."""
    asked = cases(settings)
    known = found(asked, records)
    healthy = [record for run, record in known.items() if run.number == HEALTHY]
    mutated = [record for run, record in known.items() if run.number != HEALTHY]
    killed = sum(map(is_killed, mutated))
    good = not any(map(is_killed, healthy))
    return Conclusion(
        answer=f"The tests of {len(KERNELS)} kernels detect {_share(mutated)} mutants.",
        statements=(
            solved("every mutant is tested", len(known), len(asked), "runs"),
            Statement(
                claim="the tests pass on the unchanged kernels",
                outcome=judged(good, complete=len(healthy) == len(KERNELS)),
                measured=_share(healthy, undetected=True),
            ),
            Statement(
                claim=f"the kernels' own tests detect at least {PROMISED:.0%} of the mutants",
                outcome=judged(killed >= PROMISED * len(mutated), complete=len(mutated) >= ENOUGH),
                measured=_share(mutated),
                because=f"at least {ENOUGH} mutants decide",
            ),
        ),
        tables=(
            _shares(mutated),
            table_of(
                "Mutants that are not detected",
                {
                    "kernel": lambda r: str(r.parameters["kernel"]),
                    "line": lambda r: str(r.counters["line"]),
                    "kind": lambda r: r.words["kind"],
                    "before": lambda r: r.words["old"],
                    "after": lambda r: r.words["new"],
                },
                [record for record in mutated if not is_killed(record)],
                units=NONE,
            ),
        ),
    )


def _share(records: list[CaseRecord], *, undetected: bool = False) -> str:
    return f"{sum(is_killed(r) != undetected for r in records)} of {len(records)}"


def _shares(mutated: list[CaseRecord]) -> Table:
    """Return one row per kernel, one column per kind."""
    rows = []
    for kernel in (*KERNELS, None):
        own = [r for r in mutated if kernel in (None, r.parameters["kernel"])]
        kinds = [_share([r for r in own if r.words["kind"] == kind]) for kind in KINDS]
        rows.append((kernel or "all", *kinds, _share(own)))
    columns = ("kernel", *KINDS, "all")
    return Table(title="Detected mutants", columns=columns, rows=tuple(rows), units=NONE)


STUDY = Study(
    name="mutants",
    title="Mutants: changes of kernels that their tests detect",
    question="One sign, factor, constant, index or comparison of a kernel is changed at random. Do "
    "the kernel's own tests fail?",
    cases=cases,
    conclude=conclude,
)
