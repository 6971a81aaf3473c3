"""Error of a scalar: from a reference, or from coarse solves by two formulas and three orders.

A scalar with an independent reference has the error |Q - Q_known|. Otherwise each discretisation
parameter (cells, increments, section, …) is coarsened separately, and an error is the sum of its
parts. Q is the scalar, r the coarsening factor of a parameter and p its theoretical order.

The edges of contact and stick zone lie at any position within cells, elements and rings, so that
the coefficient of h^p changes from level to level. Two errors c h^p and c' (r h)^p, with c and c'
of one spread, differ by √(r^(2p) + 1) times this spread. The part of the cells is therefore

    part = 3 √mean over the coarse solves of |Q - Q_coarse|² / (r^(2p) + 1)

With several coarse solves, a chance agreement of one of them with the run has little effect. A
coarse solve whose edge is not fitted, although that of the run is, has a larger error of another
order. It is left out if another one remains. On small grids, one of the solves is finer (r < 1).

All other parameters converge regularly (Richardson 1911), and so do slip amplitude and F1 that are
not fitted within the cells:

    part = max over the coarse solves of that part  |Q - Q_coarse| / |r^(b p) - 1|

Only the fraction b = 0.6 of the order is believed, which is a safety factor of 2.3 for p = 2 and
1.9 for p = 1 at r = 2. The 3 and the 0.6 are the only adjustable constants. No constant belongs to
a quantity or to a kind of scene.

Errors from coarse solves do not decrease along a load history: each part of an error is at least as
large as at the end of each earlier load step. Radius, area and centre of the stick zone are left
out, because a change of the load moves its edge to another place.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import exp, pi, sqrt
from types import MappingProxyType
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from contact_results.cycles import fretting_cycles
from contact_scene import LoadRamp, Scene
from contact_scene.body_pair import coupling, dundurs_beta
from contact_scene.contact_features import (
    AT_EDGES,
    CONTACT_EDGE,
    HIDDEN,
    PEAK,
    STICK_EDGE,
    Features,
)
from contact_scene.discretised import PER_TOLERANCE
from contact_scene.quantities.field_metadata import reported
from contact_scene.quantities.increment import SCALARS, State
from contact_scene.quantities.stated_error import (
    EXACT,
    Amount,
    CoarseSolveRecord,
    ErrorStatus,
    Part,
    StatedError,
    StatedErrors,
)
from contact_scene.quantities.summary import OF_CYCLES
from contact_scene.rig import Rig, prescribed_motions
from contact_scene.stepping.growing_contact import grows_without_slip
from contact_scene.stepping.load_path import ControlKind

Numbers = NDArray[np.float64]
# Scalars of a state by name: arrays of shape (1,), or (2,) for a vector; also its shear traction.
Values: TypeAlias = Mapping[str, Numbers]

# Parts of errors that the formula of the spread estimates.
BY_SPREAD = frozenset({"cells", "elements", "quadrature"})
# Largest values at the contact edge, whose errors fall regularly with the cells if they are not
# fitted within the cells: in nine drawn loops of torsion on 18 to 37 cells per radius the relative
# error of the slip amplitude is 0.16 to 0.21 over the width of the slip zone in cells.
REGULAR = frozenset({"slip_amplitude", "ruiz_f1"})
# Stated error over the spread of errors that coarse solves show. docs/spread_factor.py measures the
# coverage that follows.
SPREADS = 3.0
# Fraction of the convergence order that is believed of the other parts.
BELIEVED = 0.6
# Convergence orders of all scalars in the parameters other than the cells.
ORDERS: Mapping[str, float] = MappingProxyType(
    {
        **{"increments": 1.0, "section": 2.0, "penalty": 1.0, "harmonics": 2.0, "tolerance": 1.0},
        "map": 1.0,  # heights between points beside an edge of the surface
    }
)
# Relative error of a scalar by another method: tolerance of the radial solver for layers.
REFERENCE_PRECISION = 1e-9
# Largest ratio of error to scalar at which the error estimate counts as converged: a larger error
# leaves even the order of magnitude open.
LARGEST_SHARE = 1.0

# Width of a slip zone in cells below which no cell is taken to slip: fitted edges of stick zones
# are right to about a tenth of a cell.
NARROWEST = 0.1
# Energies that are lost to slip, and numbers of a load cycle.
LOST = frozenset({"dissipated_energy", *OF_CYCLES})
# Sizes of the stick zone, with the power of a length.
STICK_SIZES: Mapping[str, float] = MappingProxyType({"stick_radius": 1.0, "stick_area": 2.0})
STICK_CENTRE = "stick_centre"
# Name of the shear traction among the scalars of solves with different increments.
SHEAR = "shear"
# Reason why an error is not converged.
TOO_LARGE = "the error exceeds the number"

PHYSICAL = tuple(name for name, mark in reported(State).items() if mark.physical)


def values_of(result: Any) -> tuple[Values, ...]:
    """Collect the scalars of a contact result, such as forces, at the end of each load step.

    The result has one mapping per load step, from the name of a scalar to its value (1,), or (2,)
    for a vector. A load step that closes a load cycle includes the scalars of the cycle. Undefined
    scalars are absent.

    result  result of any of the solvers
    """
    closed = {
        cycle.cycle.end: {name: cycle.numbers.get(name) for name in OF_CYCLES}
        for cycle in fretting_cycles(result)
    }
    return tuple(
        {
            name: np.atleast_1d(np.asarray(value, dtype=float))
            for name, value in (
                {name: getattr(end, name) for name in PHYSICAL} | closed.get(end.step, {})
            ).items()
            if value is not None
        }
        for end in result.steps
    )


def prescribed_scalars(ramp: LoadRamp, rig: Rig | None) -> frozenset[str]:
    """Return the names of the scalars that a load step prescribes; their errors are zero.

    For example, a load step under force control prescribes the normal force. With a spring of a
    test rig, the prescribed displacement is that of the actuator.

    ramp  load step, with its prescribed force or displacement in each direction
    rig   springs of the test rig, or None
    """
    approach, shift = prescribed_motions(rig)
    controls = (
        (ramp.normal.kind, "normal_force", approach),
        (ramp.tangential.kind, "tangential_force", shift),
        (ramp.twisting.kind, "torque", "twist"),
        (ramp.tilting.kind, "moment", "tilt"),
    )
    by_force = ramp.tangential.kind is ControlKind.FORCE
    amplitude = "shift_amplitude" if shift == "tangential_shift" else "actuator_amplitude"
    return frozenset(
        {
            *("bulk_strain", "bulk_shear", "force_amplitude" if by_force else amplitude),
            *(force if kind is ControlKind.FORCE else motion for kind, force, motion in controls),
        }
    )


def characteristic_size(name: str, values: Values) -> float:
    """Compute a characteristic magnitude of a scalar at the end of a load step, in its unit.

    The tolerance of a solve causes an error relative to this magnitude, even if the scalar itself
    is nearly zero. The magnitude is a product of approach, normal force, contact radius and peak
    pressure that has the unit of the scalar, for example normal force times approach for an energy.
    It is 0 for units without such a product.

    name    name of the scalar
    values  all scalars at the end of a load step, by name
    """
    sizes = {key: float(np.max(np.abs(value))) for key, value in values.items()}
    force, radius = (sizes[key] for key in ("normal_force", "contact_radius"))
    length = sizes.get("approach", 0.0)
    by_unit = {
        "m": length,
        "m^2": sizes["contact_area"],
        "N": force,
        "N m": force * radius,
        "rad": length / radius if radius else 0.0,
        "Pa": sizes["peak_pressure"],
        "J": force * length,
        "N/m": force / length if length else 0.0,
    }
    return by_unit.get(SCALARS[name].unit, 0.0) if name in SCALARS else 0.0


@dataclass(frozen=True)
class Comparison:
    """Scalars of a finer and a coarser solve, to estimate the error that one parameter causes.

    The two solves of the scene differ in one discretisation parameter only, such as the cell size.

    part          name of the part of the error that the parameter causes, such as "cells"
    base, coarse  scalars of the finer and of the coarser solve at the end of each load step, by
                  name
    ratios        coarsening factor of the parameter at the end of each load step; 1 if the
                  parameter has no effect up to this step, 0 if `coarse` has no error by it
    features      sizes of contact, stick zone and layers in the cells of the coarser solve, at the
                  end of each load step; empty if the cells of both solves are equal
    """

    part: Part
    base: Sequence[Values]
    coarse: Sequence[Values]
    ratios: Sequence[float]
    features: Sequence[Features] = ()

    def part_of(
        self, step: int, name: str, order: float, *, regular: bool = False
    ) -> Numbers | None:
        """Estimate the error of a scalar that one discretisation parameter causes, by two solves.

        The estimate is 3 |fine - coarse| / √(r^(2p) + 1) for cells, elements and rings, and
        |fine - coarse| / |r^(b p) - 1| for other parameters and regular errors, with the coarsening
        factor r, the convergence order p and its believed fraction b. The result is None if the
        parameter has no effect up to the load step, or if one of the two solves lacks the scalar.

        step     load step at whose end the scalar is compared, from 0
        name     name of the scalar
        order    convergence order of the scalar in the cell size; the orders in other parameters
                 are those of `ORDERS`
        regular  true if the error by the cells falls regularly with them
        """
        here, there = self.base[step].get(name), self.coarse[step].get(name)
        ratio = self.ratios[step]
        if ratio == 1 or here is None or there is None:
            return None
        if self.part not in BY_SPREAD:
            order = ORDERS[self.part]
        elif not regular:
            return SPREADS * np.abs(here - there) / sqrt(ratio ** (2 * order) + 1)
        return np.abs(here - there) / abs(ratio ** (BELIEVED * order) - 1)

    def fits_edge(self, step: int, name: str, order: float) -> bool:
        """Return false if a radius or area has a lower order in the coarse solve than in the run.

        The edge is then fitted within the cells of the run, and not within those of the coarse
        solve. True for other scalars.

        step   load step, from 0
        name   name of the scalar
        order  convergence order of the scalar in the run
        """
        if not self.features or name not in CONTACT_EDGE | STICK_EDGE:
            return True
        return self.features[step].convergence_order(name) >= order


@dataclass(frozen=True)
class SolvedRun:
    """Scalars of a contact result and of its coarse solves, from which its errors are computed.

    scene        solved scene
    values       scalars of the result at the end of each load step, by name
    tolerance    relative residual of the contact equations at the end of each load step
    features     sizes of contact, stick zone and layers in cells at the end of each load step
    comparisons  pairs of solves that differ in one parameter, for all parameters
    required     for each part of the error, such as "increments": true for the load steps at which
                 the error of a scalar is unknown without this part
    neglected    relative error of scalars, by name, due to effects that the solver neglects
    part         name of the part of the error that cells, elements or rings cause
    references   scalars by other methods at the end of each load step, by name, one sequence for
                 each method; the error of these scalars is the difference
    """

    scene: Scene
    values: Sequence[Values]
    tolerance: Sequence[float]
    features: Sequence[Features]
    comparisons: Sequence[Comparison]
    required: Mapping[Part, Sequence[bool]]
    neglected: Mapping[str, float]
    part: Part = "cells"
    references: Sequence[Sequence[Values]] = ()

    def errors(self) -> Iterator[Mapping[str, StatedError]]:
        """Yield the error estimates of all scalars of the result, by name, for each load step.

        An estimate is the sum of parts by cells, increments, tolerance and other causes. Prescribed
        scalars have no error.
        """
        before: dict[str, dict[Part, Numbers]] = {}
        for step, ramp in enumerate(self.scene.load_path()):
            exact = prescribed_scalars(ramp, self.scene.rig)
            yield {
                name: EXACT if name in exact else self._estimate_error(step, name, before)
                for name in self.values[step]
            }

    @cached_property
    def shear_errors(self) -> tuple[float | None, ...]:
        """Relative error of the shear by the increments at the end of each load step.

        Shear by pressing, by strain or by earlier loads hardly changes any scalar. Its error is
        therefore that of the traction itself: the root mean square over the surface, relative to
        that of the shear. It is 0 without shear, and None if no coarse solve has a result.
        """
        found: list[float | None] = []
        for step, needs in enumerate(self.required["increments"]):
            error = self._parts(step, SHEAR).get("increments")
            if error is None:
                found.append(None if needs else 0.0)
                continue
            shear = next(
                one.base[step][SHEAR] for one in self.comparisons if SHEAR in one.base[step]
            )
            size = float(np.linalg.norm(shear))
            found.append(float(np.linalg.norm(error)) / size if size else 0.0)
        return tuple(found)

    def stated_errors(self, coarse: tuple[CoarseSolveRecord, ...]) -> StatedErrors:
        """Return the error estimates of all load steps with the records of the coarse solves."""
        return StatedErrors(tuple(self.errors()), coarse, self.shear_errors)

    def _estimate_error(
        self, step: int, name: str, before: dict[str, dict[Part, Numbers]]
    ) -> StatedError:
        """Compute the stated error of one scalar at the end of a load step, with its status.

        Without a required part, the error is unknown. Otherwise the status is "not converged" in
        two cases: the error is larger than the scalar, or the cells do not resolve the contact.

        step    load step, from 0
        name    name of the scalar
        before  parts of the errors at earlier load steps, by scalar and part; updated by this
                function
        """
        features, value = self.features[step], self.values[step][name]
        known = self._difference_from_references(step, name)
        if known is not None:
            by_map = self._parts(step, name).get("map")
            if "map" in self.required and by_map is None:
                return unknown_error("no solve with half of the points has a result")
            both = {self.part: known} | ({} if by_map is None else {"map": by_map})
            near = np.all(sum(both.values()) <= LARGEST_SHARE * np.abs(value))
            return build_stated_error(both, None if near else TOO_LARGE)
        apart = not np.any(self.values[step]["contact_area"])
        empty = name in STICK_EDGE and not np.any(self.values[step].get("stick_area", value))
        if not np.any(value) and (apart or empty):
            return EXACT if apart or features.slides else unknown_error(HIDDEN)
        largest = self._largest_so_far[step][name]
        parts = self._error_parts(step, name, largest)
        if isinstance(parts, str):
            return unknown_error(parts)
        floor = parts["tolerance"]
        if not np.any(value) and not np.any(sum(parts.values()) - floor):
            # Zero at every fineness: its cause is absent, or too small for a cell.
            hidden = name in AT_EDGES or (self._hides_slip[step] and name in LOST)
            if name == STICK_CENTRE:
                hidden = self._has_eccentric_stick[step] and (
                    features.annulus is not None or self._hides_slip[step]
                )
            return unknown_error(HIDDEN) if hidden else EXACT
        if name in STICK_SIZES and features.stick and self._hides_slip[step]:
            one_cell = STICK_SIZES[name] / features.stick * np.abs(value)
            parts[self.part] = np.maximum(parts.get(self.part, 0.0), one_cell)
        # The edge of the stick zone depends on the last change of the load, not on earlier edges.
        last = {} if name in STICK_EDGE else before.get(name, {})
        parts = {part: np.maximum(size, last.get(part, 0.0)) for part, size in parts.items()}
        before[name] = parts
        small = np.all(sum(parts.values()) <= LARGEST_SHARE * largest + parts["tolerance"])
        if np.all(largest <= floor) and np.all(sum(parts.values()) <= 2 * floor):
            # Zero within the tolerance at every fineness so far: no cell has to resolve its cause.
            return build_stated_error(parts, HIDDEN if name in AT_EDGES else None)
        by_spread = (one.ratios[step] for one in self.comparisons if one.part in BY_SPREAD)
        finest = min([1.0, *by_spread])
        reason = features.unresolved(name, finest) or (None if small else TOO_LARGE)
        if name == PEAK:
            reason = self._old_cusp(step, finest) or reason
        return build_stated_error(parts, reason)

    def _old_cusp(self, step: int, finest: float) -> str | None:
        """Return the reason if the peak still has an unresolved cusp of an earlier load step."""
        for earlier in range(self._start_of_pressure[step], step):
            if reason := self.features[earlier].unresolved(PEAK, finest):
                return f"since step {earlier + 1}, {reason}"
        return None

    def _difference_from_references(self, step: int, name: str) -> Numbers | None:
        """Return the largest difference of a scalar from other methods;
        None if they lack it or it is infinite."""
        if name == PEAK and self.features[step].infinite:
            return None
        here = self.values[step][name]
        sizes = [np.abs(here - of[step][name]) for of in self.references if name in of[step]]
        return np.max(sizes, axis=0) + REFERENCE_PRECISION * np.abs(here) if sizes else None

    @cached_property
    def _hides_slip(self) -> Sequence[bool]:
        """True for load steps at whose end no cell slips, although the edge of the contact does.

        The slip zone may then be smaller than a cell in all compared solves. The edge slips if
        shear acts or has acted, or friction acts on unlike bodies. It does not under loads that
        grow together, and below a rim of bodies without coupling, or if friction makes the annulus
        of slip at this rim narrow.
        """
        scene, shears, found = self.scene, False, []
        coupled = scene.friction is not None and coupling(scene)[0]
        smooth = scene.friction is not None and scene.indenter.rim is None
        at_rim = _annulus_of_pressing(scene) if coupled and not smooth else 0.0
        for ramp, features in zip(scene.load_path(), self.features, strict=True):
            loaded = any(ramp.tangential.end) or ramp.twisting.end or ramp.strains
            shears = shears or coupled or bool(loaded and not grows_without_slip(scene, ramp))
            narrow = features.annulus is None or features.annulus < NARROWEST
            slips = smooth or at_rim * features.contact > NARROWEST
            found.append(slips and shears and bool(features.stick) and narrow)
        return found

    @cached_property
    def _has_eccentric_stick(self) -> Sequence[bool]:
        """True for load steps at whose end the stick zone is not in the middle of the contact.

        A tangential load moves it away if bodies are coupled or strained. Its centre is then at 0
        only if all cells stick, or slip on both sides.
        """
        scene, pushes, strains, found = self.scene, False, False, []
        coupled = scene.friction is not None and coupling(scene)[0]
        for ramp in scene.load_path():
            pushes = pushes or any(ramp.tangential.end)
            strains = strains or ramp.strains
            found.append(pushes and bool(coupled or strains))
        return found

    @cached_property
    def _start_of_pressure(self) -> Sequence[int]:
        """Last load step, up to each load step, with another normal load or gross slip, which
        change the cusp of the pressure."""
        found: list[int] = []
        for step, ramp in enumerate(self.scene.load_path()):
            constant = found and ramp.normal.start == ramp.normal.end
            found.append(found[-1] if constant and not self.features[step].slides else step)
        return found

    @cached_property
    def _largest_so_far(self) -> Sequence[Values]:
        """Largest absolute values so far, the scale of errors: a scalar may pass through zero."""
        return largest_so_far(self.values)

    def _error_parts(self, step: int, name: str, largest: Numbers) -> dict[Part, Numbers] | str:
        """Compute the parts of the error of a scalar at the end of a load step, by their cause.

        Causes are the discretisation parameters (cells, increments), the tolerance and neglected
        effects. The result is the reason if a required part is unknown or the exact value is
        infinite.

        step     load step, from 0
        name     name of the scalar
        largest  largest absolute value of the scalar up to this load step
        """
        features = self.features[step]
        if name == PEAK and features.infinite:
            return "the exact value is infinite"
        parts = self._parts(step, name)
        for part, needs in self.required.items():
            if needs[step] and part not in parts:
                return f"no coarse solve for the part by {part} has a result"
        size = np.maximum(largest, characteristic_size(name, self.values[step]))
        parts["tolerance"] = PER_TOLERANCE * self.tolerance[step] * size
        if left := features.left.get(name):
            parts["tolerance"] += left * largest
        if share := self.neglected.get(name):
            parts["neglected"] = share * largest
        return parts

    def _parts(self, step: int, name: str) -> dict[Part, Numbers]:
        """Compute the parts of the error of a scalar that coarse solves measure, by their cause.

        step  load step, from 0
        name  name of the scalar
        """
        features = self.features[step]
        order = features.convergence_order(name)
        regular = name in REGULAR and not features.slip_fitted
        found: dict[Part, list[tuple[bool, Numbers]]] = {}
        for comparison in self.comparisons:
            size = comparison.part_of(step, name, order, regular=regular)
            if size is not None:
                found.setdefault(comparison.part, []).append(
                    (comparison.fits_edge(step, name, order), size)
                )
        bounds = features.least.get(name, 0.0), features.largest.get(name, np.inf)
        parts = {}
        for part, solves in found.items():
            sizes = [size for alike, size in solves if alike] or [size for _, size in solves]
            if part in BY_SPREAD and not regular:
                parts[part] = np.clip(np.sqrt(np.mean(np.square(sizes), axis=0)), *bounds)
            else:
                parts[part] = np.max(sizes, axis=0)
        return parts


def _annulus_of_pressing(scene: Scene) -> float:
    """Estimate the width of the annulus of slip below a pressed indenter, in contact radii."""
    beta, mu = dundurs_beta(scene), scene.friction.uniform if scene.friction else None
    if not beta or mu is None:  # layers, or another law of friction: any width
        return 1.0
    # If shear did not change the pressure, half-spaces would have a stick zone of the radius c with
    # (a/2c) ln((a+c)/(a-c)) = (µ/β) K'(c/a) (Spence 1973), where K' = π/2 at a narrow annulus. As
    # shear does, the annulus is wider: 1.4 times at c/a = 0.896.
    return min(1.0, 2 * exp(-pi * mu / abs(beta)))


def largest_so_far(values: Sequence[Values]) -> tuple[Values, ...]:
    """Compute the largest absolute value of each scalar up to the end of each load step.

    The maximum is over this and all earlier load steps. All components of a vector receive the
    value of the largest component. Relative errors refer to these values.

    values  scalars at the end of each load step, by name
    """
    found: list[Values] = [{}]
    for step in values:
        sizes = {name: np.full_like(x, np.max(np.abs(x))) for name, x in step.items()}
        seen = {name: np.maximum(x, found[-1].get(name, 0.0)) for name, x in sizes.items()}
        found.append({**found[-1], **seen})
    return tuple(found[1:])


def build_stated_error(parts: Mapping[Part, Numbers], reason: str | None) -> StatedError:
    """Build the error estimate of a scalar as the sum of its parts, with its status.

    parts   size of the error by cause, such as cells and increments, in the unit of the scalar
    reason  reason why the error is unreliable, an order of magnitude at best; None if it is
            reliable
    """
    status = ErrorStatus.NOT_CONVERGED if reason else ErrorStatus.ESTIMATED
    total = np.sum(list(parts.values()), axis=0)
    amounts = {part: _error_amount(size, len(total)) for part, size in parts.items()}
    error = _error_amount(total, len(total))
    return StatedError(error=error, parts=amounts, status=status, reason=reason)


def unknown_error(reason: str) -> StatedError:
    """Return the error estimate of a scalar without any, with the reason."""
    return StatedError(error=None, parts={}, status=ErrorStatus.NOT_CONVERGED, reason=reason)


def _error_amount(size: Numbers, count: int) -> Amount:
    parts = np.broadcast_to(size, count)
    return float(parts[0]) if count == 1 else (float(parts[0]), float(parts[1]))
