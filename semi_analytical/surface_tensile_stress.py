"""Largest tensile stress along the surface in a load cycle, for Ruiz's second parameter."""

from collections.abc import Sequence

import numpy as np

from contact_scene import Body
from contact_scene.array_types import Field, Vector
from contact_scene.bulk_strain import stress_by
from semi_analytical.fields import Increment, Result
from semi_analytical.stress import subsurface

# Changes of the tangential force below this fraction of Σ|q| Δ are round-off without direction.
ROUND_OFF = 1e-9


class SurfaceTensileStress:
    """Largest tensile stress at the surface in load cycles, for Ruiz's second fretting parameter.

    The stress at the end of a load step that several cycles share is evaluated once.

    result  result of the semi-analytical solver
    """

    def __init__(self, result: Result) -> None:
        self._result = result
        self._stresses: dict[int, Field] = {}

    def within(self, path: Sequence[Increment]) -> Field | None:
        """Compute the largest tensile stress σ_T of each surface cell in a load cycle.

        σ_T (nx, ny) [force/length^2] is the largest value at the ends of the load steps of the
        cycle. The stress acts along the direction in which the tangential force changes. None is
        returned if the force is constant.

        path  increments of the cycle; cycles must be given in the order of their start
        """
        direction = _force_direction(path, self._result.grid.cell_area)
        if direction is None:
            return None
        self._stresses = {step: s for step, s in self._stresses.items() if step >= path[0].step}
        ends = [i for i in path if i.index == i.increments_in_step]
        for end in ends:
            if end.step not in self._stresses:
                self._stresses[end.step] = _in_plane_stress(self._result, end)
        return np.max(
            [_normal_stress_along(direction, self._stresses[end.step]) for end in ends], axis=0
        )


def _in_plane_stress(result: Result, end: Increment) -> Field:
    """Compute the in-plane stress components at the surface of a body, tensile stress positive.

    The components σ_xx, σ_yy, σ_xy (3, nx, ny) [force/length^2] are those of the lower body, or of
    the indenter if the lower body is rigid.

    result  result of the semi-analytical solver
    end     increment at the end of a load step
    """
    body, indenter, shear = result.scene.body, result.scene.indenter, end.shear
    if not body.deforms:
        body = Body(material=indenter.material, layers=indenter.layers)
        shear = None if shear is None else -shear
    stress = subsurface(body, result.grid, end.pressure, shear, (0.0,)).stress[0]
    if end.bulk_strain is not None and body is result.scene.body:
        strain = (*end.bulk_strain, end.bulk_shear or 0.0)
        stress = stress + stress_by(strain, body, 0)[:, None, None]
    return np.asarray(stress[[0, 1, 5]])


def _force_direction(path: Sequence[Increment], cell_area: float) -> Vector | None:
    """Return the unit vector (2,) along which the tangential force
    changes most from the start of a cycle; None if the force is constant."""
    force = np.array([increment.tangential_force for increment in path])
    changes = force - force[0]
    sizes = np.hypot(changes[:, 0], changes[:, 1])
    carried = max(float(np.sum(np.hypot(*i.shear))) for i in path if i.shear is not None)
    if np.max(sizes) <= ROUND_OFF * carried * cell_area:
        return None
    return np.asarray(changes[np.argmax(sizes)] / np.max(sizes))


def _normal_stress_along(direction: Vector, stress: Field) -> Field:
    """Compute n·σ n (nx, ny) of the in-plane stress σ_xx,
    σ_yy, σ_xy (3, nx, ny) along a unit vector n."""
    (x, y), (xx, yy, xy) = direction, stress
    return np.asarray(x * x * xx + y * y * yy + 2 * x * y * xy)
