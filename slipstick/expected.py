"""Expected numbers of a scene with their stated errors, and the comparison of later numbers.

No tolerance is chosen: a number is outside if its interval and the expected interval, each the
stated error wide on either side, exclude each other. A stated error is worse by the rule for errors
of `verification.regression.comparison`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple, TypeAlias

from pydantic import Field

from contact_results.directory.atomic_file import Refused
from contact_results.directory.json_record import read_record, write_record
from contact_results.directory.machine import program_version
from contact_results.key_numbers import PRODUCTS
from contact_results.number_text import Uncertainty, number_text, uncertainty
from contact_results.stress.stress_maxima import Extreme
from contact_scene import Scene
from contact_scene.quantities.per_length import shown_name, shown_unit
from contact_scene.quantities.round_off import ROUND_OFF, natural_size
from contact_scene.quantities.stated_error import StatedError
from contact_scene.quantities.summary import StepSummary
from contact_scene.reading.description import Description
from contact_scene.reading.engineering_units import engineering_unit
from contact_scene.reading.scene_error import dotted_key, shown
from slipstick.sweep import SCALARS
from verification.judging.outcome import ChangeKind
from verification.regression.change_row import ChangeRow, rows_that_matter
from verification.regression.comparison import BETTER_BY, NOISE, WORSE_BY, has_grown
from verification.running.study import CaseRecord

WHAT = "file of expected numbers"
REMEDY = "restore it, or save the numbers by --save-expected"
# An error that has not converged is right to an order of magnitude at best.
DOUBT = 10.0
MAX_KEYS = 5  # of another scene, listed in a message

Value: TypeAlias = bool | int | float | str


class ExpectedNumber(Description):
    """Number of a result with its stated error, in the SI unit of the number."""

    value: float
    error: Annotated[float, Field(ge=0)] | None
    """Stated error; 0 for a number that the load prescribes, null if unknown."""

    reliable: bool
    """False if the stated error has not converged."""

    unit: str
    scale: Annotated[float, Field(ge=0)]
    """Largest magnitude of the quantity in the history. Smaller differences than 1e-6 of the scale
    of an error are no change."""

    @property
    def interval(self) -> float | None:
        """Half-width of the interval that contains the exact number; None if unknown."""
        return None if self.error is None else self.error * (1.0 if self.reliable else DOUBT)

    def text(self) -> str:
        """Return the number with its stated error and an engineering unit as text."""
        unit = PRODUCTS.get(self.unit) or engineering_unit(abs(self.value), self.unit)
        known = Uncertainty(self.error, self.reliable)
        prescribed = self.error == 0 and self.reliable
        text = number_text(self.value, None if prescribed else known, unit.size)
        return f"{text} {unit.name}".strip()


Numbers = Mapping[str, Mapping[str, ExpectedNumber]]  # by load step or point, and name


class ExpectedNumbers(Description):
    """Content of the file of `--save-expected`: numbers of a scene, and the scene by its keys."""

    schema_version: Literal[1] = 1
    program_version: str
    command: Literal["run", "sweep", "stress"]
    solver: str
    scene: dict[str, Value]
    """Keys of the scene with their values; title and increments are left out."""

    numbers: dict[str, dict[str, ExpectedNumber]]
    """Numbers by load step or point of a sweep, and name."""


class Source(NamedTuple):
    """Origin of expected numbers: command, scene by its keys, and name of the solver."""

    command: Literal["run", "sweep", "stress"]
    scene: dict[str, Value]
    solver: str

    def with_numbers(self, numbers: Numbers) -> ExpectedNumbers:
        """Return the content of a file of expected numbers."""
        return ExpectedNumbers(
            program_version=program_version(),
            command=self.command,
            solver=self.solver,
            scene=self.scene,
            numbers={place: dict(found) for place, found in numbers.items()},
        )


def scene_keys(scene: Scene, **more: Value | None) -> dict[str, Value]:
    """Return the keys of a scene with their values, for the comparison of two scenes.

    Title, increments and keys without a value are left out. The array of a file is represented by
    its digest.

    more  further keys that determine the numbers, such as the load step of a stress
    """
    digests = {key: array.digest for key, array in scene.array_files.items()}
    document = scene.model_dump(mode="json", exclude={"title"}, exclude_none=True)
    found = {
        dotted_key(path): digests.get(str(path[-1]), value)
        for path, value in _leaves(document)
        if path[-1] != "increments"
    }
    return found | {key: value for key, value in more.items() if value is not None}


def _leaves(value: Any, path: tuple[str | int, ...] = ()) -> Iterator[tuple[Any, Any]]:
    """Yield path and value of every entry of nested tables and arrays."""
    if not isinstance(value, dict | list):
        yield path, value
        return
    for key, entry in value.items() if isinstance(value, dict) else enumerate(value):
        yield from _leaves(entry, (*path, key))


def step_numbers(steps: Sequence[StepSummary], *, line: bool = False) -> Numbers:
    """Return the numbers of a run that have a stated error, by load step and name.

    steps  ends of all load steps
    line   True for a line contact, with names and units per length
    """
    found: dict[str, dict[str, ExpectedNumber]] = {
        f"step {number}": {} for number in range(1, len(steps) + 1)
    }
    for name, (stem, axis, unit) in SCALARS.items():
        part = "xy".index(axis) if axis else 0
        history = [
            value if isinstance(value, tuple) else (value,)
            for value in (getattr(step, stem) for step in steps)
            if isinstance(value, tuple | float)
        ]
        # Round-off is 1e-9 of the natural size of a quantity.
        least = ROUND_OFF / NOISE * natural_size(steps, unit)
        scale = max((abs(value) for values in history for value in values), default=0.0)
        for number, step in enumerate(steps, 1):
            stated, value = (step.errors or {}).get(stem), getattr(step, stem)
            if stated is not None and value is not None:
                value = value[part] if axis else value
                found[f"step {number}"][shown_name(name, line=line)] = _number(
                    value, stated, axis or "x", shown_unit(unit, line=line), max(scale, least)
                )
    return found


def stress_numbers(found: Sequence[Extreme], errors: Sequence[StatedError], place: str) -> Numbers:
    """Return the largest stresses with their stated errors, by load step and name.

    place  name of the load step and the body
    """
    scale = max((abs(extreme.value) for extreme in found), default=0.0)
    return {
        place: {
            f"{e.measure} of {e.region}": _number(e.value, stated, "x", "Pa", scale)
            for e, stated in zip(found, errors, strict=True)
        }
    }


def _number(
    value: float, stated: StatedError, axis: str, unit: str, scale: float
) -> ExpectedNumber:
    size, converged = uncertainty(stated, axis) or Uncertainty(0.0, True)
    return ExpectedNumber(value=value, error=size, reliable=converged, unit=unit, scale=scale)


def sweep_numbers(records: Iterable[tuple[str, CaseRecord]], names: Sequence[str]) -> Numbers:
    """Return the numbers of a parameter sweep with their stated errors, by point and name.

    records  name and record of each point
    names    names of the quantities
    """
    records = list(records)
    scales = {
        name: max((abs(record.measures.get(name) or 0.0) for _, record in records), default=0.0)
        for name in names
    }
    return {
        point: {
            name: ExpectedNumber(
                value=value,
                error=record.measures[f"{name} error"],
                reliable=name not in record.words["not converged"].split(),
                unit=record.units[name],
                scale=scales[name],
            )
            for name in names
            if (value := record.measures.get(name)) is not None
        }
        for point, record in records
    }


def read_expected(path: Path, source: Source) -> ExpectedNumbers:
    """Read expected numbers of the same command and scene from a file.

    Raises Refused if the file is missing or damaged, or contains numbers of another scene or
    command. Cells, elements, increments and solver may differ.

    source  command and scene whose numbers are compared
    """
    expected = read_record(path, ExpectedNumbers, WHAT, REMEDY)
    theirs = {"command": expected.command, **expected.scene}
    ours: dict[str, Value] = {"command": source.command, **source.scene}
    other = [key for key in dict.fromkeys((*theirs, *ours)) if theirs.get(key) != ours.get(key)]
    if other:
        told = [
            f"key {key}: got {_told(ours, key)}, expected {_told(theirs, key)}"
            for key in other[:MAX_KEYS]
        ]
        more = [f"{len(other) - MAX_KEYS} more keys"] if len(other) > MAX_KEYS else []
        raise Refused(
            f"{WHAT} {path} is of another scene: {'; '.join(told + more)}; compare with the file "
            "of this scene, or save its numbers by --save-expected"
        )
    return expected


def _told(keys: Mapping[str, Value], key: str) -> str:
    return shown(keys[key]) if key in keys else "none"


def save_expected(numbers: ExpectedNumbers, path: Path) -> None:
    """Save numbers of a scene in a file, which is replaced. Equal numbers give equal bytes."""
    write_record(path, numbers)


def expected_changes(
    found: ExpectedNumbers, expected: ExpectedNumbers, since: str
) -> list[ChangeRow]:
    """Return the changes of numbers since they were saved, the worst first.

    since  name of the file of expected numbers
    """
    keys = [
        dict.fromkeys((place, name) for place, of in one.numbers.items() for name in of)
        for one in (expected, found)
    ]
    rows = []
    for place, name in dict.fromkeys((*keys[0], *keys[1])):
        was, now = (one.numbers.get(place, {}).get(name) for one in (expected, found))
        kind, remark = _change(was, now)
        before, present = ("–" if one is None else one.text() for one in (was, now))
        rows.append(
            ChangeRow(found.command, name, place, kind, before, present, since=since, remark=remark)
        )
    return rows_that_matter(rows)


def _change(was: ExpectedNumber | None, now: ExpectedNumber | None) -> tuple[ChangeKind, str]:
    """Classify the change of a number since it was saved; also return a remark."""
    if was is None:
        return ChangeKind.NEW, ""
    if now is None:
        return ChangeKind.GONE, "the result does not contain it"
    apart, noise = abs(now.value - was.value), NOISE * was.scale
    if was.interval is None or now.interval is None:
        inside = apart <= noise
    else:
        both = was.interval + now.interval
        inside = apart <= max(both, ROUND_OFF * was.scale if both else noise)
    grown = shrunk = False
    if was.error is not None and now.error is not None:
        if not inside:
            return ChangeKind.OUTSIDE, f"the intervals exclude each other: {apart:.3g} apart"
        grown = has_grown(was.error, now.error, WORSE_BY, noise)
        shrunk = has_grown(now.error, was.error, BETTER_BY, noise)
    known = [one.reliable and one.error is not None for one in (was, now)]
    if known == [True, False]:
        return ChangeKind.WORSE, "the stated error is not converged (?)"
    if grown:
        assert was.error is not None
        assert now.error is not None
        times = f"{now.error / was.error:.3g} times" if was.error else "no longer 0"
        return ChangeKind.WORSE, f"the stated error is {times} as large"
    if shrunk or known == [False, True]:
        return ChangeKind.BETTER, ""
    return (ChangeKind.UNCHANGED if inside else ChangeKind.DRIFT), ""
