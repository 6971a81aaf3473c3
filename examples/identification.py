"""Film modulus from an indentation curve, and friction coefficient from a loop, by least squares.

Run it with `python examples/identification.py`. Replace the two synthetic measurements by your own
tables. The model is the solver `radial`, 70 ms for the curve and 500 ms for the loop. The script
states how much the numerical errors may change each result. It fails if a true value lies outside
four standard deviations and the numerical error.
"""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

from slipstick import Scene, load_scene, solve, stated_errors

NOISE = 0.002  # of the measured values: the standard deviation
draw = np.random.default_rng(3)


def identified(name, unit, solved, values, measured, scale, first, truth):
    """Fit the logarithm of one parameter, and print it with both errors.

    solved    from the parameter to the result
    values    from the result, or from its stated errors, to what was measured (n,)
    scale     of the scatter of the measurement
    """

    def residuals(logarithm):
        return (values(solved(np.exp(logarithm[0])).steps) - measured) / scale

    fit = least_squares(residuals, [np.log(first)], diff_step=1e-3, xtol=1e-4)
    value, slope = np.exp(fit.x[0]), fit.jac[:, 0]
    scatter = np.sqrt(np.sum(fit.fun**2) / (len(measured) - 1))
    deviation = value * scatter / np.sqrt(slope @ slope)
    # The largest change of the result if every value changes within its numerical error.
    errors = values(stated_errors(solved(value)).steps) / scale
    numerical = value * np.sum(np.abs(slope * errors)) / (slope @ slope)
    print(
        f"{name}: {value:.4g}{unit} ± {deviation:.2g}{unit} (one standard deviation), "
        f"numerical error {numerical:.1g}{unit}, true value {truth:.4g}{unit}"
    )
    if abs(value - truth) > 4 * deviation + numerical:
        raise SystemExit(f"{name}: the true value is outside the bars")


def numbers(steps, name):
    """A scalar at the ends of load steps, along x of a vector; of stated errors its error."""
    found = [s[name].error if isinstance(s, Mapping) else getattr(s, name) for s in steps]
    return np.array([value if np.ndim(value) == 0 else value[0] for value in found])


# 1. A ball on a film: the approach at eight loads.
film = Scene.model_validate(
    {
        "indenter": {"shape": "sphere", "radius": "0.2 mm", "material": "rigid"},
        "body": {
            "material": {"young_modulus": "210 GPa", "poisson_ratio": 0.3},
            "layers": [
                {
                    "thickness": "4 um",
                    "material": {"young_modulus": "300 GPa", "poisson_ratio": 0.25},
                }
            ],
        },
        "loading": [{"normal_force": float(force)} for force in np.geomspace(0.05, 2.0, 8)],
    }
)


def indented(modulus):
    """The curve for a modulus in GPa."""
    return solve(film.replace({"body.layers[1].material.young_modulus": modulus * 1e9}), "radial")


def approaches(steps):
    """At the ends of all load steps [m]."""
    return numbers(steps, "approach")


exact = approaches(indented(450.0).steps)
curve = exact * (1 + NOISE * draw.normal(size=len(exact)))
identified("film modulus", " GPa", indented, approaches, curve, curve, first=300.0, truth=450.0)

# 2. A loop of tangential force over a prescribed shift.
shifts = [0.3, 0.6, 0.8, 0.4, 0.0, -0.4, -0.8]
loop = load_scene(Path(__file__).parents[1] / "scenes" / "fretting_loop.toml").replace(
    {
        "loading": [
            {"normal_force": "1 kN"},
            *({"tangential_shift": [1e-6 * shift, 0], "increments": 3} for shift in shifts),
        ]
    }
)


def pushed(mu):
    """The loop for a coefficient of friction."""
    return solve(loop.replace({"friction.coefficient": float(mu)}), "radial")


def forces(steps):
    """Tangential forces at the ends of the load steps but the first [N]."""
    return numbers(steps[1:], "tangential_force")


exact = forces(pushed(0.1).steps)
height = float(np.max(exact))
measured = exact + NOISE * height * draw.normal(size=len(exact))
identified("friction", "", pushed, forces, measured, height, first=0.15, truth=0.1)
