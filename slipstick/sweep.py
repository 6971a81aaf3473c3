"""Parameter sweeps: solutions of a scene for every combination of values of its keys.

The values of a key are evenly spaced, linearly or logarithmically, or a sample of a normal
distribution. The sample is a Latin hypercube: the midpoints of N strata of equal probability, in a
random order for each key. A percentile of N results has an error of order 1/N^2 for one key.
"""

from __future__ import annotations

import hashlib
import re
import shlex
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from scipy.special import ndtri

from contact_errors.stress_errors import largest_stresses
from contact_results.cycles import fretting_cycles
from contact_results.files.summary_file import summary_of
from contact_results.number_text import uncertainty
from contact_results.stress.points import MEASURES, ON_INTERFACES
from contact_results.stress.stress_maxima import (
    SURFACE,
    interface_sides,
    layer_name,
)
from contact_scene import Body, SceneError, read_scene_file
from contact_scene.quantities.field_metadata import (
    Kind,
    reported,
)
from contact_scene.quantities.summary import StepSummary
from contact_scene.solver_errors import SolverError, UnsupportedScene
from slipstick.solving import solve, stated_errors
from verification.running.study import CaseRecord

_NUMBER = r"([+-]?(?:[0-9]+(?:\.[0-9]+)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
_UNIT = r"(?: +((?!log\b)[^\s0-9]\S*(?: [^\s0-9]\S*)*?))?"
_VALUES = re.compile(
    rf"(?:{_NUMBER}\.\.{_NUMBER}|normal\( *{_NUMBER} *, *(?!-){_NUMBER} *\)){_UNIT}( +log)?"
    r" +([1-9][0-9]{0,4})"
)
EXPECTED = (
    "KEY=a..b [unit] [log] N, such as body.layers[1].thickness=1..64 um log 4, or "
    "KEY=normal(mean,deviation) [unit] N; log takes positive a and b"
)
MAX_POINTS = 99_999
SEED = 1  # of the order of a sample: equal commands give equal points
DIGITS = 12  # of a spaced value: 0.3 and not 0.30000000000000004
SCALARS = {
    f"{name}_{axis}" if axis else name: (name, axis, annotation.unit)
    for name, annotation in reported(StepSummary).items()
    for axis in ("xy" if annotation.kind is Kind.VECTOR else ("",))
}


class SweepError(ValueError):
    """A sweep that cannot be made."""


@dataclass(frozen=True)
class Variation:
    """Values of one key of a scene.

    label      key and unit, as a column has them
    values     in the unit; of a distribution in ascending order
    is_log     whether the values are spaced by a factor
    is_sample  whether the values are a sample of a distribution
    """

    key: str
    unit: str
    values: tuple[float, ...]
    is_log: bool = False
    is_sample: bool = False

    @classmethod
    def of(cls, text: str) -> Variation:
        """Read an option; raises SweepError."""
        key, _, given = text.partition("=")
        match = _VALUES.fullmatch(given.strip())
        if match is None or (match[6] and not (match[1] and float(match[1]) > 0 < float(match[2]))):
            raise SweepError(f"got --vary {text}, expected {EXPECTED}")
        first, last, mean, deviation, unit, log, number = match.groups()
        count = int(number)
        if mean:
            midpoints = ndtri((np.arange(count) + 0.5) / count)
            values = float(mean) + float(deviation) * midpoints
        else:
            values = (np.geomspace if log else np.linspace)(float(first), float(last), count)
        rounded = tuple(float(f"{value:.{DIGITS}g}") for value in values)
        return cls(key.strip(), unit or "", rounded, bool(log), bool(mean))

    @property
    def label(self) -> str:
        """The key with its unit, as the head of a column."""
        return f"{self.key} [{self.unit or '1'}]"

    def override(self, value: float) -> str:
        """The option of a run that sets a value."""
        return f"{self.key}={value:.{DIGITS}g} {self.unit}".strip()


def quantities(body: Body) -> tuple[str, ...]:
    """Return the names of all quantities: scalars, and largest stresses as MEASURE@REGION."""
    layers = len(body.layers)
    interfaces = [str(number) for number, side, _, _ in interface_sides(body) if side == "above"]
    regions = ["body"]
    if layers:
        regions += [SURFACE, *(layer_name(k, layers) for k in range(layers + 1))]
    stresses = [
        f"{measure}@{region}"
        for measure in MEASURES
        for region in (interfaces if measure in ON_INTERFACES else [*regions, *interfaces])
    ]
    return (*SCALARS, *stresses)


