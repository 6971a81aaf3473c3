"""Tangential part of a converged state, and the displacement that stick requires."""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Mask, Vector, VectorField
from contact_scene.bulk_strain import UNSTRAINED, Strain
from contact_scene.quantities.residuals import ShearResiduals
from contact_scene.quantities.summary import ContactStatus
from semi_analytical.increments.tangential_solve import TangentialTarget
from semi_analytical.model import ContactModel, everywhere

# Number of distances between cells that are computed at once, which limits the memory.
PAIRS = 1 << 16


@dataclass(frozen=True)
class TangentialState:
    """Tangential part of a converged state of contact; all fields are on the reduced domain.

    shear              q (2, nx, ny) [force/length^2]
    pressure           p at which the tangential problem was solved (nx, ny) [force/length^2]
    contact_fraction   fraction of the increment during which each cell is in contact (nx, ny)
    displacement       tangential surface displacement u_t by the tractions (2, nx, ny) [length]
    shift              tangential shift of the indenter (2,) [length]; None at the friction limit
                       under force control, where it is undefined
    slip               slip of the lower body relative to the indenter, accumulated while in
                       contact: u_t + displacement by bulk strain - rigid motion (2, nx, ny)
                       [length]
    slip_distance      path length of slip since the start (nx, ny), sum of |increments| [length]
    dissipation        energy dissipated per area since the start (nx, ny) [force/length]
    in_stick           sticking cells (nx, ny)
    dissipated_energy  energy lost to friction since the start [force length]; None where the shift
                       is undefined
    status             contact status, e.g. partial slip
    force              tangential force (2,) [force]
    residuals          residuals of friction law and equilibrium
    iterations         iterations of the tangential solver
    twist, torque      twist and torque of the indenter; None without torsion
    strain             bulk strain of the lower body since first contact; None without strain
    free               free motion: displacement relative to the indenter, in the increment, of
                       cells before they come into contact (2, nx, ny) [length]
    """

    shear: VectorField
    pressure: Field
    contact_fraction: Field
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
    free: VectorField | None = None

    @property
    def motion(self) -> Vector:
        """Rigid tangential motion of the indenter: shift (2,) [length], then twist in torsion."""
        assert self.shift is not None
        return self.shift if self.twist is None else np.array([*self.shift, self.twist])


