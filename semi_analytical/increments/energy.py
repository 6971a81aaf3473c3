"""Energy balance (first law) of one increment.

The displacements u follow from the tractions t = (q, p) by a symmetric operator (Betti's theorem).
Therefore the elastic energy E = ½ Σ t·u Δ changes from state 0 to state 1 by exactly ½ Σ (t₀ +
t₁)·(u₁ - u₀) Δ, for increments of any size. With u_z = g + rigid motion, u = s + rigid motion
(CONVENTIONS) and p g = 0,

    input work = ΔE + dissipation + unresolved work
    input work       Σ ½ (f₀ + f₁)(ω₁ - ω₀), forces and moments f, conjugate motions ω
    dissipation      -Σ f·κ(s₁ - s₀) Δ, with the mean friction f and the contact fraction κ
    unresolved work  ½ Σ (p₁ g₀ - p₀ g₁) Δ + Σ (κf·(s₁ - s₀) - ½ (q₀ + q₁)·(s₁ - s₀ + d)) Δ

The mean friction f has the direction of q₁, for which the slip was solved, and the magnitude ½ µ(p₀
+ p₁), the mean of both friction limits. This is exact for constant pressure and for proportional
growth; f = q₁ would charge a first contact with twice its slip. In cells that separate in the
increment f has the direction of the slip and the magnitude ½|q₀|.

The unresolved work is the error of linear interpolation over the increment: of the pressure where
gaps close or open (first sum) and of the shear (second sum). It vanishes with the size of the
increments. The remaining imbalance measures the error of the solution of the equations.

Where the state depends on the load path, slip and friction are known to within their change over an
increment. The uncertainty of the dissipation is

    Σ over increments of Σ |q₁ - q₀| κ|s₁ - s₀| Δ,

twice the dissipation by half the change of friction. In first loading, load cycles, unloading and
loads of changing direction with 4 to 64 increments, the measured error is 0.005 to 0.66 of that.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_scene.friction import sliding_friction


@dataclass(frozen=True)
class Configuration:
    """Tractions, displacements and loads of one converged state, as needed by the energy balance.

    Fields are on the reduced domain. Without shear the tangential fields have no cells.

    pressure, normal_displacement   p [force/length^2] and u_z [length], each (nx, ny)
    gap                             gap g (nx, ny) [length]; may be infinite where p is always zero
    shear, tangential_displacement  q [force/length^2] and u [length], each (2, nx, ny)
    friction_limit                  µp (nx, ny) [force/length^2]
    slipped                         u less the rigid motion (2, nx, ny) [length]; its change is the
                                    slip plus the free motion; zero where the motion is undefined
    free                            free motion d in the increment ending here of cells before their
                                    contact (2, nx, ny) [length]
    contact_fraction                fraction κ of the increment ending here during which each cell
                                    is in contact (nx, ny)
    forces, motions                 forces and moments f on the indenter, and its conjugate rigid
                                    motions ω, in one order; motions None where undefined
    """

    pressure: Field
    normal_displacement: Field
    gap: Field
    shear: VectorField
    friction_limit: Field
    tangential_displacement: VectorField
    slipped: VectorField
    free: VectorField
    contact_fraction: Field
    forces: Vector
    motions: Vector | None

    @classmethod
    def unloaded(cls, gap: Field, after: Configuration) -> Configuration:
        """Return the configuration of the bodies before first contact, with zero tractions.

        gap    undeformed gap (nx, ny) [length]
        after  configuration of the first increment, which determines the shapes of the fields
        """
        nothing, unsheared = np.zeros_like(gap), np.zeros_like(after.shear)
        return cls(
            pressure=nothing,
            normal_displacement=nothing,
            gap=gap,
            shear=unsheared,
            friction_limit=np.zeros_like(after.friction_limit),
            tangential_displacement=unsheared,
            slipped=unsheared,
            free=unsheared,
            contact_fraction=np.zeros_like(after.contact_fraction),
            forces=np.zeros_like(after.forces),
            motions=np.zeros_like(after.forces),
        )


@dataclass(frozen=True)
class Energy:
    """Energies of a contact since the start of the load history, where all are zero [force length].

    elastic     energy stored in both bodies
    input_work  trapezoidal sum of the work of forces and moments; None from the first undefined
                motion on (friction limit under force control), as are the next three energies
    dissipated  energy lost to friction by slip
    unresolved  unresolved work of finite increments
    uncertain   uncertainty of `dissipated` due to finite increments
    largest     largest magnitude of any energy so far: the scale of the balance
    """

    elastic: float = 0.0
    input_work: float | None = 0.0
    dissipated: float | None = 0.0
    unresolved: float | None = 0.0
    uncertain: float | None = 0.0
    largest: float = 0.0

    @property
    def stored_and_dissipated(self) -> float | None:
        """Elastic energy plus energy lost to friction [force length]; None where undefined."""
        return None if self.dissipated is None else self.elastic + self.dissipated

    @property
    def left_open(self) -> float | None:
        """Input work minus the energy stored and dissipated [force length]; None if undefined.

        This difference is the sum of the unresolved work of finite increments and the error of the
        solution.
        """
        if self.input_work is None or self.stored_and_dissipated is None:
            return None
        return self.input_work - self.stored_and_dissipated

    def imbalance(self, before: Energy) -> float | None:
        """Compute the relative residual of the energy balance (first law) of one increment [1].

        The residual is input work minus the changes of elastic, dissipated and unresolved energy.
        The scale is the largest energy so far. The result is None where the rigid motion of the
        indenter is undefined.

        before  energies at the start of the increment
        """
        terms = self._balance_terms()
        if terms is None or self.largest == 0:
            return None if terms is None else 0.0
        work, elastic, dissipated, unresolved = terms - np.array(before._balance_terms())
        return float(abs(work - elastic - dissipated - unresolved) / self.largest)

    def _balance_terms(self) -> Vector | None:
        """Return input work, elastic energy, dissipation and unresolved work (4,);
        None where undefined."""
        if self.input_work is None or self.dissipated is None or self.unresolved is None:
            return None
        return np.array([self.input_work, self.elastic, self.dissipated, self.unresolved])


NOTHING_YET = Energy()


def add_increment_energy(
    spent: Energy,
    before: Configuration,
    after: Configuration,
    dissipated: float | None,
    cell_area: float,
    *,
    path_matters: bool,
) -> Energy:
    """Compute the energies since the start of the load history at the end of one increment.

    The changes in the increment are added to the energies at its start. Work and dissipation are
    None from the first undefined rigid motion on.

    spent          energies at the start of the increment
    before, after  configurations (tractions, displacements, loads) at the start and the end
    dissipated     energy dissipated since the start of the history, None where undefined [force
                   length]
    cell_area      area of a cell and its mirror images [length^2]
    path_matters   True if the end state depends on the number of increments of the load step
    """
    elastic = elastic_energy(after, cell_area)
    work, worked, unresolved = _load_work(before, after), spent.input_work, spent.unresolved
    uncertain = spent.uncertain
    if (
        work is None
        or dissipated is None
        or worked is None
        or unresolved is None
        or uncertain is None
    ):
        return Energy(elastic, None, None, None, None, max(spent.largest, elastic))
    work += worked
    unresolved += unresolved_work(before, after, cell_area)
    if path_matters:
        uncertain += friction_changed(before, after, cell_area)
    sizes = (abs(term) for term in (elastic, work, dissipated, unresolved))
    return Energy(elastic, work, dissipated, unresolved, uncertain, max(spent.largest, *sizes))


def elastic_energy(state: Configuration, cell_area: float) -> float:
    """Compute the elastic energy ½ Σ (p u_z + q·u) Δ stored in both bodies [force length].

    p and q are pressure and shear, u_z and u the normal and tangential displacement of the cells.

    state      tractions and displacements of a state
    cell_area  area Δ of a cell and its mirror images [length^2]
    """
    normal = float(np.sum(state.pressure * state.normal_displacement))
    tangential = float(np.sum(state.shear * state.tangential_displacement))
    return 0.5 * (normal + tangential) * cell_area


def pressed_work(pressure: Field, displacement: Field) -> float:
    """Compute the integral ∫ p u_z of pressure times displacement, divided by the cell area.

    Half this integral times the cell area is the elastic energy of an edge-corrected pressure. The
    sum Σ p (u_z - Δ²u_z/24) is used, with Δ² the sum of second differences. Its error is of third
    order in the cell size, because p is the mean and u_z the central value of a cell.

    pressure      mean pressure p of each cell (nx, ny), on the window
    displacement  normal displacement u_z at the cell centres (nx, ny), on the window
    """
    bend = np.zeros_like(displacement)
    bend[1:-1] += np.diff(displacement, 2, axis=0)
    bend[:, 1:-1] += np.diff(displacement, 2, axis=1)
    pressed = pressure > 0
    return float(np.sum(pressure[pressed] * (displacement - bend / 24)[pressed]))


def unresolved_work(before: Configuration, after: Configuration, cell_area: float) -> float:
    """Compute the work of one increment that linear interpolation between its ends misses.

    The formula is ½ Σ (p₁ g₀ - p₀ g₁) Δ + Σ (κf·(s₁ - s₀) - ½ (q₀ + q₁)·(s₁ - s₀ + d)) Δ [force
    length]. Indices 0 and 1 denote start and end of the increment, p pressure, g gap, q shear, f
    mean friction, κ contact fraction, s slip, d free motion before contact and Δ the cell area. The
    first sum is over cells where contact begins or ends. A gap within lasting contact is a residual
    of the solution and belongs to the imbalance.

    before, after  configurations (tractions, displacements, loads) at the start and the end
    cell_area      area Δ of a cell and its mirror images [length^2]
    """
    p0, p1 = before.pressure, after.pressure
    begins, ends = (p0 == 0) & (p1 > 0), (p0 > 0) & (p1 == 0)
    closing = float(np.sum(p1[begins] * before.gap[begins]))
    opening = float(np.sum(p0[ends] * after.gap[ends]))
    sliding, moved = 0.0, after.slipped - before.slipped
    if np.any(moved):
        slipped = moved - after.free
        friction = sliding_friction(
            before.shear, after.shear, -slipped, before.friction_limit, after.friction_limit
        )
        shear = 0.5 * (before.shear + after.shear)
        sliding = float(np.sum(after.contact_fraction * friction * slipped - shear * moved))
    return (0.5 * (closing - opening) + sliding) * cell_area


def friction_changed(before: Configuration, after: Configuration, cell_area: float) -> float:
    """Compute the uncertainty of the energy dissipated in one increment [force length].

    The uncertainty is the change of the friction times the slip: Σ |q₁ - q₀| κ|s₁ - s₀| Δ. Indices
    0 and 1 denote start and end of the increment, q shear, s slip, κ contact fraction and Δ the
    cell area.

    before, after  configurations (tractions, displacements, loads) at the start and the end
    cell_area      area Δ of a cell and its mirror images [length^2]
    """
    changed, slipped = after.shear - before.shear, after.slipped - before.slipped - after.free
    way = after.contact_fraction * np.hypot(*slipped)
    return float(np.sum(np.hypot(*changed) * way)) * cell_area


def _load_work(before: Configuration, after: Configuration) -> float | None:
    """Compute Σ ½ (f₀ + f₁)(ω₁ - ω₀) [force length] of the forces and
    moments f with their motions ω; None where a motion is undefined."""
    if before.motions is None or after.motions is None:
        return None
    return float(np.sum(0.5 * (before.forces + after.forces) * (after.motions - before.motions)))
