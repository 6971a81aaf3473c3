"""Error of a number from coarse solves: one formula, three convergence orders, one table of limits.

Each discretisation parameter (cells, increments, section, …) is coarsened separately:

    part of an error = max over the coarse solves of that part  |Q - Q_coarse| / |r^(0.6 p) - 1|
    error            = sum of the parts

r is the coarsening factor of the parameter and p its theoretical order (Richardson 1911). Zone
edges lie anywhere within cells, so that the factor of h^p scatters from level to level. The factor
0.6 is a safety factor of 2.3 for p = 2, 1.9 for p = 1 and 1.8 for p = ½ at r = 2. It is the only
adjustable constant; no constant belongs to a quantity or to a kind of scene.

Two coarse solves per parameter prevent chance agreement of one of them with the run. Errors do not
decrease along a load history: a part is at least the same part at the end of each earlier step.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from contact_errors.values import Values, prescribed, scale
from contact_scene import Scene
from contact_scene.increment_error import near_gross_slip
from contact_scene.stated_error import EXACT, Amount, ErrorStatus, Part, StatedError

Numbers = NDArray[np.float64]

BELIEVED = 0.6
# Means of smooth fields; values at the edge of a zone that lies within a cell; square roots.
SMOOTH, EDGE, ROOT = 2.0, 1.0, 0.5
# Residuals of the tolerance leave errors of about ten times as much. The edge correction applies
# 0.6 of each change (`semi_analytical.edge_correction.pressure.DAMPED`), so that 0.4/0.6 of the
# last change is left where the next solve would not change.
PER_TOLERANCE, PER_ITERATION = 10.0, 2.0 / 3.0
# A larger sum of parts over the number is no error estimate.
LARGEST_SHARE = 0.5
# A component below this part of its vector is round-off of a zero.
ROUND_OFF = 1e-9

# Smallest features in cells. Elements and rings count twice: their shape functions are linear.
LIMITS: Mapping[str, float] = MappingProxyType(
    {"contact": 4.0, "wave": 4.0, "layer": 1.0, "stick": 3.0, "cusp": 1.0, "annulus": 0.5}
)

CONTACT_EDGE = frozenset({"contact_radius", "contact_area"})
STICK_EDGE = frozenset({"stick_radius", "stick_area"})
AT_EDGES = frozenset({"slip_amplitude", "ruiz_f1"})
PEAK, STRESS = "peak_pressure", frozenset({"ruiz_f2"})
OF_SLIP = frozenset(
    {
        *("tangential_shift", "tangential_force", "twist", "torque", "dissipated_energy"),
        *("energy_per_cycle", "input_work", *AT_EDGES, *STRESS),
    }
)
WORK, ENERGIES = "input_work", ("elastic_energy", "dissipated_energy")


@dataclass(frozen=True)
class Features:
    """Resolution of the contact at the end of a load step, in cells; None for an absent feature.

    contact   smaller semi-axis of the contact
    layer     thinnest layer
    wave      mean wavelength of a height map
    stick     smaller semi-axis of the stick zone
    annulus   width of the slip zone around it
    cell      side of a cell [length]
    fitted    whether the edge of the contact is fitted within the cells
    stick_fitted
              the same of the edge of the stick zone
    whole_rings
              whether the stick radius is that of whole rings
    sharp     whether the indenter has a rim, below which all numbers converge with the first order
    infinite  whether the exact peak pressure is infinite
    cusp      whether friction acts back on the pressure
    ridge     whether the largest pressure is nearer to the edge of the contact than to its middle
    slides    whether all of the contact slips
    changes   relative changes of numbers in the last iteration of the edge correction
    """

    contact: float
    cell: float
    layer: float | None = None
    wave: float | None = None
    stick: float | None = None
    annulus: float | None = None
    fitted: bool = False
    stick_fitted: bool = False
    whole_rings: bool = False
    sharp: bool = False
    infinite: bool = False
    cusp: bool = False
    ridge: bool = False
    slides: bool = False
    changes: Mapping[str, float] = field(default_factory=dict)

    def order(self, name: str) -> float:
        """Convergence order of a number in the size of a cell."""
        if name == PEAK:
            return ROOT if self.cusp else EDGE if self.sharp or self.ridge else SMOOTH
        if name in STRESS:
            return ROOT
        if name in AT_EDGES or self.sharp:
            return EDGE
        if name in CONTACT_EDGE:
            return SMOOTH if self.fitted else EDGE
        if name in STICK_EDGE:
            return SMOOTH if self.stick_fitted else EDGE
        return SMOOTH

    def resolve(self, name: str) -> bool:
        """Whether the cells resolve the features on which a number depends."""
        if any(
            size is not None and size < LIMITS[feature]
            for feature, size in (
                ("contact", self.contact), ("layer", self.layer), ("wave", self.wave)
            )
        ):  # fmt: skip
            return False
        if name in STICK_EDGE:
            return self.stick is None or self.stick >= LIMITS["stick"]
        if name == PEAK and self.cusp and not self.slides:
            return self.stick is None or self.stick >= LIMITS["cusp"]
        if name in OF_SLIP:
            return self.annulus is None or self.annulus >= LIMITS["annulus"]
        return True

    def hidden(self, name: str) -> float:
        """Number of cells by which the edge of a zone may be wrong on every level alike."""
        if name in CONTACT_EDGE:
            thin = self.layer is not None and self.layer < 2 * self.contact
            return float(thin and not self.fitted)
        if name in STICK_EDGE and not self.slides and self.stick is not None:
            return float(self.whole_rings or self.stick < LIMITS["stick"])
        return 0.0


@dataclass(frozen=True)
class Comparison:
    """Two solves that differ in one discretisation parameter.

    part    of the error that the parameter contributes to
    ratios  coarsening factor of the parameter at the end of each step; 1 without an effect
    order   of all numbers in the parameter; None where it is that of the cells
    """

    part: Part
    base: Sequence[Values]
    coarse: Sequence[Values]
    ratios: Sequence[float]
    order: float | None = None

    def part_of(self, step: int, name: str, order: float) -> Numbers | None:
        """Part of the error of a number at the end of a step, from 0; None without one."""
        here, there = self.base[step].get(name), self.coarse[step].get(name)
        if self.ratios[step] == 1 or here is None or there is None:
            return None
        power = BELIEVED * (order if self.order is None else self.order)
        return np.abs(here - there) / abs(self.ratios[step] ** power - 1)


@dataclass(frozen=True)
class SolvedRun:
    """A result with its coarse solves.

    tolerance    residual of each step
    features     of each step
    comparisons  of all parameters
    required     parts without which no error is known; each with the steps that need it
    neglected    relative error of numbers by effects that the solver neglects
    """

    scene: Scene
    values: Sequence[Values]
    tolerance: Sequence[float]
    features: Sequence[Features]
    comparisons: Sequence[Comparison]
    required: Mapping[Part, Sequence[bool]]
    neglected: Mapping[str, float]

    def errors(self) -> Iterator[Mapping[str, StatedError]]:
        """Stated errors at the end of each step."""
        largest = largest_so_far(self.values)
        nearly = near_gross_slip(self.scene)
        before: dict[str, dict[Part, Numbers]] = {}
        for step, ramp in enumerate(self.scene.load_path()):
            exact, found = prescribed(ramp), {}
            for name, value in self.values[step].items():
                features = self.features[step]
                apart = not np.any(self.values[step]["contact_area"])
                none = apart or (name in STICK_EDGE and features.slides)
                if name in exact or (none and not np.any(value)):
                    found[name] = EXACT
                    continue
                parts = self._parts(step, name, largest[step][name])
                if parts is None:
                    found[name] = UNKNOWN
                    continue
                if not np.any(value) and not any(
                    np.any(size) for part, size in parts.items() if part != "tolerance"
                ):
                    found[name] = EXACT  # zero at every fineness: its cause is absent
                    continue
                last = before.get(name, {})
                parts = {
                    part: np.maximum(size, last.get(part, 0.0)) for part, size in parts.items()
                }
                before[name] = parts
                total, floor = np.sum(list(parts.values()), axis=0), parts["tolerance"]
                small = np.all(total <= LARGEST_SHARE * largest[step][name] + floor)
                believed = features.resolve(name) and not (nearly[step] and name in OF_SLIP)
                found[name] = stated(parts, bool(small and believed))
            yield found

    def order(self, name: str) -> float:
        """Smallest convergence order of a number in the cells."""
        return min(features.order(name) for features in self.features)

    def _parts(self, step: int, name: str, largest: Numbers) -> dict[Part, Numbers] | None:
        """Parts of the error of a number; None where one is unknown."""
        if name == WORK:
            return self._of_work(step)
        features = self.features[step]
        if name == PEAK and features.infinite:
            return None
        parts: dict[Part, Numbers] = {}
        for comparison in self.comparisons:
            size = comparison.part_of(step, name, features.order(name))
            if size is not None:
                parts[comparison.part] = np.maximum(parts.get(comparison.part, 0.0), size)
        if any(needs[step] and part not in parts for part, needs in self.required.items()):
            return None
        size = np.maximum(largest, scale(name, self.values[step]))
        parts["tolerance"] = PER_TOLERANCE * self.tolerance[step] * size
        if change := features.changes.get(name):
            parts["tolerance"] = parts["tolerance"] + PER_ITERATION * change * largest
        if hidden := features.hidden(name) * features.cell:
            radius = self.values[step][name.replace("_area", "_radius")]
            area = 2 * np.pi * radius * hidden + np.pi * hidden**2
            space = next(iter(self.required))
            parts[space] = parts[space] + (area if name.endswith("_area") else hidden)
        if share := self.neglected.get(name):
            parts["neglected"] = share * largest
        return parts

    def _of_work(self, step: int) -> dict[Part, Numbers] | None:
        """The work of the loads is the sum of the energies, and so are its errors."""
        total: dict[Part, Numbers] = {}
        if ENERGIES[0] not in self.values[step]:
            return None
        for name in ENERGIES:
            if name in self.values[step]:
                size = np.abs(self.values[step][name])
                parts = self._parts(step, name, size)
                if parts is None:
                    return None
                for part, amount in parts.items():
                    total[part] = total.get(part, np.zeros(1)) + amount
        return total or None


def largest_so_far(values: Sequence[Values]) -> tuple[Values, ...]:
    """Largest size of each number in the history up to each step, one for a whole vector."""
    seen: dict[str, Numbers] = {}
    found = []
    for step in values:
        for name, value in step.items():
            size = np.abs(value)
            size[size > ROUND_OFF * np.max(size)] = np.max(size)
            seen[name] = np.maximum(seen.get(name, 0.0), size)
        found.append(dict(seen))
    return tuple(found)


def stated(parts: Mapping[Part, Numbers], converged: bool) -> StatedError:
    """Sum of the parts."""
    status = ErrorStatus.ESTIMATED if converged else ErrorStatus.NOT_CONVERGED
    total = np.sum(list(parts.values()), axis=0)
    amounts = {part: _amount(size, len(total)) for part, size in parts.items()}
    return StatedError(error=_amount(total, len(total)), parts=amounts, status=status)


UNKNOWN = StatedError(error=None, parts={}, status=ErrorStatus.NOT_CONVERGED)


def _amount(size: Numbers, count: int) -> Amount:
    parts = np.broadcast_to(size, count)
    return float(parts[0]) if count == 1 else (float(parts[0]), float(parts[1]))
