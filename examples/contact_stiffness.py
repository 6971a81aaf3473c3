"""Contact stiffness of a ball: with and without a hard coating, and at a load reversal.

Run it with `python examples/contact_stiffness.py`. It fails if a stiffness misses Hertz or Mindlin
by more than its stated error.
"""

from slipstick import (
    Body,
    CoulombFriction,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Scene,
    Sphere,
    SurfaceDiscretisation,
    solve,
    stated_errors,
)

STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
HARD = IsotropicMaterial(young_modulus=400e9, poisson_ratio=0.25)
R = 10e-3
W = 50.0
MU = 0.3

bare = Scene(
    indenter=Sphere(radius=R, material=STEEL),
    body=Body(material=STEEL),
    friction=CoulombFriction(coefficient=MU),
    loading=(
        LoadStep(normal_force=W, increments=4),
        LoadStep(tangential_force=(0.6 * MU * W, 0.0), increments=2),
        LoadStep(tangential_force=(0.59 * MU * W, 0.0), increments=1),
    ),
    contact_stiffness=True,
)
film = Body(material=STEEL, layers=(Layer(thickness=20e-6, material=HARD),))
cells = SurfaceDiscretisation(cells=(64, 64))


def report(name, scene):
    """Print the stiffnesses at the end of each step, and return the first with their errors."""
    result = solve(scene, discretisation=cells)
    errors = stated_errors(result).steps
    print(f"{name}: dW/dδ and dT/dδ in N/µm")
    for when, end, error in zip(
        ("pressed", "pushed", "pulled back"), result.steps, errors, strict=True
    ):
        texts = (
            f"{getattr(end, one) / 1e6:8.3f} ± {float(error[one].error) / 1e6:.3f}"
            for one in ("normal_stiffness", "tangential_stiffness")
        )
        print(f"  {when:12}", *texts)
    return result.steps[0], errors[0]


end, error = report("bare", bare)
report("coated", bare.model_copy(update={"body": film}))

E = STEEL.plane_strain_modulus / 2
G = STEEL.shear_modulus
a = (3 * W * R / 4 / E) ** (1 / 3)
exact = {"normal_stiffness": 2 * E * a, "tangential_stiffness": 4 * G * a / (2 - 0.3)}
for name, value in exact.items():
    off = abs(getattr(end, name) - value)
    # The arc of the sphere differs from Hertz's paraboloid by (a/R)².
    if off > float(error[name].error) + (a / R) ** 2 * value:
        raise SystemExit(f"{name} is off by {off:.3g} N/m")
