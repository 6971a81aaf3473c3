"""Film modulus from an indentation curve, by least squares.

Run it with `python examples/identification.py`. Replace the synthetic measurement by your own
table. The model is the solver `radial`, 70 ms for the curve. The script states how much the
numerical errors may change the modulus. It fails if the true value lies outside four standard
deviations and the numerical error. `slipstick against --fit` fits inputs to a loop or a profile.
"""

import numpy as np
from scipy.optimize import least_squares

from slipstick import Scene, solve, stated_errors

TRUTH = 450.0  # film modulus [GPa]
FIRST = 300.0  # first value of the search
NOISE = 0.002  # standard deviation of the measured approaches, relative to each

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
    """The result for a film modulus [GPa]."""
    return solve(film.replace({"body.layers[1].material.young_modulus": modulus * 1e9}), "radial")


def approaches(result):
    """Approaches at the ends of all load steps [m]."""
    return np.array([step.approach for step in result.steps])


exact = approaches(indented(TRUTH))
measured = exact * (1 + NOISE * np.random.default_rng(3).normal(size=len(exact)))


def residuals(logarithm):
    """Relative differences of the approaches for the logarithm of the modulus."""
    return approaches(indented(np.exp(logarithm[0]))) / measured - 1


fit = least_squares(residuals, [np.log(FIRST)], diff_step=1e-3, xtol=1e-4)
modulus = float(np.exp(fit.x[0]))
slopes = fit.jac[:, 0]
scatter = np.sqrt(np.sum(fit.fun**2) / (len(measured) - 1))
deviation = modulus * scatter / np.linalg.norm(slopes)
# The largest change of the modulus if every approach changes within its numerical error.
errors = [step["approach"].error for step in stated_errors(indented(modulus)).steps]
numerical = modulus * np.sum(np.abs(slopes * errors / measured)) / (slopes @ slopes)
print(
    f"film modulus: {modulus:.4g} GPa ± {deviation:.2g} GPa (one standard deviation), "
    f"numerical error {numerical:.1g} GPa, true value {TRUTH:g} GPa"
)
if abs(modulus - TRUTH) > 4 * deviation + numerical:
    raise SystemExit("the true value is outside the bars")
