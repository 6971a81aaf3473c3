"""How well an increment fulfils the equations of the penalty model, under the usual names.

Here zero means the springs' law, not the exact one: the overlap that springs need is no residual,
it is reported beside them.
"""

from dataclasses import replace

import numpy as np

from contact_scene.residuals import Residuals
from fem_reference.contact.penalty.newton import Iterate
from fem_reference.contact.penalty.problem import PenaltyProblem
from fem_reference.contact.penalty.spring_contact import Response
from fem_reference.contact.penalty.surface import Target
from fem_reference.plan import Path
from fem_reference.residuals import friction_cone, over


def penalty_residuals(
    problem: PenaltyProblem, target: Target, at: Iterate, response: Response
) -> Residuals:
    """Residuals of a solution whose overlaps gave this response.

    complementarity   ∫|p − law| dA / W
    penetration       largest |p − law| / ε over the approach
    slip_direction    ∫|q − law| dA / µW
    others            as of `residuals.Residuals`, of the tractions by the law
    """
    surface, law = problem.surface, response.traction
    missed = np.abs(at.traction - law)
    load = float(np.sum(surface.weights * law[0]))
    approach = abs(float(at.coordinates[0]))
    unbalanced = np.abs(surface.resultant(law) - target.value)
    pressing = Residuals(
        complementarity=over(float(np.sum(surface.weights * missed[0])), load),
        penetration=over(float(np.max(missed[0])) / problem.stiffness, approach),
        normal_equilibrium=over(float(unbalanced[0]), load) if target.free[0] else None,
    )
    if len(law) == 1:
        return pressing
    by_load = None
    if target.free[1]:
        by_load = over(float(unbalanced[1]), problem.capacity(law[0]))
    limit = problem.friction.carried(load)
    assert limit is not None  # friction is the same everywhere
    twisting = problem.path is Path.TWISTING
    return replace(
        pressing,
        friction_cone=friction_cone(np.abs(law[1]), problem.friction.limit(law[0])),
        slip_direction=over(float(np.sum(surface.weights * missed[1])), limit),
        tangential_equilibrium=None if twisting else by_load,
        torque_equilibrium=by_load if twisting else None,
    )
