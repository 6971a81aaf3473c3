"""Tables of the studies that `slipstick maintain study` and the studies of scene files offer."""

from dataclasses import dataclass

from verification.running.study import Study
from verification.studies.coated_tractions import STUDY as COATED_TRACTIONS
from verification.studies.error_coverage.study import STUDY as ERROR_COVERAGE
from verification.studies.refinement.scene_level import CELLS, METHODS
from verification.studies.refinement.study import (
    SceneStudyOf,
    domain_study,
    increments_study,
    mesh_study,
)
from verification.studies.scoreboard import STUDY as SCOREBOARD
from verification.studies.seeded_defects import STUDY as SEEDED_DEFECTS
from verification.studies.stability.study import STUDY as STABILITY
from verification.studies.work_precision.study import STUDY as WORK_PRECISION


@dataclass(frozen=True)
class SceneStudy:
    """Describe a kind of convergence study that can be made of any scene file.

    title    one line for lists of studies
    of       function that makes the study of a scene file
    solvers  names of the solvers that can make the study; the first one is the default
    """

    title: str
    of: SceneStudyOf
    solvers: tuple[str, ...]


STUDIES: dict[str, Study] = {
    study.name: study
    for study in (
        COATED_TRACTIONS,
        STABILITY,
        SEEDED_DEFECTS,
        WORK_PRECISION,
        ERROR_COVERAGE,
        SCOREBOARD,
    )
}
SCENE_STUDIES: dict[str, SceneStudy] = {
    "mesh": SceneStudy(
        "Error of finite cells or elements in SCENE", mesh_study, (CELLS, *METHODS)
    ),
    "increments": SceneStudy(
        "Error of finite increments in SCENE", increments_study, (CELLS, *METHODS)
    ),
    "domain": SceneStudy(
        "Error of the end of the section of the finite elements in SCENE", domain_study,
        tuple(reversed(METHODS)),
    ),
}  # fmt: skip
