"""Transcripts of the command: what it prints and writes, as text whose numbers can be compared.

A transcript in `tests/transcripts` begins with its own input, lines `$ ...`. Below each command are
its exit code, its output and the content of every file that it wrote. A table, a record or an array
has one line per column, key or dataset. Long ones are replaced by their sum, a weighted sum and
samples: an exchange of axes, rows, signs or units changes the weighted sum.

    python tests/transcript.py --because REASON [NAME...]    accepts new transcripts
"""

import argparse
import csv
import json
import multiprocessing
import re
import shlex
import shutil
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, chdir, redirect_stderr, redirect_stdout
from difflib import SequenceMatcher
from html import unescape
from io import StringIO
from itertools import count, zip_longest
from pathlib import Path
from runpy import run_path
from tempfile import TemporaryDirectory
from unittest.mock import patch
from zlib import crc32

import h5py
import meshio
import numpy as np
from figure_text import figure_lines

from slipstick.cli import main
from verification.running.case_pool import ThisProcess

FOLDER = Path(__file__).with_name("transcripts")
INPUTS = (".toml", ".csv", ".py")
LEFT_OUT = (".pyc", ".npy")  # files that are not text and that no command writes
FORK = multiprocessing.get_context("fork")
SHOWN = 12  # values of a column that are shown one by one; of a longer one, as many samples
# Allowed difference, relative to a number and to the largest number of its line.
RELATIVE = 1e-5
OF_LINE = 1e-6
LOOSER = (  # pattern of a line, allowed difference: relative, of the line's largest, absolute
    (re.compile("^out: (constant|estimate) "), 1e-9, 0.0, 0.0),  # without a solve
    (re.compile("^out: judged on few "), 1e-4, 1e-5, 1e-7),  # errors of coarse solves
    (re.compile("^out: (runs|judged|study|posed) "), 1e-9, 1e-9, 0.0),  # sums of logarithms
    # Where a solve ends depends on round-off; half of its tolerance.
    (re.compile("residual|imbalance"), 0.3, 0.0, 5e-9),
    # As in comparisons of reports: preconditioners and first guesses change nothing else.
    (re.compile("iterations|convolutions|sweeps|rounds|augmentations"), 0.05, 0.0, 3.0),
    (re.compile('_uncertainty"'), 0.1, 0.0, 1e-10),  # round-off of a table
    (re.compile("shear_error"), 5e-3, 1e-4, 1e-9),  # round-off where increments change nothing
    (re.compile("tangential_shift_y"), RELATIVE, OF_LINE, 1e-20),  # [m] across a push
    (re.compile("centre_of_force"), RELATIVE, OF_LINE, 1e-12),  # [m] of a contact in the middle
    (re.compile("unresolved_work"), RELATIVE, OF_LINE, 1e-18),  # [J] of a load without friction
    (re.compile(r"verdicts\[\]\.error: "), 5e-3, 1e-4, 1e-9),  # relative to the scale of each
    # Differences of nearly equal solves: round-off of the approach [m] and the pressure [Pa].
    (re.compile("approach[.]numerical: "), 5e-3, 1e-4, 1e-17),
    (re.compile("pressure[.]numerical: "), 5e-3, 1e-4, 1e-2),
    # Differences of solves; an order is the logarithm of the ratio of two.
    (re.compile("error|uncertainty|remaining|numerical|gap_of"), 5e-3, 1e-4, 0.0),
    (re.compile(r"order( \[1\])?: |half_width"), 5e-3, 1e-3, 0.05),
    (re.compile("AxesImage|ContourSet|drawing"), 1e-2, 1e-2, 0.0),  # pixels and cells on a border
)
# Round-off changes single counts of work; the sum over all solves shows a worse first guess.
WORK = re.compile("(iterations|convolutions|sweeps|rounds): ")
SUM_OF_WORK = 0.01
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?(?![\w.]*\w)")
STATED_ERROR = re.compile(r"± (\d+\.\d+(?:e[-+]?\d+)?)")  # of a difference of solves, two digits
# Part of an error by the tolerance of the solves: the other parts are differences of such solves.
TOLERANCE_PART = re.compile(r"parts\.tolerance ([\d.e+-]+)")
VARIABLE = (  # text that differs between machines, versions and times
    (re.compile(r"((about|less than) )?\b\d[\d.]* ([mµ]?s|min|h|hours|minutes)\b"), "TIME"),
    (re.compile(r"(about )?\b\d[\d.]* [KMG]i?B\b"), "MEMORY"),
    (re.compile(r"\b\d{4}-\d\d-\d\d([T ][\d:.]+(Z|\+[\d:]+)?)?"), "DATE"),
    (re.compile(r"(?<![.\w])(?=[0-9]*[a-f])[0-9a-f]{12,64}\b"), "DIGEST"),
    (re.compile(r"(?<=[\w.]-)[0-9a-f]{8}\b"), "DIGEST"),
    (re.compile(r"data:[\w/+;-]+,[\w+/=]+"), "DATA"),
    (re.compile(r"\b\d+\.\d+\.\d+(\.\w+)?\b"), "VERSION"),
    (re.compile(r"(differs( here)?:|cases? \w+ compared with|of (the|\d+) cases:) .*"), "BASELINE"),
)
# Of a plan: memory by the sizes of arrays, time by the counted clock of `_run`.
ESTIMATE = re.compile("^out: .*([KMG]iB|error estimates included)$")
VARIABLE_KEY = re.compile(
    "seconds|bytes|machine|libraries|version$|started|commit|provenance|processor|regression"
    "|baseline[.]|by[.]"
)


