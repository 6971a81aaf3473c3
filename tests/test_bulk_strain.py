"""Tests of a bulk strain of the lower body: slip, work and stress, with all solvers."""

from dataclasses import replace

import numpy as np
import pytest

import fem_reference
import radial
import semi_analytical
from contact_results.stress.below_contact import body_response
from contact_results.stress.loaded_bodies import state_of_result
from contact_scene import FiniteElementDiscretisation, RadialDiscretisation, Scene
from contact_scene.bulk_strain import strain_under, stress_by
from semi_analytical.grid import SurfaceGrid
from semi_analytical.operator.domain import WINDOW
from semi_analytical.plan import plan
from semi_analytical.plan import plan as plan_of_cells

HARD = {"young_modulus": "420 GPa", "poisson_ratio": 0.25}
STEEL = {"young_modulus": "210 GPa", "poisson_ratio": 0.3}
COATED = {"material": STEEL, "layers": [{"thickness": "0.2 mm", "material": HARD}]}
PRESS = {"normal_force": "1 kN"}
STRAIN = 3e-4


def scene(*loading, body=None, friction=0.1, indenter=None):
    return Scene(
        indenter={"shape": "paraboloid", "radius": "18 mm", "material": indenter or HARD},
        body=body or {"material": HARD},
        friction=None if friction is None else {"coefficient": friction},
        loading=loading,
    )


def on_cells(contact, cells=20, symmetry=None, edge="off"):
    grid, decided = SurfaceGrid((cells, cells), (1.2e-3, 1.2e-3)), plan(contact, edge=edge)
    if symmetry is not None:
        decided = replace(decided, symmetry=symmetry)
    return semi_analytical.solve(contact, grid, 1e-9, plan=decided)


def on_elements(contact):
    return fem_reference.solve(contact, FiniteElementDiscretisation(elements_per_radius=8))


def on_rings(contact):
    return radial.solve(contact, RadialDiscretisation(rings=8, tolerance=1e-8))


def test_cells_balance_any_strain_out_of_phase_and_need_no_whole_window():
    alike = (
        {"tangential_force": ("60 N", 0), "increments": 3},
        {"bulk_strain": (2e-4, -1e-4, 0), "increments": 3},
        {"tangential_force": ("-60 N", 0), "increments": 4},
    )
    sheared = ({"bulk_strain": (0, 0, 2e-4), "twist": 2e-4, "increments": 4},)
    for steps in (alike, sheared):
        for body in ({"material": HARD}, COATED):
            contact = scene({**PRESS, "increments": 2}, *steps, body=body)
            reduced, whole = on_cells(contact), on_cells(contact, symmetry=WINDOW)
            assert plan_of_cells(contact).symmetry != WINDOW or body is COATED
            for one, other in zip(reduced.increments, whole.increments, strict=True):
                assert one.energy_imbalance < 1e-9
                assert one.shear == pytest.approx(other.shear, abs=1e-6 * np.max(one.pressure))
                assert one.dissipated_energy == pytest.approx(other.dissipated_energy, rel=1e-6)
            assert reduced.steps[-1].dissipated_energy > 1e-7


def test_a_shear_strain_is_the_same_along_both_axes():
    along_x, along_y = on_cells(scene(PRESS, {"bulk_strain": (0, 0, 2e-4)})).steps[-1].shear
    assert pytest.approx(along_x, abs=1e-6 * np.max(along_x)) == along_y.T
    assert np.max(along_x) > 1e6


def test_a_stress_is_the_strain_of_a_free_specimen_and_counts_from_the_touch():
    given = (84e6, -42e6, 16.8e6)
    for body in (scene(PRESS).body, scene(PRESS, body=COATED).body):
        strain = strain_under(given, body.material)
        xx, yy, zz, yz, xz, xy = stress_by(strain, body, len(body.layers))
        assert (xx, yy, xy, zz, yz, xz) == pytest.approx((*given, 0, 0, 0))
    stressed, strained = (
        on_cells(scene(PRESS, {**by, "increments": 1})).steps[-1]
        for by in (
            {"bulk_stress": ("84 MPa", "42 MPa", "16.8 MPa")},
            {"bulk_strain": (1.75e-4, 0.5e-4, 0.5e-4)},
        )
    )
    assert tuple(stressed.bulk_strain) == pytest.approx((1.75e-4, 0.5e-4))
    assert stressed.shear == pytest.approx(strained.shear)
    again = {"normal_force": "1 kN", "increments": 1}
    apart = ({"normal_force": 0, "bulk_strain": (STRAIN, 0, 0)}, again)
    end = on_cells(scene(PRESS, *apart)).steps[-1]
    assert tuple(end.bulk_strain) == (STRAIN, 0)
    assert not np.any(end.shear)


@pytest.mark.parametrize(
    "solve",
    [
        on_cells,
        on_rings,
        on_elements,
    ],
)
def test_the_stress_below_has_that_of_the_strain_layer_by_layer(solve):
    """Without friction the pressure does not change, and the stress by the strain is added."""
    stretch = {"bulk_strain": (STRAIN, STRAIN, 0.0), "increments": 1}
    contact = scene(PRESS, stretch, body=COATED, friction=None, indenter="rigid")
    result = solve(contact)
    plain, strained = (body_response(state_of_result(result, step)).stress() for step in (1, 2))
    for name in ("section", "axis"):
        added = getattr(strained, name).stress - getattr(plain, name).stress
        for layer, (E, nu) in enumerate(((420e9, 0.25), (210e9, 0.3))):
            inside = getattr(plain, name).material == layer
            expected = np.array([1.0, 1.0, 0, 0, 0, 0]) * E / (1 - nu) * STRAIN
            assert np.any(inside)
            # The pressures of both steps may differ in the last bit.
            near = 1e-6 * expected[0]
            assert np.ptp(added[:, inside], axis=1) == pytest.approx(0, abs=near)
            assert np.mean(added[:, inside], axis=1) == pytest.approx(expected, abs=near)
