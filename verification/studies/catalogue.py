"""Tables of all studies: those of `slipstick maintain study`, and those of a user's scene file."""

from verification.running.study import Study
from verification.studies.coated_tractions import STUDY as COATED_TRACTIONS
from verification.studies.error_coverage import STUDY as ERROR_COVERAGE
from verification.studies.refinement import SceneStudyOf, increments_study, mesh_study
from verification.studies.scoreboard import STUDY as SCOREBOARD
from verification.studies.seeded_defects import STUDY as SEEDED_DEFECTS
from verification.studies.stability.study import STUDY as STABILITY
from verification.studies.work_precision import STUDY as WORK_PRECISION

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
# Studies of any scene file: title for lists, and function that makes the study of a file.
SCENE_STUDIES: dict[str, tuple[str, SceneStudyOf]] = {
    "mesh": ("Error of finite cells or elements in SCENE", mesh_study),
    "increments": ("Error of finite increments in SCENE", increments_study),
}