def transcribe(commands: Iterable[str], directory: Path) -> list[str]:
    """Run commands in a directory with the inputs of all transcripts; return the transcript."""
    for path in FOLDER.iterdir():
        if path.suffix in INPUTS:
            shutil.copy(path, directory)
    lines, known = [], _contents(directory)
    for command in commands:
        lines += [f"$ {command}", *_run(shlex.split(command), directory)]
        written = _contents(directory)
        for name in sorted(known.keys() - written.keys()):
            lines.append(f"removed: {name}")
        for name in sorted(written):
            if written[name] != known.get(name):
                lines += [f"written: {name}", *(f"    {x}" for x in file_lines(directory / name))]
        known = written
    return [_masked(line.replace(str(directory), "DIR")) for line in lines]


def _run(words: list[str], directory: Path) -> Iterator[str]:
    """Run `slipstick ...` or `python FILE ...`; yield exit code and output."""
    program, *arguments = words
    with ExitStack() as stack:
        out = stack.enter_context(redirect_stdout(StringIO()))
        err = stack.enter_context(redirect_stderr(StringIO()))
        stack.enter_context(chdir(directory))
        stack.enter_context(patch.dict("os.environ", COLUMNS="80"))
        stack.enter_context(patch("sys.argv", words[1:]))
        stack.enter_context(patch("time.process_time", count().__next__))  # a second of each solve
        stack.enter_context(patch("time.perf_counter", count().__next__))
        stack.enter_context(patch("slipstick.cli.progress.time", _Stopped))
        # A row of the table of pressing with friction would take half a minute.
        stack.enter_context(patch("slipstick.tables.frictional.PATH_INCREMENTS", 12))
        for module in ("figure_files", "style"):
            stack.enter_context(patch(f"contact_results.figures.{module}.save", _write_figure))
        # Another interpreter would take a second to import what a function needs.
        stack.enter_context(patch("multiprocessing.get_context", lambda kind: FORK))
        pool = "verification.running.case_pool.LocalWorkers"
        stack.enter_context(patch(pool, lambda processes: ThisProcess()))
        try:
            main(arguments) if program == "slipstick" else run_path(
                arguments[0], run_name="__main__"
            )
            code = 0
        except SystemExit as end:
            code = end.code or 0
    yield f"exit code: {code}"
    yield from (f"out: {line}" for line in out.getvalue().splitlines() if line)
    messages = (line.strip("│╭╮╰╯─ ") for line in err.getvalue().splitlines())
    yield from (f"err: {line}" for line in messages if line)


