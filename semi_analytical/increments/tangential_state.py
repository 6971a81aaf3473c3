"""The tangential part of a state, and what it means for the increment that starts from it."""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import binary_erosion

from contact_scene.array_types import Field, Mask, Vector, VectorField
from contact_scene.bulk_strain import UNSTRAINED, Strain
from contact_scene.quantities.residuals import ShearResiduals
from contact_scene.quantities.summary import ContactStatus
from semi_analytical.increments.tangential_solve import TangentialTarget
from semi_analytical.model import ContactModel
from semi_analytical.tangential.admissible_shear import everywhere

# So many cells at most are equally far from one, up to eight cells away.
EQUALLY_FAR = 12


@dataclass(frozen=True)
class TangentialState:
    """The tangential part of a state, all fields on the domain.

    pressure           p that the shear is below (nx, ny) [force/length^2]
    touching           part of the increment for which cells are in contact (nx, ny), of those that
                       are at either end
    displacement       u_t by the shear; less the motion it remembers where particles met
    shift              of the indenter; None at the friction limit under force control
    twist, torque      of the indenter; None where nothing twists
    strain             of the lower body since first touch; None where there is none
    slip               u_t + strain - motion accumulated while in contact (paper, eq. (4))
    slip_distance      way slipped since the start (nx, ny), |slip increments| added up
    dissipation        energy dissipated per area since the start (nx, ny) [force/length]
    dissipated_energy  since the start; None where the shift is
    """

    shear: VectorField
    pressure: Field
    touching: Field
    displacement: VectorField
    shift: Vector | None
    slip: VectorField
    slip_distance: Field
    dissipation: Field
    in_stick: Mask
    dissipated_energy: float | None
    status: ContactStatus
    force: Vector
    residuals: ShearResiduals
    iterations: int
    twist: float | None = None
    torque: float | None = None
    strain: Strain | None = None

    @property
    def motion(self) -> Vector:
        """Shift, and twist where there is one."""
        assert self.shift is not None
        return self.shift if self.twist is None else np.array([*self.shift, self.twist])


def untouched(cells: tuple[int, int]) -> TangentialState:
    """Before first touch: no shear, no shift, no slip."""
    nothing = np.zeros((2, *cells))
    return TangentialState(
        shear=nothing,
        pressure=nothing[0],
        touching=nothing[0],
        displacement=nothing,
        shift=np.zeros(2),
        slip=nothing,
        slip_distance=nothing[0],
        dissipation=nothing[0],
        in_stick=np.zeros(cells, dtype=bool),
        dissipated_energy=0.0,
        status=ContactStatus.FULL_STICK,
        force=np.zeros(2),
        residuals=ShearResiduals(0.0, 0.0, 0.0),
        iterations=0,
    )


def rigid(model: ContactModel, motion: Vector) -> VectorField:
    """Displacement of the indenter's particles by a shift, or by a shift and a twist."""
    shift = everywhere(motion[:2])
    return shift if len(motion) == 2 else shift + motion[2] * model.rotation


def surface_target(
    model: ContactModel, last: TangentialState, load: TangentialTarget
) -> VectorField:
    """By what the surfaces have to be moved, beside the motion of the load, to stick (2, nx, ny):
    what they remember, and what a given twist and the strain of the lower body add."""
    target = last.displacement - rigid(model, last.motion)
    target = target - stretched(model, load.strain, last.strain)
    if load.torsion is None or load.torsion.twist is None:
        return target
    return target + load.torsion.twist * model.rotation


def stretched(
    model: ContactModel, strain: Strain | None, last: Strain | None = None
) -> VectorField | float:
    """Displacement of the surface by a bulk strain, less that of another one [length]."""
    if strain is None:
        return 0.0
    (xx, yy, xy), (y, x) = np.subtract(strain, last or UNSTRAINED), model.arms
    return np.stack([xx * x + xy * y, xy * x + yy * y])


def strain_moments(model: ContactModel, q: VectorField) -> Vector:
    """Σ(q_x x, q_y y, q_x y + q_y x) Δ: what a shear resists a strain with (3,) [force length]."""
    y, x = model.arms
    products = (q[0] * x, q[1] * y, q[0] * y + q[1] * x)
    return np.array([float(np.sum(one)) for one in products]) * model.grid.cell_area


def first_motion(last: TangentialState, load: TangentialTarget) -> Vector:
    """The motion of the state before, as the load counts it."""
    assert last.shift is not None
    if load.torsion is None or load.torsion.torque is None:
        return last.shift
    return np.array([*last.shift, last.twist or 0.0])


def torque_of(model: ContactModel, q: VectorField) -> float:
    """Σ(q_y x - q_x y) Δ [force length]."""
    return float(np.sum(q * model.rotation)) * model.grid.cell_area


def torsion_reached(
    model: ContactModel, load: TangentialTarget, motion: Vector, q: VectorField
) -> tuple[float | None, float | None]:
    """Twist and torque; None where nothing twists."""
    if load.torsion is None:
        return None, None
    if load.torsion.torque is not None:
        return float(motion[2]), load.torsion.torque
    return load.torsion.twist, torque_of(model, q)


def touching_share(before: Field, after: Field, gap: Field) -> Field:
    """Part of an increment for which each cell is in contact, of those that are at either end.

    Particles slip past each other from their touch on and until they part. Behind an edge that
    moves on, p² grows as the way of the edge since, at all places alike (below a paraboloid
    p² ~ a² - r²). What a cell has of the growth of p² at the nearest cell that touches at both ends
    (the mean of those equally near, for mirrored contacts to have mirrored slip) is therefore its
    part of the motion: to first order in the increment, in which the motion follows the edge.
    Before first touch the nearest is the place of the largest pressure; there all that has no gap
    meets at once. Parting is meeting backwards.

    before, after  pressure at start and end (nx, ny)
    gap            undeformed (nx, ny)
    """
    share = np.ones_like(after)
    for less, more in ((before, after), (after, before)):
        touched = less > 0
        apart = ~touched if np.any(touched) else gap > 0
        changes = (more > 0) & apart
        if np.any(changes):
            share[changes] = _own_part(less, more, changes)
    return share


def _own_part(less: Field, more: Field, changes: Mask) -> Field:
    """Of cells that touch at one end only, with the pressure `more`: their p² over its growth."""
    touched, largest = less > 0, np.max(more)
    p, grown = more / largest, (more / largest) ** 2 - (less / largest) ** 2
    if np.any(touched):
        growth = _at_nearest(grown, touched & ~binary_erosion(touched), changes)
    else:
        growth = np.ones(np.count_nonzero(changes))
    own = p[changes] ** 2
    return np.divide(own, growth, out=np.ones_like(own), where=own < growth)


def _at_nearest(values: Field, known: Mask, wanted: Mask) -> Field:
    """The mean of the values at the known cells that are nearest to each wanted one (wanted,)."""
    from scipy.spatial import KDTree  # as long to import as a small contact takes

    tree = KDTree(np.argwhere(known))
    distance, which = tree.query(np.argwhere(wanted), k=EQUALLY_FAR)
    nearest = distance < distance[:, :1] * (1 + 1e-9)
    # Where fewer are known than asked for, the tree names one behind the last, infinitely far.
    found = np.where(nearest, np.append(values[known], 0.0)[which], 0.0)
    return np.asarray(np.sum(found, axis=1) / np.count_nonzero(nearest, axis=1))
