"""Wrong answers to challenges, as files, and a function that solves another one wrongly.

`answers.py FOLDER CLAIMS LEVEL...` completes `answers.json` of a folder. A level is its size h and
its numbers QUANTITY.STEP=VALUE, VALUE±UNCERTAINTY or a list.
"""

import json
import sys
from pathlib import Path

from verification import Answer


def level_of(text):
    """Level of an answer from its size and numbers."""
    h, *given = text.split()
    numbers = []
    for one in given:
        key, _, value = one.partition("=")
        quantity, _, step = key.partition(".")
        number, _, u = value.partition("±")
        numbers.append({"quantity": quantity, "load_step": int(step), "value": json.loads(number)})
        if u:
            numbers[-1]["u"] = float(u)
    return {"h": float(h), "numbers": numbers}


def solve(problem, level):
    """Hertz's contact, with an error that halves with the level."""
    off = 1 + 0.004 / 2**level
    values = {("approach", 1): 8.37e-6 * off, ("contact_radius", 1): 3.882e-4 / off}
    return Answer(1e-5 / 2**level, values, unknowns=100 * 4**level)


if __name__ == "__main__":
    file, claims = Path(sys.argv[1], "answers.json"), json.loads(sys.argv[2])
    content = json.loads(file.read_text(encoding="utf-8"))
    content |= {"solver": {"name": "wrong"} | claims, "levels": [*map(level_of, sys.argv[3:])]}
    file.write_text(json.dumps(content, indent=1), encoding="utf-8")
