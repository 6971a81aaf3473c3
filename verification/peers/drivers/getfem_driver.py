"""GetFEM: a rigid indenter of revolution pressed on a layered body, by an augmented Lagrangian.

Biquadratic elements on a section (r, z), pressure linear along its surface, no friction; the box
moves as the substrate would under the point force.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from verification.peers.drivers.exchange import Answer, Request, answer

Vector = NDArray[np.float64]

BOX, GROWTH = 100.0, 1.3  # the box over the length, and an element over the one before
REACH = 1.5  # lengths of equal elements
TOUCHES, AXIS, FAR = 1, 2, (3, 4)
POINTS = "IM_GAUSS_PARALLELEPIPED(2, 6)"
MOST_ITERATIONS = 60
ELASTIC = (
    "X(1)*(lame*(Div_u+u(1)/X(1))*(Div_Test_u+Test_u(1)/X(1))"
    "+rigid*(Grad_u+Grad_u'):Grad_Test_u+2*rigid*u(1)*Test_u(1)/sqr(X(1)))"
)
ON_AXIS = "1e6*u(1)*Test_u(1)"
# The law as a projection (Alart and Curnier 1991). u(2) is upward, p acts on the body.
PRESSED = (
    "X(1)*p*Test_u(2)+X(1)*(p-pos_part(p-gain*(gap-d-u(2))))*Test_p/gain"
    "+(2*pi*X(1)*p-force/reach)*Test_d"
)


def solve(request: Request) -> Answer:
    """Pressure at radii, and the approach, which is begun at the one given."""
    gf, side = import_module("getfem"), 1 / request["elements"]
    gf.util_trace_level(0)
    mesh = _mesh(gf, request["thickness"], side)
    spaces = [gf.MeshFem(mesh, 1 + degree // 2) for degree in range(3)]
    for degree, space in enumerate(spaces):
        space.set_fem(gf.Fem(f"FEM_QK(2,{degree})"))
    parts, linear, displaced = spaces
    touching = linear.basic_dof_on_region(TOUCHES)
    surface, points = gf.MeshFem("partial", linear, touching), gf.MeshIm(mesh, gf.Integ(POINTS))
    coated = parts.basic_dof_nodes()[1] > -request["thickness"]
    both = request["poisson_ratios"], request["moduli"]
    nu, young = (np.where(coated, above, below) for above, below in both)
    radii = linear.basic_dof_nodes()[0]
    model = gf.Model("real")
    model.add_fem_variable("u", displaced)
    model.add_fem_variable("p", surface)
    model.add_variable("d", 1)
    model.set_variable("d", [request["approach"]])  # without contact nothing would hold it
    for name, space, values in (
        ("rigid", parts, young / (2 * (1 + nu))),
        ("lame", parts, young * nu / ((1 + nu) * (1 - 2 * nu))),
        ("gap", linear, request["slope"] * radii + request["curvature"] * radii**2 / 2),
        ("far", displaced, _far(displaced.basic_dof_nodes(), request, side)),
    ):
        model.add_initialized_fem_data(name, space, values)
    for name, value in (("gain", 1 / side), ("reach", REACH), ("force", request["force"])):
        model.add_initialized_data(name, [value])
    model.add_nonlinear_term(points, ELASTIC)
    model.add_nonlinear_term(points, ON_AXIS, AXIS)
    model.add_nonlinear_term(points, PRESSED, TOUCHES)
    for region in FAR:
        model.add_Dirichlet_condition_with_simplification("u", region, "far")
    iterations = model.solve("max_res", request["tolerance"], "max_iter", MOST_ITERATIONS)[0]
    return {
        "radii": radii[touching].tolist(),
        "pressure": model.variable("p"),
        "shear": None,
        "approach": float(model.variable("d")[0]),
        "converged": bool(iterations < MOST_ITERATIONS),
    }


def _mesh(gf: Any, thickness: float, side: float) -> Any:
    """Equal elements where it may touch; a line of nodes on the interface."""
    radii, depths = _lines(side, REACH), _lines(side, 0.5)
    nearest = int(np.argmin(np.abs(depths - thickness)))
    depths[: nearest + 1] *= thickness / depths[nearest]
    mesh = gf.Mesh("cartesian", radii, -depths[::-1])
    deep, wide = -depths[-1], radii[-1]
    for region, low, high in (
        (TOUCHES, (0.0, 0.0), (REACH, 0.0)), (AXIS, (0.0, deep), (0.0, 0.0)),
        (FAR[0], (0.0, deep), (wide, deep)), (FAR[1], (wide, deep), (wide, 0.0)),
    ):  # fmt: skip
        corners = np.add(low, -side / 9), np.add(high, side / 9)
        mesh.set_region(region, mesh.outer_faces_in_box(*corners))
    return mesh


def _far(nodes: Vector, request: Request, side: float) -> Vector:
    """Boussinesq's displacement by the force on the substrate (Johnson 1985, eq. 3.18), at the
    degrees of freedom, which take radial and upward turns."""
    nu = request["poisson_ratios"][1]
    rigid = request["moduli"][1] / (2 * (1 + nu))
    r, z = nodes[0], -nodes[1]
    rho = np.maximum(np.hypot(r, z), side)
    outward = r * z / rho**2 - (1 - 2 * nu) * r / (rho + z)
    upward = -2 * (1 - nu) - z**2 / rho**2
    radial = np.arange(len(r)) % 2 == 0
    of_unit = np.where(radial, outward, upward) / (4 * np.pi * rigid * rho)
    return np.asarray(request["force"] * of_unit)


def _lines(side: float, reach: float) -> Vector:
    """Equal steps to `reach`, then growing ones to the box."""
    lines = list(side * np.arange(round(reach / side) + 1))
    while lines[-1] < BOX:
        lines.append(lines[-1] + GROWTH * (lines[-1] - lines[-2]))
    return np.array(lines)


if __name__ == "__main__":
    answer(solve, "getfem")