@dataclass(frozen=True)
class SweepPoint:
    """One scene of a sweep, solved by a worker process.

    file        scene file, which every worker can read
    overrides   options that override its keys
    content     digest of the scene, so that a record of another content is not used
    invalid     message of a scene that the values make invalid
    values      of the varied keys, by label
    wanted      names of the quantities
    with_error  whether errors are stated
    """

    file: str
    overrides: tuple[str, ...]
    content: str
    values: tuple[tuple[str, float], ...]
    wanted: tuple[str, ...]
    solver: str
    with_error: bool
    invalid: str = ""

    @property
    def name(self) -> str:
        """Values of the keys, and a digest that distinguishes points."""
        shown = " ".join(self.overrides[-len(self.values) :])
        digest = hashlib.sha256(repr(self).encode()).hexdigest()[:8]
        return f"{re.sub('[^A-Za-z0-9.]+', '-', shown)[:99]}-{digest}"

    def record(self, refused: str = "") -> CaseRecord:
        """The record without numbers, with the arguments of a run that solves the point."""
        options = (word for change in self.overrides for word in ("--set", change))
        words = {
            "refused": refused,
            "scene": shlex.join([self.file, *options, "--solver", self.solver]),
        }
        return CaseRecord(parameters=dict(self.values), words={"not converged": "", **words})

    def compute(self) -> CaseRecord:
        """Solve the scene and state errors; a refusal is recorded by its text."""
        if self.invalid:
            return self.record(self.invalid)
        try:
            result: Any = solve(read_scene_file(self.file, self.overrides), self.solver)  # type: ignore[call-overload]
            numbers = dict(self._numbers(result))
        except SolverError as error:
            return self.record(f"{type(error).__name__}: {error}")
        record = self.record()
        for name in self.wanted:
            value, stated, axis, unit = numbers.get(name, (None, None, "", "Pa"))
            known = uncertainty(stated, axis or "x")
            size = known.size if known else 0.0 if stated else None  # without one it is exact
            for column, number in ((name, value), (f"{name} error", size)):
                record.measures[column], record.units[column] = number, unit or "1"
            if known and not known.converged:
                record.words["not converged"] += f"{name} "
        return record

    def _numbers(self, result: Any) -> Iterator[tuple[str, tuple[Any, ...]]]:
        """Yield the name of every number, with its value, stated error, axis and unit."""
        stated = stated_errors(result) if self.with_error else None
        end = summary_of(result, fretting_cycles(result), stated).steps[-1]
        for name, (stem, axis, unit) in SCALARS.items():
            value = getattr(end, stem)
            if axis and value is not None:
                value = value["xy".index(axis)]
            yield name, (value, (end.errors or {}).get(stem), axis, unit)
        wanted = {name for name in self.wanted if "@" in name}
        if wanted and not result.scene.body.deforms:
            raise UnsupportedScene("the body is rigid and has no stress; omit the stresses")
        largest = largest_stresses(result, stated, wanted) if wanted else {}
        for name, (value, error) in largest.items():
            yield name, (value, error, "", "Pa")


def points(
    file: Path,
    overrides: Sequence[str],
    variations: Sequence[Variation],
    wanted: Sequence[str],
    solver: str,
    *,
    with_error: bool = True,
) -> tuple[SweepPoint, ...]:
    """Every combination of the spaced values, each with the whole sample of the distributions.

    Raises SceneError if no scene is valid, and SweepError.
    """
    samples = [each for each in variations if each.is_sample]
    spaced = [each for each in variations if not each.is_sample]
    counts = {len(each.values) for each in samples} or {1}
    if len({each.key for each in variations}) < len(variations) or len(counts) > 1:
        raise SweepError("a key is named twice, or samples differ in N; use one --vary per key")
    total = int(np.prod([*counts, *(len(each.values) for each in spaced)], dtype=float))
    if total > MAX_POINTS:
        raise SweepError(f"got {total} points, expected at most {MAX_POINTS}; use a smaller N")
    order = np.random.default_rng(SEED)
    columns = [order.permutation(each.values).tolist() for each in samples]
    made, refusals = [], []
    for at in product(*(each.values for each in spaced)):
        for draw in zip(*columns, strict=True) if samples else [()]:
            chosen = {
                each.key: v for each, v in zip([*spaced, *samples], (*at, *draw), strict=True)
            }
            changes = (*overrides, *(each.override(chosen[each.key]) for each in variations))
            content, invalid = "", ""
            try:
                content = hashlib.sha256(repr(read_scene_file(file, changes)).encode()).hexdigest()
            except SceneError as error:
                refusals.append(error)
                invalid = str(error)
            values = tuple((each.label, chosen[each.key]) for each in variations)
            source = (str(file.resolve()), changes, content, values, tuple(wanted), solver)
            made.append(SweepPoint(*source, with_error, invalid))
    if len(refusals) == len(made):
        raise refusals[0]
    return tuple(made)
