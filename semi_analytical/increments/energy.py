"""The first law over an increment: work put in, stored, dissipated, and what the increment leaves.

The displacements u follow from the tractions t = (q, p) by a symmetric operator (Betti), so the
elastic energy E = ½ Σ t·u Δ changes from state 0 to state 1 by ½ Σ (t₀ + t₁)·(u₁ - u₀) Δ: exactly,
however large the increment is. With u_z = g + rigid motion and u = s + rigid motion (CONVENTIONS),
and with p g = 0, it follows that

    input work = ΔE + dissipation + unresolved work
    input work      Σ ½ (f₀ + f₁)(ω₁ - ω₀), forces and moments f over their conjugate motions ω
    dissipation     -Σ f·κ(s₁ - s₀) Δ, with f along q₁ and as large as ½ µ(p₀ + p₁), and κ the part
                    of the increment for which a cell touches
    unresolved work  ½ Σ (p₁ g₀ - p₀ g₁) Δ + Σ (κf - ½ (q₀ + q₁))·(s₁ - s₀) Δ

Where surfaces part in the increment they lose until then, f is along their way and ½|q₀|.

Friction while slipping is at its limit, which follows the pressure: hence the mean of both limits,
along the shear at the end, for which slip was solved. Where the pressure stays, or all grows in
proportion, that is exact; friction q₁ at the end would charge a first contact for twice its slip.

The unresolved work is the error of taking the loads (first sum, where gaps close or open) and the
shear (second sum) as straight lines over the increment. It vanishes with the increments; what
remains beside it measures how well the equations were solved.

Where the path matters, slip and the friction along it are known no better than to what they change
by in an increment: the dissipation is uncertain by

    Σ over increments of Σ |q₁ - q₀| κ|s₁ - s₀| Δ,

twice the half change of friction along all slip. Measured on first pressing, loops, unloading and
turning loads, 4 to 64 increments: the true error is .005 to .66 of that.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_scene.friction import sliding_friction


@dataclass(frozen=True)
class Configuration:
    """A state as its energy sees it; fields on the domain, but
    tangential ones without cells where no shear arises.

    pressure, normal_displacement       p and u_z (nx, ny)
    gap                                 g (nx, ny); not finite at most where p is always zero
    shear, tangential_displacement      q and u (2, nx, ny)
    friction_limit                      µp (nx, ny)
    slipped                             u less the rigid motion (2, nx, ny): it changes by the slip
    touching                            part κ of the increment before for which cells touch
    forces, motions                     f and ω in one order; motions None where undefined
    """

    pressure: Field
    normal_displacement: Field
    gap: Field
    shear: VectorField
    friction_limit: Field
    tangential_displacement: VectorField
    slipped: VectorField | None
    touching: Field
    forces: Vector
    motions: Vector | None

    @classmethod
    def at_rest(cls, gap: Field, after: Configuration) -> Configuration:
        """Before first touch: no load, no motion; with the fields of a state that comes after."""
        nothing, unsheared = np.zeros_like(gap), np.zeros_like(after.shear)
        return cls(
            pressure=nothing,
            normal_displacement=nothing,
            gap=gap,
            shear=unsheared,
            friction_limit=np.zeros_like(after.friction_limit),
            tangential_displacement=unsheared,
            slipped=unsheared,
            touching=np.zeros_like(after.touching),
            forces=np.zeros_like(after.forces),
            motions=np.zeros_like(after.forces),
        )


@dataclass(frozen=True)
class Energy:
    """Energies since the start of the history, where all are zero [force length].

    elastic     stored in both bodies
    input_work  trapezoidal sum of the forces and moments; None once a motion is undefined (at the
                friction limit under force control), as are the three that follow
    dissipated  by slip
    unresolved  what finite increments leave open
    uncertain   by how much finite increments leave `dissipated` uncertain
    largest     largest magnitude that any of them has had: the scale of the balance
    """

    elastic: float = 0.0
    input_work: float | None = 0.0
    dissipated: float | None = 0.0
    unresolved: float | None = 0.0
    uncertain: float | None = 0.0
    largest: float = 0.0

    @property
    def transferred(self) -> float | None:
        """Energy stored and dissipated [force length]."""
        return None if self.dissipated is None else self.elastic + self.dissipated

    @property
    def left_open(self) -> float | None:
        """Trapezoidal sum of the loads minus the energy stored and dissipated [force length]."""
        if self.input_work is None or self.transferred is None:
            return None
        return self.input_work - self.transferred

    def imbalance(self, before: Energy) -> float | None:
        """What is missing of the balance since `before`, over the largest energy so far [1]."""
        terms = self._terms()
        if terms is None or self.largest == 0:
            return None if terms is None else 0.0
        work, elastic, dissipated, unresolved = terms - np.array(before._terms())
        return float(abs(work - elastic - dissipated - unresolved) / self.largest)

    def _terms(self) -> Vector | None:
        if self.input_work is None or self.dissipated is None or self.unresolved is None:
            return None
        return np.array([self.input_work, self.elastic, self.dissipated, self.unresolved])


NOTHING_YET = Energy()


def after_increment(
    spent: Energy,
    before: Configuration,
    after: Configuration,
    dissipated: float | None,
    cell_area: float,
    *,
    path_matters: bool,
) -> Energy:
    """The energies at the end of an increment.

    spent       those at its start
    dissipated  since the start of the history, None where undefined [force length]
    cell_area   of a cell and its images
    path_matters  whether the end depends on how finely the loading step is cut
    """
    elastic = elastic_energy(after, cell_area)
    work, worked, unresolved = _work(before, after), spent.input_work, spent.unresolved
    uncertain = spent.uncertain
    if (
        work is None or dissipated is None or worked is None or unresolved is None
        or uncertain is None
    ):  # fmt: skip
        return Energy(elastic, None, None, None, None, max(spent.largest, elastic))
    work += worked
    unresolved += unresolved_work(before, after, cell_area)
    if path_matters:
        uncertain += friction_changed(before, after, cell_area)
    sizes = (abs(term) for term in (elastic, work, dissipated, unresolved))
    return Energy(elastic, work, dissipated, unresolved, uncertain, max(spent.largest, *sizes))


def elastic_energy(state: Configuration, cell_area: float) -> float:
    """½ Σ (p u_z + q·u) Δ [force length]."""
    normal = float(np.sum(state.pressure * state.normal_displacement))
    tangential = float(np.sum(state.shear * state.tangential_displacement))
    return 0.5 * (normal + tangential) * cell_area


def unresolved_work(before: Configuration, after: Configuration, cell_area: float) -> float:
    """½ Σ (p₁ g₀ - p₀ g₁) Δ + Σ (κf - ½ (q₀ + q₁))·(s₁ - s₀) Δ [force length].

    Only where contact begins or ends: a gap that is left in a lasting contact is no gap but a
    residual, and belongs to the imbalance.
    """
    assert before.slipped is not None
    assert after.slipped is not None
    p0, p1 = before.pressure, after.pressure
    begins, ends = (p0 == 0) & (p1 > 0), (p0 > 0) & (p1 == 0)
    closing = float(np.sum(p1[begins] * before.gap[begins]))
    opening = float(np.sum(p0[ends] * after.gap[ends]))
    return (0.5 * (closing - opening) + _unresolved_sliding(before, after)) * cell_area


def _unresolved_sliding(before: Configuration, after: Configuration) -> float:
    """Σ (κf - ½ (q₀ + q₁))·(s₁ - s₀)."""
    assert before.slipped is not None
    assert after.slipped is not None
    slipped = after.slipped - before.slipped
    if not np.any(slipped):
        return 0.0
    friction = sliding_friction(
        before.shear, after.shear, -slipped, before.friction_limit, after.friction_limit
    )
    missed = after.touching * friction - 0.5 * (before.shear + after.shear)
    return float(np.sum(missed * slipped))


def friction_changed(before: Configuration, after: Configuration, cell_area: float) -> float:
    """Σ |q₁ - q₀| κ|s₁ - s₀| Δ [force length]."""
    assert before.slipped is not None
    assert after.slipped is not None
    changed, slipped = after.shear - before.shear, after.slipped - before.slipped
    way = after.touching * np.hypot(*slipped)
    return float(np.sum(np.hypot(*changed) * way)) * cell_area


def _work(before: Configuration, after: Configuration) -> float | None:
    """Σ ½ (f₀ + f₁)(ω₁ - ω₀)."""
    if before.motions is None or after.motions is None:
        return None
    return float(np.sum(0.5 * (before.forces + after.forces) * (after.motions - before.motions)))
