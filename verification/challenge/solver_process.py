"""Calls of a user's solver function, in a child process with a time limit for each level.

Whatever the function does (end its process, run forever, change its problem) is a failure of the
function. It neither ends nor changes the judgement.
"""

from __future__ import annotations

import copy
import importlib
import importlib.util
import multiprocessing
import os
import signal
import sys
import threading
import time
import traceback
import warnings
from collections.abc import Callable, Generator, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from contact_results.directory.atomic_file import Refused
from verification.challenge.answer import Answer, Field, Key

if TYPE_CHECKING:
    from contact_scene.array_types import Vector


class CannotDo(Exception):
    """Exception that a solver function raises for a challenge outside its scope."""


@dataclass(frozen=True)
class Posed:
    """Challenge without its reference solution, as passed to a solver function.

    A key is the pair of quantity name and load step, counted from 1.

    scene   scene as in a scene file, in SI; a body and a `patch` if the traction is given
    loads   normal and tangential force at the end of every load step [N]; NaN for a prescribed
            motion; `scene["loading"]` contains moments and motions
    asked   unit of each required number, by key
    since   load step from whose end a number counts, by key, for numbers that count from there and
            not from the beginning
    places  points (points, 3) with x, y and depth z at which numbers are required, by key [m]
    fields  keys of the tractions that are required at points of the solver's choice
    window  side of a square that contains the contact with a margin [m]
    """

    name: str
    scene: Mapping[str, Any]
    loads: tuple[tuple[float, tuple[float, float]], ...]
    asked: Mapping[Key, str]
    since: Mapping[Key, int]
    places: Mapping[Key, Vector]
    fields: tuple[Key, ...]
    window: float


Solve: TypeAlias = Callable[[Posed, int], Answer]


class SolverFailed(RuntimeError):
    """A solver function gave no answer: it raised an exception, ended its process or took too
    long.
    """


# Time limit of one level [s]: ten minutes, several times what a level of a challenge takes.
SECONDS_PER_LEVEL = 600.0
SECONDS_BETWEEN_LOOKS = 0.1
# Time for a process to end after its last answer [s], for example to join its own threads.
SECONDS_TO_END = 5.0
# macOS offers fork as well, but ends child processes that use its libraries.
FORKS = sys.platform == "linux"


def answers_of(
    solve: Solve | str, problem: Posed, levels: int, seconds: float | None = SECONDS_PER_LEVEL
) -> Generator[Answer, None, None]:
    """Yield the answer of a solver function on each refinement level, from level 0.

    The function runs in one child process for all levels, and receives a copy of the problem on
    each level. A function in memory runs in a copy of this process (fork), which only Linux offers;
    elsewhere it runs in this process without time limit. A function that is named by a text runs in
    a new interpreter, which imports it. The output of the function goes to the output of this
    process.

    solve    function, or text FILE.py:FUNCTION or MODULE:FUNCTION
    problem  challenge without its reference solution
    levels   number of refinement levels
    seconds  time limit of each level, which on level 0 includes the import; None: call the function
             in this process, without time limit

    Raises SolverFailed if there is no answer, Refused if the answer cannot be read, and CannotDo if
    the function raises it. In this process, exceptions of the function are passed on.
    """
    if seconds is None or not (FORKS or isinstance(solve, str)):
        function = named_solver(solve) if isinstance(solve, str) else solve
        for level in range(levels):
            yield copy.deepcopy(_timed_answer(function, problem, level))
        return
    named = isinstance(solve, str)
    context: Any = multiprocessing.get_context("spawn" if named else "fork")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=_send_answers, args=(sender, solve, problem, levels))
    with warnings.catch_warnings():
        # Python warns of a fork beside threads, which may hold locks: the time limit ends a wait.
        warnings.filterwarnings("ignore", ".*fork", DeprecationWarning)
        process.start()
    sender.close()
    try:
        for level in range(levels):
            yield _received_answer(receiver, process, level, seconds)
        process.join(SECONDS_TO_END)
    finally:
        _end_with_descendants(process)
        receiver.close()