class _Stopped:
    """A clock at which no line of progress is due."""

    monotonic = staticmethod(lambda: 0.0)


def _write_figure(figure, path, dots=0):
    """Write what a figure shows instead of its pixels."""
    path.write_text("\n".join(figure_lines(figure, array_text)), encoding="utf-8")


def _contents(directory: Path) -> dict[str, bytes]:
    """Files below a directory by name, without the stored cases that the other files summarise."""
    files = [
        path for path in directory.rglob("*") if path.is_file() and path.suffix not in LEFT_OUT
    ]
    names = {path.relative_to(directory): path for path in files}
    left_out = {"cases", "points", "seconds.csv", "junit.xml"}
    chosen = {name: path for name, path in names.items() if not left_out & {*name.parts}}
    return {name.as_posix(): path.read_bytes() for name, path in chosen.items()}


def _masked(line: str) -> str:
    for pattern, name in VARIABLE:
        line = line if ESTIMATE.match(line) else pattern.sub(name, line)
    return line


# ---- files as lines -----------------------------------------------------------------------------


def file_lines(path: Path) -> Iterator[str]:
    """Yield the content of a file as lines of text, by its kind."""
    if path.suffix in (".json", ".geojson"):
        text = path.read_text(encoding="utf-8")
        yield f"indentation: {min(map(len, re.findall('^ +', text, re.MULTILINE)), default=0)}"
        yield from record_lines(json.loads(text))
    elif path.suffix == ".h5":
        with h5py.File(path) as file:
            yield from group_lines(file)
    elif path.suffix == ".vtu":
        yield from mesh_lines(path)
    elif path.suffix == ".csv":
        yield from table_lines(path.read_text(encoding="utf-8"))
    elif path.suffix in (".html", ".svg", ".xml"):
        yield from page_lines(path.read_text(encoding="utf-8"))
    else:
        yield from path.read_text(encoding="utf-8").splitlines()


def values_text(values: Iterable[object]) -> str:
    """Show a few values, or the number, sums and samples of many."""
    values = list(values)
    if len(values) <= SHOWN:
        return " ".join(map(_text, values))
    numbers = [v for v in values if isinstance(v, (int, float)) and not isinstance(v, bool)]
    others = [v for v in values if isinstance(v, bool) or not isinstance(v, (int, float))]
    parts = [f"{len(values)} values"]
    if others:
        distinct = list(dict.fromkeys(map(_text, others)))
        shown = " ".join(distinct[:SHOWN])
        words = "\n".join(_masked(_text(value)) for value in others)
        digest = crc32(NUMBER.sub("#", words).encode()) % 1000
        parts.append(f"{len(others)} texts, digest {digest}: {shown}")
        within = [float(number) for number in NUMBER.findall(words)]
        parts += [f"numbers in texts: {array_text(within)}"] if within else []
    if numbers:
        parts.append(array_text(np.array(numbers, float)))
    return "; ".join(parts)


def array_text(array):
    """Show size, sums and samples of an array."""
    flat = np.asarray(array).ravel().astype(float)
    finite = np.where(np.isfinite(flat), flat, 0.0)
    weights = np.sin(1 + 1.7 * np.arange(flat.size) + 1e-3 * np.arange(flat.size) ** 2)
    shown = flat[np.linspace(0, flat.size - 1, SHOWN // 2).astype(int)] if flat.size else flat
    sums = [np.abs(finite).max(initial=0), finite.sum(), finite @ weights, *shown]
    others = np.count_nonzero(~np.isfinite(flat))
    missing = f"{others} not finite; " if others else ""
    return f"{missing}largest, sum, weighted, samples: {' '.join(map(_text, sums))}"


def _text(value):
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float):
        return f"{value:.9g}"
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False, default=str)


