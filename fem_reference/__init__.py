"""Axisymmetric finite-element reference solver for frictional contact of layered bodies.

The package shares the scene and its load stepping (`contact_scene`) and the contact of points
(`contact_solver`) with the other solvers, but no elasticity. The solvers therefore verify each
other.
"""

from contact_scene.effect import Effect
from contact_scene.quantities.residuals import Residuals
from contact_scene.solver_errors import ContactAtZoneEdge
from fem_reference.fields import Increment, Method, Result
from fem_reference.plan import Path, Plan, plan
from fem_reference.solve import solve

__all__ = [
    "ContactAtZoneEdge",
    "Effect",
    "Increment",
    "Method",
    "Path",
    "Plan",
    "Residuals",
    "Result",
    "plan",
    "solve",
]