def _received_answer(
    receiver: Connection, process: BaseProcess, level: int, seconds: float
) -> Answer:
    """Wait for the answer of a child process on one level and return it.

    receiver  end of the pipe through which the process sends
    process   child process that calls the solver function
    level     number of the refinement level, for messages
    seconds   time limit
    """
    until = time.monotonic() + seconds
    while not receiver.poll(max(0.0, min(SECONDS_BETWEEN_LOOKS, until - time.monotonic()))):
        if time.monotonic() >= until:
            raise SolverFailed(
                f"gave no answer on level {level} within {seconds:g} s; allow more seconds, or "
                "ask for fewer levels"
            )
        if not process.is_alive():
            break
    kind: Any = None
    content: Any = None
    with suppress(EOFError, OSError):
        if receiver.poll():
            kind, content = receiver.recv()
    if kind is None:
        process.join(SECONDS_TO_END)
        raise SolverFailed(f"ended without an answer on level {level}: {_end_text(process)}")
    if isinstance(kind, type):
        raise kind(content)
    answer: Answer = content
    return answer


def _end_text(process: BaseProcess) -> str:
    code = process.exitcode
    if code is None:
        return "it closed the pipe of the answer"
    if code >= 0:
        return f"exit code {code}"
    name = signal.Signals(-code).name
    return f"{name}, which the system sends for lack of memory" if name == "SIGKILL" else name


def _end_with_descendants(process: BaseProcess) -> None:
    """Kill a child process and the processes that it has started, as far as they have not ended."""
    assert process.pid is not None
    if hasattr(os, "killpg"):
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
    process.kill()
    process.join()
    process.close()


def _send_answers(sender: Connection, solve: Solve | str, problem: Posed, levels: int) -> None:
    """Call a solver function in this child process and send its answers, or the reason for none.

    A message is a pair: "answer" and an answer, or the type and the text of the exception that
    `answers_of` raises.
    """
    if hasattr(os, "setpgid"):
        os.setpgid(0, 0)  # a group of its own, which is ended as a whole
    threading.Thread(target=_end_with_parent, daemon=True).start()
    # Not into a buffer, which is lost if the process is killed, or belongs to a test runner.
    sys.stdout, sys.stderr = (
        os.fdopen(number, "w", 1, encoding="utf-8", errors="replace", closefd=False)
        for number in (1, 2)
    )
    level, own = 0, os.getpid()
    try:
        function = named_solver(solve) if isinstance(solve, str) else solve
        for level in range(levels):
            answer = _timed_answer(function, problem, level)
            if os.getpid() != own:
                os._exit(0)  # the function has forked, and both processes came back
            sender.send(("answer", answer))
    except (CannotDo, Refused) as reason:
        sender.send((type(reason), str(reason)))
    except BaseException as error:  # SystemExit and KeyboardInterrupt as well
        error.__traceback__ = error.__traceback__ and error.__traceback__.tb_next
        text = "".join(traceback.format_exception(error)).rstrip()
        sender.send((SolverFailed, f"raised an exception on level {level}:\n{text}"))


def _end_with_parent() -> None:
    """Wait for the end of the parent process, and end this process and those that it has
    started.
    """
    parent = multiprocessing.parent_process()
    assert parent is not None
    parent.join()
    if hasattr(os, "killpg"):
        os.killpg(0, signal.SIGKILL)
    os._exit(1)


def _timed_answer(solve: Solve, problem: Posed, level: int) -> Answer:
    """Call a solver function with a copy of the problem and return its answer with its CPU time.

    Raises Refused for an answer that cannot be read.
    """
    started = time.process_time()
    answer = plain_answer(solve(copy.deepcopy(problem), level), level)
    spent = time.process_time() - started
    seconds = spent if answer.seconds is None else answer.seconds
    return replace(answer, label=answer.label or str(level), seconds=seconds)


def _plain_scalar(value: object, name: str) -> float | tuple[float, float]:
    """Convert a scalar of an answer, or a pair with its uncertainty, to float.

    Raises Refused for other values, with the name in its message.
    """
    numbers = _plain_numbers(value, name)
    if numbers.size == 1:
        return float(numbers[0])
    if isinstance(value, tuple) and numbers.size == 2:
        return float(numbers[0]), float(numbers[1])
    raise Refused(
        f"{name} has {numbers.size} numbers, expected one, or a pair with its uncertainty"
    )


