"""Solves by finite elements with Coulomb's law at points, as part of a case."""

from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    FiniteElementDiscretisation,
    IsotropicMaterial,
    LoadStep,
    Paraboloid,
    Scene,
)
from fem_reference import Path, solve
from verification.cases.fem_harmonics_run import PointsRun

SCENE = Scene(
    title="Rigid ball pressed and pushed",
    indenter=Paraboloid(radius=18e-3, material=RIGID),
    body=Body(material=IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)),
    friction=CoulombFriction(coefficient=0.3),
    loading=(
        LoadStep(normal_force=1e3, increments=2),
        LoadStep(tangential_force=(100.0, 0.0), increments=2),
    ),
)
MESH = FiniteElementDiscretisation(elements_per_radius=8, harmonics=3)


def factorizations(result) -> list[int]:
    return [increment.factorizations for increment in result.increments]


def test_run_at_points_counts_the_factorisations_of_its_solve() -> None:
    """Of every harmonic, once for both sets of points, whether it is in the cache or not."""
    alone = solve(SCENE, MESH)
    assert alone.plan.path is Path.HARMONICS
    run = PointsRun("ball", SCENE, MESH)
    first, again = run.solve(), run.solve()
    assert sum(factorizations(alone)) > 0
    assert factorizations(first) == factorizations(again) == factorizations(alone)
