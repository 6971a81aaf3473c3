"""The studies that `slipstick study` knows."""

from verification.studies.coated_tractions import STUDY as COATED_TRACTIONS
from verification.studies.gross_sliding.study import STUDY as GROSS_SLIDING
from verification.studies.running.study import Study

STUDIES: dict[str, Study] = {study.name: study for study in (COATED_TRACTIONS, GROSS_SLIDING)}
