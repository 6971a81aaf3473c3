"""Fail unless the report in a folder is complete, every verdict in it passed, and its exact curves
are of the size of their unit.

usage: check_report.py FOLDER
"""

import json
import sys
from pathlib import Path

folder = Path(sys.argv[1])
LARGEST = {"index.html": 800_000, "sheets.html": 1_500_000}  # bytes at the quick level
missing = [name for name in (*LARGEST, "report.json") if not (folder / name).is_file()]
if missing:
    sys.exit(f"{folder} lacks {' and '.join(missing)}")

for name, largest in LARGEST.items():
    if (size := (folder / name).stat().st_size) > largest:
        sys.exit(f"{folder}/{name} has {size} bytes, more than {largest}")

report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
# Units of curves are peak values of Hertz: the largest of the full report are 0.2 to 5.5.
for chart in (chart for case in report["cases"] for chart in case["charts"]):
    for curve in (curve for row in chart["rows"] for panel in row for curve in panel["curves"]):
        size = max(map(abs, curve["y"]), default=0.0)
        if curve["look"] == "reference" and size and not 0.1 < size < 10:
            sys.exit(f"the exact curve of {chart['name']} is {size} of its unit, expected about 1")

counts = report["counts"]
print("Verdicts: " + ", ".join(f"{number} {verdict}" for verdict, number in counts.items()))
if counts["fail"] or not counts["pass"]:
    sys.exit("the verification failed, or judged nothing")
