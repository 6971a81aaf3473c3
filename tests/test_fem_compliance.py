"""Tests of condensed finite-element compliances against Hankel integrals and closed forms."""

from math import inf, isinf

import numpy as np
import pytest
from hankel_responses import Patch, nodal_forces, patch_energy

from contact_scene import RIGID, Body, IsotropicMaterial, Layer, machine
from contact_scene.solver_errors import ResourceRefused
from fem_reference.elasticity import factored_section
from fem_reference.elasticity.compliance import composite, condense
from fem_reference.elasticity.factored_section import FactoredSection
from fem_reference.elasticity.motion import PRESSING, SHEARING, TORSION, motion
from fem_reference.mesh.section_mesh import section_mesh
from fem_reference.mesh.section_outline import sufficient_box
from semi_analytical.frf.stack import stack_of

NU = 0.3
HALF_SPACE = Body(material=IsotropicMaterial(young_modulus=2 * (1 + NU), poisson_ratio=NU))
PATCHES = {
    "pressure": (PRESSING, Patch(0, 0, 0, 1)),
    "radial shear": (PRESSING, Patch(0, 1, 1, 0)),
    "both": (PRESSING, Patch(0, -1, -1, 1)),
    "torsion": (TORSION, Patch(0, -1, 1, 0)),
    "shear": (SHEARING, Patch(1, 1, 0, 0)),
    "all of n = 1": (SHEARING, Patch(1, 1, 0.7, 1.2)),
    "all of n = 2": (motion(2), Patch(2, 1, 0.7, 1.2)),
    "all of n = 8": (motion(8), Patch(8, 1, 0.7, 1.2)),
}
COATINGS = {
    "half as stiff": (0.5, 0.3, 1.0, 0.3, 1.0),
    "four times as stiff": (4.0, 0.3, 1.0, 0.3, 0.5),
    "thin and stiff": (4.0, 0.3, 1.0, 0.3, 0.01),
    "thin and soft": (0.25, 0.3, 1.0, 0.3, 0.01),
    "on a rigid base": (1.0, 0.3, inf, 0.3, 0.5),
    "nearly incompressible": (1.0, 0.499, 1.0, 0.3, 0.3),
    "incompressible": (1.0, 0.5, 1.0, 0.3, 0.3),
    "on an incompressible substrate": (1.0, 0.3, 1.0, 0.5, 0.3),
    "all incompressible": (1.0, 0.5, 1.0, 0.5, 0.3),
}


def coated(E1, nu1, E2, nu2, h):
    layer = IsotropicMaterial(young_modulus=E1, poisson_ratio=nu1)
    base = RIGID if isinf(E2) else IsotropicMaterial(young_modulus=E2, poisson_ratio=nu2)
    return Body(material=base, layers=(Layer(thickness=h, material=layer),))


def energy_error(compliance, patch, bodies, signs=(1,)):
    forces = nodal_forces(patch, compliance.radii)[list(compliance.motion.components)]
    energy = np.einsum("ci,cidj,dj->", forces, compliance.matrix, forces)
    return energy / patch_energy(map(stack_of, bodies), patch, signs) - 1


def bound(harmonic, N):
    """Of the energy: what the elements under a patch leave falls with N^-3, the rest is 2e-5 at N =
    8."""
    return 2e-5 + 3e-4 * (1 + harmonic / 2) ** 2.4 * (8 / N) ** 3


@pytest.mark.parametrize("patch", ["both", "torsion", "all of n = 1"])
@pytest.mark.parametrize("coating", COATINGS)
def test_every_kind_of_coating_agrees_with_hankel_integrals(coating, patch):
    of, load = PATCHES[patch]
    body = coated(*COATINGS[coating])
    error = energy_error(condense(section_mesh(body, 8), of), load, [body])
    assert abs(error) < bound(of.harmonic, 8)


@pytest.mark.parametrize("patch", ["radial shear", "both", "torsion", "all of n = 2"])
def test_compliances_of_two_bodies_add_with_the_normal_turned(patch):
    of, load = PATCHES[patch]
    lower, upper = (coated(*COATINGS[x]) for x in ("half as stiff", "incompressible"))
    sections = section_mesh(lower, 8), section_mesh(upper, 8)
    both = composite(*sections, of)
    assert abs(energy_error(both, load, [lower, upper], (1, -1))) < bound(of.harmonic, 8)
    alone = composite(None, sections[1], of)
    assert abs(energy_error(alone, load, [upper], (-1,))) < bound(of.harmonic, 8)


def test_bodies_alike_are_condensed_once_and_uncoupled():
    section = section_mesh(HALF_SPACE, 6)
    pair = composite(section, section, PRESSING)
    assert pair.factorizations == 1
    assert not np.any(pair.matrix[0, :, 1])
    assert np.array_equal(pair.matrix[1, :, 1], 2 * condense(section, PRESSING).matrix[1, :, 1])


def test_two_rigid_bodies_or_unequal_meshes_are_refused():
    with pytest.raises(ValueError, match="two rigid bodies"):
        composite(None, None, PRESSING)
    with pytest.raises(ValueError, match="same N"):
        composite(section_mesh(HALF_SPACE, 4), section_mesh(HALF_SPACE, 6), PRESSING)


def energy_in_a_box(body, of, load, box):
    compliance = condense(section_mesh(body, 32, box=box), of)
    forces = nodal_forces(load, compliance.radii)[list(of.components)]
    return np.einsum("ci,cidj,dj->", forces, compliance.matrix, forces)


def test_the_chosen_box_suffices():
    """Below a film of a thousand times the modulus of its substrate."""
    body = coated(1000.0, 0.3, 1.0, 0.3, 0.5)
    of, load = PATCHES["pressure"]
    larger = energy_in_a_box(body, of, load, 4 * sufficient_box(body))
    assert energy_in_a_box(body, of, load, None) == pytest.approx(larger, rel=2e-5)
    alike_in_shear = coated(1.49 / 1.3, 0.49, 1.0, 0.3, 50.0)
    assert sufficient_box(alike_in_shear) > 20 * 50.0


def test_too_little_memory_is_refused_before_any_factorisation(monkeypatch):
    monkeypatch.setattr(machine, "available_bytes", lambda: 1e6)
    monkeypatch.delattr(factored_section, "splu")
    with pytest.raises(ResourceRefused, match=r"about 0\.0 GiB.*elements_per_radius"):
        FactoredSection(section_mesh(HALF_SPACE, 4), PRESSING)
