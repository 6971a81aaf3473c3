"""Driver of aspher: nested grids with FFT and FFT preconditioner; friction by its load stepping."""

from __future__ import annotations

from importlib import import_module

from verification.peers.drivers.exchange import Answer, Request, answer, gap_of

COARSEST = 16


def solve(request: Request) -> Answer:
    """Solve a contact with aspher; return pressure, approach and, with friction, the shear
    tractions.
    """
    aspher = import_module("aspher")
    n, side = request["cells"], request["window"]
    load = request["force"] / side**2
    gap = gap_of(request).ravel()
    if not request["friction"]:
        found = aspher.solve_nested(
            grid_size=n, gap=gap, p_nominal=load, domain_size=side, E_star=request["modulus"],
            coarsest=min(COARSEST, n // 2), backend="fft", precond_engine="fft",
            tol=request["tolerance"],
        )  # fmt: skip
        return {
            "pressure": found.pressure.reshape(n, n),
            "shear": None,
            "approach": float(found.approach),
            "converged": found.status == "converged" or bool(getattr(found, "converged", False)),
        }
    solver = aspher.FrictionSolver(
        grid_size=n, domain_size=side, E_star=request["modulus"], nu=0.0,
        model=aspher.CoulombFriction(request["friction"]), precond=True,
    )  # fmt: skip
    solver.set_gap(gap)
    pressed = solver.step(p_bar=load)
    forces = request.get("tangential_forces") or [request["tangential_force"]]
    shears = []
    for force in forces:
        step = solver.step(q_bar=(force / side**2, 0.0), dt=1.0)
        shears.append([step.qx.reshape(n, n), step.qy.reshape(n, n)])
        if not step.converged:
            break
    return {
        "pressure": solver.pressure.reshape(n, n),
        "shear": shears if "tangential_forces" in request else shears[-1],
        "approach": float(pressed.approach),
        "converged": bool(step.converged),
    }


if __name__ == "__main__":
    answer(solve, "aspher")
