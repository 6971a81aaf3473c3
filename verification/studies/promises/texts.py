"""Scene files that somebody has damaged, or made to do harm."""

from __future__ import annotations

import gc
import json
import math
import random
import re
import time
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from contact_scene import SceneError, read_scene_file
from contact_scene.quantity import Quantity
from contact_scene.units import LENGTH
from verification.studies.promises.commands import run
from verification.studies.promises.promise import Attempt
from verification.studies.promises.scenes import EVERYTHING

LONGEST = 50.0  # ms of CPU for a damaged file
MEGABYTE = 1_000_000
MOST_MEMORY, SOON = 300.0, 1.0  # MiB and CPU seconds of a whole process, its start included
JUNK = (
    *("0", "-1", "1", "1" + 30 * "0", "true", "-0.0", "1e300", "5e-324", "nan", "inf", '""'),
    *('"rigid"', '"1 mm"', '"1 s"', '"sphere"', '"../x"', '"<sphere>"', '"1e9 GPa"', "[]", "{}"),
    *('"1 furlong"', "[[1]]", "[1, 2, 3]", "{ x = 1 }", "{ shape = 1 }", '"nan mm"', "1979-05-27"),
)
PIECES = (b"\n", b'"', b"[", b"]", b"{", b"=", b".", b"0", b"\x00", b"\xff", b"e", b"-")
EXTREME = ("nan", "inf", "-inf", "-1", "0", "-0.0", "5e-324", "1e-308", "1e308")
BOMBS = {
    "keys": b"a = 1\n" * (100 * MEGABYTE // 6),
    "steps": b"[[loading]]\n" * 800_000,
    "brackets": b"a = " + b"[" * 9 * MEGABYTE,
    "title": b'title = "' + 9 * MEGABYTE * b"a" + b'"',
    "lines": b'title = """' + 9 * MEGABYTE * b"\n" + b'"""',
    "digits": b"\na = " + b"1" * MEGABYTE,
    "tables": b"[a" + 2000 * b".a" + b"]",
}


def lines_changed(count: int) -> Iterator[Attempt]:
    """Values replaced, keys renamed, lines taken out, doubled and exchanged."""
    chance, lines = random.Random(20), EVERYTHING.splitlines()
    for _ in range(count):
        changed = list(lines)
        for _ in range(chance.randint(1, 4)):
            at = chance.randrange(len(changed))
            key, sign, _ = changed[at].partition(" = ")
            change = chance.choice(("value", "value", "key", "out", "double", "exchange"))
            if change == "value" and sign:
                changed[at] = f"{key} = {chance.choice(JUNK)}"
            elif change == "key":
                changed[at] = changed[at][1:]
            elif change == "double":
                changed.insert(chance.randrange(len(changed)), changed[at])
            elif change == "exchange":
                other = chance.randrange(len(changed))
                changed[at], changed[other] = changed[other], changed[at]
            elif len(changed) > 1:
                del changed[at]
        yield _read("\n".join(changed).encode())


def bytes_changed(count: int) -> Iterator[Attempt]:
    """Bytes replaced, taken out and put in."""
    chance = random.Random(21)
    for _ in range(count):
        content = bytearray(EVERYTHING.encode())
        for _ in range(chance.randint(1, 4)):
            at, length = chance.randrange(len(content)), chance.choice((0, 0, 1, 1, 2, 10, 500))
            content[at : at + length] = chance.choice((*PIECES, chance.randbytes(3)))
        yield _read(bytes(content))


def numbers_changed(count: int) -> Iterator[Attempt]:
    """Each number of the file in turn by each extreme one."""
    places = list(re.finditer(r"(?<= )\"?-?\d[\d.e-]*(?: [a-zA-Z/^2 ]+\")?|(?<=\[)\d+", EVERYTHING))
    pairs = [(place, number) for number in EXTREME for place in places]
    random.Random(22).shuffle(pairs)
    for place, number in pairs[:count]:
        line = EVERYTHING.count("\n", 0, place.start()) + 1
        content = EVERYTHING[: place.start()] + number + EVERYTHING[place.end() :]
        yield _read(content.encode(), line)


def _read(content: bytes, line: int | None = None) -> Attempt:
    """Read, or refused by name and soon.

    line  of the only mistake: a refusal has to name a line, that one or one that it spoils
    """
    Quantity(LENGTH, "a length")("1 inch")  # the first such unit waits for the library of units
    with TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_bytes(content)
        begun, told = time.process_time(), ""
        gc.disable()  # what the tries before have left is not the reader's to tidy up
        try:
            scene = read_scene_file(path).scene
            took = 1e3 * (time.process_time() - begun)
            json.dumps(scene.model_dump(mode="json"), allow_nan=False)
        except SceneError as error:
            took = 1e3 * (time.process_time() - begun)
            named = all(str(p).isprintable() and p.file == str(path) for p in error.problems)
            told = "" if named and error.problems else f"not named: {error}"
            if line is not None and not any(p.line for p in error.problems):
                told = f"no line named: {error}"
        except Exception as error:  # whatever it is, it is no refusal
            return Attempt(False, f"{type(error).__name__}: {error}", math.nan)
        finally:
            gc.enable()
    if took > LONGEST:
        told = f"{took:.0f} ms for {content[:60]!r}"
    return Attempt(not told, told, took)


def bombs(count: int) -> Iterator[Attempt]:
    """Small to write, large to read."""
    with TemporaryDirectory() as folder:
        scene = Path(folder) / "scene.toml"
        scene.touch()
        start = run(Path(folder), "check", "scene.toml").seconds
        for name, content in list(BOMBS.items())[:count]:
            scene.write_bytes(content)
            end = run(Path(folder), "check", "scene.toml")
            took = end.seconds - start
            good = end.code == 2 and end.memory < MOST_MEMORY and took < SOON
            told = f"{name}: exit code {end.code}, {end.memory:.0f} MiB, {took:.1f} s"
            yield Attempt(good, told, end.memory)
