"""Tests of the Krylov subspace method for linear systems with free motions."""

import numpy as np
from random_compliance import compliance

from contact_solver.krylov import least_residual


def test_gmres_leaves_nothing_that_unknowns_or_free_motions_explain(rng):
    """Also where free motions depend on each other."""
    matrix = compliance(rng, 12) + 0.3 * np.triu(rng.standard_normal((12, 12)))
    one = rng.standard_normal(12)
    free = np.stack([one, 2 * one, rng.standard_normal(12)])
    right = rng.standard_normal(12)
    for depth in (1e-1, 1e-12):
        found = least_residual(lambda w: (3 * w, matrix @ w, 7 * w[:5]), right, free, 5, depth, 12)
        np.testing.assert_allclose(3 * found.image, matrix @ found.solution, atol=1e-12)
        np.testing.assert_allclose(3 * found.extra, 7 * found.solution[:5], rtol=1e-5, atol=1e-6)
    np.testing.assert_allclose(found.image + found.motion @ free, right, atol=1e-10)