def record_lines(record):
    """Yield one line per key of a JSON record, with the values of all elements of its lists.

    An error and its parts share a line."""
    columns = {}

    def collect(key, value):
        if isinstance(value, Mapping):
            for name, part in value.items():
                collect(f"{key}.{name}" if key else name, part)
        elif isinstance(value, list) and value:
            for part in value:
                collect(f"{key}[]", part)
        else:
            columns.setdefault(key, []).append(value)

    collect("", record)
    groups = {}
    for key, values in columns.items():
        group, _, part = re.sub(r"(\.errors?\.\w+|residuals)\.", r"\1:", key).partition(":")
        if not VARIABLE_KEY.search(key):
            text = values_text(values)
            groups.setdefault(group, []).append(f"{part} {text}" if part else text)
    yield from (f"{group}: {'; '.join(texts)}" for group, texts in groups.items())


def table_lines(text: str) -> Iterator[str]:
    """Yield one line per column of a CSV table, below its comments."""
    lines = text.splitlines()
    yield from (line for line in lines if line.startswith("#"))
    rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    for head, *column in zip_longest(*rows, fillvalue=""):
        yield f"{head}: {values_text(map(_number_or_text, column))}"


def _number_or_text(text):
    try:
        return float(text)
    except ValueError:
        return text


def group_lines(file):
    """Yield one line per dataset and attribute of an HDF5 file."""
    yield from (f"{file.name} @{name}: {_numbers_text(v)}" for name, v in file.attrs.items())
    for item in file.values():
        if isinstance(item, h5py.Group):
            yield from group_lines(item)
            continue
        marks = " ".join(f"{name}={_numbers_text(v)}" for name, v in item.attrs.items())
        value = item[()]
        head = f"{item.name} {item.shape} {item.dtype} {marks}: "
        if isinstance(value, bytes) and value.startswith(b"{"):
            yield from (f"{item.name}.{line}" for line in record_lines(json.loads(value)))
        elif item.dtype.kind in "fiub":
            yield head + _numbers_text(value)
        else:
            yield head + values_text(np.ravel(value).astype(str).tolist())


def _numbers_text(array):
    return array_text(array) if np.size(array) > SHOWN else values_text(np.ravel(array).tolist())


def mesh_lines(path: Path) -> Iterator[str]:
    """Yield one line per array of a VTU file, and its comment."""
    yield from re.findall(r"<!--.*?-->", path.read_bytes().decode("utf-8", "replace"))
    mesh = meshio.read(path)
    yield f"points {mesh.points.shape}: {array_text(mesh.points)}"
    for block in mesh.cells:
        yield f"{block.type} {block.data.shape}: {array_text(block.data)}"
    for name, values in mesh.point_data.items():
        yield f"at points: {name} {values.shape}: {array_text(values)}"
    for name, blocks in mesh.cell_data.items():
        yield f"on cells: {name} {blocks[0].shape}: {array_text(blocks[0])}"


def page_lines(text: str) -> Iterator[str]:
    """Yield the text of a page line by line, with the looks and links of its parts; and of each
    drawing the sums of its coordinates."""
    text = re.sub(r"<(style|script).*?</\1>", "", text, flags=re.DOTALL)
    for part in re.split(r"(<svg.*?</svg>)", text, flags=re.DOTALL):
        for line in re.split(r"</(?:tr|p|h\d|li|div|figcaption|summary|title|text|pre)>", part):
            words = " ".join(unescape(re.sub(r"<[^>]*>", " ", line)).split())
            if words.startswith("made by slipstick"):
                return  # only provenance follows
            yield from [words] if words else []
        if part.startswith("<svg"):
            tags = " ".join(re.findall(r"<[^>]*>", part))
            numbers = [float(x) for x in re.findall(r"(?<![\w.#])-?\d+(?:\.\d+)?", tags)]
            yield f"drawing: {len(numbers)} coordinates; {array_text(np.array(numbers))}"
            looks = Counter(re.findall('(?:style|stroke|fill)="[^"]*"', tags))
            yield from (f"look of {number}: {look}" for look, number in looks.items())
        else:
            marks = re.findall('(?:class|href|open|rowspan|colspan|title|name)="[^"]*"', part)
            yield from [f"marks: {values_text(marks)}"] if marks else []


# ---- comparison ---------------------------------------------------------------------------------


