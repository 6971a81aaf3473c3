"""The first law over an increment: work put in, stored, dissipated, and what the increment leaves.

The displacements u follow from the tractions t = (q, p) by a symmetric operator (Betti), so the
elastic energy E = ½ Σ t·u Δ changes from state 0 to state 1 by ½ Σ (t₀ + t₁)·(u₁ - u₀) Δ: exactly,
however large the increment is. With u_z = g + rigid motion and u = s + rigid motion (CONVENTIONS),
and with p g = 0, it follows that

    input work = ΔE + dissipation + unresolved work
    input work      Σ ½ (f₀ + f₁)(ω₁ - ω₀), forces and moments f over their conjugate motions ω
    dissipation     -Σ q₁·(s₁ - s₀) Δ, by the friction at the end, which is how slip was solved for
    unresolved work  ½ Σ (p₁ g₀ - p₀ g₁) Δ + ½ Σ (q₁ - q₀)·(s₁ - s₀) Δ

The unresolved work is the error of taking the loads (first sum, where gaps close or open) and the
friction (second sum) as straight lines or constants over the increment. It vanishes with the
increments; what remains beside it measures how well the equations were solved.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
VectorField = NDArray[np.float64]
Vector = NDArray[np.float64]


@dataclass(frozen=True)
class Configuration:
    """A state as its energy sees it; fields on the whole window.

    pressure, normal_displacement       p and u_z (nx, ny)
    gap                                 g (nx, ny); not finite at most where p is always zero
    shear, tangential_displacement      q and u (2, nx, ny)
    slipped                             u less the rigid motion (2, nx, ny): it changes by the slip
    forces, motions                     f and ω in one order; motions None where undefined
    """

    pressure: Field
    normal_displacement: Field
    gap: Field
    shear: VectorField
    tangential_displacement: VectorField
    slipped: VectorField | None
    forces: Vector
    motions: Vector | None

    @classmethod
    def at_rest(cls, gap: Field, pairs: int) -> Configuration:
        """Before first touch: no load, no motion.

        pairs  how many conjugate pairs of force and motion there are
        """
        nothing = np.zeros((2, *gap.shape))
        return cls(
            pressure=nothing[0],
            normal_displacement=nothing[0],
            gap=gap,
            shear=nothing,
            tangential_displacement=nothing,
            slipped=nothing,
            forces=np.zeros(pairs),
            motions=np.zeros(pairs),
        )


@dataclass(frozen=True)
class Energy:
    """Energies since the start of the history, where all are zero [force length].

    elastic     stored in both bodies
    input_work  of the forces and moments; None once a motion is undefined (at the friction limit
                under force control), as are the two that follow
    dissipated  by slip
    unresolved  what finite increments leave open
    largest     largest magnitude that any of them has had: the scale of the balance
    """

    elastic: float = 0.0
    input_work: float | None = 0.0
    dissipated: float | None = 0.0
    unresolved: float | None = 0.0
    largest: float = 0.0

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
) -> Energy:
    """The energies at the end of an increment.

    spent       those at its start
    dissipated  since the start of the history, None where undefined [force length]
    """
    elastic = elastic_energy(after, cell_area)
    work = _work(before, after)
    if spent.input_work is None or spent.unresolved is None or work is None or dissipated is None:
        return Energy(elastic, None, None, None, max(spent.largest, elastic))
    unresolved = spent.unresolved + unresolved_work(before, after, cell_area)
    work += spent.input_work
    sizes = (abs(term) for term in (elastic, work, dissipated, unresolved))
    return Energy(elastic, work, dissipated, unresolved, max(spent.largest, *sizes))


def elastic_energy(state: Configuration, cell_area: float) -> float:
    """½ Σ (p u_z + q·u) Δ [force length]."""
    normal = float(np.sum(state.pressure * state.normal_displacement))
    tangential = float(np.sum(state.shear * state.tangential_displacement))
    return 0.5 * (normal + tangential) * cell_area


def unresolved_work(before: Configuration, after: Configuration, cell_area: float) -> float:
    """½ Σ (p₁ g₀ - p₀ g₁) Δ + ½ Σ (q₁ - q₀)·(s₁ - s₀) Δ [force length].

    Only where contact begins or ends: a gap that is left in a lasting contact is no gap but a
    residual, and belongs to the imbalance.
    """
    assert before.slipped is not None
    assert after.slipped is not None
    p0, p1 = before.pressure, after.pressure
    begins, ends = (p0 == 0) & (p1 > 0), (p0 > 0) & (p1 == 0)
    closing = float(np.sum(p1[begins] * before.gap[begins]))
    opening = float(np.sum(p0[ends] * after.gap[ends]))
    turning = np.sum((after.shear - before.shear) * (after.slipped - before.slipped))
    return 0.5 * (closing - opening + float(turning)) * cell_area


def _work(before: Configuration, after: Configuration) -> float | None:
    """Σ ½ (f₀ + f₁)(ω₁ - ω₀)."""
    if before.motions is None or after.motions is None:
        return None
    return float(np.sum(0.5 * (before.forces + after.forces) * (after.motions - before.motions)))
