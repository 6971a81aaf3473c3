"""Records of other codes belong to the decks that are written, and are read for what they are."""

import math
from dataclasses import asdict
from itertools import product

import numpy as np
import pytest

from verification.external_codes import coated_scene
from verification.external_codes.calculix_deck import (
    BORE,
    BOX,
    FINE,
    Fineness,
    calculix_deck,
)
from verification.external_codes.calculix_result import read_normal_force, read_tractions
from verification.external_codes.coated_scene import HERTZ, far_displacement
from verification.external_codes.nodal_pressure import up_to_edge
from verification.external_codes.recorded import Recorded, recorded
from verification.external_codes.run_calculix import FINENESSES, SCENES, deck_hash
from verification.problems.coated_ball import ROWS, coated_ball, solved_here

COARSE = Fineness(10, 1000.0)


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.name)
def test_record_is_of_the_decks_that_are_written(scene):
    row = recorded(scene.name).record
    assert {key: row[key] for key in asdict(scene)} == asdict(scene)
    for fineness, run in zip(FINENESSES, row["runs"], strict=True):
        assert (run["elements"], run["stiffness"]) == (fineness.elements, fineness.stiffness)
        assert run["deck_sha256"] == deck_hash(calculix_deck(scene, fineness))


def blocks(deck):
    """Rows of numbers by keyword line."""
    found, rows = {}, []
    for line in deck.splitlines():
        if line.startswith("*"):
            rows = found.setdefault(line, [])
        else:
            rows.append([field.strip() for field in line.split(",")])
    return found


def nodes_and_elements(scene, body):
    found = blocks(calculix_deck(scene, COARSE))
    nodes = {int(n): (float(r), float(z)) for n, r, z in found[f"*NODE, NSET={body}"]}
    return nodes, [list(map(int, row[1:])) for row in found[f"*ELEMENT, TYPE=CAX8, ELSET={body}"]]


@pytest.mark.parametrize(("scene", "body"), [*product(SCENES, ("BODY", "BALL"))])
def test_elements_fill_their_section(scene, body):
    nodes, elements = nodes_and_elements(scene, body)
    area = 0.0
    for element in elements:
        r, z = np.array([nodes[n] for n in element]).T / HERTZ.contact_radius
        around = [0, 4, 1, 5, 2, 6, 3, 7]  # corner and midside in turn, counterclockwise
        twice = r[around] * np.roll(z[around], -1) - z[around] * np.roll(r[around], -1)
        assert twice.sum() > 0
        np.testing.assert_allclose(r[4:], (r[:4] + np.roll(r[:4], -1)) / 2, rtol=1e-9)
        area += twice.sum() / 2
    width = (BOX if body == "BODY" else FINE) - BORE
    height = BOX if body == "BODY" else 1.0
    # the ball's lower side is a parabola, far flatter than this tolerance sees
    assert area == pytest.approx(width * height, rel=1e-4)


def test_far_displacement_is_towards_the_force_at_the_surface():
    nu = coated_scene.POISSON_RATIO
    shear_modulus = coated_scene.SUBSTRATE_MODULUS / (2 * (1 + nu))
    outward, inward = far_displacement(3.0, 0.0)
    force = coated_scene.NORMAL_FORCE / (4 * math.pi * shear_modulus * 3.0)
    assert outward == pytest.approx(-(1 - 2 * nu) * force)
    assert inward == pytest.approx(2 * (1 - nu) * force)


def test_far_displacement_is_in_equilibrium():
    """(1−2ν)∇²u + ∇(∇·u) = 0, by differences."""
    nu, h, r, z = coated_scene.POISSON_RATIO, 1e-2, 2.0, 1.5
    at = {
        (i, j): far_displacement(r + i * h, z + j * h) for i in range(-2, 3) for j in range(-2, 3)
    }

    def divergence(i, j):
        du = (at[i + 1, j][0] - at[i - 1, j][0]) / (2 * h)
        dw = (at[i, j + 1][1] - at[i, j - 1][1]) / (2 * h)
        return du + at[i, j][0] / (r + i * h) + dw

    def laplacian(c):
        across = at[1, 0][c] + at[-1, 0][c] + at[0, 1][c] + at[0, -1][c] - 4 * at[0, 0][c]
        return across / h**2 + (at[1, 0][c] - at[-1, 0][c]) / (2 * h * r)

    outward = (1 - 2 * nu) * (laplacian(0) - at[0, 0][0] / r**2)
    outward += (divergence(1, 0) - divergence(-1, 0)) / (2 * h)
    inward = (1 - 2 * nu) * laplacian(1) + (divergence(0, 1) - divergence(0, -1)) / (2 * h)
    size = abs(laplacian(1))
    assert abs(outward) < 1e-3 * size
    assert abs(inward) < 1e-3 * size


