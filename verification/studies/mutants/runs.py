"""A mutant of a kernel, put to the kernel's own tests in a copy of the tree."""

from __future__ import annotations

import os
import random
import shutil
import subprocess
import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from verification.running.row import CaseRecord, parameters_of
from verification.studies.mutants.mutation import Mutant, mutants

ROOT = Path(__file__).resolve().parents[3]
COPIED = (
    *("contact_scene", "semi_analytical", "fem_reference", "radial", "contact_results"),
    *("contact_errors", "verification", "slipstick", "tests", "scenes"),
)
# Kernels, and the files of tests that are theirs.
KERNELS = {
    "semi_analytical/frf/surface.py": ("test_frf", "test_frf_properties"),
    "semi_analytical/influence/closed_form.py": ("test_influence_closed_form",),
    "semi_analytical/contact_area.py": ("test_contact_area",),
    "semi_analytical/stick_slip.py": ("test_stick_slip",),
    "semi_analytical/admissible_shear.py": ("test_admissible_shear", "test_stick_slip"),
    "fem_reference/contact/box_program.py": ("test_fem_box_program",),
    "fem_reference/contact/ring_edge.py": ("test_fem_edge",),
}  # fmt: skip
SEED, HEALTHY = 20261123, -1
LONGEST = 900.0  # seconds on the wall for one file of tests
FAILED, BROKEN, PASSED = 1, 2, 0  # exit codes of pytest; broken: not even collected
TIMED_OUT = "no end"
SAME_EXAMPLES = {"HYPOTHESIS_PROFILE": "ci"}  # as they decide on a change


@dataclass(frozen=True)
class MutantRun:
    """A kernel with its mutant of this number, or HEALTHY as it is."""

    kernel: str
    number: int

    @property
    def name(self) -> str:
        """For files."""
        which = "healthy" if self.number == HEALTHY else f"{self.number:03d}"
        return f"{Path(self.kernel).stem.replace('_', '-')}-{which}"

    def compute(self) -> CaseRecord:
        """Raises FileNotFoundError where tests are not beside the packages, and ChildProcessError
        where they did not run."""
        if not (ROOT / "tests").is_dir():
            raise FileNotFoundError(f"no tests in {ROOT}: the study is of a clone")
        record = CaseRecord(parameters=parameters_of(self))
        if self.number == HEALTHY:
            return record.model_copy(update={"words": _outcome(self.kernel, None)})
        mutant = of_kernel(self.kernel)[self.number]
        told = {"old": mutant.old, "new": mutant.new}
        return record.model_copy(
            update={
                "counters": {"line": mutant.line},
                "words": told | _outcome(self.kernel, mutant.text),
            }
        )


def of_kernel(kernel: str) -> tuple[Mutant, ...]:
    """All its mutants."""
    return _of_text((ROOT / kernel).read_text(encoding="utf-8"))


@cache
def _of_text(source: str) -> tuple[Mutant, ...]:
    return tuple(mutants(source))


def drawn(kernel: str, count: int) -> tuple[MutantRun, ...]:
    """So many of its mutants, the same at every call."""
    all_of_them = range(len(of_kernel(kernel)))
    chosen = random.Random(f"{SEED} {kernel}").sample(all_of_them, min(count, len(all_of_them)))
    return tuple(MutantRun(kernel, number) for number in sorted(chosen))


def _outcome(kernel: str, text: str | None) -> dict[str, str]:
    """Which file of tests failed, if one did."""
    with TemporaryDirectory() as name:
        tree = Path(name)
        for folder in COPIED:
            shutil.copytree(
                ROOT / folder, tree / folder, ignore=shutil.ignore_patterns("__pycache__")
            )
        shutil.copy(ROOT / "pyproject.toml", tree)
        if text is not None:
            (tree / kernel).write_text(text, encoding="utf-8")
        for tests in KERNELS[kernel]:
            if (killer := _failure(tree, tests)) is not None:
                return {"killed_by": killer}
    return {}


def _failure(tree: Path, tests: str) -> str | None:
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
        return TIMED_OUT
    if done.returncode not in (PASSED, FAILED, BROKEN):
        raise ChildProcessError(f"tests/{tests}.py: {done.stdout[-300:]}{done.stderr[-300:]}")
    return None if done.returncode == PASSED else tests
