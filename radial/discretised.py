"""Radial solver with variable discretisation, for runs, error estimates and refinement.

The variable parameters are the increments, the tolerance, and the rings; without friction, the
Legendre orders and quadrature points.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import ceil, pi, sqrt
from typing import Any, ClassVar, Self

import numpy as np

from contact_scene import RadialDiscretisation
from contact_scene.contact_features import EDGE, SMOOTH, Features, is_singular
from contact_scene.discretised import (
    LINEAR,
    PRECISION,
    Discretisation,
    DiscretisedSolver,
    Fineness,
    Pairs,
    Refinement,
    Share,
    Work,
    slip_zone,
)
from contact_scene.quantities.stated_error import (
    Part,
)
from contact_scene.quantities.summary import ContactStatus
from radial.angular_grid import RingAngles
from radial.fields import Increment, Result
from radial.memory import estimated_bytes
from radial.plan import Plan, plan

FIRST_FINENESS = 0.5
MAX_FINENESS = 4.0
# Unknowns whose work equals the overhead of an operation. An increment of `coated_fretting` and of
# `fretting_loop` takes 7.5 and 8.5 ms at half the default numbers of rings and angles, 25 and 18 ms
# at the default and 550 and 130 ms at twice these numbers.
RING_OVERHEAD = 1.0
# Standard deviation of a position anywhere within an interval, over the length of the interval.
UNIFORM_SPREAD = 1 / sqrt(12)


@dataclass(frozen=True)
class RingSolver(DiscretisedSolver):
    """Radial solver of one scene, with variable numbers of rings, angles and increments.

    A single factor multiplies the default numbers of rings and angles. Without friction, it
    multiplies the numbers of Legendre orders and quadrature points instead.

    discretisation  settings of the scene file or of a result
    chosen_plan     plan of a solved result (modelled effects, increments); None for the plan made
                    of the scene
    """

    discretisation: RadialDiscretisation
    chosen_plan: Plan | None = None

    table: ClassVar[str] = "radial"
    settings: ClassVar[type[Discretisation]] = RadialDiscretisation
    part: ClassVar[Part] = "quadrature"
    cells: ClassVar[str] = "rings"
    most: ClassVar[float] = MAX_FINENESS
    # If half of the rings are too few to solve, two thirds may suffice.
    shares: ClassVar[Sequence[Share]] = (
        ("half the {}", 1 / 2, 0),
        ("two thirds of the {}", 2 / 3, 0),
    )

    @classmethod
    def of(cls, result: Result) -> Self:
        return cls(result.scene, result.fineness, result.plan)

    @property
    def plan(self) -> Plan:
        """Plan of a solve: modelled physical effects, and increments of each load step.

        The plan is that of the solved result, if there is one. Otherwise it is made from the scene.
        """
        return self.chosen_plan or plan(self.scene)

    @property
    def depends_on_rings(self) -> bool:
        """True if the accuracy of the radial solver depends on its number of rings.

        The accuracy of other solves, such as those without friction, depends on the numbers of
        Legendre orders and quadrature points instead.
        """
        return self.plan.coupled or self.plan.circle is not None

    def solve(self, fineness: Fineness, progress: Any = None, store: Any = None) -> Result:
        from radial.history import solve

        changed: dict[str, Any] = {"tolerance": fineness.tolerance}
        if not self.depends_on_rings:
            # The rings carry no unknowns, but slip amplitude and F1 are interpolated between them.
            share = fineness.space / self.plan.fineness
            changed["rings"] = ceil(share * self.discretisation.rings)
        discretisation = self.discretisation.model_copy(update=changed)
        return solve(self.scene, discretisation, progress, self._plan_of(fineness), store)

    def run(self, progress: Any = None, store: Any = None) -> Result:
        from radial.history import solve

        return solve(self.scene, self.discretisation, progress, self.run_plan, store)

    def run_fineness(self) -> Fineness:
        return Fineness(self.plan.fineness, self.plan.increments, self.discretisation.tolerance)

    def describe_space(self) -> Pairs:
        yield "rings", _rings_text(self.discretisation, self.plan)

    def describe_result(self, result: Result) -> Pairs:
        yield "rings", _rings_text(result.fineness, result.plan)

    def space_of(self, result: Result) -> float:
        return result.plan.fineness

    def coarser(self, result: Result, share: float, more: int) -> float:
        """Return the ring factor of a solve that is compared with a result, for its error estimate.

        The factor multiplies the default number of rings. If the accuracy depends on rings, the
        solve is coarser than the result. Otherwise the accuracy depends on Legendre orders and
        quadrature points, and the solve has twice their numbers.

        result  result whose errors are estimated
        share   fraction of the rings of the result
        more    without effect
        """
        return result.plan.fineness * (share if self.depends_on_rings else 2.0)

    @property
    def is_reference(self) -> bool:
        return not self.plan.circle

    def cell_sides(self, result: Result) -> tuple[float, ...]:
        return (1 / result.plan.fineness,)

    def unknowns(self, result: Result) -> int:
        """Count the tractions at points on rings, or the rings of a solve without these points."""
        angles = result.plan.angles
        return 3 * angles * len(result.steps[-1].radii) if angles else result.plan.rings

    def record_entry(self, space: float) -> Mapping[str, Any]:
        return {"ring_factor": space}

    def residuals(self, result: Result) -> Sequence[float]:
        return [max(step.worst_residual, PRECISION) for step in result.steps]

    def measure_features(self, result: Result, end: Increment) -> Features:
        """Measure the sizes of contact and stick zone in half rings at the end of a load step.

        The sizes determine if the rings resolve the contact. The contact radius is divided by the
        width of the widest ring, and stick zone and slip annulus by the mean width. Half rings are
        counted, because linear interpolation between rings resolves a feature as well as two cells
        per ring. If the accuracy does not depend on the rings, the contact counts as infinitely
        resolved.

        result  result of the radial solver
        end     state at the end of the load step
        """
        indenter, plan = self.scene.indenter, result.plan
        within = end.radii[end.radii <= end.contact_radius]
        widest = float(np.max(np.diff([0.0, *within, end.contact_radius])))
        side = end.contact_radius / len(within)
        stick, annulus = slip_zone(end, LINEAR / side) if self.depends_on_rings else (None, None)
        # Values at rings are biased, so that all scalars converge with the first order.
        biased = self.depends_on_rings and (plan.circle is None or indenter.rim is not None)
        return Features(
            contact=LINEAR * end.contact_radius / widest if self.depends_on_rings else np.inf,
            stick=stick,
            annulus=annulus,
            fitted=not plan.circle,
            stick_fitted=not plan.circle,
            largest_order=EDGE if biased else SMOOTH,
            infinite=is_singular(indenter),
            cusp=plan.coupled,
            slides=end.status is ContactStatus.GROSS_SLIDING,
            least=_spread_between_rings(end) if plan.circle else {},
        )

    def first_space(self) -> float:
        return FIRST_FINENESS if self.depends_on_rings else 1.0

    def refine_space(self, space: float, by: Refinement) -> float:
        rings = by.get(self.part, 1.0) * space
        return rings if self.depends_on_rings else float(np.ceil(rings))

    def work(self, fineness: Fineness) -> Work:
        return Work(fineness.space**4, sum(fineness.increments), RING_OVERHEAD)

    def memory(self, fineness: Fineness) -> int:
        return estimated_bytes(self.scene, self._plan_of(fineness))

    def _plan_of(self, fineness: Fineness) -> Plan:
        return replace(self.plan, fineness=fineness.space, increments=fineness.increments)


def _spread_between_rings(end: Increment) -> Mapping[str, float]:
    """Return the spread of radius and area of a contact whose edge lies between two rings."""
    # The fit sets no edge beyond the first ring without pressure: solves with a ring at the same
    # edge do not show this spread.
    at = min(int(np.searchsorted(end.radii, end.contact_radius, side="right")), len(end.radii) - 1)
    spread = UNIFORM_SPREAD * float(end.radii[at] - end.radii[at - 1])
    return {"contact_radius": spread, "contact_area": 2 * pi * end.contact_radius * spread}


def _rings_text(fineness: RadialDiscretisation, plan: Plan) -> str:
    """Return the text of rings and angles; without friction, rings are only points of output."""
    if plan.circle:
        angles = "" if plan.circle is RingAngles.ONE else f", times {plan.angles} angles"
        return f"{plan.rings} over the contact, denser at its edge{angles}"
    return f"{fineness.rings} over the largest contact, for output only"
