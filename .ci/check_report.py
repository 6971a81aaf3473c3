"""Fail unless the report in a folder is complete and every verdict in it passed.

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

counts = json.loads((folder / "report.json").read_text(encoding="utf-8"))["counts"]
print("Verdicts: " + ", ".join(f"{number} {verdict}" for verdict, number in counts.items()))
if counts["fail"] or not counts["pass"]:
    sys.exit("the verification failed, or judged nothing")
