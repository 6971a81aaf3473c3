"""Parameter sweeps: solutions of a scene for every combination of values of some of its keys.

The values of a key are either spaced evenly, on a linear or logarithmic scale, or a sample of a
normal distribution. The sample is a Latin hypercube: the midpoints of N strata of equal
probability, in a random order for each key. A percentile of N results has an error of order 1/N^2
for one key.
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
from contact_results.files.summary_file import summary_of
from contact_results.number_text import uncertainty
from contact_results.result_report import ResultReport
from contact_results.stress.points import MEASURES, ON_INTERFACES, layer_name
from contact_results.stress.stress_maxima import SURFACE, interface_sides
from contact_scene import Body, Scene, SceneError, read_scene_file
from contact_scene.quantities.field_metadata import (
    Kind,
    reported,
)
from contact_scene.quantities.per_length import shown_name, shown_unit
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
    """Error raised for options that do not define a parameter sweep."""


@dataclass(frozen=True)
class Variation:
    """Values of one key of a scene in a parameter sweep.

    key        key of the scene file, such as "body.layers[1].thickness"
    unit       unit of the values; empty for a dimensionless key
    values     values in this unit, in ascending order for a sample
    is_log     true for values spaced by a constant factor
    is_sample  true for a sample of a normal distribution
    """

    key: str
    unit: str
    values: tuple[float, ...]
    is_log: bool = False
    is_sample: bool = False

    @classmethod
    def of(cls, text: str) -> Variation:
        """Read the variation of a key from the text of the option `--vary`; raises SweepError.

        text  for example "indenter.radius=5..20 mm log 4"
        """
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
        """Key with unit in brackets, as the header of a column."""
        return f"{self.key} [{self.unit or '1'}]"

    def override(self, value: float) -> str:
        """Return the argument of the option `--set` that gives the key a value."""
        return f"{self.key}={value:.{DIGITS}g} {self.unit}".strip()


def quantities(body: Body, *, line: bool = False) -> tuple[str, ...]:
    """Return the names of all quantities that a sweep can write for a scene.

    The quantities are the scalars of summary.json, with vectors by component, and the largest
    stresses of the body as MEASURE@REGION.

    line  True for a line contact
    """
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
    return (*(shown_name(name, line=line) for name in SCALARS), *stresses)


@dataclass(frozen=True)
class SweepPoint:
    """One combination of values in a parameter sweep; a worker process solves its scene.

    file        path of the scene file, which every worker can read
    overrides   arguments of `--set` that override keys of the file
    content     digest of the scene; a stored record with another digest is not used
    values      varied keys with their values, by label
    wanted      names of the requested quantities
    solver      name of the solver
    with_error  true if errors are estimated
    invalid     message about values that make the scene invalid; empty for a valid scene
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
        """File name of the sweep point: values of the varied keys, and a digest.

        The digest distinguishes points.
        """
        shown = " ".join(self.overrides[-len(self.values) :])
        digest = hashlib.sha256(repr(self).encode()).hexdigest()[:8]
        return f"{re.sub('[^A-Za-z0-9.]+', '-', shown)[:99]}-{digest}"

    def record(self, refused: str = "") -> CaseRecord:
        """Return the record of the sweep point without results.

        The record contains the values of the varied keys, and the arguments of `slipstick run` that
        solve the scene of the point.

        refused  message of an error, if the scene has no solution; else empty
        """
        options = (word for change in self.overrides for word in ("--set", change))
        words = {
            "refused": refused,
            "scene": shlex.join([self.file, *options, "--solver", self.solver]),
        }
        return CaseRecord(parameters=dict(self.values), words={"not converged": "", **words})

    def compute(self) -> CaseRecord:
        """Solve the scene of the sweep point, and return its record with quantities and errors.

        If the scene is invalid or the solver raises an error, the record contains the message
        instead.
        """
        if self.invalid:
            return self.record(self.invalid)
        try:
            contents = read_scene_file(self.file, self.overrides)
            result: Any = solve(contents, self.solver)  # type: ignore[call-overload]
            numbers = dict(self._numbers(result, contents.scene))
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

    def _numbers(self, result: Any, scene: Scene) -> Iterator[tuple[str, tuple[Any, ...]]]:
        """Yield name and data of each requested quantity at the end of the last load step.

        The data are value, stated error, component of a vector ("x", "y" or empty) and unit.

        result  result of the solve of the sweep point
        scene   scene of the sweep point, with layers that the solver merges
        """
        stated = stated_errors(result) if self.with_error else None
        end = summary_of(ResultReport.of(result, stated).with_cycles()).steps[-1]
        line = result.scene.indenter.is_line
        for name, (stem, axis, si) in SCALARS.items():
            unit = shown_unit(si, line=line)
            value = getattr(end, stem)
            if axis and value is not None:
                value = value["xy".index(axis)]
            shown = shown_name(name, line=line)
            yield shown, (value, (end.errors or {}).get(stem), axis, unit)
        wanted = {name for name in self.wanted if "@" in name}
        if wanted and not result.scene.body.deforms:
            raise UnsupportedScene("the body is rigid and has no stress; omit the stresses")
        largest = largest_stresses(result, stated, wanted, given=scene) if wanted else {}
        for name, (value, error) in largest.items():
            yield name, (value, error, "", "Pa")


def sweep_points(
    file: Path,
    overrides: Sequence[str],
    variations: Sequence[Variation],
    wanted: Sequence[str],
    solver: str,
    *,
    with_error: bool = True,
) -> tuple[SweepPoint, ...]:
    """Return the points of a parameter sweep: all combinations of the spaced values.

    If keys have normal distributions, each combination is made with the whole sample. Raises
    SweepError for repeated keys, samples of different length and too many points, and SceneError if
    no point has a valid scene.

    file        path of the scene file
    overrides   arguments of `--set` that apply to all points
    variations  varied keys with their values
    wanted      names of the requested quantities
    solver      name of the solver
    with_error  true to estimate errors
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
