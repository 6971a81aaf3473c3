"""Fail unless the report in a folder is complete and every verdict in it passed.

usage: check_report.py FOLDER
"""

import json
import sys
from pathlib import Path

folder = Path(sys.argv[1])
missing = [name for name in ("index.html", "report.json") if not (folder / name).is_file()]
if missing:
    sys.exit(f"{folder} lacks {' and '.join(missing)}")

LARGEST_PAGE = 1_000_000  # bytes at the quick level
size = (folder / "index.html").stat().st_size
if size > LARGEST_PAGE:
    sys.exit(f"{folder}/index.html has {size} bytes, more than {LARGEST_PAGE}")

counts = json.loads((folder / "report.json").read_text(encoding="utf-8"))["counts"]
print("Verdicts: " + ", ".join(f"{number} {verdict}" for verdict, number in counts.items()))
if counts["fail"] or not counts["pass"]:
    sys.exit("the verification failed, or judged nothing")
