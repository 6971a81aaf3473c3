"""One solve with a penalty, and its errors against a reference."""

from __future__ import annotations

from dataclasses import dataclass, replace

from contact_scene.residuals import worst
from fem_reference import Result
from verification.cases.fem_indentation import pressed
from verification.cases.fem_penalty_indentation import by_springs
from verification.judging.ladder import Ladder, meshed
from verification.judging.observables import APPROACH, PEAK_PRESSURE, PRESSURE_L2, PRESSURE_WITHIN
from verification.judging.pressing_errors import PRESSURE, SHEAR
from verification.judging.run import Run, SectionRun, per_radius
from verification.problems.hertz import BALL
from verification.problems.indentation import COATED, FEW, STRONG, WEAK
from verification.problems.paper_scene import HERTZ
from verification.running.row import CaseRecord, parameters_of
from verification.running.rules import RESIDUAL
from verification.solver import Method

HERTZIAN = "hertz"
FRICTIONAL = {"weak": WEAK, "strong": STRONG, "coated": COATED}
CONTACTS = (HERTZIAN, *FRICTIONAL)


@dataclass(frozen=True)
class PenaltyCase:
    """A contact on a mesh with a penalty.

    contact        one of CONTACTS
    elements       per contact radius
    factor         c
    augmentations  Uzawa updates in each increment
    increments     of the normal loading; without friction it takes one
    box            size of the section in contact radii; None: chosen
    """

    contact: str
    elements: int
    factor: float = 10.0
    augmentations: int = 1
    increments: int = FEW
    box: float | None = None

    @property
    def name(self) -> str:
        """For files."""
        parts = [self.contact, f"N{self.elements}", f"c{self.factor:g}", f"a{self.augmentations}"]
        if self.contact != HERTZIAN:
            parts.append(f"k{self.increments}")
        if self.box is not None:
            parts.append(f"L{self.box:g}")
        return "-".join(parts).replace(".", "p")

    @property
    def springs_per_radius(self) -> float:
        """k = ε a/E*, of Hertz's contact [1]."""
        return (
            self.factor * self.elements * HERTZ.contact_radius / meshed(BALL.radius, self.elements)
        )

    @property
    def _pressed(self) -> Ladder:
        return pressed(FRICTIONAL[self.contact], self.elements, self.increments)

    @property
    def _run(self) -> SectionRun:
        if self.contact == HERTZIAN:
            mesh = per_radius(self.elements, meshed(BALL.radius, self.elements))
            run: Run | SectionRun = SectionRun(self.name, BALL.scene, mesh)
        else:
            run = self._pressed.judged.run
        assert isinstance(run, SectionRun)
        penalty = {
            "penalty": self.factor,
            "augmentations": self.augmentations,
            "overlap": 1.0,
            "box": self.box,
        }
        discretisation = run.discretisation.model_copy(update=penalty)
        return replace(run, discretisation=discretisation, method=Method.PENALTY)

    def compute(self) -> CaseRecord:
        """Solve and compare; raises what `fem_reference.solve` raises.

        approach, peak    relative errors, peak without friction only
        pressure, shear   largest errors over p_H and µp_H, shear with friction only
        ripple            L2 norm of the error of the pressure over that of the pressure, edge
                          included; without friction only
        overlap           largest, over the approach
        by_springs        increments that springs in series solved
        systems           linear systems of all increments
        """
        result = self._run.solve()
        end = result.steps[-1]
        errors = self._of_hertz(result) if self.contact == HERTZIAN else self._of_friction(result)
        systems = sum(i.iterations for i in result.increments)
        return CaseRecord(
            parameters=parameters_of(self) | {"springs_per_radius": self.springs_per_radius},
            measures={
                **errors,
                "overlap": (end.overlap or 0.0) / end.approach,
                "systems_per_increment": systems / len(result.increments),
                RESIDUAL: worst(*(i.residuals.worst for i in result.increments)),
            },
            counters={
                "increments": len(result.increments),
                "halvings": sum(i.halvings for i in result.increments),
                "by_springs": round(by_springs(result)),
                "systems": systems,
            },
        )

    def _of_hertz(self, result: Result) -> dict[str, float]:
        return {
            "approach": APPROACH.error(BALL)(result),
            "peak": PEAK_PRESSURE.error(BALL)(result),
            "pressure": PRESSURE_WITHIN.error(BALL)(result),
            "ripple": PRESSURE_L2.error(BALL)(result),
        }

    def _of_friction(self, result: Result) -> dict[str, float]:
        problem = self._pressed.problem
        return {what.name: what.error(problem)(result) for what in (APPROACH, PRESSURE, SHEAR)}
