"""Our own method through the same door, each time without what an earlier run has left on disk."""

from __future__ import annotations

from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Rigid,
    Scene,
)
from semi_analytical import SurfaceGrid, plan, solve
from semi_analytical.stress.field import subsurface
from verification.peers.drivers.exchange import Answer, Request, answer
from verification.running.cold_cache import cold_cache


def scene_of(request: Request) -> Scene:
    """Its scene: the ball is of the body's material, so that nothing couples, but rigid on a
    coating."""
    nu = request["poisson_ratio"]

    def elastic(modulus: float) -> IsotropicMaterial:
        """By the plane-strain modulus E/(1 - ν²)."""
        return IsotropicMaterial(young_modulus=modulus * (1 - nu**2), poisson_ratio=nu)

    alike = elastic(2 * request["modulus"])
    ball: IsotropicMaterial | Rigid = alike
    body = Body(material=alike)
    if request["coating"]:
        ratio, thickness = request["coating"]
        layer = Layer(thickness=thickness, material=elastic(ratio * request["modulus"]))
        ball, body = RIGID, Body(material=elastic(request["modulus"]), layers=(layer,))
    pressing, pushing = request["increments"]
    loading = [LoadStep(normal_force=request["force"], increments=pressing)]
    if request["tangential_force"]:
        push = (request["tangential_force"], 0.0)
        loading.append(LoadStep(tangential_force=push, increments=pushing))
    friction = request["friction"]
    return Scene(
        indenter=Paraboloid(radius=request["radius"], material=ball),
        body=body,
        friction=CoulombFriction(coefficient=friction) if friction else None,
        loading=tuple(loading),
    )


def solve_request(request: Request) -> Answer:
    """Pressure and shear, and the stress where depths are asked for."""
    n = request["cells"]
    scene, grid = scene_of(request), SurfaceGrid((n, n), (request["window"],) * 2)
    decided = plan(scene, edge="last" if request.get("edges") else "off")
    result = solve(scene, grid, request["tolerance"], plan=decided)
    end = result.steps[-1]
    if request["depths"]:
        subsurface(scene.body, result.grid, end.pressure, end.shear, request["depths"])
    return {
        "version": None,
        "pressure": end.pressure,
        "shear": end.shear,
        "approach": end.approach,
        "iterations": sum(increment.convolutions for increment in result.increments),
        "converged": True,
    }


if __name__ == "__main__":
    answer(solve_request, around=cold_cache)
