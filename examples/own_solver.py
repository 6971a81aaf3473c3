"""A solver of one's own, judged: Love's half-space and conjugate gradients, in numpy alone.

python examples/own_solver.py
"""

import sys

import numpy as np

from verification import Answer, CannotDo, Field, judge


def love(x, y):
    """Integral of 1/r over the cell corners that x and y hold."""
    return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))


def modulus(scene):
    """E* of both bodies [Pa]."""
    ball, body = scene.get("indenter", {}), scene["body"]
    if body["layers"] or ball.get("shape") != "paraboloid" or ball["material"] == "rigid":
        raise CannotDo("elastic balls on homogeneous bodies only")
    if scene["loading"][0]["tilt"]:
        raise CannotDo("no tilt")
    pair = [ball["material"], body["material"]]
    return 1 / sum((1 - m["poisson_ratio"] ** 2) / m["young_modulus"] for m in pair)


def solve(problem, level):
    """Pressure under the first load on 32, 64, … cells a side."""
    n, e_star = 32 * 2**level, modulus(problem.scene)
    h = problem.window / n
    x = (np.arange(n) + 0.5) * h - problem.window / 2
    gap = (x[:, None] ** 2 + x[None, :] ** 2) / (2 * problem.scene["indenter"]["radius"])
    k = (np.fft.fftfreq(2 * n) * 2 * n)[:, None] * h
    lo, hi = k - h / 2, k + h / 2
    corners = love(hi, hi.T) - love(lo, hi.T) - love(hi, lo.T) + love(lo, lo.T)
    spectrum = np.fft.fft2(corners / (np.pi * e_star))

    def displace(p):
        padded = np.fft.ifft2(spectrum * np.fft.fft2(p, (2 * n, 2 * n)))
        return padded.real[:n, :n]

    load = problem.loads[0][0] / h**2
    p = np.full((n, n), load / n**2)
    direction, before = np.zeros_like(p), 1.0
    for _ in range(500):  # Polonsky and Keer 1999
        touching = p > 0
        g = displace(p) + gap
        g -= g[touching].mean()
        norm = np.sum(g[touching] ** 2)
        direction = np.where(touching, g + norm / before * direction, 0)
        before = norm
        pull = displace(direction)
        pull -= pull[touching].mean()
        step = np.sum(g[touching] * direction[touching]) / np.sum((pull * direction)[touching])
        p = np.maximum(p - step * direction, 0)
        overlap = (p == 0) & (g < 0)
        p[overlap] -= step * g[overlap]
        if overlap.any():
            before, direction = 1.0, np.zeros_like(p)
        p *= load / p.sum()
        if np.sqrt(norm) < 1e-10 * n * np.abs(gap).max():
            break
    touching = p > 0
    approach = (displace(p) + gap)[touching].mean()
    radius = np.sqrt(touching.sum() * h**2 / np.pi)
    xs, ys = (part[touching] for part in np.meshgrid(x, x, indexing="ij"))
    field = Field(xs, ys, p[touching], np.full(xs.size, h**2))
    values = {("approach", 1): approach, ("contact_radius", 1): radius}
    return Answer(h, values, {("pressure", 1): field}, unknowns=n * n)


if __name__ == "__main__":
    judgement = judge("hertz_point", solve, at_least="C")  # errors of at most 1 %
    print(judgement.line)
    for row in judgement.rows:
        print(f"  {row.status:12} {row.quantity:24} {row.error or 0:.1e}  {row.because}")
    sys.exit(judgement.exit_code())
