"""Errors of the largest stresses in a body, from a reference or from coarse tractions.

Without shear, the stress below the pressure of the radial solver is the reference for bodies of
revolution. The error is the difference. Otherwise the error follows from two subsurface solutions
for coarse tractions.

The coarse tractions on cells are means over four cells, in two positions of the coarse grid. With
finite elements, a mesh with elements of twice the size receives the tractions of all rings, and
those of every second ring. Each stress of a region has up to two places where it may be largest:
inside, and at the surface adjacent to the edge of the contact. The error of the largest stress is

    max over these places (value + its error) - largest stress found

- Inside the body the stress has the convergence order 2. For a maximum between the depth levels,
  twice the excess of a parabola through three levels is added.
- Adjacent to the contact edge the order is 1 if the edge is fitted within the cells, else ½.
- Let the tractions end like a square root at the edge, with m cells per contact radius. Half a cell
  inside the edge the computed tensile stress is then too small by m^-½ of its true value.
- At a fitted edge the error is at least 4.3 times the difference from another fit.
- If an edge that is not fitted may have the largest tensile stress, the error has not converged.
- A section of finite elements ends where the displacement is that of a half-space. A wider section
  is compared, with the order 2, and 1 in plane strain.
- Below shear that depends on the rings of the radial solver, two solves with other numbers of rings
  are compared. The order is 2, and 1 near the surface. There the place of a largest stress moves
  with the edge and is searched again.
- Other stresses than the tensile stress are compared at the edge only if their maximum was found
  near the surface.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from math import hypot, inf, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

import radial
from contact_errors.error_formula import (
    BELIEVED,
    LARGEST_SHARE,
    REFERENCE_PRECISION,
    SPREADS,
    TOO_LARGE,
    build_stated_error,
    unknown_error,
)
from contact_errors.known_pressing import pressing_alone
from contact_results.stress.below_contact import body_response
from contact_results.stress.body_response import BodyResponse
from contact_results.stress.loaded_bodies import (
    LoadedBodies,
    NoSuchState,
    state_of_increment,
    state_of_result,
)
from contact_results.stress.on_disc import OnDisc
from contact_results.stress.points import StressField, StressPoints
from contact_results.stress.radial_body import is_sheared
from contact_results.stress.stress_maxima import (
    SURFACE,
    Extreme,
    excess_between_depths,
    extremes,
)
from contact_scene import RadialDiscretisation, Scene
from contact_scene.accuracy import LARGEST_TENSION
from contact_scene.contact_features import EDGE, ROOT, SMOOTH, is_singular
from contact_scene.discretised import PRECISION, Fineness
from contact_scene.quantities.stated_error import (
    Part,
    StatedError,
    StatedErrors,
)
from contact_scene.solver_errors import SolverError, UnsupportedScene
from radial.discretised import RingSolver

Field = NDArray[np.float64]
Key = tuple[str, str]

# Regions that contain the edge of the contact.
AT_SURFACE = "body", "layer 1", SURFACE
# Depth in cells up to which the contact edge determines the error of a stress.
NEAR = 2.0
# Reasons why the error of a stress is not converged.
AT_WINDOW_EDGE = "the largest stress lies at the edge of the window"
INFINITE = "the pressure is infinite at a tip or a rim, and the stress may be infinite below it"
UNRESOLVED = "the contact edge, which may have the largest stress, is not fitted within the cells"
SMALL_STICK = "the stress has a peak at the centre of a stick zone that is not resolved"
THIN_LAYER = "a layer near the surface is thinner than two elements of the contact"
NO_ERRORS = "the errors of the tractions are unknown, and the stress has at least these"
COARSE = 2.0  # coarsening factor of the tractions
# Ratio of the sections of finite elements that are compared, as for the scalars of the contact.
WIDER = 4.0
# Least radius of a stick zone, in widths of `NEAR` cells or rings. With 0.5 and 2.5 of them, at the
# centre of frictional pressing, the von Mises stress on elements errs by twice its stated error.
STICK = 4.0
# Least thickness of a layer in elements of the contact. Tractions of elements err at the edge by
# half an element. Below a stiff film of 1.5 elements the tension errs by 17 %, three times its
# stated error, and that of 2.2 elements by 6 %, within it.
THICKNESS = 2.0
# Factor of the rings of a solve in place of one on too few. Twice the rings take 16 times the time.
MORE_RINGS = 1.5
# Error over the difference from a solution of the radial solver with twice the points.
OF_FINER = 1 / (1 - COARSE ** (-BELIEVED * SMOOTH))
# Error over the difference of two fits of the edge, as if the wider one had half of the cells.
OF_ANOTHER_FIT = 1 / (COARSE ** (BELIEVED * ROOT) - 1)
# Error over the excess of a parabola through three depths, which omits terms of the third order.
OF_PARABOLA = 2.0
# Relative error of the stress at a fitted edge by the evaluation of its tractions: at most 1.2e-3
# in Hertz contacts with partial and gross slip on 24 to 96 cells per side.
EDGE_PRECISION = 1e-3


def largest_stresses(
    result: object,
    errors: StatedErrors | None,
    names: Collection[str],
    step: int | None = None,
    *,
    given: Scene | None = None,
) -> Mapping[str, tuple[float, StatedError | None]]:
    """Compute the largest stresses in the regions of the lower body at the end of a load step.

    Regions are the body, its layers and its interfaces. Returns values [force/length^2] and their
    error estimates by name; empty for a rigid body.

    result  result of any of the solvers
    errors  error estimates of the result; None to omit the errors of the stresses
    names   requested stresses as MEASURE@REGION, such as "max_principal@body"; an interface is
            named by its number, and the side with the larger value is returned
    step    load step, from 1; None for the last
    given   scene of the user, whose layers are the regions; None for those of the result
    """
    state = state_of_result(result, step, errors)  # type: ignore[arg-type]
    if given is not None:
        state = state.with_bodies_of(given)
    if not state.body.deforms:
        return {}
    field = body_response(state).stress()
    largest: dict[str, Extreme] = {}
    for each in sorted(extremes(field), key=lambda extreme: extreme.value):
        words = each.region.split()
        region = words[1] if words[0] == "interface" else each.region
        if (name := f"{each.measure}@{region}") in names:
            largest[name] = each
    stated: Sequence[StatedError | None] = [None] * len(largest)
    if errors is not None:
        stated = stress_errors(state, field, list(largest.values()))
    return {name: (largest[name].value, error) for name, error in zip(largest, stated, strict=True)}


def stress_at(
    state: LoadedBodies,
    x: Field,
    y: Field,
    levels: Sequence[Any],
    *,
    indenter: bool = False,
    error: bool = True,
) -> tuple[StressPoints, Field, str]:
    """Compute the stress at points in a body, with an error estimate at each point.

    Returns the points with their stress, and the largest error of the stress components at each
    point (n,) [force/length^2]. Unknown errors are not a number, and the third value is the reason.
    Raises UnsupportedScene for finite elements.

    Below shear that depends on the rings of the radial solver, the error by the rings is added. Its
    components scatter alike, so that the sum of their squares estimates the largest one.

    state     bodies and surface tractions
    x, y      coordinates of the points (n,) [length]
    levels    depth and material of each of the n points
    indenter  true for points in the indenter, false for points in the lower body
    error     false to omit the errors
    """
    response = body_response(state, indenter=indenter)
    here = response.stress_at(x, y, levels)
    unknown = np.full(len(x), np.nan)
    if not error:
        return here, unknown, ""
    others = [one.stress_at(x, y, levels) for one in response.compared()]
    apart = [np.max(np.abs(here.stress - other.stress), axis=0) for other in others]
    spread = np.sqrt(np.mean(np.square(apart), axis=0))
    near = here.depth < NEAR * _traction_cell_width(state)
    if not isinstance(response, OnDisc):
        per_spread = np.where(near, _error_per_spread(ROOT), _error_per_spread(SMOOTH))
        return here, per_spread * spread, ""
    rings = _below_other_rings(response, lambda one: one.stress_at(x, y, levels).stress)
    if isinstance(rings, str):
        return here, unknown, rings
    by_rings = _error_by_rings(here.stress, rings, np.where(near, ROOT, SMOOTH))
    return here, OF_FINER * spread + np.hypot.reduce(by_rings), ""


def stress_errors(
    state: LoadedBodies,
    field: StressField,
    found: Sequence[Extreme],
    *,
    indenter: bool = False,
    at_depths: bool = False,
) -> tuple[StatedError, ...]:
    """Estimate the errors of the largest stresses found in the stress field of a body.

    The largest stresses are compared with those below the pressure of the radial solver, if this
    solver has the same pressure and no shear acts. Otherwise the stress is computed again from
    coarse surface tractions, and the largest stresses are compared. The errors of the tractions by
    increments and by the points of a measured indenter are added: that of the shear as the change
    of the stress by more shear. Their error by the cells is not added, because it is far smaller
    than the effect of the coarse tractions on the stress.

    state      bodies and surface tractions of a contact result
    field      stress field of the body
    found      largest stress of each region and measure in this field
    indenter   true for the indenter, false for the lower body
    at_depths  true if `found` are largest stresses at chosen depths, not in whole regions
    """
    response = body_response(state, indenter=indenter)
    if state.pressed is not None:
        assert isinstance(response, OnDisc)
        return _stress_errors_on_disc(response, field.points, found, at_depths=at_depths)
    part = response.part
    errors: list[StatedError] = []
    known = None if at_depths else _reference_maxima(state, found, indenter)
    if known is not None:
        pressing = replace(state, by_increments=None)
        for extreme in found:
            # A largest stress that the reference lacks decays to zero outside.
            exact = known.get((extreme.region, extreme.measure), 0.0)
            size = abs(extreme.value - exact) + REFERENCE_PRECISION * abs(exact)
            errors.append(_stated(pressing, extreme.value, {part: size}, None))
        return tuple(errors)
    depths = np.unique(field.points.depth).tolist()
    sampled = depths[::2] if len(depths) > 2 else depths
    near = NEAR * _traction_cell_width(state)
    reach = _reach_of_edge(state, near)
    here = _largest_by_place(field, near, reach)
    compared = response.compared()
    there = [_largest_by_place(coarse.stress(sampled), near, reach) for coarse in compared]
    more = there[0]
    if state.shear_error:
        changed = compared[0].with_more_shear(state.shear_error)
        more = _largest_by_place(changed.stress(sampled), near, reach)
    wider = response.on_wider_section(WIDER)
    on_wider = wider and _largest_by_place(wider.stress(sampled), near, reach)
    # The largest stress adjacent to a fitted contact edge converges with a higher order.
    fitted = bool(field.how.get("edges")) if field.edge is None else field.edge.determined
    infinite = state.scene is not None and is_singular(state.scene.indenter)
    measures = field.points.measures
    thin = _has_thin_layer(response)
    for extreme in found:
        largest = 0.0
        by_shear = 0.0
        by_section = 0.0
        unresolved = False
        key = extreme.region, extreme.measure
        if on_wider:
            apart = [abs(on_wider[at].get(key, 0.0) - there[0][at].get(key, 0.0)) for at in here]
            by_section = max(apart) / (1 - WIDER ** (-BELIEVED * (1 if state.of_strips else 2)))
        tension = extreme.measure == LARGEST_TENSION
        shallow = extreme.on_edge or (extreme.depth < near and abs(extreme.x) <= reach)
        for at_edge, values in here.items():
            value = values.get(key)
            if value is None or (at_edge and not (shallow or tension)):
                continue
            order = SMOOTH if not at_edge else EDGE if fitted else ROOT
            others = [each[at_edge].get(key, 0.0) for each in there]
            change = abs(more[at_edge].get(key, 0.0) - others[0])
            by_shear = max(by_shear, value + change - extreme.value)
            spread = sqrt(np.mean([(value - other) ** 2 for other in others]))
            error = _error_per_spread(order) * spread
            if not shallow:
                excess, _ = excess_between_depths(field.points, measures[extreme.measure], extreme)
                error += OF_PARABOLA * excess
            if at_edge and field.edge is not None and extreme.region in AT_SURFACE:
                error = max(error, OF_ANOTHER_FIT * field.edge.apart) + EDGE_PRECISION * abs(value)
            if at_edge and tension and not fitted:
                cells = max((state.contact_radius or 0.0) / _traction_cell_width(state), 2.0)
                error = max(error, value / (sqrt(cells) - 1))
                unresolved = value + error > extreme.value
            largest = max(largest, value + error - extreme.value)
        doubts = (
            (extreme.at_window_edge, AT_WINDOW_EDGE),
            (unresolved, UNRESOLVED),
            (infinite and shallow and not tension, INFINITE),
            (thin, THIN_LAYER),
            (_has_small_stick(state, extreme, near), SMALL_STICK),
        )
        reason = next((why for doubtful, why in doubts if doubtful), None)
        sizes: dict[Part, float] = {part: largest, "increments": by_shear, "section": by_section}
        errors.append(_stated(state, extreme.value, sizes, reason))
    return tuple(errors)


def _reference_maxima(
    state: LoadedBodies, found: Sequence[Extreme], indenter: bool
) -> Mapping[Key, float] | None:
    """Find the largest stresses of a body by the radial solver, by region and measure.

    The result is None with shear, with infinite pressure, with a bulk strain that is not equal in
    all directions, and if the pressure is not that of a body of revolution that is pressed without
    friction.

    state     bodies and surface tractions of another solver
    found     largest stresses of this solver
    indenter  true for the indenter, false for the lower body
    """
    scene = state.scene
    if scene is None or is_sheared(state) or is_singular(scene.indenter):
        return None
    alone = pressing_alone(scene)
    if alone is None or not scene.indenter.is_of_revolution:
        return None
    load = alone.loading[state.step - 1].model_copy(update={"bulk_strain": state.strain})
    measures = {extreme.measure for extreme in found}
    try:
        result = radial.solve(alone.model_copy(update={"loading": (load,)}))
        known = state_of_result(result, None)
        # The solver merges layers of equal constants; the measures of their interfaces are kept.
        known = replace(known, body=state.body, indenter=state.indenter)
        field = OnDisc(known, indenter, measures=measures).stress()
    except (SolverError, NoSuchState):
        return None
    return {(e.region, e.measure): e.value for e in extremes(field)}


def _stated(
    state: LoadedBodies,
    value: float,
    sizes: Mapping[Part, float],
    reason: str | None,
) -> StatedError:
    """Build the stated error of a stress, with the parts that the errors of the tractions cause.

    sizes   parts of the error: the first by cells, elements or points, others by the error of the
            shear and by the end of a section of finite elements [force/length^2]
    reason  reason why the error is unreliable, or None
    """
    parts = dict(sizes)
    round_off = PRECISION * _largest_traction(state)
    parts[next(iter(sizes))] += round_off
    shares: dict[Part, float | None] = {"increments": state.by_increments, "map": state.by_map}
    for cause, share in shares.items():
        parts[cause] = parts.get(cause, 0.0) + (share or 0.0) * abs(value)
    if None in (state.by_increments, state.shear_error) and is_sheared(state):
        reason = reason or NO_ERRORS
    small = sum(parts.values()) <= LARGEST_SHARE * abs(value) or abs(value) <= round_off
    known = {cause: np.array([size]) for cause, size in parts.items() if size}
    return build_stated_error(known, reason or (None if small else TOO_LARGE))


def _has_thin_layer(response: BodyResponse) -> bool:
    """Return True if the elements of a contact do not resolve a layer of the body near the surface.

    Adjacent layers of equal constants are one layer.
    """
    state = response.state
    if state.discretisation is None or state.scene is None:
        return False
    from fem_reference.compliance.gauss_points import POINTS_PER_EDGE

    radii = state.axes[state.radial]
    least = THICKNESS * float(radii[POINTS_PER_EDGE if radii[0] else 1] - radii[0])
    top = 0.0
    for layer in (state.scene.indenter if response.indenter else state.scene.body).layers:
        if top < least and layer.thickness < least:
            return True
        top += layer.thickness
    return False


def _has_small_stick(state: LoadedBodies, extreme: Extreme, near: float) -> bool:
    """Return True if a stress lies within `near` of the centre of an unresolved stick zone."""
    # Shear to the axis, or around it, reaches the friction limit at the radius of the stick zone.
    if max(extreme.depth, hypot(extreme.x, extreme.y)) >= near or not state.shear_turns:
        return False
    return (state.stick_radius or 0.0) < STICK * near


def _largest_traction(state: LoadedBodies) -> float:
    """Return the largest finite traction [force/length^2]: a stress is a sum of such terms."""
    sizes = np.concatenate([np.abs(one).ravel() for one in state.tractions.values()])
    return float(np.max(sizes, where=np.isfinite(sizes), initial=0.0))


def _reach_of_edge(state: LoadedBodies, near: float) -> float:
    """Return the distance along x beyond which the edge of a line contact has no effect on the
    order of the stress [length]; infinite for other contacts."""
    pressure = state.tractions["pressure"]
    across = state.radial if state.on_rings else "x"
    if not state.of_strips and (state.on_rings or pressure.shape[1:] != (1,)):
        return inf
    return float(np.max(np.abs(state.axes[across][pressure.ravel() > 0]))) + near


def _largest_by_place(
    field: StressField, near: float, reach: float
) -> Mapping[bool, Mapping[Key, float]]:
    """Find the largest stresses near the edge of the contact (True) and elsewhere (False).

    The two places have different convergence orders. There is one value for each region of the body
    and each stress measure, and none at a place without points, such as near the surface for chosen
    depths below. Points near the edge include the fitted contact edge.

    near   depth up to which a point is near the edge [length]
    reach  distance along x up to which a point is near the edge [length]
    """
    found = {}
    shallow = (field.points.depth < near) & (np.abs(field.points.x) <= reach)
    for at_edge, chosen in ((True, shallow), (False, ~shallow)):
        points, edge = field.points.select(chosen), field.edge if at_edge else None
        if edge is not None and not points.x.size:
            points, edge = edge.points, None
        each = extremes(replace(field, points=points, edge=edge)) if points.x.size else ()
        found[at_edge] = {(e.region, e.measure): e.value for e in each}
    return found


def _error_per_spread(order: float) -> float:
    """Return the larger of two errors over the difference from coarse tractions, r = 2, order p:
    3/√(r^(2p) + 1) if errors scatter, 1/(r^p - 1) if they decrease as a power."""
    scattered = SPREADS / sqrt(COARSE ** (2 * order) + 1)
    return float(max(scattered, 1 / (COARSE**order - 1)))


def _traction_cell_width(state: LoadedBodies) -> float:
    """Compute the width of cells along x, or the mean width of a ring [length]."""
    places = next(iter(state.axes.values()))
    return float(places[-1] - places[0]) / (len(places) - 1)


def _stress_errors_on_disc(
    response: OnDisc, points: StressPoints, found: Sequence[Extreme], *, at_depths: bool
) -> tuple[StatedError, ...]:
    """Estimate the errors of the largest stresses below the tractions of the radial solver.

    The stresses at the same places are computed again with twice the numbers of Legendre orders and
    quadrature points. The differences yield the errors, with the excess of a maximum between the
    depths of the points. If the tractions depend on the number of rings, the stresses below the
    tractions of two solves with fewer rings are compared as well. The place of a largest stress
    near the surface moves with the edge of the contact.

    response   body below the tractions of the radial solver
    points     points of the stress field
    found      largest stress of each region and measure among these points
    at_depths  true if `found` are largest stresses at chosen depths
    """
    from semi_analytical.frf.depth import Level

    state = response.state
    state = state if is_sheared(state) else replace(state, by_increments=0.0)
    near = NEAR * _traction_cell_width(state)
    measures, levels = points.measures, []
    for e in found:
        here = (points.depth == e.depth) & (measures[e.measure] == e.value)
        levels.append(Level(e.depth, int(points.material[np.argmax(here)])))
    on_points = state.ring_fineness is not None and is_sheared(state)
    moves = [on_points and not at_depths and e.depth < near for e in found]
    x, y = np.array([(e.x, e.y) for e in found]).T
    (finer,) = response.compared()
    try:
        same = more = finer.stress_at(x, y, levels).measures
        again = finer.values_near(found, levels, moves)
        if state.shear_error:
            more = finer.with_more_shear(state.shear_error).stress_at(x, y, levels).measures
    except UnsupportedScene:  # the finer fit has no edge: the errors are unknown
        return (unknown_error("the finer fit has no edge"),) * len(found)
    others = _below_other_rings(
        response, lambda one: np.array(one.values_near(found, levels, moves))
    )
    if isinstance(others, str):
        return (unknown_error(others),) * len(found)
    values = np.array([e.value for e in found])
    excess = np.array([excess_between_depths(points, measures[e.measure], e)[0] for e in found])
    sizes = OF_FINER * np.abs(again - values) + OF_PARABOLA * excess
    sizes += _error_by_rings(values, others, np.where(moves, EDGE, SMOOTH))
    errors = []
    for k, e in enumerate(found):
        # The largest stress of a region may be another one of its maxima.
        size = max(
            float(other.value + error - e.value)
            for other, error in zip(found, sizes, strict=True)
            if other.measure == e.measure and response.contains(e.region, other.region)
        )
        by_shear = abs(more[e.measure][k] - same[e.measure][k])
        doubts = (
            (e.at_window_edge, AT_WINDOW_EDGE),
            (_has_small_stick(state, e, near), SMALL_STICK),
        )
        reason = next((why for doubtful, why in doubts if doubtful), None)
        parts: dict[Part, float] = {response.part: size, "increments": by_shear}
        errors.append(_stated(state, e.value, parts, reason))
    return tuple(errors)


def _below_other_rings(
    response: OnDisc, evaluate: Callable[[OnDisc], NDArray[np.float64]]
) -> list[tuple[float, Field]] | str:
    """Evaluate a body below the tractions of two solves with other numbers of rings.

    These have half and two thirds of the rings, or half more of them in place of a solve whose
    rings do not determine the edge of the contact.

    Returns the ratio of the rings with the value for each solve, and none if the tractions do not
    depend on the number of rings. The result is a reason if no value is known.

    response  body below the tractions of the radial solver
    evaluate  function of the body below other tractions, such as its stress at points
    """
    state = response.state
    if state.scene is None or not is_sheared(state):
        return []
    scene = state.scene.model_copy(update={"contact_stiffness": False})
    run = state.ring_fineness
    solver = RingSolver(scene, RadialDiscretisation())
    if not solver.depends_on_rings:
        return []
    if run is None:
        return "the run does not state its number of rings: run the scene again"
    others: list[tuple[float, Field]] = []
    reason = ""
    for share in (*(share for _, share, _ in solver.shares), MORE_RINGS):
        if len(others) == len(solver.shares):
            break
        try:
            history = _solve_on_rings(solver, replace(run, space=share * run.space))
            if isinstance(history, SolverError):
                raise history
            coarse = state_of_increment(history, state.step, state.increment)
            coarse = replace(coarse, strain=state.strain, body=state.body, indenter=state.indenter)
            others.append((1 / share, evaluate(replace(response, state=coarse))))
        except (SolverError, NoSuchState) as error:
            reason = f"with other numbers of rings, {error}"
    return others or reason


@lru_cache(maxsize=3)
def _solve_on_rings(solver: RingSolver, fineness: Fineness) -> radial.Result | SolverError:
    """Solve the whole history, because rings are laid over its largest contact."""
    try:
        return solver.solve(fineness)
    except SolverError as error:
        return error


def _error_by_rings(value: Field, others: Sequence[tuple[float, Field]], order: Field) -> Field:
    """Estimate errors of the given convergence orders from the ratio of rings and the
    values of other solves; 0 without other solves."""
    if not others:
        return np.zeros_like(value)
    spreads = [(value - other) ** 2 / (ratio ** (2 * order) + 1) for ratio, other in others]
    return SPREADS * np.sqrt(np.mean(spreads, axis=0))
