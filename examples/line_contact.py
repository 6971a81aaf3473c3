"""Cylinder on a coated flat, per unit length: pressed, pushed, and the stress below.

Run it with `python examples/line_contact.py`. It fails if the bare contact misses Hertz by more
than it promises.
"""

from math import pi, sqrt

from semi_analytical.stress import subsurface
from slipstick import Body, CoulombFriction, Cylinder, Layer, LoadStep, Scene, solve

PROMISE = 1e-5  # relative error of the peak pressure on 1024 strips, the default

STEEL = {"young_modulus": "210 GPa", "poisson_ratio": 0.3}
HARD = {"young_modulus": "420 GPa", "poisson_ratio": 0.25}

bare = Scene(
    indenter=Cylinder(radius="18 mm", material=STEEL, reference_length="20 mm"),
    body=Body(material=STEEL),
    friction=CoulombFriction(coefficient=0.3),
    loading=[
        LoadStep(normal_force="1 kN/mm"),
        LoadStep(tangential_force=("150 N/mm", 0.0)),
    ],
)
pressed, pushed = solve(bare).steps
R = 18e-3
W = 1e6
modulus = 210e9 / (1 - 0.3**2) / 2
a = sqrt(4 * W * R / (pi * modulus))
error = pressed.peak_pressure / (2 * W / (pi * a)) - 1
print(f"half width {pressed.contact_radius * 1e3:.4f} mm, Hertz {a * 1e3:.4f} mm")
print(f"peak pressure off by {error:+.1e}")
print(f"stick half width {pushed.stick_radius / a:.4f} a, Cattaneo {sqrt(0.5):.4f} a")
print(f"shift {pushed.tangential_shift[0] * 1e6:.4f} µm")

coated = bare.replace(
    {"body": Body(material=STEEL, layers=[Layer(thickness=a / 2, material=HARD)])}
)
result = solve(coated)
end = result.steps[0]
print(f"coated: half width {end.contact_radius / a:.4f} a, {end.peak_pressure / 1e6:.1f} MPa")
depths = [a * n / 20 for n in range(31)]
found = subsurface(coated, result.grid, end.pressure, None, depths)
xx, _, zz, *_ = found.below()[1].T
shear, depth = max(zip(abs(xx - zz) / 2, depths, strict=True))
print(f"largest shear stress on the axis {shear / 1e6:.0f} MPa at {depth / a:.2f} a")

if abs(error) > PROMISE:
    raise SystemExit(f"error {error:+.1e} exceeds the promised {PROMISE:.0e}")
