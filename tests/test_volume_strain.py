"""Tests of the resistance of finite elements to a change of volume."""

import numpy as np
import pytest

from contact_scene import Body, IsotropicMaterial
from fem_reference.elasticity.weak_form import dilatation
from fem_reference.mesh.section_mesh import section_mesh


@pytest.mark.parametrize("nu", [-0.9, 0.0, 0.3, 0.4999, 0.49999, 0.5])
def test_resistance_to_volume_strain_is_lambda_or_an_unknown_pressure(nu):
    """lambda = E nu / (1 + nu)(1 - 2 nu) or, where that is beyond 1e4 mu, its inverse."""
    body = Body(material=IsotropicMaterial(young_modulus=1.0, poisson_ratio=nu))
    resistance = dilatation(section_mesh(body, 2))
    inverse, unknown = (1 + nu) * (1 - 2 * nu), nu > 0.49995
    assert np.all(resistance.mixed == unknown)
    stiff, soft = (0.0, inverse / nu) if unknown else (nu / inverse, 0.0)
    assert resistance.resistance == pytest.approx(stiff, rel=1e-9, abs=0)
    assert resistance.compliance == pytest.approx(soft, rel=1e-9, abs=0)
