"""Fields in a homogeneous half-space under uniform tractions on a rectangle, in closed form.

Normal traction: Love (1929). Tangential traction: derivatives of the same potentials. With the
distance rho from the source point, the response of the half-space (CONVENTIONS.md, exp(-alpha z)
waves) consists of derivatives of the harmonic functions

    A = 1/rho,    B = -ln(rho + z),    C = z ln(rho + z) - rho,    A = -B_z,  B = -C_z,

divided by 2 pi. The integral of each derivative over the rectangle is the second difference of a
primitive over the corners. Functions of x alone or y alone are omitted from the primitives.
"""

from functools import cached_property
from math import pi

import numpy as np

from contact_scene.array_types import Field
from semi_analytical.frf.stack import HalfSpace
from semi_analytical.stress.components import empty_response


class RectanglePotentials:
    """Integrals over a rectangle of derivatives of A, B, C, over 2 pi, at a depth.

    x, y   corner offsets of the observers from the loaded rectangles, minus and plus half a side,
           shared by neighbours; shapes (…, nx + 1), (…, ny + 1), none zero at depth zero [length]
    depth  z >= 0 [length]

    Each integral has shape (…, nx, ny).
    """

    def __init__(self, x: Field, y: Field, depth: float) -> None:
        self._x, self._y, self._z = x[..., :, None], y[..., None, :], depth
        self._rho = np.sqrt(self._x**2 + self._y**2 + depth**2)
        self._xz = self._x**2 + depth**2
        self._yz = self._y**2 + depth**2
        self._deep = self._rho + depth

    def _corners(self, primitive: Field) -> Field:
        return np.diff(np.diff(primitive, axis=-2), axis=-1) / (2 * pi)

    @cached_property
    def _log_x(self) -> Field:
        """Primitive of A_x."""
        return np.arcsinh(self._y / np.sqrt(self._xz))

    @cached_property
    def _log_y(self) -> Field:
        """Primitive of A_y."""
        return np.arcsinh(self._x / np.sqrt(self._yz))

    @cached_property
    def _angle_x(self) -> Field:
        """Primitive of -B_xx, with rho - z written without cancellation."""
        x, y, z, rho = self._x, self._y, self._z, self._rho
        return np.arctan(x * y * (x**2 + y**2) / (self._deep * (x**2 * rho + y**2 * z)))

    @cached_property
    def _angle_y(self) -> Field:
        x, y, z, rho = self._x, self._y, self._z, self._rho
        return np.arctan(x * y * (x**2 + y**2) / (self._deep * (y**2 * rho + x**2 * z)))

    @cached_property
    def _log_deep(self) -> Field:
        return np.log(self._deep)

    @cached_property
    def a(self) -> Field:
        x, y, z = self._x, self._y, self._z
        solid = self._angle_x + self._angle_y
        return self._corners(x * self._log_x + y * self._log_y - z * solid)

    @cached_property
    def a_x(self) -> Field:
        return self._corners(self._log_x)

    @cached_property
    def a_y(self) -> Field:
        return self._corners(self._log_y)

    @cached_property
    def a_z(self) -> Field:
        return -self._corners(self._angle_x + self._angle_y)

    @cached_property
    def a_xx(self) -> Field:
        return -self._corners(self._x * self._y / (self._rho * self._xz))

    @cached_property
    def a_yy(self) -> Field:
        return -self._corners(self._x * self._y / (self._rho * self._yz))

    @cached_property
    def a_xy(self) -> Field:
        return self._corners(1 / self._rho)

    @cached_property
    def a_xz(self) -> Field:
        return -self._corners(self._y * self._z / (self._rho * self._xz))

    @cached_property
    def a_yz(self) -> Field:
        return -self._corners(self._x * self._z / (self._rho * self._yz))

    @cached_property
    def b_x(self) -> Field:
        x, y, z = self._x, self._y, self._z
        return -self._corners(y * self._log_deep + z * self._log_x + x * self._angle_x)

    @cached_property
    def b_y(self) -> Field:
        x, y, z = self._x, self._y, self._z
        return -self._corners(x * self._log_deep + z * self._log_y + y * self._angle_y)

    @cached_property
    def b_xx(self) -> Field:
        return -self._corners(self._angle_x)

    @cached_property
    def b_yy(self) -> Field:
        return -self._corners(self._angle_y)

    @cached_property
    def b_xy(self) -> Field:
        return -self._corners(self._log_deep)

    @cached_property
    def b_xxx(self) -> Field:
        x, y, z, rho = self._x, self._y, self._z, self._rho
        return self._corners(y * (x**2 - z * rho) / (rho * self._deep * self._xz))

    @cached_property
    def b_yyy(self) -> Field:
        x, y, z, rho = self._x, self._y, self._z, self._rho
        return self._corners(x * (y**2 - z * rho) / (rho * self._deep * self._yz))

    @cached_property
    def b_xxy(self) -> Field:
        return -self._corners(self._x / (self._rho * self._deep))

    @cached_property
    def b_xyy(self) -> Field:
        return -self._corners(self._y / (self._rho * self._deep))

    @cached_property
    def c_xx(self) -> Field:
        return self._corners(self._z * self._angle_x - self._x * self._log_x)

    @cached_property
    def c_yy(self) -> Field:
        return self._corners(self._z * self._angle_y - self._y * self._log_y)

    @cached_property
    def c_xy(self) -> Field:
        return self._corners(self._z * self._log_deep - self._rho)

    @cached_property
    def c_xxx(self) -> Field:
        return self._corners(self._y / self._deep - self._log_x)

    @cached_property
    def c_yyy(self) -> Field:
        return self._corners(self._x / self._deep - self._log_y)

    @cached_property
    def c_xxy(self) -> Field:
        return -self._corners(self._x / self._deep)

    @cached_property
    def c_xyy(self) -> Field:
        return -self._corners(self._y / self._deep)


