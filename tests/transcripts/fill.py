"""Write inputs: `fill.py FILE LINE...` writes lines, `fill.py FILE.json TO.json PLACE=VALUE...`
copies an existing record and sets or removes values in it, such as `cases/0/status="fail"`."""

import json
import sys
from pathlib import Path


def fill(name, *given):
    """Write a file of lines, or a changed copy of a record."""
    if not name.endswith(".json") or not Path(name).exists():
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).write_text("\n".join([*given, ""]), encoding="utf-8")
        return
    record = json.loads(Path(name).read_text(encoding="utf-8"))
    for change in given[1:]:
        place, _, value = change.partition("=")
        *outer, last = [int(key) if key.isdigit() else key for key in place.split("/")]
        part = record
        for key in outer:
            part = part[key]
        if value:
            part[last] = json.loads(value)
        else:
            del part[last]
    Path(given[0]).parent.mkdir(parents=True, exist_ok=True)
    Path(given[0]).write_text(json.dumps(record, indent=1), encoding="utf-8")


if __name__ == "__main__":
    fill(*sys.argv[1:])
