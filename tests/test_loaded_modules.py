"""Tests of loaded modules: an import, a command or a verification case loads what it needs."""

from pathlib import Path

import pytest
from processes import imported_after

from verification.cases.catalogue import CASES, MODULE_OF

ROOT = Path(__file__).resolve().parents[1]
HERTZ = str(ROOT / "scenes" / "hertz.toml")
RESULTS = [
    ".".join(path.relative_to(ROOT).with_suffix("").parts)
    for path in sorted((ROOT / "contact_results").rglob("[a-z]*.py"))
]

COMMAND = """
import sys
from slipstick.cli import main
try:
    main(sys.argv[1:])
except SystemExit as end:
    assert end.code in (None, 0, 2), end.code
"""
# A command until its first case goes to a worker, and the worker of that case.
AT_WORK = f"""
from verification.running.case_pool import LocalWorkers
def submit(self, *asked):
    raise SystemExit
LocalWorkers.submit = submit
{COMMAND}
"""
WORKER = """
import sys
from verification.cases.catalogue import CaseToJudge
CaseToJudge(sys.argv[1], "QUICK").compute()
"""
IMPORT_RESULTS = f"""
import importlib
for name in {RESULTS}:
    importlib.import_module(name)
"""

SOLVERS = ("contact_solver", "semi_analytical", "fem_reference", "radial")
HEAVY = ("scipy", "matplotlib", "h5py", "pint", "jinja2", "skfem", "semi_analytical")
LIBRARIES = ("numpy", "pydantic", "scipy", "h5py", "matplotlib", "typer", "rich")
OTHER_CASES = sorted({MODULE_OF[name] for name in CASES} - {"indenters"})
NOT_OF_A_CASE = (
    *(f"verification.cases.{name}" for name in OTHER_CASES),
    *("fem_reference", "skfem", "matplotlib", "jinja2"),
    *(f"verification.{name}" for name in ("studies", "defects")),
    *(f"verification.report.{name}" for name in ("page", "drawing")),
)
QUICK = ("-o", "out", "--figures", "none", "--no-error")
PUSHED = (
    *(HERTZ, "--set", "friction.coefficient=0.1"),
    *("--set", "loading[1].tangential_force=[9, 0]"),
)
ON_CELLS = (*PUSHED, "--set", "semi_analytical.cells=[16,16]")
ON_ELEMENTS = (*PUSHED, "--solver", "fem", "--set", "fem_reference.elements_per_radius=4")
NO_ELEMENTS = ("fem_reference", "rich", "verification")
NO_CELLS = ("semi_analytical", "rich", "verification")
# Program, its arguments, a module that it loads, and modules that it does not load.
LOADED = {
    "package": (
        "import slipstick",
        (),
        "slipstick",
        (*LIBRARIES, *SOLVERS, "contact_scene", "contact_results", "verification"),
    ),
    "scene": (
        "from slipstick import Scene, load_scene",
        (),
        "contact_scene",
        ("scipy", "h5py", *SOLVERS, "contact_results", "verification"),
    ),
    "results": (IMPORT_RESULTS, (), "contact_results.cycles", (*SOLVERS, "verification")),
    "help": (COMMAND, ("--help",), "typer", (*HEAVY, "numpy", "pydantic")),
    "schema": (COMMAND, ("maintain", "schema", "summary"), "pydantic", (*HEAVY, "verification")),
    "check": (COMMAND, ("check", HERTZ), "contact_scene", (*HEAVY, "verification")),
    "run on cells": (COMMAND, ("run", *ON_CELLS, *QUICK), "semi_analytical", NO_ELEMENTS),
    "run on elements": (COMMAND, ("run", *ON_ELEMENTS, *QUICK), "fem_reference", NO_CELLS),
    "run without friction": (COMMAND, ("run", HERTZ, *QUICK), "semi_analytical", ("scipy",)),
    "case": (
        AT_WORK,
        ("verify", "hertz_point", "--workers", "1"),
        "verification.cases.indenters",
        NOT_OF_A_CASE,
    ),
    "worker of a case": (WORKER, ("hertz_point",), "verification.cases.indenters", NOT_OF_A_CASE),
}


@pytest.mark.parametrize("name", LOADED)
def test_nothing_is_loaded_that_is_not_needed(name, tmp_path):
    program, words, needed, rooms = LOADED[name]
    loaded = imported_after(program, *words, cwd=tmp_path)
    assert needed in loaded
    assert {n for n in loaded for room in rooms if f"{n}.".startswith(f"{room}.")} == set()
