"""Names of files that lead elsewhere."""

from __future__ import annotations

import os
import random
import sys
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from contact_scene import SceneError, read_scene_file
from verification.studies.promises.commands import run
from verification.studies.promises.promise import Attempt

# OUT is a folder beside that of the scene; what it holds would be taken if it were read.
NAMES = (
    *("../out/h.npy", "OUT/h.npy", "a/../../out/h.npy", "./../out/h.npy", "..//out//h.npy"),
    *("a/../h.npy", "..", ".", "", "/", "../out", "a/", "h.npy/../../out/h.npy"),
    *("link.npy", "linked/h.npy", "a/link.npy", "dangling.npy", "loop.npy", "queue.npy"),
    *(
        "..\\\\out\\\\h.npy",
        "C:\\\\h.npy",
        "c:/h.npy",
        "\\\\\\\\server\\\\share\\\\h.npy",
        "//server/h",
    ),
    *("file://OUT/h.npy", "http://localhost:9/h.npy", "~/h.npy", "$HOME/h.npy", "%2e%2e/out/h.npy"),
    *("．．/out/h.npy", "..\\u2215out\\u2215h.npy", "h.npy\\u0000.txt", "h.npy\\n", "\\u202eh.npy"),
    *("/dev/zero", "/dev/stdin", "/proc/self/environ", "/etc/passwd", "CON", "NUL", "h.npy:x"),
    *("|id", "$(id)", "`id`", "a" * 5000, 300 * "a/" + "h.npy", "-o", "*.npy"),
)
FILES = (
    'shape = "height_map"\nfile = "NAME"\nspacing = "10 um"',
    'shape = "sphere"\nradius = "10 mm"\nfriction = { coefficient = { map = "NAME", '
    'spacing = "10 um" } }',
)
SCENE = """[indenter]
INDENTER
material = "rigid"
[body]
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
FRICTION
[[loading]]
normal_force = 1
"""
OF_THE_SYSTEM = ("/dev/", "/proc/", "/etc/")
COMMANDS = (("verify", "NAME"), ("maintain", "study", "NAME"), ("challenge", "export", "NAME"))
ASKED = ("../out/x", "OUT/x", "hertz_point/../../out/x", "..", "/", "hertz_point\n", "CON", "a:b")


def escaping(count: int) -> Iterator[Attempt]:
    """Each name where a scene names a file, then where a command takes the name of a case."""
    tries: list[Any] = [*product((0, 1), NAMES), *product(COMMANDS, ASKED)]
    random.Random(24).shuffle(tries)
    for where, name in tries[:count]:
        with TemporaryDirectory() as folder:
            scenes, out = _folders(Path(folder))
            before = _content(Path(folder))
            given = name.replace("OUT", str(out))
            tell = _command if isinstance(where, tuple) else _file
            told = tell(where, given, scenes, out)
            changed = _content(Path(folder)) != before
        yield Attempt(not told and not changed, f"{where} {name[:60]!r}: {told or 'wrote'}")


def _folders(folder: Path) -> tuple[Path, Path]:
    """That of the scene, with links out of it, and another one beside it."""
    scenes, out = folder / "scenes", folder / "out"
    (scenes / "a").mkdir(parents=True)
    out.mkdir()
    for place in (scenes / "h.npy", out / "h.npy"):
        np.save(place, np.zeros((8, 8)))
    (scenes / "link.npy").symlink_to(out / "h.npy")
    (scenes / "a" / "link.npy").symlink_to(out / "h.npy")
    (scenes / "linked").symlink_to(out)
    (scenes / "dangling.npy").symlink_to(out / "none.npy")
    (scenes / "loop.npy").symlink_to(scenes / "loop.npy")
    os.mkfifo(scenes / "queue.npy")
    return scenes, out


def _content(folder: Path) -> list[tuple[str, int]]:
    """Names and sizes of all that is there but in the cache."""
    found = (path for path in folder.rglob("*") if "cache" not in path.parts)
    return sorted((str(path), path.lstat().st_size) for path in found)


_watched: list[list[str]] = []
_listening = False


def _listen() -> None:
    """Let Python tell of every file that is opened; it cannot be told to stop."""
    global _listening
    if _listening:
        return

    def heard(event: str, given: tuple[Any, ...]) -> None:
        if _watched and event in ("open", "os.listdir", "socket.connect"):
            _watched[-1].append(str(given[0]))

    sys.addaudithook(heard)
    _listening = True


def _file(where: int, name: str, scenes: Path, out: Path) -> str:
    """What is wrong with how a scene with such a file ended; empty for nothing."""
    shape, _, friction = FILES[where].replace("NAME", name).partition("\nfriction = ")
    rest = f"friction = {friction}" if friction else ""
    text = SCENE.replace("INDENTER", shape).replace("FRICTION\n", "")
    path = scenes / "scene.toml"
    path.write_text(f"{rest}\n{text}", encoding="utf-8")
    _listen()
    opened: list[str] = []
    _watched.append(opened)
    try:
        read_scene_file(path)
        told = "read"
    except SceneError as error:
        named = all(str(p).isprintable() and len(str(p)) < 1000 for p in error.problems)
        told = "" if named and error.problems else f"not named: {error}"
    except Exception as error:  # whatever it is, it is no refusal
        told = f"{type(error).__name__}: {error}"
    finally:
        _watched.pop()
        path.unlink()
    elsewhere = (str(out), *OF_THE_SYSTEM)
    outside = [place for place in opened if os.path.realpath(place).startswith(elsewhere)]
    return told or (f"opened {outside}" if outside else "")


def _command(where: tuple[str, ...], name: str, scenes: Path, out: Path) -> str:
    end = run(scenes, *(name if word == "NAME" else word for word in where))
    refused = end.code == 2 and "Traceback" not in end.said
    return "" if refused else f"exit code {end.code}: {end.said[-200:]}"
