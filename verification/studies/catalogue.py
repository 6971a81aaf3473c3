"""The studies that `slipstick study` knows."""

from collections.abc import Callable, Sequence
from pathlib import Path

from verification.studies.coated_tractions import STUDY as COATED_TRACTIONS
from verification.studies.cross_check.study import STUDY as CROSS_CHECK
from verification.studies.error_budget.study import STUDY as ERROR_BUDGET
from verification.studies.gross_sliding.study import STUDY as GROSS_SLIDING
from verification.studies.penalty.study import STUDY as PENALTY
from verification.studies.refinement.study import increments_study, mesh_study
from verification.studies.running.study import Study
from verification.studies.seeded_defects.study import STUDY as SEEDED_DEFECTS
from verification.studies.stability.study import STUDY as STABILITY
from verification.studies.work_precision.study import STUDY as WORK_PRECISION

# A study of a scene file: path, overrides and the number of a loading step.
SceneStudy = Callable[[Path, Sequence[str], int | None], Study]

STUDIES: dict[str, Study] = {
    study.name: study
    for study in (
        COATED_TRACTIONS,
        GROSS_SLIDING,
        STABILITY,
        PENALTY,
        CROSS_CHECK,
        SEEDED_DEFECTS,
        WORK_PRECISION,
        ERROR_BUDGET,
    )
}
SCENE_STUDIES: dict[str, tuple[str, SceneStudy]] = {
    "increments": ("What finite increments cost in SCENE", increments_study),
    "mesh": ("What finite cells cost in SCENE", mesh_study),
}
