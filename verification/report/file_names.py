"""Names of the files of a verification report and of a study."""

from verification.running.report_record import PACKED_SUFFIX
from verification.running.study import RECORD as STUDY_RECORD

PAGE = "index.html"
SHEETS = "sheets.html"  # one sheet per case
RECORD = "report.json"
PACKED = f"{RECORD}{PACKED_SUFFIX}"  # what is kept of a report: `xz report.json` makes it
JUNIT = "junit.xml"
SUMMARY = "summary.md"
FILES = (RECORD, PAGE, SHEETS, JUNIT, SUMMARY)  # of any report
POSSIBLE = (*FILES, PACKED)
STUDY_FILES = (STUDY_RECORD, PAGE)
CASES = "cases"  # of the directory: the records of finished cases
