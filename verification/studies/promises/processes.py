"""Commands that are killed, interrupted, repeated, or asked for what nobody builds."""

from __future__ import annotations

import random
import re
import shutil
import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from verification.studies.promises.commands import EAGER, begun, ended, results, run
from verification.studies.promises.promise import Attempt
from verification.studies.promises.scenes import CONTACT, LAYER, absurd, fretting

SOLVERS = ("semi-analytical", "fem", "fem-complementarity", "radial")
QUIET = ("--figures", "none", "--no-error")
WITHIN = 0.15  # of the peak
LONGEST = 10.0  # CPU seconds of a plan
ANSWERS = {0, 2, 3, 4}  # an answer, or a refusal by name
FILM = LAYER.format(thickness=0.05, modulus=70.0, nu=0.33)


@contextmanager
def _scene(text: str) -> Iterator[Path]:
    """A directory with a scene in it."""
    with TemporaryDirectory() as folder:
        (Path(folder) / "scene.toml").write_text(text, encoding="utf-8")
        yield Path(folder)


def repeated(count: int) -> Iterator[Attempt]:
    """The same run in a fresh process, with one thread and with two, by solver in turn."""
    for number in range(count):
        solver, threads = SOLVERS[number % len(SOLVERS)], 2 - number // len(SOLVERS) % 2
        files = []
        film = FILM if number % 2 and solver != "radial" else ""  # too little slip for its rings
        with _scene(fretting(layer=film, pushes=2)) as folder:
            for out, used in (("one", 1), ("other", threads)):
                words = ("run", "scene.toml", "--solver", solver, "-o", out, *QUIET)
                shutil.rmtree(folder / "cache", ignore_errors=True)  # its hits are counted
                run(folder, *words, threads=used)
                files.append(results(folder / out))
        same = bool(files[0]) and files[0] == files[1]
        yield Attempt(same, f"{solver}, {threads} threads: other bytes")


def killed(count: int) -> Iterator[Attempt]:
    """One run after the other is killed at some time, then ends; what it leaves is compared."""
    chance = random.Random(7)
    for number in range(0, count, 5):
        solver = SOLVERS[number // 5 % len(SOLVERS)]
        words = ("run", "scene.toml", "--solver", solver, "-o", "out", *QUIET)
        with _scene(fretting(cells=24, elements=6, layer=FILM, pushes=6)) as folder:
            run(folder, *words, program=EAGER)  # the cache is filled, as it will be for all others
            shutil.rmtree(folder / "out")
            run(folder, *words)
            expected = results(folder / "out")
            shutil.rmtree(folder / "out")
            sound, told = bool(expected), "no results"
            for _ in range(min(5, count - number)):
                process = begun(folder, *words, program=EAGER)
                time.sleep(chance.uniform(0.5, 6.0))
                process.send_signal(signal.SIGKILL)
                ended(process)
                shown = results(folder / "out")
                if "summary.json" in shown and shown != expected:
                    sound, told = False, f"{solver}: an incomplete result is shown"
            end = run(folder, *words)
            if sound and (results(folder / "out") != expected or "damaged" in end.said):
                sound, told = False, f"{solver}: other bytes after kills: {end.said[-200:]}"
            left = {path.name for path in folder.iterdir()} - {"scene.toml", "out", "cache"}
            left |= {path.name for path in (folder / "out").glob(".*")}
            if left:
                sound, told = False, f"{solver}: left {sorted(left)}"
            yield from [Attempt(sound, told)] * min(5, count - number)


COMMANDS = (
    ("run", "scene.toml", "-o", "out"),
    ("run", "scene.toml", "-o", "out", "--solver", "fem"),
    ("run", "scene.toml", "-o", "out", "--accuracy", "1%"),
    ("run", "scene.toml", "-o", "out", "--solver", "radial"),
    ("stress", "scene.toml", "-o", "out"),
    ("challenge", "export", "hertz_point", "-o", "out"),
    ("table", "ball"),
    ("plan", "scene.toml", "--accuracy", "1%"),
    ("verify", "hertz_point", "-o", "out"),
    ("maintain", "study", "cross-check", "-o", "out", "--workers", "1"),
    ("check", "scene.toml"),
)


def interrupted(count: int) -> Iterator[Attempt]:
    """Each command in turn, in the foreground, after some time."""
    chance = random.Random(8)
    for number in range(count):
        words = COMMANDS[number % len(COMMANDS)]
        film = "" if "radial" in words else FILM  # too little slip for its rings
        with _scene(fretting(layer=film, pushes=20)) as folder:
            process = begun(folder, *words)
            time.sleep(chance.uniform(0.2, 5.0))
            process.send_signal(signal.SIGINT)
            end = ended(process)
            left = [p.name for p in folder.rglob("*") if ".partial-" in p.name]
            # Before the command has begun it dies of the signal, which a shell calls 130, too.
            ends = (0, 128 + signal.SIGINT, -signal.SIGINT)
            good = end.code in ends and "Traceback" not in end.said
            told = f"{' '.join(words)}: exit code {end.code}, left {left}: {end.said[-200:]}"
            yield Attempt(good and not left, told)


def estimated(count: int) -> Iterator[Attempt]:
    """Memory that is planned, against the peak of the run, writing and figures included."""
    chance = random.Random(9)
    for number in range(count):
        solver = SOLVERS[number % len(SOLVERS)]
        film = LAYER.format(
            thickness=CONTACT * 2.0 ** chance.uniform(-2, 2),
            modulus=210.0 * 2.0 ** chance.uniform(-2, 2), nu=chance.uniform(0.1, 0.45),
        )  # fmt: skip
        text = fretting(
            cells=2 * round(2.0 ** chance.uniform(4, 8)), elements=chance.choice((8, 16, 32)),
            nu=chance.choice((0.3, 0.2)), layer=film if chance.random() < 0.5 else "",
            pushes=chance.choice((0, 2)) if solver in ("semi-analytical", "radial") else 0,
        )  # fmt: skip
        words = ("scene.toml", "--solver", solver)
        with _scene(text) as folder:
            told = re.search(r"memory +about (\d+) MiB", run(folder, "plan", *words).out)
            shutil.rmtree(folder / "cache", ignore_errors=True)
            end = run(folder, "run", *words, "-o", "out")
        if told is None or end.code not in ANSWERS:
            yield Attempt(False, f"{solver}: nothing planned, or exit code {end.code}")
            continue
        error = float(told[1]) / end.memory - 1.0
        said = f"{solver}: {told[1]} MiB planned, {end.memory:.0f} MiB taken"
        yield Attempt(abs(error) <= WITHIN, said, 1e2 * abs(error))


def planned(count: int) -> Iterator[Attempt]:
    """Contacts that nobody builds, by each solver: how long until there is an answer."""
    asked = [(name, text, solver) for name, text in absurd() for solver in SOLVERS]
    random.Random(10).shuffle(asked)
    for name, text, solver in asked[:count]:
        with _scene(text) as folder:
            end = run(folder, "plan", "scene.toml", "--solver", solver)
        told = f"{name}, {solver}: exit code {end.code}, {end.seconds:.1f} s"
        yield Attempt(end.code in ANSWERS and end.seconds <= LONGEST, told, end.seconds)