DAT = """
 total force (fx,fy,fz) for set BALL and time  0.5000000E+00

        5.0E-06 -1.000000E-02 -1.2E-22

 total force (fx,fy,fz) for set BALL and time  0.1000000E+01

        5.0E-06 -5.000000E-02 -1.2E-22
"""


def frd_line(number, *values):
    return f" -1{number:10d}" + "".join(f"{value:12.5E}" for value in values)


def frd(pressures):
    """Nodes on the surface from the axis, one below it, and contact stresses at all of them."""
    nodes = [frd_line(n, n * HERTZ.contact_radius, 0.0, 0.0) for n in range(len(pressures))]
    stresses = [frd_line(n, 0, 0, 0, p, 3e-2 * p, 4e-2 * p) for n, p in enumerate(pressures)]
    below = frd_line(99, 0.5 * HERTZ.contact_radius, -1.0, 0.0), frd_line(99, 0, 0, 0, 7.0, 0, 0)
    head = "    2C                             5                                     1"
    contact = " -4  CONTACT     6    1"
    return "\n".join([head, *nodes, below[0], " -3", contact, *stresses, below[1], " -3"])


def test_force_is_the_last_one_of_the_whole_circle():
    assert read_normal_force(DAT) == pytest.approx(180 * 5e-2 / coated_scene.NORMAL_FORCE)


def test_tractions_are_those_of_touched_corner_nodes():
    read = read_tractions(frd([4.0, 3.0, 2.0, 1.0, 0.0]))
    assert read.radii == pytest.approx([0.0, 2.0], abs=1e-5)
    expected = np.array([4.0, 2.0]) / coated_scene.HERTZ.peak_pressure
    assert read.pressure == pytest.approx(expected, rel=1e-5)
    assert read.shear == pytest.approx(5e-2 * expected, rel=1e-5)


def synthetic(limit, per_stiffness, per_element):
    """Three runs with the force limit + per_stiffness / k + per_element / n, and the pressure that
    less the radius."""
    runs = []
    for each in FINENESSES:
        value = limit + per_stiffness / each.stiffness + per_element / each.elements
        radii = [n / each.elements for n in range(each.elements)]
        runs.append({**asdict(each), "normal_force": value, "radii": radii,
                     "pressure": [value - r for r in radii]})  # fmt: skip
    return {"runs": runs}


def test_extrapolation_removes_the_penalty():
    record = Recorded(synthetic(2.0, 5.0, 0.0))
    assert record.normal_force.value == pytest.approx(2.0, rel=1e-14)
    radii, values, _ = record.profile("pressure", 0.1, 0.5)
    assert values == pytest.approx(2.0 - radii, rel=1e-14)


def test_uncertainty_covers_what_the_mesh_leaves():
    record = Recorded(synthetic(2.0, 5.0, 0.01))
    value, uncertainty = record.normal_force
    profile = record.profile("pressure", 0.1, 0.5)
    assert abs(value - 2) <= uncertainty * (1 + 1e-9)
    assert np.max(np.abs(profile.values - (2 - profile.radii))) <= profile.uncertainty * (1 + 1e-9)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"E1_over_E2={row['E1_over_E2']:g}")
def test_edge_and_pressure_are_those_that_nodes_of_half_open_elements_hide(row):
    """Values next to the edge are the means of what two faces tell, each kept above the least of
    its points of integration."""
    exact = solved_here(coated_ball(row)).ends[0]
    a, p0 = exact.contact_radius, float(exact.pressure(np.zeros(1))[0])
    r = a * np.array(Fineness(24, 1000.0, 1.25, 1.0).lines[1:])
    r = r[: np.flatnonzero(r > a)[0] + 1]
    known = exact.pressure(r) / p0
    told = known.copy()
    told[-2:] = 0.1, 0.02  # an edge on a node, and a face beyond that touches a little
    edge, pressure = up_to_edge(r / a, told)
    assert edge == pytest.approx(1.0, abs=3e-4)
    assert np.max(np.abs(pressure - known)) < 0.04 < 0.09 < np.max(np.abs(told - known))
