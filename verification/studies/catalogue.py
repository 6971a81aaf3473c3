"""Table of the studies of `slipstick maintain study`."""

from verification.running.study import Study
from verification.studies.coated_tractions import STUDY as COATED_TRACTIONS
from verification.studies.error_coverage import STUDY as ERROR_COVERAGE
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
    )
}
