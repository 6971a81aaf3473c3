"""A coated contact by both solvers: cells with Fourier transforms, and finite elements.

Run it with `python examples/compare_with_fem.py`. It fails if the two are further apart than it
promises.
"""

import numpy as np

from slipstick import (
    RIGID,
    Body,
    CoulombFriction,
    FiniteElementDiscretisation,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
    SurfaceDiscretisation,
    solve,
)

PRESSURE = 5e-3  # of the peak
SHEAR = 2e-2  # of µ times the peak
APPROACH = 1e-3  # relative
A = 0.32e-3  # about the contact radius: it lays out grid and mesh and does not decide the answer

# What is solved: a rigid ball pressed on a coating twice as stiff as the body below. The surface
# moves under pressure and the ball does not, so that friction leaves shear without any push.
scene = Scene(
    title="Rigid ball on a coated body",
    indenter=Paraboloid(radius=18e-3, material=RIGID),
    body=Body(
        material=IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3),
        layers=(
            Layer(
                thickness=0.4e-3,
                material=IsotropicMaterial(young_modulus=420e9, poisson_ratio=0.3),
            ),
        ),
    ),
    friction=CoulombFriction(coefficient=0.1),
    loading=(LoadStep(normal_force=1e3, increments=10),),
)

# How finely. The two share the scene and no line of numerics.
grid = SurfaceDiscretisation(cells=(97, 97), window=(2.4 * A, 2.4 * A))
mesh = FiniteElementDiscretisation(elements_per_radius=48, contact_radius=A)
cells = solve(scene, "semi-analytical", grid)
elements = solve(scene, "fem-complementarity", mesh)

one, other = cells.steps[-1], elements.steps[-1]
print("           approach     contact radius   energy lost")
for name, end in (("cells", one), ("elements", other)):
    print(
        f"{name:9}  {end.approach * 1e6:.5f} µm   {end.contact_radius * 1e3:.5f} mm"
        f"       {end.dissipated_energy * 1e6:.4f} µJ"
    )

# An odd number of cells puts a row on the axis: its right half is a profile over the radius. The
# centre, where stick ends in a kink, and the edge, where the pressure does, are left out.
x = cells.grid.x
row = (x > 0.2 * A) & (x < 0.9 * A)
middle = len(x) // 2
p, q = one.pressure[row, middle], one.shear[0, row, middle]
p_other, q_other = (
    np.interp(x[row], other.radii, field) for field in (other.pressure, other.shear_radial)
)
peak = other.peak_pressure
found = {
    "pressure": (np.max(np.abs(p - p_other)) / peak, PRESSURE),
    "shear": (np.max(np.abs(q - q_other)) / (0.1 * peak), SHEAR),
    "approach": (abs(one.approach / other.approach - 1), APPROACH),
}
for name, (difference, allowed) in found.items():
    print(f"{name}: the two are {difference:.1e} apart, promised {allowed:.0e}")
if any(difference > allowed for difference, allowed in found.values()):
    raise SystemExit("further apart than promised")
