"""Preconditioner of the coupled problem by an inverse that is a convolution, with bins of slip."""

import numpy as np

from contact_scene.array_types import Matrix, Vector
from contact_solver.conjugate_gradients import Map
from contact_solver.slip_compliance_bins import beyond, shares
from contact_solver.zones import Zones


class BinnedPreconditioner:
    """Approximate inverse of the generalised derivative, with bins of the slip compliance.

    In the stick zone the derivative is the tangential operator. A slipping point adds its slip
    compliance d (see `slip_compliance_bins`). The approximate inverse is

        M = Π F⁻¹ Π + Σ_j χ_j t (f + d_j)⁻¹ t χ_j,    Π = stick + χ_0 t t

    F is the tangential operator with the unpadded period, f its scalar mean. χ_j is the weight of a
    point in bin j with the compliance d_j, and t the unit vector perpendicular to the slip. Far
    beyond the last bin d dominates f: there M tends to t (K₀ + d)⁻¹ t, with the self-compliance K₀
    of a point. Rows and free unknowns are vectors of the zones.
    """

    def __init__(self, zones: Zones, inverse: Map, self_compliance: float) -> None:
        """Divide the slipping points of given zones among the bins.

        inverse          approximate inverse of the map from tractions to displacements without
                         coupling, then of a scalar shear with the compliance of each bin
        self_compliance  tangential displacement of a point by its own unit shear
                         [length^3/force]
        """
        self._zones, self._inverse = zones, inverse
        compliance = zones.slip_compliance / self_compliance
        excess = beyond(compliance)
        self._shares = shares(compliance)
        self._shares[-1] *= np.sqrt(1 - excess)
        self._alone = excess / (self_compliance + zones.slip_compliance)

    def __call__(self, residuals: Matrix) -> Matrix:
        """Convert residuals of Newton's method to changes of the free tractions, approximately.

        residuals  residuals (k, size), one row per free unknown
        """
        return np.array([self._change(rows) for rows in residuals]).reshape(residuals.shape)

    def _change(self, rows: Vector) -> Vector:
        zones, slip = self._zones, self._zones.slip
        first, *others = self._shares
        weighted = rows.copy()
        along = zones.split_unknowns(weighted)[1]
        alone = self._alone * along
        bins = np.zeros((len(others), zones.contact.size))
        for one, share in zip(bins, others, strict=True):
            one[slip] = share * along
        along *= first
        field = zones.field(weighted)
        u = self._inverse(np.concatenate([field, bins]))
        free = zones.free(u[: len(field)])
        along = zones.split_unknowns(free)[1]
        along *= first
        along += alone
        for one, share in zip(u[len(field) :], others, strict=True):
            along += share * one[slip]
        return free
