"""Coupled increments: laws of symmetry and scale, energy, limits, and what they cost others."""

import subprocess
import sys
from dataclasses import replace
from itertools import groupby, pairwise
from pathlib import Path

import numpy as np
import pytest
from contact_scenes import APPROACH, LIMIT, MU, RADIUS, grid, paraboloid
from contact_scenes import scene as alike_scene
from coupled_scenes import (
    SUBSTRATE,
    bulk,
    coated,
    coupled_increments,
    press,
    push,
    scene,
)

from contact_scene import RIGID, Body, IsotropicMaterial, Layer, Paraboloid
from contact_scene.summary import ContactStatus
from semi_analytical import GrossSliding, SurfaceGrid, coupled_increment, solve
from semi_analytical.box import Box, box_around
from semi_analytical.model import ContactModel
from semi_analytical.operator.domain import QUARTER
from semi_analytical.pressing import MARGIN

TOLERANCE = 1e-8
GRID = grid(32)
HISTORY = (press(), push(0.5, 0.2), push(-0.3, 0.1))


def last(described, on=GRID, tolerance=1e-10):
    return solve(described, on, tolerance).increments[-1]


def turned(loading):
    """The loads turned by a quarter: (x, y) -> (-y, x)."""
    return tuple(
        {**step, "tangential_force": (-step["tangential_force"][1], step["tangential_force"][0])}
        if "tangential_force" in step
        else step
        for step in loading
    )


def mirrored(loading):
    """The loads mirrored: x -> -x."""
    return tuple(
        {**step, "tangential_force": (-step["tangential_force"][0], step["tangential_force"][1])}
        if "tangential_force" in step
        else step
        for step in loading
    )


def assert_equal_shear(one, other, pressure, tolerance=1e-6):
    assert np.max(np.abs(one - other)) <= tolerance * MU * np.max(pressure)


def test_a_turned_load_turns_the_answer():
    one, other = last(scene(*HISTORY)), last(scene(*turned(HISTORY)))
    np.testing.assert_allclose(
        other.pressure, np.rot90(one.pressure), atol=1e-6 * one.peak_pressure
    )
    x, y = (np.rot90(component) for component in one.shear)
    assert_equal_shear(other.shear, np.stack([-y, x]), one.pressure)
    x, y = one.tangential_shift
    np.testing.assert_allclose(other.tangential_shift, [-y, x], rtol=1e-7)


def test_a_mirrored_load_mirrors_the_answer():
    one, other = last(scene(*HISTORY)), last(scene(*mirrored(HISTORY)))
    np.testing.assert_allclose(other.pressure, one.pressure[::-1], atol=1e-6 * one.peak_pressure)
    sign = np.array([-1.0, 1.0])[:, None, None]
    assert_equal_shear(other.shear, sign * one.shear[:, ::-1], one.pressure)
    assert other.dissipated_energy == pytest.approx(one.dissipated_energy, rel=1e-7)


def test_pressing_alone_shears_outward_and_equally_to_all_sides():
    """Slip below a rigid ball is inward, so its traction on the body is outward."""
    pressed = last(scene(press(increments=4)))
    x, y = GRID.coordinates()
    outward = pressed.shear[0] * x + pressed.shear[1] * y
    assert np.all(outward[pressed.in_contact] > 0)
    q_x, q_y = pressed.shear
    assert_equal_shear(q_x, q_y.T, pressed.pressure)
    assert_equal_shear(q_x, -q_x[::-1], pressed.pressure)
    np.testing.assert_allclose(pressed.tangential_shift, 0, atol=1e-9 * pressed.approach)


@pytest.mark.parametrize("length", [1e-6, 1e3], ids=["18 nm ball", "18 m ball"])
def test_scaled_lengths_and_moduli_scale_the_answer(length):
    modulus = 3e-4
    body = coated().layers[0]
    scaled = scene(
        *(
            {
                key: (
                    tuple(modulus * length**2 * v for v in value)
                    if key == "tangential_force"
                    else modulus * length**2 * value
                    if key == "normal_force"
                    else value
                )
                for key, value in step.items()
            }
            for step in HISTORY
        ),
        indenter=Paraboloid(radius=length * RADIUS, material=RIGID),
        body=Body(
            material=_softened(SUBSTRATE, modulus),
            layers=(
                Layer(
                    thickness=length * body.thickness, material=_softened(body.material, modulus)
                ),
            ),
        ),
    )
    small = SurfaceGrid(GRID.cells, tuple(length * side for side in GRID.window))
    one, other = last(scene(*HISTORY)), last(scaled, small)
    np.testing.assert_allclose(
        other.pressure, modulus * one.pressure, atol=1e-7 * np.max(other.pressure)
    )
    assert_equal_shear(other.shear, modulus * one.shear, other.pressure)
    assert other.approach == pytest.approx(length * one.approach, rel=1e-9)
    np.testing.assert_allclose(other.tangential_shift, length * one.tangential_shift, rtol=1e-7)