def differences(accepted: list[str], found: list[str], shown: int = 6) -> list[str]:
    """Return the first lines that differ, below the command and the file that they belong to."""
    report = []
    words = [[_words(line) for line in lines] for lines in (accepted, found)]
    for _, a, b, c, d in SequenceMatcher(None, *words, autojunk=False).get_opcodes():
        for k in range(max(b - a, d - c)):
            old = accepted[a + k] if a + k < b else "(nothing)"
            new = found[c + k] if c + k < d else "(nothing)"
            if not _agree(old, new):
                report.append(
                    f"{_place(accepted[: a + k + 1])}\n  accepted: {old}\n  found:    {new}"
                )
    more = [f"and {len(report) - shown} more"] if len(report) > shown else []
    old, new = map(_work, (accepted, found))
    if abs(new - old) > max(3.0, SUM_OF_WORK * old):
        more.append(f"sum of iterations and convolutions\n  accepted: {old:g}\n  found:    {new:g}")
    return report[:shown] + more


def _work(lines: list[str]) -> float:
    """Sum of the counted work of all solves."""
    counts = (line.partition(": ")[2] for line in lines if WORK.search(line))
    return sum(float(number) for count in counts for number in NUMBER.findall(count))


def _place(lines: list[str]) -> str:
    """Command and file to which the last of the lines belongs."""
    command = next(k for k in reversed(range(len(lines))) if lines[k].startswith("$ "))
    files = [line for line in lines[command:] if line.startswith("written: ")]
    return " | ".join([lines[command], *files[-1:]])


def _words(line: str) -> str:
    """Return a line without its numbers and the widths of its columns.

    The widths depend on times and sizes, which the transcript leaves out."""
    return NUMBER.sub("#", re.sub(r"([ ─])\1+", r"\1", line))


def _agree(accepted: str, found: str) -> bool:
    """True if two lines of equal words have equal numbers."""
    if _words(accepted) != _words(found):
        return False
    pairs = list(zip(NUMBER.findall(accepted), NUMBER.findall(found), strict=True))
    largest = max((abs(float(old)) for old, _ in pairs), default=0.0)
    allowed = (row[1:] for row in LOOSER if row[0].search(accepted))
    relative, of_line, absolute = next(allowed, (RELATIVE, OF_LINE, 0.0))
    by_solves = (float(size) for size in TOLERANCE_PART.findall(accepted))
    least = max(of_line * largest, absolute, *by_solves)
    stated = STATED_ERROR.findall(accepted)
    return all(
        old == new
        or abs(float(old) - float(new))
        <= max(relative * abs(float(old)), least, _last_digit(old, 2 if old in stated else 3))
        for old, new in pairs
    )


def _last_digit(text: str, digits: int) -> float:
    """One unit in the last digit of a rounded number that has so many digits."""
    mantissa, _, exponent = text.partition("e")
    if "." not in mantissa or len(mantissa.strip("+-0.").replace(".", "")) < digits:
        return 0.0
    return 1.01 * 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


# ---- acceptance ---------------------------------------------------------------------------------


def read(name: str) -> tuple[list[str], list[str]]:
    """Commands and accepted lines of a transcript."""
    lines = (FOLDER / f"{name}.txt").read_text(encoding="utf-8").splitlines()
    return [line[2:] for line in lines if line.startswith("$ ")], lines[1:]


def names() -> list[str]:
    return sorted(path.stem for path in FOLDER.glob("*.txt"))


def accept() -> None:
    parser = argparse.ArgumentParser(description="Accept what the commands print and write now.")
    parser.add_argument("names", nargs="*", help="transcripts; default: all that differ")
    parser.add_argument("--because", required=True, help="reason why the new output is right")
    given = parser.parse_args()
    for name in given.names or names():
        commands, accepted = read(name)
        with TemporaryDirectory() as directory:
            found = transcribe(commands, Path(directory))
        if wrong := differences(accepted, found):
            print(name, *wrong, sep="\n")
            text = "\n".join([f"# accepted because: {given.because}", *found, ""])
            (FOLDER / f"{name}.txt").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    accept()
