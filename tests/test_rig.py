"""Tests of the springs of a test rig in series with the contact, in all solvers, and their
energies."""

import pytest

import fem_reference
import radial
import semi_analytical
from contact_results.cycles import fretting_cycles
from contact_scene import (
    FiniteElementDiscretisation,
    IsotropicMaterial,
    RadialDiscretisation,
    Scene,
)
from contact_scene.quantities.increment import numbers
from semi_analytical.grid import SurfaceGrid
from semi_analytical.plan import plan

TOLERANCE = 1e-10
SAME = IsotropicMaterial(young_modulus=461.538461538e9, poisson_ratio=0.0)
STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)


def scene(*loading, rig=None, body=SAME):
    return Scene(
        indenter={"shape": "paraboloid", "radius": "18 mm", "material": SAME},
        body={"material": body},
        friction={"coefficient": 0.1},
        rig=rig,
        loading=loading,
    )


def on_cells(contact, cells=32):
    grid = SurfaceGrid((cells, cells), (1.2e-3, 1.2e-3))
    return semi_analytical.solve(contact, grid, TOLERANCE, plan=plan(contact))


def on_elements(contact):
    fine = FiniteElementDiscretisation(
        elements_per_radius=8, tolerance=TOLERANCE, contact_radius="0.4 mm"
    )
    return fem_reference.solve(contact, fine)


def on_rings(contact):
    return radial.solve(contact, RadialDiscretisation(tolerance=1e-9))


SOLVERS = pytest.mark.parametrize("solve", [on_cells, on_elements, on_rings])


def steps(shifts):
    return [{"tangential_shift": (float(shift), 0.0), "increments": 4} for shift in shifts]


@SOLVERS
@pytest.mark.parametrize("body", [SAME, STEEL])
def test_a_contact_below_a_normal_spring_is_the_contact_at_its_own_approach(solve, body):
    rig = {"normal_stiffness": "40 N/um"}
    through = solve(scene({"approach": "30 um", "increments": 1}, rig=rig, body=body)).steps[-1]
    alone = solve(scene({"approach": through.approach, "increments": 1}, body=body)).steps[-1]
    # Coupled bodies pass the increment by radii, which the spring changes by round-off.
    assert through.normal_force == pytest.approx(alone.normal_force, rel=1e-7)
    for name in ("elastic_energy", "input_work"):
        found, known = numbers(through)[name], numbers(alone)[name]
        assert (found is None) == (known is None)
        assert found is None or found == pytest.approx(known, rel=1e-6), name
    own = through.approach + through.normal_force / 40e6
    assert through.actuator_approach == pytest.approx(own, rel=1e-9)


def test_separated_bodies_have_the_position_of_the_actuator():
    apart = scene(
        {"normal_force": "1 kN"},
        {"tangential_shift": ("1 um", 0), "increments": 1},
        {"normal_force": 0, "tangential_shift": (0, 0), "increments": 2},
        rig={"tangential_stiffness": "50 N/um", "normal_stiffness": "90 N/um"},
    )
    last = on_cells(apart).steps[-1]
    assert tuple(last.actuator_shift) == tuple(last.tangential_shift) == (0, 0)
    assert last.actuator_approach == last.approach == 0


@pytest.mark.parametrize(
    ("amplitude", "regime", "share"),
    [(1e-10, "stick", 1e-2), (0.6e-6, "partial slip", 0.5), (3e-6, "gross slip", 4.0)],
)
def test_the_regime_of_a_loop_follows_its_amplitude(amplitude, regime, share):
    """At gross slip the work exceeds that of Mindlin's loop; 5 E_d/4Q*δ is below 5."""
    once = steps((amplitude, -amplitude, amplitude, -amplitude))
    result = on_cells(scene({"normal_force": "1 kN"}, *once))
    first, second = (cycle.numbers for cycle in fretting_cycles(result))
    assert first["from_virgin"]
    assert not second["from_virgin"]
    assert first["regime"] == second["regime"] == regime
    assert (first["gross_slip_share"] > 1) == (regime == "gross slip")
    assert first["gross_slip_share"] < share
    assert first["shift_amplitude"] == pytest.approx(amplitude)
    assert first["energy_ratio"] == pytest.approx(first["gross_slip_share"] / 5)
    assert first["actuator_amplitude"] is None