def _softened(material, factor):
    return IsotropicMaterial(
        young_modulus=factor * material.young_modulus, poisson_ratio=material.poisson_ratio
    )


def test_a_split_layer_changes_nothing():
    (layer,) = coated().layers
    halves = [
        Layer(thickness=part * layer.thickness, material=layer.material) for part in (0.3, 0.7)
    ]
    split = Body(material=SUBSTRATE, layers=tuple(halves))
    one, other = last(scene(*HISTORY)), last(scene(*HISTORY, body=split))
    np.testing.assert_allclose(other.pressure, one.pressure, atol=1e-7 * one.peak_pressure)
    assert_equal_shear(other.shear, one.shear, one.pressure)


def test_a_layer_of_the_same_material_is_none():
    plain = Body(material=SUBSTRATE)
    one, other = last(scene(*HISTORY, body=plain)), last(scene(*HISTORY, body=coated(1.0)))
    np.testing.assert_allclose(other.pressure, one.pressure, atol=1e-7 * one.peak_pressure)
    assert_equal_shear(other.shear, one.shear, one.pressure)


def test_alike_bodies_by_the_coupled_solver_are_as_by_the_uncoupled_one():
    described = alike_scene(*HISTORY)
    uncoupled = solve(described, GRID, 1e-11).increments
    coupled = coupled_increments(described, GRID, 1e-11)
    for one, other in zip(uncoupled, coupled, strict=True):
        np.testing.assert_allclose(other.pressure, one.pressure, atol=1e-8 * one.peak_pressure)
        assert_equal_shear(other.shear, one.shear, one.pressure, 1e-8)
        assert other.dissipated_energy == pytest.approx(one.dissipated_energy, rel=1e-8, abs=1e-20)
    assert one.tangential_shift == pytest.approx(other.tangential_shift, rel=1e-8)


def test_swapped_bodies_turn_the_shear_of_pressing_round():
    """Traction on the lower body: outward if that is the elastic one, inward if the other is."""
    soft, stiff = Body(material=SUBSTRATE), Body(material=RIGID)
    on_soft = last(scene(press(), body=soft))
    of_soft = last(scene(press(), body=stiff, indenter=paraboloid(SUBSTRATE)))
    np.testing.assert_allclose(
        of_soft.pressure, on_soft.pressure, atol=1e-7 * on_soft.peak_pressure
    )
    assert_equal_shear(of_soft.shear, -on_soft.shear, on_soft.pressure)


def test_swapped_bodies_answer_an_opposite_push_with_the_opposite_shear():
    soft, stiff = Body(material=SUBSTRATE), Body(material=RIGID)
    on_soft = last(scene(press(), push(0.5), body=soft))
    of_soft = last(scene(press(), push(-0.5), body=stiff, indenter=paraboloid(SUBSTRATE)))
    np.testing.assert_allclose(
        of_soft.pressure, on_soft.pressure, atol=1e-7 * on_soft.peak_pressure
    )
    assert_equal_shear(of_soft.shear, -on_soft.shear, on_soft.pressure)


LOADINGS = {
    "pressing and pushing": (press(increments=5), push(0.6, increments=4)),
    "W and T together": (press(**push(0.5)), {**push(-0.4), **press(0.6, 4)}),
    "unloading": (press(), push(0.4), {**press(0.05, 6), **push(0.0, increments=6)}),
    "shift": (
        press(),
        {"tangential_shift": (0.3 * APPROACH, 0.0), "increments": 5},
        {"tangential_shift": (-0.1 * APPROACH, 0.0), "increments": 5},
    ),
}


def displacement(model, increment):
    """u_t by operators on the whole window, their coupling included."""
    A = model.operator(model.grid.cells)
    return A.tangential(increment.shear) + A.tangential_by_pressure(increment.pressure)


def elastic_energy(model, increment):
    """½ Σ t·u of the tractions."""
    A, p, q = model.operator(model.grid.cells), increment.pressure, increment.shear
    u_z = A.normal(p) + A.normal_by_shear(q)
    u_t = displacement(model, increment)
    return 0.5 * float(np.sum(p * u_z) + np.sum(q * u_t)) * model.grid.cell_area


