"""Critical loads: the load factor at which each stress measure first meets its strength.

All loads and prescribed displacements of the history are multiplied by a load factor f. The scene
is solved at several factors. s(f) is the largest value of a stress measure in a region of a body,
over the ends of the load steps. The root s(f) = S for a strength S is found by a secant iteration
on ln(s/S) over ln f, with bisection where it leaves the bracket of the root. In a self-similar
contact s is a power of f, such as f^(1/3) under a paraboloid, and the second solve is at the root.

The error of s changes the root by the local slope:

    error of f = f ((1 - error of s / s)^(-1/n) - 1),    n = d ln s / d ln f
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from math import copysign, exp, expm1, inf, isfinite, log, log1p
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_errors.coarse_solves import stated_errors
from contact_errors.error_formula import TOO_LARGE, build_stated_error, unknown_error
from contact_errors.stress_errors import stress_errors
from contact_results.stress.below_contact import body_response
from contact_results.stress.loaded_bodies import LoadedBodies, state_of_result
from contact_results.stress.points import layer_name
from contact_results.stress.stress_maxima import Extreme, extremes
from contact_scene import Body, Scene, SceneFile
from contact_scene.contact_features import is_singular
from contact_scene.quantities.stated_error import StatedError
from contact_scene.reading.description import Description
from contact_scene.solver_errors import SolverError, UnsupportedScene
from slipstick.solving import check_arguments

if TYPE_CHECKING:
    from contact_results.stress.points import StressField
    from contact_scene.discretised import Discretisation, DiscretisedSolver

# "body" or "indenter", region of the body as in `stress_maxima`, and stress measure.
Key = tuple[str, str, str]
BODIES = ("body", "indenter")
# Keys of a material and of the strength of an interface, by the stress measure that they limit.
STRENGTHS = {
    "von_mises": "yield_strength",
    "max_principal": "tensile_strength",
    "interface_shear": "shear",
    "interface_tensile_stress": "tension",
}

# Regions in contact with the other body.
OUTERMOST = ("body", "layer 1")
SINGULAR = (
    "the elastic stress is infinite at the tip or rim of the indenter, so that yield begins at any "
    "load; give the indenter a radius there"
)

# Load factors are searched up to this one and down to its inverse. Stresses below a paraboloid
# change by its cube root, a factor of 4.6.
MAX_FACTOR = 100.0
# Largest ratio of the load factors of two successive solves.
MAX_STEP = 10.0
# d ln s / d ln f before two solves determine it: that of a paraboloid under a normal force.
FIRST_SLOPE = 1 / 3
# d ln s / d ln f below which a stress determines no load: 1 % of it is a factor of 2.7 of the load.
LEAST_SLOPE = 0.01
LARGEST_SHARE = 0.9  # of an error in its stress, beyond which a factor says nothing
# |ln(s/S)| at which the search ends, far below the scatter of measured strengths.
TOLERANCE = 1e-4
# Least |ln f| between two solves that determine a slope, and between the root and an added solve.
APART = 0.02
ADDED = 0.1
# Largest number of solves for one strength. Two to five are usual.
MAX_SOLVES = 20


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
    """Stated error of the load factor; null without a load factor."""

    below: float | None = None
    """Largest factor of the search, at which the stress is below the strength; null if there is a
    load factor or if the stress is above."""

    above: float | None = None
    """Smallest factor of the search, at which the stress is above the strength; null if there is a
    load factor or if the stress is below."""

    normal_force: float | None = None
    """Normal force at the end of the critical step at this load factor [N], of a line contact
    [N/m]."""

    step: int | None = None
    """Load step, from 1, at whose end the stress is largest."""

    place: tuple[float, float, float] | None = None
    """Place of the largest stress: x, y and depth below the surface [m]."""

    reason: str | None = None
    """Reason why the stress determines no load, why the solver refuses a load, or why the error is
    not converged; null for others."""


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


def critical_loads(
    scene: Scene | SceneFile,
    solver: str = "semi-analytical",
    discretisation: Discretisation | None = None,
    *,
    progress: Callable[[float], None] | None = None,
) -> CriticalLoads:
    """Find the load factor at which each stress measure first meets its strength.

    The window and the mesh are chosen for each load factor. Those in the discretisation are ignored
    unless the indenter is a height map.

    Parameters
    ----------
    scene : Scene or SceneFile
        Scene with at least one `yield_strength`, `tensile_strength` or `interface_strength`.
    solver, discretisation
        As in `slipstick.solve`.
    progress : callable
        Called with the load factor before each solve.

    Returns
    -------
    CriticalLoads

    Raises
    ------
    SolverError
        UnsupportedScene without strengths, and errors of the scene at the load factor 1.
    """
    chosen = check_arguments(scene, solver, discretisation)
    wanted = strengths(chosen.scene)
    if not wanted:
        raise UnsupportedScene(
            "the scene has no strength: add yield_strength or tensile_strength to a material, or "
            'interface_strength = { shear = "…", tension = "…" } to a layer'
        )
    search = LoadFactorSearch(chosen, wanted, progress)
    search.largest_stresses(0.0)
    limits = sorted(map(search.critical_load, wanted), key=lambda one: one.load_factor or inf)
    factors = tuple(map(exp, sorted(search.solved)))
    return CriticalLoads(
        title=chosen.scene.title, solver=solver, load_factors=factors, limits=tuple(limits)
    )


def strengths(scene: Scene) -> dict[Key, float]:
    """Return the strengths of materials and interfaces of both bodies [force/length^2]."""
    found = {}
    for which in BODIES:
        body: Body = getattr(scene, which)
        count = len(body.layers)
        materials = (*(layer.material for layer in body.layers), body.material)
        holders: dict[str, object] = {
            layer_name(k, count) if count else "body": one for k, one in enumerate(materials)
        }
        for k, layer in enumerate(body.layers, 1):
            holders[f"interface {k} above"] = layer.interface_strength
        for region, holder in holders.items():
            for measure, name in STRENGTHS.items():
                found[which, region, measure] = getattr(holder, name, None)
    return {key: value for key, value in found.items() if value is not None}


@dataclass
class LoadFactorSearch:
    """Solves of a scene at several load factors, and the search of the roots among them.

    solver    solver of the scene at the load factor 1
    wanted    strengths whose critical loads are searched [force/length^2]
    progress  function that is called before each solve, or None
    solved    largest stresses by ln f, each with the increment at the end of its load step; without
              stresses that are nowhere positive
    last      ln f and result of the last solve
    stresses  stress of a body by ln f, load step and body
    """

    solver: DiscretisedSolver
    wanted: Mapping[Key, float]
    progress: Callable[[float], None] | None
    solved: dict[float, dict[Key, tuple[Extreme, Any]]] = field(default_factory=dict)
    last: tuple[float, Any] = (inf, None)
    stresses: dict[tuple[float, int, str], StressField] = field(default_factory=dict)

    def critical_load(self, key: Key) -> CriticalLoad:
        """Find the load factor at which a stress measure first meets its strength."""
        which, region, measure = key
        limit: dict[str, Any] = {"body": which, "region": region.removesuffix(" above")}
        limit |= {"measure": measure, "strength": self.wanted[key]}
        if (
            measure == "von_mises"
            and region in OUTERMOST
            and is_singular(self.solver.scene.indenter)
        ):
            return CriticalLoad(**limit, reason=SINGULAR)
        try:
            x = self._find_root(key)
        except SolverError as refused:
            x, limit["reason"] = None, f"the solver refuses a load beyond: {refused}"
        if x is None:
            below = self._level(key, 0.0) < 0
            limit["below" if below else "above"] = exp((max if below else min)(self.solved))
            return CriticalLoad(**limit)
        slope = self._slope(key, x)
        extreme, end = self.solved[x][key]
        shift = -self._level(key, x) / slope if slope > LEAST_SLOPE else 0.0
        factor = exp(x + shift)
        error = self._error_of_factor(key, x, factor, slope)
        return CriticalLoad(
            **limit,
            load_factor=factor,
            error=error,
            normal_force=float(end.normal_force) * exp(shift),
            step=int(end.step),
            place=(extreme.x, extreme.y, extreme.depth),
            reason=error.reason,
        )

    def _find_root(self, key: Key) -> float | None:
        """Return ln f at which a stress equals its strength; None if there is none in the range.

        Raises a SolverError of a solve.
        """
        reach, lower, upper = log(MAX_FACTOR), -inf, inf
        x = min(self.solved, key=lambda one: abs(self._level(key, one)))
        for _ in range(MAX_SOLVES):
            level, slope = self._level(key, x), self._slope(key, x) or FIRST_SLOPE
            if abs(level) <= TOLERANCE:
                break
            lower, upper = (x, upper) if level < 0 else (lower, x)
            step = -level / slope if slope > 0 else copysign(inf, -level)
            step = min(max(step, -log(MAX_STEP)), log(MAX_STEP))
            following = min(max(x + step, -reach), reach)
            if isfinite(upper - lower) and not lower < following < upper:
                following = (lower + upper) / 2
            if following == x:
                return None
            x = following
        else:  # the stress jumps
            x = upper if isfinite(upper) else x
        if not self._slope(key, x):
            self.largest_stresses(x - ADDED)
        return x

    def _level(self, key: Key, x: float) -> float:
        """Return ln(s/S) of a stress at ln f = x; -inf for a stress that is nowhere positive."""
        found = self.largest_stresses(x)
        return log(found[key][0].value / self.wanted[key]) if key in found else -inf

    def _slope(self, key: Key, x: float) -> float:
        """Return d ln s / d ln f between ln f = x and the nearest other solve; 0 without one."""
        here = self.largest_stresses(x)
        near = [one for one in self.solved if abs(one - x) >= APART and key in self.solved[one]]
        if key not in here or not near:
            return 0.0
        other = min(near, key=lambda one: abs(one - x))
        return (self._level(key, other) - self._level(key, x)) / (other - x)

    def largest_stresses(self, x: float) -> dict[Key, tuple[Extreme, Any]]:
        """Return the largest stresses at ln f = x, each with the end of its load step.

        Raises a SolverError of the solve.
        """
        if x in self.solved:
            return self.solved[x]
        result = self._solve(x)
        found: dict[Key, tuple[Extreme, Any]] = {}
        for end in result.steps:
            if not end.contact_area:
                continue
            state = self._state(result, end.step)
            for which in {body for body, _, _ in self.wanted}:
                stress = body_response(state, indenter=which == "indenter").stress()
                self.stresses[x, end.step, which] = stress
                for one in extremes(stress):
                    key = which, one.region, one.measure
                    smallest = found[key][0].value if key in found else 0.0
                    if key in self.wanted and one.value > smallest:
                        found[key] = one, end
        self.solved[x] = found
        return found

    def _solve(self, x: float) -> Any:
        """Return the result at ln f = x, which is solved again unless it is the last."""
        if self.last[0] != x:
            if self.progress is not None:
                self.progress(exp(x))
            scene = self.solver.scene.with_loads_multiplied(exp(x))
            fineness = _without_sizes(self.solver.discretisation, scene)
            self.last = x, replace(self.solver, scene=scene, discretisation=fineness).run()
        return self.last[1]

    def _state(self, result: Any, number: int, stated: Any = None) -> LoadedBodies:
        """Return the loaded bodies with all layers: solvers merge those of equal constants."""
        return state_of_result(result, number, stated).with_bodies_of(self.solver.scene)

    def _error_of_factor(self, key: Key, x: float, factor: float, slope: float) -> StatedError:
        """Convert the error of the stress at a root to the error of the load factor.

        x       ln f of the solve at the root
        factor  load factor
        slope   d ln s / d ln f
        """
        if slope <= LEAST_SLOPE:
            return unknown_error("the stress hardly grows with the load factor")
        extreme, end = self.solved[x][key]
        upper = key[0] == "indenter"
        try:
            result = self._solve(x)
            state = self._state(result, end.step, stated_errors(result))
            below = self.stresses[x, end.step, key[0]]
            (error,) = stress_errors(state, below, [extreme], indenter=upper)
        except SolverError as failed:
            return unknown_error(str(failed))
        if error.error is None:
            return error
        left = extreme.value * abs(self._level(key, x))
        parts: Any = {**error.parts, "tolerance": left}
        # The stress may be smaller: its root is then at a factor that is larger than in proportion.
        share = sum(map(float, parts.values())) / extreme.value
        if share > LARGEST_SHARE:
            return unknown_error("the error of the stress is almost as large as the stress")
        growth = expm1(-log1p(-share) / slope) / share if share else 1 / slope
        scale = factor * growth / extreme.value
        sizes = {part: np.array([scale * size]) for part, size in parts.items()}
        doubt = None if growth * share < 1 else TOO_LARGE
        return build_stated_error(sizes, error.reason or doubt)


def _without_sizes(discretisation: Discretisation, scene: Scene) -> Any:
    """Drop the sizes of grid and mesh that belong to one load.
    The window of a height map is a part of the surface, and is kept."""
    if scene.indenter.extent is not None:
        return discretisation
    sizes = {"window", "contact_radius"} & type(discretisation).model_fields.keys()
    return discretisation.model_copy(update=dict.fromkeys(sizes))
