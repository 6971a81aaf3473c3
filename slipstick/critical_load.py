"""Critical loads: the load factor at which each stress measure first meets its strength.

All loads and prescribed displacements of the history are multiplied by a load factor f. The scene
is solved at several factors. s(f) is the largest value of a stress measure in a region of a body,
over the ends of the load steps. The root s(f) = S for a strength S is found by a bracketed secant
iteration on ln(s/S) over ln f. In a self-similar contact s is a power of f, such as f^(1/3) under
a paraboloid, and the second solve is at the root.

The error of s changes the root by the local slope:

    error of f = f (error of s / s) / (d ln s / d ln f)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import exp, inf, isfinite, log
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_errors.error_formula import TOO_LARGE, build_stated_error, unknown_error
from contact_errors.stress_errors import stress_errors
from contact_results.stress.below_contact import stress_below_contact
from contact_results.stress.loaded_bodies import NoSuchState, state_of_result
from contact_results.stress.points import StressField, layer_name
from contact_results.stress.stress_maxima import Extreme, extremes
from contact_scene import Body, Scene, SceneFile
from contact_scene.quantities.stated_error import ErrorStatus, Part, StatedError
from contact_scene.reading.description import Description
from contact_scene.solver_errors import SolverError, UnsupportedScene
from slipstick.solving import check_arguments

if TYPE_CHECKING:
    from slipstick.solvers.solver import Discretisation, Solver

Progress = Callable[[float, Mapping["Strength", float]], None]

# Strengths by stress measure: keys of a material, and keys of the interface below a layer.
OF_MATERIALS = {"von_mises": "yield_strength", "max_principal": "tensile_strength"}
OF_INTERFACES = {"interface_shear": "shear", "interface_tensile_stress": "tension"}

# Load factors are searched up to this one and down to its inverse. Stresses below a paraboloid
# change by its cube root, a factor of 4.6.
MAX_FACTOR = 100.0
# Largest ratio of a load factor to its predecessor, where no root is bracketed.
MAX_STEP = 10.0
# d ln s / d ln f before two solves determine it: that of a paraboloid under a normal force.
FIRST_SLOPE = 1 / 3
# |ln(s/S)| below which the error of the stress is estimated. It is then the error at the root.
NEAR = 0.1
# |ln(s/S)| at which the search ends: this part of the relative error of the stress, and at least a
# value that is far below the scatter of measured strengths.
SHARE_OF_ERROR = 0.1
LEAST_TOLERANCE = 1e-5
# |ln f| between solves below which they do not determine a slope, and that of an additional solve.
APART = 0.02
# Part of a bracket that the next solve removes at least.
LEAST_PART = 0.01
# Ratio of the factors of a failed and a successful solve between which no further solve is tried.
CLOSE = 1.1
# Largest number of solves for one strength. Two to five are usual.
MAX_SOLVES = 20


@dataclass(frozen=True)
class Strength:
    """Strength of a material or an interface, the limit of one stress measure.

    body     "body" for the lower body, or "indenter"
    region   region of the body, as in `stress_maxima`: "body" for a body without layers
    measure  name of the stress measure
    value    limit [force/length^2]
    """

    body: str
    region: str
    measure: str
    value: float

    @property
    def shown_region(self) -> str:
        """Region for tables: interfaces without their side, and "body" for the whole body."""
        return self.region.removesuffix(" above")


class CriticalLoad(Description):
    """Load factor at which one stress measure first meets its strength, and the place."""

    body: str
    """ "body" for the lower body, or "indenter"."""

    region: str
    """The material or the interface: "body" without layers, "layer 1", "base", "interface 1"."""

    measure: str
    """Stress measure that the strength limits: von_mises, max_principal, interface_shear or
    interface_tensile_stress."""

    strength: float
    """Limit of the stress measure [Pa]."""

    load_factor: float | None = None
    """Factor of all loads and prescribed displacements at which the largest stress equals the
    strength; null if it was not found in the searched range."""

    error: StatedError | None = None
    """Stated error of the load factor; null without error estimates or without a load factor."""

    below: float | None = None
    """Largest factor of the search, at which the stress is below the strength; null if there is a
    load factor or if the stress is above."""

    above: float | None = None
    """Smallest factor of the search, at which the stress is above the strength; null if there is a
    load factor or if the stress is below."""

    normal_force: float | None = None
    """Normal force at the end of the critical step at this load factor [N], of a line contact
    [N/m]."""

    slope: float | None = None
    """d ln(stress) / d ln(load factor) at this load factor."""

    step: int | None = None
    """Load step, from 1, at whose end the stress is largest."""

    x: float | None = None
    """Place of the largest stress [m]."""

    y: float | None = None
    """Place of the largest stress [m]."""

    depth: float | None = None
    """Depth of the largest stress below the surface [m]."""

    reason: str | None = None
    """Reason why there is no load factor; null if there is one."""


class CriticalLoads(Description):
    """Critical loads of a scene, the smallest load factor first, and the solves of the search."""

    title: str
    """Title of the scene."""

    solver: str
    """Name of the solver."""

    load_factors: tuple[float, ...]
    """Load factors of all solves, in ascending order."""

    limits: tuple[CriticalLoad, ...]
    """Critical load of every strength in the scene."""


@dataclass(frozen=True)
class LargestStress:
    """Largest value of a stress measure over the ends of the load steps.

    step          load step, from 1
    normal_force  normal force at its end [force], of a line contact [force/length]
    extreme       value and place
    """

    step: int
    normal_force: float
    extreme: Extreme


# ln f of a solve and ln(s/S): -inf without tension, None if the solve failed.
Level = tuple[float, float | None]


def critical_loads(
    scene: Scene | SceneFile,
    solver: str = "semi-analytical",
    discretisation: Discretisation | None = None,
    *,
    step: int | None = None,
    max_factor: float = MAX_FACTOR,
    errors: bool = True,
    progress: Progress | None = None,
) -> CriticalLoads:
    """Find the load factor at which each stress measure first meets its strength.

    The grid and the mesh are chosen for each load factor: a window of smooth indenters and a
    contact radius in the discretisation are ignored.

    Parameters
    ----------
    scene : Scene or SceneFile
        Scene with at least one `yield_strength`, `tensile_strength` or `interface_strength`.
    solver, discretisation
        As in `slipstick.solve`.
    step : int
        Load step, from 1, at whose end the stress is evaluated. Default: all.
    max_factor : float
        Load factors are searched up to this one and down to its inverse.
    errors : bool
        Estimate the errors of the load factors.
    progress : callable
        Called after each solve with the load factor and the ratios of stress to strength.

    Returns
    -------
    CriticalLoads

    Raises
    ------
    ValueError
        There is no such load step, or max_factor is below 1.
    SolverError
        UnsupportedScene without strengths or without contact, and errors of the solve of the scene
        at the load factor 1.
    """
    chosen, solved, fineness = check_arguments(scene, solver, discretisation)
    count = len(solved.loading)
    if step is not None and not 1 <= step <= count:
        raise ValueError(f"there is no step {step}; the scene has steps 1 to {count}")
    if not max_factor >= 1:
        raise ValueError(f"got max_factor {max_factor}, expected at least 1")
    wanted = strengths(solved)
    if not wanted:
        raise UnsupportedScene(
            "the scene has no strength: add yield_strength or tensile_strength to a material, or "
            'interface_strength = { shear = "…", tension = "…" } to a layer'
        )
    reach = log(max_factor)
    search = LoadFactorSearch(solved, chosen, fineness, wanted, step, reach, errors, progress)
    search.solve(0.0)
    for refused in search.refused.values():
        raise refused
    nearest = sorted(wanted, key=lambda one: abs(search.levels(one)[0][1] or 0.0))
    limits = sorted(
        map(search.critical_load, nearest),
        key=lambda one: inf if one.load_factor is None else one.load_factor,
    )
    factors = tuple(sorted(map(exp, search.solved)))
    return CriticalLoads(
        title=solved.title, solver=solver, load_factors=factors, limits=tuple(limits)
    )


def strengths(scene: Scene) -> tuple[Strength, ...]:
    """List the strengths of a scene: of the materials and the interfaces of both bodies."""
    found = []
    for which in ("body", "indenter"):
        body: Body = getattr(scene, which)
        count = len(body.layers)
        materials = (*(layer.material for layer in body.layers), body.material)
        interfaces = (layer.interface_strength for layer in body.layers)
        regions = [
            *((layer_name(k, count) if count else "body", OF_MATERIALS, one)
              for k, one in enumerate(materials)),
            *((f"interface {k} above", OF_INTERFACES, one)
              for k, one in enumerate(interfaces, 1)),
        ]  # fmt: skip
        for region, keys, holder in regions:
            for measure, key in keys.items():
                value = getattr(holder, key, None)
                if value is not None:
                    found.append(Strength(which, region, measure, value))
    return tuple(found)


@dataclass
class LoadFactorSearch:
    """Solves of a scene at several load factors, and the search of the roots among them.

    scene           scene at the load factor 1, with strengths
    solver          solver of the scene
    discretisation  settings of the solver
    wanted          strengths whose critical loads are searched
    step            load step at whose end the stress is evaluated; None for all
    reach           largest |ln f| of the search
    with_errors     True to estimate errors
    progress        function that is called after each solve, or None
    solved          largest stress by ln f and strength; without an entry for stresses that are
                    nowhere positive
    refused         error of each failed solve, by ln f
    relative        relative error of the stress near its strength
    """

    scene: Scene
    solver: Solver
    discretisation: Discretisation
    wanted: Sequence[Strength]
    step: int | None
    reach: float
    with_errors: bool
    progress: Progress | None = None
    solved: dict[float, Mapping[Strength, LargestStress]] = field(default_factory=dict)
    refused: dict[float, SolverError] = field(default_factory=dict)
    relative: dict[Strength, StatedError] = field(default_factory=dict)

    def solve(self, logarithm: float) -> None:
        """Solve the scene at a load factor, and store the largest stresses or the error.

        logarithm  ln f
        """
        scene = self.scene.with_loads_multiplied(exp(logarithm))
        try:
            fineness = _without_sizes(self.discretisation, scene)
            result = self.solver.solve(scene, fineness, self.solver.plan(scene, fineness))
            found = self._largest_stresses(result)
        except SolverError as error:
            self.refused[logarithm] = error
            return
        self.solved[logarithm] = found
        if self.progress is not None:
            ratios = {one: each.extreme.value / one.value for one, each in found.items()}
            self.progress(exp(logarithm), ratios)

    def _largest_stresses(self, result: Any) -> Mapping[Strength, LargestStress]:
        """Return the largest stress of each strength in a result; estimate errors near a root."""
        fields: dict[tuple[int, str], tuple[StressField, dict[tuple[str, str], Extreme]]] = {}
        steps = [self.step] if self.step else range(1, len(result.steps) + 1)
        for number in steps:
            try:
                state = self._state(result, number)
            except NoSuchState:
                continue
            for which in dict.fromkeys(one.body for one in self.wanted):
                made = stress_below_contact(state, indenter=which == "indenter")
                by_name = {(e.region, e.measure): e for e in extremes(made, getattr(state, which))}
                fields[number, which] = made, by_name
        if not fields:
            raise UnsupportedScene(
                "the bodies are separated at the end of every step and have no stress; use a step "
                "that ends in contact"
            )
        found: dict[Strength, LargestStress] = {}
        for one in self.wanted:
            for (number, which), (_, by_name) in fields.items():
                extreme = by_name.get((one.region, one.measure))
                if which != one.body or extreme is None or extreme.value <= 0:
                    continue
                if one not in found or extreme.value > found[one].extreme.value:
                    force = float(result.steps[number - 1].normal_force)
                    found[one] = LargestStress(number, force, extreme)
        if self.with_errors:
            self._estimate_errors(result, found, {key: made for key, (made, _) in fields.items()})
        return found

    def _estimate_errors(
        self,
        result: Any,
        found: Mapping[Strength, LargestStress],
        fields: Mapping[tuple[int, str], StressField],
    ) -> None:
        """Estimate the relative errors of the stresses that are near their strength.

        found   largest stresses
        fields  stress by load step and body
        """
        near = [
            one
            for one, each in found.items()
            if one not in self.relative and abs(log(each.extreme.value / one.value)) < NEAR
        ]
        if not near:
            return
        stated = self.solver.errors(result)
        for one in near:
            number, extreme = found[one].step, found[one].extreme
            state = self._state(result, number, stated)
            below = fields[number, one.body]
            (error,) = stress_errors(state, below, [extreme], indenter=one.body == "indenter")
            self.relative[one] = _divided(error, extreme.value)

    def _state(self, result: Any, number: int, stated: Any = None) -> Any:
        """Return the loaded bodies at the end of a load step, with all layers of the scene.

        A solver merges layers of equal elastic constants, whose strengths may differ.
        """
        state = state_of_result(result, number, stated)
        indenter = self.scene.indenter
        upper = Body(material=indenter.material, layers=indenter.layers)
        return replace(state, body=self.scene.body, indenter=upper)

    def levels(self, strength: Strength) -> list[Level]:
        """Return ln f and ln(s/S) of all solves for one strength, in ascending order of f."""
        found: list[Level] = [(x, None) for x in self.refused]
        for x, largest in self.solved.items():
            each = largest.get(strength)
            found.append((x, -inf if each is None else log(each.extreme.value / strength.value)))
        return sorted(found, key=lambda level: level[0])

    def tolerance(self, strength: Strength) -> float:
        """Return the |ln(s/S)| at which the search of a root ends."""
        error = self.relative.get(strength)
        size = 0.0 if error is None or error.error is None else float(np.max(error.error))
        return max(LEAST_TOLERANCE, SHARE_OF_ERROR * size)

    def critical_load(self, strength: Strength) -> CriticalLoad:
        """Find the load factor at which a stress measure first meets its strength."""
        for _ in range(MAX_SOLVES):
            following = next_solve(self.levels(strength), self.tolerance(strength), self.reach)
            if following is None:
                break
            self.solve(following)
        levels = self.levels(strength)
        lower, upper = bracket(levels)
        limit: Any = {"body": strength.body, "region": strength.shown_region}
        limit |= {"measure": strength.measure, "strength": strength.value}
        x, y = min((end for end in (lower, upper) if end), key=lambda level: abs(level[1]))
        if abs(y) > self.tolerance(strength) and (lower is None or upper is None):
            limit["below" if upper is None else "above"] = exp(x)
            return CriticalLoad(**limit, reason=self._reason_without_root(x, upward=upper is None))
        largest, rate = self.solved[x][strength], slope(levels, x)
        shift = -y / rate if rate > 0 else 0.0
        factor = exp(x + shift)
        extreme = largest.extreme
        return CriticalLoad(
            **limit,
            load_factor=factor,
            error=self._error_of_factor(strength, factor, y, rate) if self.with_errors else None,
            normal_force=largest.normal_force,
            slope=rate,
            step=largest.step,
            x=extreme.x,
            y=extreme.y,
            depth=extreme.depth,
        )

    def _error_of_factor(
        self, strength: Strength, factor: float, level: float, rate: float
    ) -> StatedError:
        """Convert the relative error of a stress to the error of its load factor.

        level  ln(s/S) at the last solve, whose effect is part of the error
        rate   d ln s / d ln f
        """
        error = self.relative.get(strength)
        if error is None or error.error is None:
            return unknown_error("the error of the stress is unknown")
        if rate <= 0:
            return unknown_error("the stress does not grow with the load factor")
        parts: dict[Part, Any] = {
            part: np.array([factor * float(size) / rate])  # type: ignore[arg-type]
            for part, size in error.parts.items()
        }
        parts["tolerance"] = parts.get("tolerance", 0.0) + np.array([factor * abs(level) / rate])
        large = sum(float(size[0]) for size in parts.values()) > factor
        return build_stated_error(parts, error.reason or (TOO_LARGE if large else None))

    def _reason_without_root(self, x: float, *, upward: bool) -> str:
        """Return the reason why the search of a root ended without one.

        x       ln f of the last successful solve
        upward  True if the stress is below its strength there
        """
        failed = [error for at, error in self.refused.items() if (at > x) == upward]
        if failed:
            return f"the solver refuses a load beyond: {failed[-1]}"
        state = "below" if upward else "above"
        return f"the stress is {state} its strength at {exp(x):.4g} times the loads"


def bracket(levels: Sequence[Level]) -> tuple[Any, Any]:
    """Return the solves adjacent to the first root, below and above it; None without one.

    levels  ln f and ln(s/S) of all solves, in ascending order
    """
    good = [level for level in levels if level[1] is not None]
    upper = next((level for level in good if level[1] >= 0), None)  # type: ignore[operator]
    lower = [level for level in good if upper is None or level[0] < upper[0]]
    return (lower[-1] if lower else None), upper


def slope(levels: Sequence[Level], x: float) -> float:
    """Return d ln s / d ln f at a solve, by a parabola through it and its neighbours.

    levels  ln f and ln(s/S) of all solves
    x       ln f of the solve

    Returns 0 if there is no other solve.
    """
    chosen: list[tuple[float, float]] = []
    for at, level in sorted(levels, key=lambda each: abs(each[0] - x)):
        far = all(abs(at - x - other) >= APART for other, _ in chosen)
        if level is not None and isfinite(level) and far and len(chosen) < 3:
            chosen.append((at - x, level))
    if len(chosen) < 2:
        return 0.0
    at, values = np.array(chosen).T
    return float(np.polyfit(at, values, len(chosen) - 1)[-2])


def next_solve(levels: Sequence[Level], tolerance: float, reach: float) -> float | None:
    """Choose ln f of the next solve for the root of ln(s/S); None if the search ends.

    levels     ln f and ln(s/S) of all solves, in ascending order
    tolerance  |ln(s/S)| at the root
    reach      largest |ln f| of the search
    """
    lower, upper = bracket(levels)
    ends = [end for end in (lower, upper) if end is not None]
    x, y = min(ends, key=lambda level: abs(level[1]))
    if abs(y) <= tolerance:
        others = [at for at, level in levels if level is not None and isfinite(level)]
        return None if any(abs(at - x) >= APART for at in others) else x - NEAR
    near = [level for level in levels if level[1] is not None and isfinite(level[1])]
    near = sorted(near, key=lambda level: abs(level[1]))[:2]  # type: ignore[arg-type]
    rate = FIRST_SLOPE
    if len(near) == 2:
        (x0, y0), (x1, y1) = near
        rate = (y1 - y0) / (x1 - x0)  # type: ignore[operator]
    guess = x - y / rate if rate > 0 else inf
    failed = [at for at, level in levels if level is None]
    if lower is not None and upper is not None:
        width = upper[0] - lower[0]
        if width <= tolerance or any(lower[0] < at < upper[0] for at in failed):
            return None
        if not isfinite(guess):
            return float(lower[0] + width / 2)
        margin = LEAST_PART * width
        return float(min(max(guess, lower[0] + margin), upper[0] - margin))
    sign = 1 if upper is None else -1
    start = ends[0][0]
    ahead = min((sign * (at - start) for at in failed if sign * (at - start) > 0), default=inf)
    distance = sign * (guess - start) if isfinite(guess) else inf
    if distance <= 0:
        distance = inf
    distance = min(distance, log(MAX_STEP), reach - sign * start)
    if distance >= ahead:
        distance = ahead / 2 if ahead > log(CLOSE) else 0.0
    return start + sign * distance if distance > tolerance else None


def _divided(error: StatedError, value: float) -> StatedError:
    """Return the stated error of a positive scalar relative to the scalar."""
    if error.error is None:
        return error
    parts: Any = {part: np.array([size]) / value for part, size in error.parts.items()}
    return build_stated_error(
        parts, error.reason if error.status is ErrorStatus.NOT_CONVERGED else None
    )


def _without_sizes(discretisation: Discretisation, scene: Scene) -> Any:
    """Return a discretisation without the sizes of grid and mesh that belong to one load.

    The window of a height map is a part of the surface, and is kept.
    """
    if scene.indenter.extent is not None:
        return discretisation
    sizes = {"window", "contact_radius"} & type(discretisation).model_fields.keys()
    return discretisation.model_copy(update=dict.fromkeys(sizes))