@pytest.mark.parametrize("body", [coated(2.0), bulk(0.0)], ids=["coated", "nu = 0"])
@pytest.mark.parametrize("loading", LOADINGS.values(), ids=LOADINGS)
def test_work_against_the_tractions_of_the_end_is_stored_or_lost_to_motion(loading, body):
    """First law over one increment, during which the tractions are those of its end.

    Work done at the end forces exceeds storage and friction by the energy of the increment alone,
    ½ Δt·AΔt, and by what closing gaps take: exact, not only for small increments. The motion past
    each other is slip where surfaces touch throughout, and of what meets slip is a part of it.
    """
    described = scene(*loading, body=body)
    model = ContactModel.of(described, GRID)
    cell = GRID.cell_area
    increments = solve(described, GRID, 1e-9).increments
    for before, now in pairwise(increments):
        moved = now.tangential_shift - before.tangential_shift
        pressed = now.approach - before.approach
        pull = np.sum(now.shear, axis=(1, 2)) * cell
        work = now.normal_force * pressed + float(pull @ moved)
        change = replace(
            now, pressure=now.pressure - before.pressure, shear=now.shear - before.shear
        )
        stored = elastic_energy(model, now) - elastic_energy(model, before)
        alone = elastic_energy(model, change)
        closed = float(np.sum(now.pressure * before.gap)) * cell
        passed = displacement(model, now) - displacement(model, before) - moved[:, None, None]
        rubbed = -float(np.sum(now.shear * passed)) * cell
        scale = abs(work) + abs(stored)
        assert work - alone - closed == pytest.approx(stored + rubbed, abs=1e-6 * scale)
        slip, noise = now.slip - before.slip, 1e-6 * np.max(np.abs(passed))
        lasting = (before.pressure > 0) & (now.pressure > 0)
        np.testing.assert_allclose(slip[:, lasting], passed[:, lasting], atol=noise)
        assert np.all(np.hypot(*slip) <= np.hypot(*passed) + noise)
        assert now.dissipated_energy >= before.dissipated_energy


def test_pressing_dissipates():
    """Slip of dissimilar bodies turns work into heat although nothing pushes sideways."""
    pressed = solve(scene(press()), GRID, TOLERANCE).increments
    heat = [increment.dissipated_energy for increment in pressed]
    assert heat[0] > 0
    assert np.all(np.diff(heat) > 0)


def test_force_beyond_the_limit_is_gross_sliding_with_the_limit_named():
    described = scene({"approach": 0.5 * APPROACH, "increments": 2}, push(0.9))
    with pytest.raises(GrossSliding, match=r"90 N exceeds the friction limit 4\d\.\d+ N"):
        solve(described, GRID, TOLERANCE)


def test_force_at_the_limit_slips_all_over_with_the_shift_undefined():
    end = last(scene(press(), push(0.9), push(1.0, increments=1)), tolerance=TOLERANCE)
    assert end.status is ContactStatus.GROSS_SLIDING
    assert end.tangential_shift is None
    assert end.dissipated_energy is None
    np.testing.assert_allclose(end.shear[0], MU * end.pressure, atol=1e-12 * end.peak_pressure)
    assert not np.any(end.shear[1])
    assert end.residuals.worst <= TOLERANCE
    # The shear pulls the pressure with it: full slip is not the state of pressing.
    assert np.max(np.abs(end.pressure - end.pressure[::-1])) > 1e-2 * end.peak_pressure


def test_the_limit_is_the_end_of_sliding_under_shift_control():
    far = {"tangential_shift": (10 * APPROACH, 0.0), "increments": 2}
    slid = last(scene(press(), far), tolerance=TOLERANCE)
    forced = last(scene(press(), push(1.0, increments=1)), tolerance=TOLERANCE)
    assert slid.status is ContactStatus.GROSS_SLIDING
    assert slid.tangential_force[0] == pytest.approx(LIMIT, rel=1e-6)
    np.testing.assert_allclose(slid.pressure, forced.pressure, atol=1e-4 * forced.peak_pressure)


def test_status_tells_partial_slip_from_no_stick_area_from_gross_sliding():
    shift = {"tangential_shift": (APPROACH, 0.0), "increments": 10}
    path = solve(scene(press(), shift, body=bulk()), GRID, TOLERANCE).increments[2:]
    assert [status for status, _ in groupby(increment.status for increment in path)] == [
        ContactStatus.PARTIAL_SLIP,
        ContactStatus.NO_STICK_AREA_LEFT,
        ContactStatus.GROSS_SLIDING,
    ]
    for increment in path:
        assert (increment.stick_area == 0) == (increment.status is not ContactStatus.PARTIAL_SLIP)
    # The force rises all the way: no peak above what sliding takes, and no drop after it.
    force = [increment.tangential_force[0] for increment in path]
    assert np.all(np.diff(force) > 0)
    assert force[-1] == pytest.approx(LIMIT, rel=1e-5)