def plain_answer(answer: object, level: int) -> Answer:
    """Check the types of an answer of a solver function, and convert its numbers to float.

    The result consists of plain numbers, texts and arrays, so that it is independent of the
    function and its libraries. Raises Refused for an answer that cannot be read.

    level  number of the refinement level, for the message
    """
    if not isinstance(answer, Answer):
        raise Refused(f"level {level}: {type(answer).__name__} came back, expected an Answer")
    for name in ("scalars", "fields", "points", "gave_up"):
        if not isinstance(getattr(answer, name), Mapping):
            raise Refused(f"level {level}: {name} is {getattr(answer, name)!r}, expected a mapping")
    h = _plain_numbers(answer.h, f"level {level}: h")
    if h.size != 1 or not 0 < h[0] < np.inf:
        raise Refused(f"level {level}: h is {answer.h!r}, expected a positive length [m]")
    keys: tuple[Any, ...] = (*answer.scalars, *answer.fields, *answer.points)
    for key in keys:
        if not isinstance(key, tuple) or len(key) != 2:
            raise Refused(f"level {level}: {key!r}, expected a quantity and a loading step")
    scalars: dict[Key, float | tuple[float, float]] = {}
    given: dict[Key, Any] = {**answer.scalars}
    for key, value in given.items():
        if value is None:
            continue
        scalars[key] = _plain_scalar(value, f"level {level}: {key!r}")
    for key, field in answer.fields.items():
        if not isinstance(field, Field):
            raise Refused(f"level {level}: {key!r} is {type(field).__name__}, expected a Field")
    return Answer(
        float(h[0]),
        scalars,
        {key: Field(f.x, f.y, f.value, f.area) for key, f in answer.fields.items()},
        {step: str(reason) for step, reason in answer.gave_up.items()},
        answer.unknowns,
        answer.seconds,
        str(answer.label),
        {
            key: _plain_numbers(values, f"level {level}: {key!r}")
            for key, values in answer.points.items()
        },
    )


def _plain_numbers(value: Any, name: str) -> Vector:
    """Convert a number, or numbers, to an array (n,); raises Refused for anything else.

    name  name of the value, for the message
    """
    try:
        numbers = np.ravel(np.asarray(value))
        if not np.iscomplexobj(numbers):
            return np.array(numbers, dtype=np.float64)
    except (ValueError, TypeError):
        pass
    raise Refused(f"{name} is {value!r}, expected a number")


class NoSuchSolver(Refused):
    """The function, file or module that a text names does not exist or cannot be imported."""


EXPECTED = "expected FILE.py:FUNCTION or MODULE:FUNCTION"


def names_a_solver(text: str) -> bool:
    """Return True if an argument of the command line names a solver function as FILE.py:FUNCTION.

    The alternative is the folder of an answer. A text with a colon is a folder only if it exists.
    """
    return ":" in text and not Path(text).exists()


def named_solver(text: str) -> Callable[[Posed, int], Answer]:
    """Import the solver function that an argument FILE.py:FUNCTION or MODULE:FUNCTION names.

    Raises NoSuchSolver if there is no such function, or if the execution of the file fails.
    """
    place, _, name = text.rpartition(":")
    module = module_of(Path(place)) if place.endswith(".py") else _import_module(place, text)
    found: object = getattr(module, name, None)
    if not callable(found):
        raise NoSuchSolver(f"{text}: {place} has no function {name!r}; {EXPECTED}")
    return found


def module_of(path: Path) -> ModuleType:
    """Execute the Python file of a user's solver function and return its module.

    The file can import modules of its own folder. Raises NoSuchSolver if the file cannot be read or
    its execution fails.
    """
    if not path.is_file():
        raise NoSuchSolver(f"{path}: no such file; {EXPECTED}")
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.path.insert(0, str(path.parent.resolve()))
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:
        raise NoSuchSolver(f"{path}: {type(error).__name__}: {error}") from error
    return module


def _import_module(place: str, text: str) -> ModuleType:
    try:
        return importlib.import_module(place)
    except (ImportError, ValueError) as error:
        raise NoSuchSolver(f"{text}: {error}; {EXPECTED}") from None
