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


class AxisPotentials:
    """Integrals over a loaded rectangle of derivatives of three potentials along a surface axis s.

    The potentials are A = 1/ρ, B = -ln(ρ + z) and C = z ln(ρ + z) - ρ, with the distance ρ from the
    source point. Displacement and stress in a half-space are sums of such integrals. The name of a
    property states the potential and the variables of its derivative: `b_sso` is the integral of
    the derivative of B twice along s and once along the other axis o, divided by 2π. Each integral
    has the shape (…, nx, ny).

    s, o   corner offsets of the observers along this and the other axis, which broadcast [length]
    depth  z >= 0 [length]
    """

    def __init__(self, s: Field, o: Field, depth: float) -> None:
        self._s, self._o, self._z = s, o, depth
        self._rho = np.sqrt(s**2 + o**2 + depth**2)
        self._sz = s**2 + depth**2
        self._deep = self._rho + depth

    @cached_property
    def log(self) -> Field:
        """Primitive of the derivative A_s of the potential A = 1/ρ, at the corners.

        s is the coordinate along the axis and ρ the distance from the source point. The difference
        over the corners is the integral of A_s over the rectangle.
        """
        return np.arcsinh(self._o / np.sqrt(self._sz))

    @cached_property
    def angle(self) -> Field:
        """Primitive of the derivative -B_ss of the potential B = -ln(ρ + z), at the corners.

        s is the coordinate along the axis and ρ the distance from the source point. The difference
        over the corners is the integral of -B_ss over the rectangle. The formula has the factor
        ρ - z as (s² + o²)/(ρ + z), without cancellation.
        """
        s, o, z, rho = self._s, self._o, self._z, self._rho
        return np.arctan(s * o * (s**2 + o**2) / (self._deep * (s**2 * rho + o**2 * z)))

    @cached_property
    def a_s(self) -> Field:
        """Integral of A_s over the rectangle, divided by 2π (…, nx, ny) [1]."""
        return _corner_differences(self.log)

    @cached_property
    def a_ss(self) -> Field:
        """Integral of A_ss over the rectangle, divided by 2π (…, nx, ny) [1/length]."""
        return -_corner_differences(self._s * self._o / (self._rho * self._sz))

    @cached_property
    def a_sz(self) -> Field:
        """Integral of A_sz over the rectangle, divided by 2π (…, nx, ny) [1/length]."""
        return -_corner_differences(self._o * self._z / (self._rho * self._sz))

    @cached_property
    def b_s(self) -> Field:
        """Integral of B_s over the rectangle, divided by 2π (…, nx, ny) [length]."""
        log_deep = np.log(self._deep)
        return -_corner_differences(self._o * log_deep + self._z * self.log + self._s * self.angle)

    @cached_property
    def b_ss(self) -> Field:
        """Integral of B_ss over the rectangle, divided by 2π (…, nx, ny) [1]."""
        return -_corner_differences(self.angle)

    @cached_property
    def b_sss(self) -> Field:
        """Integral of B_sss over the rectangle, divided by 2π (…, nx, ny) [1/length]."""
        s, o, z, rho = self._s, self._o, self._z, self._rho
        return _corner_differences(o * (s**2 - z * rho) / (rho * self._deep * self._sz))

    @cached_property
    def b_sso(self) -> Field:
        """Integral of B_sso over the rectangle, divided by 2π (…, nx, ny) [1/length]."""
        return -_corner_differences(self._s / (self._rho * self._deep))

    @cached_property
    def c_ss(self) -> Field:
        """Integral of C_ss over the rectangle, divided by 2π (…, nx, ny) [length]."""
        return _corner_differences(self._z * self.angle - self._s * self.log)

    @cached_property
    def c_sss(self) -> Field:
        """Integral of C_sss over the rectangle, divided by 2π (…, nx, ny) [1]."""
        return _corner_differences(self._o / self._deep - self.log)

    @cached_property
    def c_sso(self) -> Field:
        """Integral of C_sso over the rectangle, divided by 2π (…, nx, ny) [1]."""
        return -_corner_differences(self._s / self._deep)


def _corner_differences(primitive: Field) -> Field:
    """Evaluate an integral over rectangles, over 2π,
    as the second difference of its corner primitive (…, nx + 1, ny + 1)."""
    return np.diff(np.diff(primitive, axis=-2), axis=-1) / (2 * pi)


def half_space_response(
    x: Field, y: Field, depth: float, material: HalfSpace, *, sheared: bool = True
) -> Field:
    """Compute displacement and stress in a half-space by unit tractions on a surface rectangle.

    The result (9, tractions, …, nx, ny) has 3 displacements and 6 stresses by each traction
    component. The fields are in equilibrium and regular at nu = 1/2. The divergence of the
    displacement is 2 (1 - 2 nu) / 2G times A_z under pressure, A_x and A_y under shear, with the
    integral A of 1/(2π rho) over the rectangle. Every normal stress includes 2 nu times these
    derivatives.

    x, y      corner offsets of the observers from the loaded rectangles, minus and plus half a
              side, shared by neighbours; shapes (…, nx + 1), (…, ny + 1), none zero at depth zero
              [length]
    depth     z >= 0 [length]
    material  elastic constants (G, nu)
    sheared   include the responses to the shear components, before those to pressure
    """
    x, y = x[..., :, None], y[..., None, :]
    along = AxisPotentials(x, y, depth), AxisPotentials(y, x, depth)
    rho = np.sqrt(x**2 + y**2 + depth**2)
    log_deep = np.log(rho + depth)
    # The potentials are harmonic: A = -B_z, B = -C_z.
    a, a_z = -along[0].c_ss - along[1].c_ss, along[0].b_ss + along[1].b_ss
    a_xy, b_xy = _corner_differences(1 / rho), -_corner_differences(log_deep)
    G, nu = material
    z, g, half = depth, 1 - 2 * nu, 1 / (2 * G)
    result = empty_response(a.shape, sheared=sheared)
    by_p = result[:, -1]
    by_p[2] = half * (2 * (1 - nu) * a - z * a_z)
    by_p[5] = a_z + z * (along[0].a_ss + along[1].a_ss)
    by_p[8] = g * b_xy - z * a_xy
    for k, s in enumerate(along):
        by_p[k] = half * (g * s.b_s - z * s.a_s)
        by_p[3 + k] = g * s.b_ss - z * s.a_ss + 2 * nu * a_z
        by_p[7 - k] = -z * s.a_sz
    if not sheared:
        return result
    c_xy = _corner_differences(z * log_deep - rho)
    for k, (s, o) in enumerate((along, along[::-1])):
        by_q = result[:, k]
        by_q[k] = half * (2 * a + 2 * nu * s.c_ss + z * s.b_ss)
        by_q[1 - k] = half * (2 * nu * c_xy + z * b_xy)
        by_q[2] = -half * (g * s.b_s + z * s.a_s)
        by_q[3 + k] = 2 * (1 + nu) * s.a_s + 2 * nu * s.c_sss + z * s.b_sss
        by_q[4 - k] = 2 * nu * (s.a_s + o.c_sso) + z * o.b_sso
        by_q[5] = -z * s.a_sz
        by_q[6 + k] = -z * a_xy
        by_q[7 - k] = a_z - z * s.a_ss
        by_q[8] = o.a_s + 2 * nu * s.c_sso + z * s.b_sso
    return result
