"""The studies that `slipstick maintain study` knows."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from fem_reference import Method
from verification.running.study import Study
from verification.studies.cross_check import STUDY as CROSS_CHECK
from verification.studies.error_budget.study import STUDY as ERROR_BUDGET
from verification.studies.error_coverage.study import STUDY as ERROR_COVERAGE
from verification.studies.mutants.study import STUDY as MUTANTS
from verification.studies.promises.study import STUDY as PROMISES
from verification.studies.refinement.domain import domain_study
from verification.studies.refinement.increments import increments_study
from verification.studies.refinement.mesh import mesh_study
from verification.studies.refinement.sampling import sampling_study
from verification.studies.refinement.window import window_study
from verification.studies.scoreboard import STUDY as SCOREBOARD
from verification.studies.seeded_defects.study import STUDY as SEEDED_DEFECTS
from verification.studies.sliding.coated_tractions import STUDY as COATED_TRACTIONS
from verification.studies.sliding.gross_sliding import STUDY as GROSS_SLIDING
from verification.studies.stability.study import STUDY as STABILITY
from verification.studies.work_precision.study import STUDY as WORK_PRECISION

SURFACE = None  # the semi-analytical method, among those of the finite elements
SECTION = (Method.COMPLEMENTARITY, Method.PENALTY)

# Path, overrides, number of a loading step, and the method.
SceneStudyOf = Callable[[Path, Sequence[str], int | None, Method | None], Study]


@dataclass(frozen=True)
class SceneStudy:
    """A study that any scene file can have.

    title    a line for lists
    methods  by which it can be made; the first is taken if none is named
    """

    title: str
    of: SceneStudyOf
    methods: tuple[Method | None, ...]


STUDIES: dict[str, Study] = {
    study.name: study
    for study in (
        COATED_TRACTIONS,
        GROSS_SLIDING,
        STABILITY,
        CROSS_CHECK,
        SEEDED_DEFECTS,
        MUTANTS,
        WORK_PRECISION,
        ERROR_BUDGET,
        ERROR_COVERAGE,
        SCOREBOARD,
        PROMISES,
    )
}
SCENE_STUDIES: dict[str, SceneStudy] = {
    "mesh": SceneStudy(
        "What finite cells or elements cost in SCENE", mesh_study, (SURFACE, *SECTION)
    ),
    "increments": SceneStudy(
        "What finite increments cost in SCENE", increments_study, (SURFACE, *SECTION)
    ),
    "domain": SceneStudy(
        "What the end of the finite elements' section costs in SCENE", domain_study, SECTION
    ),
    "window": SceneStudy(
        "Whether the window of the surface grid matters in SCENE", window_study, (SURFACE,)
    ),
    "sampling": SceneStudy(
        "What sampling the frequency response would cost in SCENE", sampling_study, (SURFACE,)
    ),
}
