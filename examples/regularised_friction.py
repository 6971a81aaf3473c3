"""Sensitivity of a regularised friction law: what finite stiffness changes, and its limit.

python examples/regularised_friction.py

The substitute for an external code is the penalty law without augmentation: springs of c contact
moduli per element. The true answer is Cattaneo and Mindlin's (ν = 0). It fails if the error is
not of first order in the compliance of the springs, or if the limit misses the closed form.
"""

import numpy as np

from slipstick import (
    Body,
    CoulombFriction,
    FiniteElementDiscretisation,
    IsotropicMaterial,
    LoadStep,
    Paraboloid,
    Scene,
    solve,
)

STIFFNESS = (1.0, 2.0, 4.0)  # contact moduli per element
ALLOWED = 2e-3  # relative error of the shift
STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.0)
MU = 0.3
W = 100.0
T = 15.0
R = 10e-3

scene = Scene(
    title="Partial slip through springs",
    indenter=Paraboloid(radius=R, material=STEEL),
    body=Body(material=STEEL),
    friction=CoulombFriction(coefficient=MU),
    loading=(LoadStep(normal_force=W), LoadStep(tangential_force=(T, 0.0), increments=4)),
)
e_star = STEEL.young_modulus / 2
a = (3 * W * R / (4 * e_star)) ** (1 / 3)
exact = 3 * MU * W / (4 * e_star * a) * (1 - (1 - T / (MU * W)) ** (2 / 3))

shifts = []
for c in STIFFNESS:
    mesh = FiniteElementDiscretisation(
        elements_per_radius=16, contact_radius=a, penalty=c, augmentations=0, overlap=1.0
    )
    shifts.append(solve(scene, "fem", mesh).steps[-1].tangential_shift[0])
    print(f"c = {c:3.0f}: shift {shifts[-1] * 1e9:.2f} nm, error {shifts[-1] / exact - 1:+.1e}")
# The border of the stick zone moves between nodes of the mesh, which scatters the order.
differences = -np.diff(shifts)
order = np.log2(differences[0] / differences[1])
limit = 2 * shifts[-1] - shifts[-2]
print(f"order in 1/c {order:.2f}, limit {limit * 1e9:.2f} nm, exact {exact * 1e9:.2f} nm")
if abs(order - 1) > 0.3 or abs(limit / exact - 1) > ALLOWED:
    raise SystemExit("springs do not converge to the closed form")