def untouched_state(cells: tuple[int, int]) -> TangentialState:
    """Return the tangential state of the contact before first contact: no shear, no shift, no slip.

    The first increment starts from this state.

    cells  number of cells of the domain along x and y
    """
    nothing = np.zeros((2, *cells))
    return TangentialState(
        shear=nothing,
        pressure=nothing[0],
        contact_fraction=nothing[0],
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
    """Compute the displacement of the indenter's surface points by shift and twist [length].

    The result broadcasts with fields (2, nx, ny).

    model   contact model with the coordinates of the cells
    motion  shift (2,) [length], or shift and twist (3,)
    """
    shift = everywhere(motion[:2])
    return shift if len(motion) == 2 else shift + motion[2] * model.rotation


def surface_target(
    model: ContactModel,
    last: TangentialState,
    load: TangentialTarget,
    free: VectorField | None = None,
) -> VectorField:
    """Compute the relative tangential surface displacement that full stick requires [length].

    The result (2, nx, ny) consists of the displacement locked in by the previous increment, the
    free motion of cells before their contact, the bulk strain of the lower body in this increment,
    and the prescribed twist. The shift of the indenter is not included, nor a twist that the solver
    determines.

    last  tangential state at the start of the increment
    load  prescribed tangential load at the end of the increment
    free  free motion of cells before their contact (2, nx, ny) [length]; None without
    """
    target = last.displacement - rigid(model, last.motion)
    target = target if free is None else target + free
    target = target - bulk_strain_displacement(model, load.strain, last.strain)
    return target if load.twist is None else target + load.twist * model.rotation


def bulk_strain_displacement(
    model: ContactModel, strain: Strain | None, last: Strain | None = None
) -> VectorField | float:
    """Compute the surface displacement by a change of the lower body's bulk strain [length].

    The result has the shape (2, nx, ny). Without strain it is the number 0.

    strain  strain (xx, yy, xy) at the end of the increment; None without strain
    last    strain at the start of the increment; None for zero
    """
    if strain is None:
        return 0.0
    (xx, yy, xy), (y, x) = np.subtract(strain, last or UNSTRAINED), model.arms
    return np.stack([xx * x + xy * y, xy * x + yy * y])


def strain_moments(model: ContactModel, q: VectorField) -> Vector:
    """Compute the generalised forces of a shear that do work on a bulk strain [force length].

    The forces are Σ(q_x x, q_y y, q_x y + q_y x) Δ (3,), with Δ the area of a cell. The energy
    balance multiplies them by the strains (xx, yy, xy).

    q  shear (2, nx, ny) [force/length^2]
    """
    y, x = model.arms
    products = (q[0] * x, q[1] * y, q[0] * y + q[1] * x)
    return np.array([float(np.sum(one)) for one in products]) * model.grid.cell_area


def torque_of(model: ContactModel, q: VectorField) -> float:
    """Compute the torque Σ(q_y x - q_x y) Δ of a shear about the z axis [force length].

    Δ is the area of a cell.

    q  shear (2, nx, ny) [force/length^2]
    """
    return float(np.sum(q * model.rotation)) * model.grid.cell_area


def torsion_reached(
    model: ContactModel, load: TangentialTarget, motion: Vector, q: VectorField
) -> tuple[float | None, float | None]:
    """Return twist and torque of the indenter at the end of an increment; None without torsion.

    Under a prescribed torque, the twist is that of the solution. Under a prescribed twist, the
    torque follows from the shear.

    load    prescribed tangential load
    motion  solved rigid motion: shift, and twist under a prescribed torque
    q       solved shear (2, nx, ny) [force/length^2]
    """
    if load.torque is not None:
        return float(motion[2]), load.torque
    return load.twist, None if load.twist is None else torque_of(model, q)


def touching_share(before: Field, after: Field, gap: Field) -> Field:
    """Compute the contact fraction: the part of an increment during which each cell is in contact.

    The slip of an increment is multiplied by this fraction (nx, ny), because surfaces slip relative
    to each other only while in contact. Behind an advancing contact edge, p² grows in proportion to
    the advance since first contact (below a paraboloid p² ~ a² - r²). The contact fraction of a new
    cell is therefore the ratio of its p² to the growth of p² at the nearest cell that was in
    contact before. The mean of equally near cells is used, so that mirrored contacts have mirrored
    slip. The result is correct to first order in the increment. In first contact the largest p²
    takes the place of the growth, and cells without gap have the fraction 1. Separation is treated
    as contact in reverse.

    before, after  pressure at the start and the end of the increment (nx, ny)
    gap            undeformed gap (nx, ny)
    """
    share = np.ones_like(after)
    for less, more in ((before, after), (after, before)):
        touched = less > 0
        apart = ~touched if np.any(touched) else gap > 0
        changes = (more > 0) & apart
        if np.any(changes):
            share[changes] = _new_contact_fraction(less, more, changes)
    return share


def at_nearest_edge(values: Field, touched: Mask, wanted: Mask) -> Field:
    """Return a field (c, nx, ny) with the values at the nearest edge cells of an earlier contact.

    The mean of equally near cells is used. The result is 0 outside the wanted cells.

    values   field (c, nx, ny)
    touched  mask of the cells in contact before (nx, ny), at least one
    wanted   mask of the cells whose values are required (nx, ny)
    """
    from scipy.ndimage import binary_erosion  # the import takes as long as a contact

    found, edge = np.zeros_like(values), touched & ~binary_erosion(touched)
    if np.any(wanted):
        for one, value in zip(found, values, strict=True):
            one[wanted] = _mean_at_nearest_cells(value, edge, wanted)
    return found


def _new_contact_fraction(less: Field, more: Field, changes: Mask) -> Field:
    """Compute the part of an increment during which cells of a new contact are in contact.

    The part is p² of the cell over the growth of p² at the nearest cell in lasting contact, at most
    1. For cells that separate, the increment is considered in reverse.

    less, more  pressure at the end of the increment with the smaller and with the larger contact
                (nx, ny)
    changes     cells that are in contact in `more` only (nx, ny)
    """
    from scipy.ndimage import binary_erosion  # the import takes as long as a contact

    touched, largest = less > 0, np.max(more)
    p, grown = more / largest, (more / largest) ** 2 - (less / largest) ** 2
    if np.any(touched):
        growth = _mean_at_nearest_cells(grown, touched & ~binary_erosion(touched), changes)
    else:
        growth = np.ones(np.count_nonzero(changes))
    own = p[changes] ** 2
    return np.divide(own, growth, out=np.ones_like(own), where=own < growth)


def _mean_at_nearest_cells(values: Field, known: Mask, wanted: Mask) -> Field:
    """Compute the mean of a field over the nearest known
    cells of each wanted cell (wanted,), with equal weights."""
    at, to, data, means = np.argwhere(known), np.argwhere(wanted), values[known], []
    for some in np.array_split(to, 1 + len(to) * len(at) // PAIRS):
        squared = np.sum((some[:, None] - at) ** 2, axis=-1)
        nearest = squared == np.min(squared, axis=1, keepdims=True)
        means.append(np.sum(nearest * data, axis=1) / np.count_nonzero(nearest, axis=1))
    return np.concatenate(means)
