"""Semi-analytical contact solver: superposition of influence coefficients by FFT convolution."""

from contact_scene.effect import Effect
from contact_scene.quantities.residuals import Residuals
from contact_scene.solver_errors import (
    ContactAtWindowEdge,
    ContactNotResolved,
    GrossSliding,
    NotConverged,
    ResourceRefused,
    SolverError,
    UnsupportedScene,
)
from semi_analytical.default_grid import discretise
from semi_analytical.fields import Increment, Result
from semi_analytical.grid import SurfaceGrid
from semi_analytical.plan import Coupling, Plan, all_effects, plan
from semi_analytical.solve import solve, solve_discretised

__all__ = [
    "ContactAtWindowEdge",
    "ContactNotResolved",
    "Coupling",
    "Effect",
    "GrossSliding",
    "Increment",
    "NotConverged",
    "Plan",
    "Residuals",
    "ResourceRefused",
    "Result",
    "SolverError",
    "SurfaceGrid",
    "UnsupportedScene",
    "all_effects",
    "discretise",
    "plan",
    "solve",
    "solve_discretised",
]
