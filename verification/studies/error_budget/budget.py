"""What is refined for a case, one choice at a time, and the parts of the error that come of it."""

from __future__ import annotations

from dataclasses import dataclass, replace

from verification.judging.case import Level
from verification.judging.run import SOLVER_TOLERANCE
from verification.running.row import Row, value_of
from verification.studies.work_precision.contacts import CONTACTS
from verification.studies.work_precision.points import Found
from verification.studies.work_precision.setting import Method, PrecisionCase

CELLS = {Level.QUICK: 64, Level.STANDARD: 128, Level.FULL: 256}
ELEMENTS = {Level.QUICK: 16, Level.STANDARD: 32, Level.FULL: 64}
FINER = 2  # times as fine: cells, increments, window, section
TIGHTER = 1e-2  # of the solver's tolerance
STIFFER = 4.0  # penalty: a smaller factor would be lost in the mesh's part
PENALTY = 10.0  # c
BOX = 100.0  # contact radii

MESH, INCREMENTS, SPRINGS, DOMAIN, TOLERANCE = (
    "mesh", "increments", "penalty", "domain", "solver tolerance"
)  # fmt: skip
TOTAL = "total error"


@dataclass(frozen=True)
class Budget:
    """A verification case and the solve whose error is taken apart.

    case     name of the case
    contact  of the study of work and precision
    steps    whether its path has increments that could be refined
    """

    case: str
    contact: str
    method: Method
    steps: bool = False

    @property
    def title(self) -> str:
        """For people."""
        return f"{CONTACTS[self.contact].title}, {self.method}"

    def base(self, level: Level) -> PrecisionCase:
        """The solve as the case makes it, on the grid or mesh of the level."""
        increments = (CONTACTS[self.contact].increments or 1) if self.steps else 0
        if self.method is Method.SURFACE:
            return PrecisionCase(
                self.contact, self.method, CELLS[level], increments=increments,
                window=CONTACTS[self.contact].window,
            )  # fmt: skip
        return PrecisionCase(
            self.contact, self.method, ELEMENTS[level], increments=increments, box=BOX,
            penalty=PENALTY if self.method is Method.PENALTY else 0.0,
        )  # fmt: skip

    def refined(self, level: Level) -> dict[str, PrecisionCase]:
        """The same with one choice refined, by the name of the choice."""
        base = self.base(level)
        finer = {MESH: replace(base, fineness=FINER * base.fineness)}
        if self.steps:
            finer[INCREMENTS] = replace(base, increments=FINER * base.increments)
        if base.penalty:
            finer[SPRINGS] = replace(base, penalty=STIFFER * base.penalty)
        if base.by_sections:
            finer[DOMAIN] = replace(base, box=FINER * base.box)
        else:  # cells of the same side on a larger window
            finer[DOMAIN] = replace(
                base, window=FINER * base.window, fineness=FINER * base.fineness
            )
        finer[TOLERANCE] = replace(base, tolerance=TIGHTER * SOLVER_TOLERANCE)
        return finer

    def cases(self, level: Level) -> tuple[PrecisionCase, ...]:
        """All solves."""
        return (self.base(level), *self.refined(level).values())


BUDGETS = (
    Budget("hertz_point", "hertz", Method.SURFACE),
    Budget("cattaneo_mindlin", "cattaneo", Method.SURFACE, steps=True),
    Budget("fretting_loop", "loop", Method.SURFACE, steps=True),
    Budget("coated_paraboloid", "coated", Method.SURFACE),
    Budget("frictional_indentation", "indentation", Method.SURFACE, steps=True),
    Budget("fem_hertz", "hertz", Method.ELEMENTS),
    Budget("fem_penalty_hertz", "hertz", Method.PENALTY),
    Budget("fem_indentation", "indentation", Method.ELEMENTS, steps=True),
    Budget("fem_penalty_indentation", "indentation", Method.PENALTY, steps=True),
)


def parts_of(budget: Budget, level: Level, found: Found) -> tuple[Row, ...]:
    """The error of every quantity and its parts, not negative; nothing if the base solve was lost.

    Measures are the distance of the base solve from the reference, TOTAL, and by choice how much
    the error changes when that alone is refined; of a choice whose solve was lost there is none.
    """
    base = found.get(budget.base(level))
    if base is None:
        return ()
    finer = {name: found[case] for name, case in budget.refined(level).items() if case in found}
    rows = []
    for quantity, meaning in CONTACTS[budget.contact].errors.items():
        error = value_of(base, quantity)
        parts = {name: abs(error - value_of(row, quantity)) for name, row in finer.items()}
        rows.append(
            Row(
                parameters={"case": budget.case, "quantity": quantity, "meaning": meaning},
                measures={TOTAL: abs(error), **parts},
                words={"largest": max(parts, key=lambda choice: parts[choice])} if parts else {},
            )
        )
    return tuple(rows)
