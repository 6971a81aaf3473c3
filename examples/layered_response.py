"""A coating in an external FFT contact code: only the response of one wavenumber changes.

python examples/layered_response.py

The substitute for the external code is a periodic contact solver in numpy. It fails if its contact
of a rigid ball with a coated body differs from `radial` by more than the period explains.
"""

from pathlib import Path

import numpy as np

from semi_analytical.frf.stack import Stack
from semi_analytical.frf.surface import scalars
from slipstick import load_scene, solve

CELLS = 256  # along a window of 12 contact radii
ALLOWED = 1e-2  # relative error of pressure and radius


def response(layers, base, wavenumbers):
    """Normal displacement per unit pressure [m/Pa]; 0 for the mean.

    layers  (shear modulus [Pa], Poisson's ratio, thickness [m]), outermost first
    base    (shear modulus [Pa], Poisson's ratio)
    """
    out = np.zeros_like(wavenumbers)
    out[wavenumbers > 0] = scalars(Stack(layers, base), wavenumbers[wavenumbers > 0]).c22
    return out


def press(gap, area, force, compliance):
    """Pressure of the external code: projected conjugate gradients (Polonsky and Keer 1999)."""
    p, direction, before = np.full_like(gap, force / area / gap.size), np.zeros_like(gap), 1.0

    def displace(t):
        return np.fft.irfft2(compliance * np.fft.rfft2(t), s=t.shape)

    for _ in range(400):
        g = displace(p) + gap
        touching = p > 0
        g -= g[touching].mean()
        norm = np.sum(g[touching] ** 2)
        direction = np.where(touching, g + norm / before * direction, 0)
        before, pull = norm, displace(direction)
        pull -= pull[touching].mean()
        step = np.sum(g[touching] * direction[touching]) / np.sum(pull * direction)
        p = np.maximum(p - step * direction, 0)
        overlap = (p == 0) & (g < 0)
        p[overlap] -= step * g[overlap]
        if overlap.any():
            before, direction = 1.0, np.zeros_like(gap)
        p *= force / (area * p.sum())
        if np.sqrt(norm / touching.sum()) < 1e-8 * gap.max():
            break
    return p


if __name__ == "__main__":
    scene = load_scene(Path(__file__).parents[1] / "scenes" / "coated_ball.toml")
    (layer,), steel = scene.body.layers, scene.body.material
    known = solve(scene, "radial").steps[-1]
    side = 12 * known.contact_radius
    h = side / CELLS
    x = (np.arange(CELLS) - CELLS / 2) * h
    gap = (x[:, None] ** 2 + x**2) / (2 * scene.indenter.radius)
    k = np.hypot(
        2 * np.pi * np.fft.fftfreq(CELLS, h)[:, None], 2 * np.pi * np.fft.rfftfreq(CELLS, h)
    )
    film = (layer.material.shear_modulus, layer.material.poisson_ratio, layer.thickness)
    base = (steel.shear_modulus, steel.poisson_ratio)
    p = press(gap, h * h, scene.loading[0].normal_force, response([film], base, k))
    radius = np.sqrt((p > 0).sum() / np.pi) * h
    errors = abs(p.max() / known.peak_pressure - 1), abs(radius / known.contact_radius - 1)
    print(f"peak pressure {p.max() / 1e9:.4f} GPa, radius {radius * 1e3:.4f} mm, errors {errors}")
    if max(errors) > ALLOWED:
        raise SystemExit("the coated contact differs from the reference")
