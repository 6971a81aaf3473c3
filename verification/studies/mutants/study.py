"""The study of mutants: how many the tests of their kernels kill, and what is said of the rest."""

from __future__ import annotations

from pathlib import Path

from verification.exhibits.table import NONE, Table, table_of
from verification.judging.case import Level
from verification.running.row import CaseRecord, found
from verification.running.rules import judged, solved
from verification.running.study import Conclusion, Records, Settings, Statement, Study
from verification.studies.mutants.runs import HEALTHY, KERNELS, MutantRun, drawn

EACH = {Level.QUICK: 2, Level.STANDARD: 24, Level.FULL: 24}
PROMISED, ENOUGH = 0.9, 150
NOT_SAID = "nothing sees it"
TRACE = "np.trace(normal, axis1=1, axis2=2)[:, None, None] + 1e-30"
RIDGE = f"1e-09 * np.eye(6) * ({TRACE})"
SUMMED = "np.sum(y, axis=(1, 2), where=open_cells)"
# Of those that nothing can see: kernel, what stood there and what was made of it, and why.
EQUAL = {
    ("surface", "(1 - 2 * nu) * one", "(1 - 2 * nu) / one"): "one is an array of ones",
    ("surface", "(3 - 4 * nu) * one", "(3 - 4 * nu) / one"): "one is an array of ones",
    ("contact_area", "s * t", "s / t"): "s and t are 1 or -1",
    ("contact_area", "along[0] - along[1]", "along[0] + along[1]"):
        "they differ where both are positive, and there the part is cut off at one",
    ("contact_area", "LENGTH ** 2", "LENGTH * 2"): "another width of the weights of the fit",
    ("contact_area", RIDGE, RIDGE.replace("eye(6) *", "eye(6) /")):
        "another ridge far below what the cells decide",
    ("contact_area", TRACE, TRACE.replace("+ 1e-30", "- 1e-30")):
        "below the last digit of a trace, and without any cell to fit the fit is zero",
    ("stick_slip", "residuals.worst <= tolerance", "residuals.worst < tolerance"):
        "they differ where both are equal to the last bit: one attempt more",
    ("stick_slip", "work >= power * (1 - SLIDING)", "work > power * (1 - SLIDING)"):
        "they differ where both are equal to the last bit, as at rest, and what rests sticks",
    ("admissible_shear", "-excess", "--excess"): "where the search for the only multiplier begins",
    ("admissible_shear", f"{SUMMED} - total", f"{SUMMED} + total"):
        "where the search for the only multiplier begins",
    ("admissible_shear", "length > bound", "length >= bound"): "on the bound the factor is one",
    ("box_program", "MOST_STEPS + 1", "MOST_STEPS - 1"):
        "two steps fewer before the other method, which finds the same",
    ("box_program", "sides < 0", "sides <= 0"):
        "free components are solved for, and their gradient is zero",
    ("box_program", "sides > 0", "sides >= 0"): "the gradient of free components is zero",
    ("box_program", "-1", "--1"): "the bounds of what is fixed are equal: it is at either",
    ("box_program", "step < 0", "step <= 0"): "no bound is asked of what makes no step",
}  # fmt: skip


def cases(settings: Settings) -> tuple[MutantRun, ...]:
    """Every kernel as it is, and mutants of it."""
    return tuple(
        run
        for kernel in KERNELS
        for run in (MutantRun(kernel, HEALTHY), *drawn(kernel, EACH[settings.level]))
    )


def conclude(settings: Settings, records: Records) -> Conclusion:
    """The share that is killed, and who survives."""
    asked = cases(settings)
    known = found(asked, records)
    healthy = [record for run, record in known.items() if run.number == HEALTHY]
    mutated = {run: record for run, record in known.items() if run.number != HEALTHY}
    killed = sum(map(is_killed, mutated.values()))
    survivors = [record for record in mutated.values() if not is_killed(record)]
    told = f"{killed} of {len(mutated)}"
    return Conclusion(
        answer=f"The tests of {len(KERNELS)} kernels kill {told} mutants." if mutated else "",
        statements=(
            solved("every mutant is put to the tests", len(known), len(asked), "runs"),
            Statement(
                claim="the tests pass on the kernels as they are",
                outcome=judged(
                    not any(map(is_killed, healthy)), complete=len(healthy) == len(KERNELS)
                ),
                measured=f"{sum(not is_killed(one) for one in healthy)} of {len(healthy)}",
            ),
            Statement(
                claim=f"of random mutants ≥ {PROMISED:.0%} are killed by the kernel's own tests",
                outcome=judged(killed >= PROMISED * len(mutated), complete=len(mutated) >= ENOUGH),
                measured=told,
                because=f"at least {ENOUGH} mutants decide",
            ),
        ),
        tables=(_by_kernel(mutated), _survivors(survivors)),
        remarks=(
            "A mutant has one operator exchanged for another or undone. Which are drawn changes "
            "with the text of a kernel. What survives with a reason is no different program, or "
            "one whose numbers are the same; it counts as not killed.",
        ),
    )


def why(survivor: CaseRecord) -> str:
    """Why nothing can see it, where that was found."""
    kernel = Path(str(survivor.parameters["kernel"])).stem
    return EQUAL.get((kernel, survivor.words["old"], survivor.words["new"]), NOT_SAID)


def is_killed(record: CaseRecord) -> bool:
    """Whether a test failed."""
    return "killed_by" in record.words


def _by_kernel(mutated: dict[MutantRun, CaseRecord]) -> Table:
    rows = []
    for kernel, tests in KERNELS.items():
        own = [record for run, record in mutated.items() if run.kernel == kernel]
        rows.append((kernel, ", ".join(tests), f"{sum(map(is_killed, own))} of {len(own)}"))
    return Table(
        title="Mutants that are killed", columns=("kernel", "its tests", "killed"),
        rows=tuple(rows), units=NONE,
    )  # fmt: skip


def _survivors(survivors: list[CaseRecord]) -> Table:
    return table_of(
        "Mutants that survive",
        {
            "kernel": lambda r: str(r.parameters["kernel"]),
            "line": lambda r: str(r.counters["line"]),
            "of": lambda r: r.words["old"],
            "made": lambda r: r.words["new"],
            "why": why,
        },
        survivors,
        units=NONE,
    )


STUDY = Study(
    name="mutants",
    title="Mutants: what the tests of kernels notice",
    question="One operator of a kernel is changed at random. Do the kernel's own tests fail?",
    cases=cases,
    conclude=conclude,
)