def half_space_response(
    f: RectanglePotentials, material: HalfSpace, depth: float, *, sheared: bool = True
) -> Field:
    """Compute the fields by unit tractions on a rectangle, shape (FIELDS, acting tractions, …, nx,
    ny).

    They are in equilibrium and regular at nu = 1/2. The divergence of the displacement is 2 (1 - 2
    nu) / 2G times A_z under pressure, A_x and A_y under shear. Every normal stress includes 2 nu
    times these derivatives.
    """
    G, nu = material
    z, g = depth, 1 - 2 * nu
    result = empty_response(f.a.shape, sheared=sheared)
    by_p = result[:, -1]
    half = 1 / (2 * G)

    by_p[0] = half * (g * f.b_x - z * f.a_x)
    by_p[1] = half * (g * f.b_y - z * f.a_y)
    by_p[2] = half * (2 * (1 - nu) * f.a - z * f.a_z)
    by_p[3] = g * f.b_xx - z * f.a_xx + 2 * nu * f.a_z
    by_p[4] = g * f.b_yy - z * f.a_yy + 2 * nu * f.a_z
    by_p[5] = f.a_z + z * (f.a_xx + f.a_yy)
    by_p[6] = -z * f.a_yz
    by_p[7] = -z * f.a_xz
    by_p[8] = g * f.b_xy - z * f.a_xy

    if not sheared:
        return result
    by_x, by_y = result[:, 0], result[:, 1]
    by_x[0] = half * (2 * f.a + 2 * nu * f.c_xx + z * f.b_xx)
    by_x[1] = half * (2 * nu * f.c_xy + z * f.b_xy)
    by_x[2] = -half * (g * f.b_x + z * f.a_x)
    by_x[3] = 2 * (1 + nu) * f.a_x + 2 * nu * f.c_xxx + z * f.b_xxx
    by_x[4] = 2 * nu * (f.a_x + f.c_xyy) + z * f.b_xyy
    by_x[5] = -z * f.a_xz
    by_x[6] = -z * f.a_xy
    by_x[7] = f.a_z - z * f.a_xx
    by_x[8] = f.a_y + 2 * nu * f.c_xxy + z * f.b_xxy

    by_y[0] = by_x[1]
    by_y[1] = half * (2 * f.a + 2 * nu * f.c_yy + z * f.b_yy)
    by_y[2] = -half * (g * f.b_y + z * f.a_y)
    by_y[3] = 2 * nu * (f.a_y + f.c_xxy) + z * f.b_xxy
    by_y[4] = 2 * (1 + nu) * f.a_y + 2 * nu * f.c_yyy + z * f.b_yyy
    by_y[5] = -z * f.a_yz
    by_y[6] = f.a_z - z * f.a_yy
    by_y[7] = -z * f.a_xy
    by_y[8] = f.a_x + 2 * nu * f.c_xyy + z * f.b_xyy
    return result