def test_no_stick_area_is_left_below_the_friction_limit():
    """All cells slip, not all in one direction, so that together they carry less than µW."""
    end = last(scene(press(), push(0.9999, increments=1)), tolerance=TOLERANCE)
    assert end.status is ContactStatus.NO_STICK_AREA_LEFT
    assert np.max(np.abs(end.shear[1])) > 1e-3 * MU * end.peak_pressure
    slips = end.in_contact
    size = np.hypot(*end.shear)[slips]
    np.testing.assert_allclose(size, MU * end.pressure[slips], rtol=1e-9)


UNCALLED = """
import sys
sys.path.insert(0, {tests!r})
from contact_scenes import PRESS, grid, push, scene
import semi_analytical
from semi_analytical.operator import operator
whole = operator.kernel_spectrum
def forbidden(coefficients, pair, reach):
    assert pair not in ("xz", "yz"), "a spectrum of the coupling was built"
    return whole(coefficients, pair, reach)
operator.kernel_spectrum = forbidden
semi_analytical.solve(scene(PRESS, push(0.5), push(-0.5)), grid(16), 1e-8)
semi_analytical.solve(scene(PRESS, friction=None), grid(16), 1e-8)
unwanted = {{
    "semi_analytical.alternation", "semi_analytical.newton_increment",
    "semi_analytical.predictor", "semi_analytical.coupled_increment",
}}
assert not unwanted & set(sys.modules), unwanted & set(sys.modules)
"""


def test_scenes_without_coupling_neither_import_nor_build_it():
    script = UNCALLED.format(tests=str(Path(__file__).parent))
    ran = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False
    )
    assert ran.returncode == 0, ran.stderr


def test_a_box_that_proves_too_small_grows_to_where_bodies_overlap_and_no_farther(monkeypatch):
    described, of = scene(press(increments=1)), grid(96)
    expected = solve(described, of, TOLERANCE).increments[-1]
    boxes = []

    def at_first_too_small(cells, margin, part):
        box = box_around(cells, margin, part)
        if not boxes:
            nx, ny = box.shape
            box = Box(box.first, (nx - 10, ny - 10))
        boxes.append(box)
        return box

    monkeypatch.setattr(coupled_increment, "box_around", at_first_too_small)
    found = solve(described, of, TOLERANCE).increments[-1]
    assert len(boxes) == 2
    assert QUARTER.window(boxes[1].shape) == box_around(expected.pressure > 0, MARGIN).shape
    assert boxes[1].shape < QUARTER.cells(of.cells)
    np.testing.assert_allclose(
        found.pressure, expected.pressure, atol=1e-6 * expected.peak_pressure
    )
    np.testing.assert_allclose(found.shear, expected.shear, atol=1e-6 * expected.peak_pressure)


def test_a_contact_has_room_in_its_box_in_proportion_to_its_width(monkeypatch):
    """On 2048 cells the push of one step moves an edge by more cells than the least margin has."""
    margins = []

    def noted(cells, margin, part):
        margins.append(margin)
        return box_around(cells, margin, part)

    monkeypatch.setattr(coupled_increment, "box_around", noted)
    for cells in (64, 512):
        end = solve(scene(press(increments=1)), grid(cells), TOLERANCE).increments[-1]
        wide = np.count_nonzero(np.any(end.pressure > 0, axis=1))
        assert margins[-1] >= max(MARGIN, 0.03 * wide)
    assert margins[0] == MARGIN


def test_one_cell_that_touches_sticks_and_its_slip_of_round_off_is_none():
    """Its own displacement vanishes by symmetry: what its pressure does around it tells a scale."""
    odd = SurfaceGrid((45, 45), (9 * GRID.window[0], 9 * GRID.window[1]))
    end = last(scene(press(1e-6, increments=2)), odd)
    assert np.count_nonzero(end.in_contact) == 1
    assert end.status is ContactStatus.FULL_STICK
    assert end.halvings == 0
    assert end.residuals.slip_direction < 1e-10


@pytest.mark.parametrize("cells", [25, 29, 33, 35, 49])
def test_a_contact_of_one_or_five_cells_is_an_ordinary_state(cells):
    """The cell in the middle does not slip: its slip is round-off without a direction."""
    body = Body(material=IsotropicMaterial(young_modulus=100e9, poisson_ratio=0.2))
    loads = 50.0 * (np.arange(1, 7) / 50) ** 3  # as the first increments of 50 below 50 N
    described = scene(
        *({"normal_force": load, "increments": 1} for load in loads),
        body=body,
        indenter=Paraboloid(radius=0.01, material=RIGID),
        friction=0.3,
    )
    for width in (336e-6, 338e-6):
        on = SurfaceGrid((cells, cells), (width, width))
        increments = solve(described, on, TOLERANCE).increments
        assert np.count_nonzero(increments[0].in_contact) == 1
        assert np.max(np.abs(increments[0].shear)) < 1e-9 * increments[0].peak_pressure
        assert np.count_nonzero(increments[-1].in_contact) >= 5
