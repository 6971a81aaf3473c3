"""Critical loads of a ball on bare and on coated steel: which limit is met first, and where.

Run it with `python examples/critical_load.py`. It fails if the first yield of the bare steel misses
the closed form of Hertz theory by more than its stated error.
"""

from math import pi

from slipstick import (
    Body,
    InterfaceStrength,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
    SurfaceDiscretisation,
    critical_loads,
)

R = 10e-3
W = 500.0
YIELD = 1.5e9
BALL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3, yield_strength=YIELD)
HARD = IsotropicMaterial(young_modulus=400e9, poisson_ratio=0.25, tensile_strength=0.8e9)
BOND = InterfaceStrength(shear=0.4e9)

bare = Scene(
    indenter=Paraboloid(radius=R, material=BALL),
    body=Body(material=STEEL),
    loading=(LoadStep(normal_force=W),),
)
film = Layer(thickness=80e-6, material=HARD, interface_strength=BOND)
coated = bare.model_copy(update={"body": Body(material=STEEL, layers=(film,))})
cells = SurfaceDiscretisation(cells=(64, 64))


def report(name, scene):
    """Print the critical loads of a scene, the smallest first, and return the first."""
    limits = critical_loads(scene, discretisation=cells).limits
    for one in limits:
        print(f"{name:7} {one.measure:16} of {one.region:12}", end="")
        if one.load_factor is None:
            print(f"> {one.below:.0f} W")
            continue
        error = float(one.error.error)
        print(f"{one.load_factor:.4f} ± {error:.2g} W at a depth of {one.place[2] * 1e6:.0f} µm")
    return limits[0]


first = report("bare", bare)
report("coated", coated)

# First yield for nu = 0.3 is below the surface, at p0 = 1.6128 Y (Johnson 1985, section 4.5).
modulus = BALL.plane_strain_modulus / 2
exact = (1.6128 * YIELD * pi) ** 3 * R**2 / (6 * modulus**2) / W
if abs(first.load_factor - exact) > float(first.error.error):
    raise SystemExit(f"the first yield is at {first.load_factor} W, expected {exact} W")
