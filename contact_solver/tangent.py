"""Tangent of a converged increment: change of the forces by the rigid motions of the indenter.

In given zones of contact, stick and slip, the equations of an increment are linear in the changes
of tractions t and rigid motions m (see `natural_map`). One linear solve for each motion gives the
tractions by its unit value. With the shapes R of the motions, the tangent is

    K_kl = ∂F_k/∂m_l = Σ R_k·∂t/∂m_l

In the zones of the solution the matrix is that of the last Newton step, and K the exact derivative
of the forces at the end of the increment, whose start is kept: slip continues. With stick in the
whole contact, K is the slope after a load reversal. Moving edges of the zones do not contribute,
because pressure, gap and slip vanish there.
"""

from collections.abc import Mapping

import numpy as np

from contact_scene.array_types import Field, Mask, Matrix, Vector
from contact_scene.solver_errors import NotConverged
from contact_solver.admissible_shear import magnitude
from contact_solver.coupled_problem import CoupledProblem
from contact_solver.krylov import least_residual
from contact_solver.natural_map import zones_of
from contact_solver.newton_iterate import evaluate_point, natural_map
from contact_solver.rigid_motion import RigidMotions
from contact_solver.zones import MAX_SLIP_COMPLIANCE, Zones

# Reduction of the residual by GMRES, of which the error of the tangent is a small multiple.
REDUCTION = 1e-9
MAX_ITERATIONS = 150
# Relative size of a motion, and of a singular value, that is round-off.
ROUND_OFF = 1e-12


def contact_stiffnesses(
    problem: CoupledProblem,
    tractions: Field,
    motion: Vector | None,
    shifting: RigidMotions,
    units: Matrix,
    changes: Mapping[str, bool],
    springs: tuple[float, float],
) -> dict[str, float]:
    """Compute the change of the force along each of several motions by this motion, by name.

    Other forces that are prescribed do not change, and other motions are fixed. The result is empty
    if a linear solve does not converge. Gross slip under a prescribed force continues.

    problem    pressure and shear of an increment
    tractions  shear and pressure (q_x, q_y, p) of its solution (3, n)
    motion     tangential rigid motions of the solution; None without friction, and in gross slip
               under prescribed forces
    shifting   tangential motions, which may include some that the target contains; those of the
               problem that close the gap follow
    units      approach, tangential shift and twist in terms of these motions, times the roots of
               the force by a unit force of the problem (3, k); zero if symmetry excludes the motion
    changes    for normal, tangential and torsional stiffness, True for the derivative in the zones
               of the solution, False for stick in the whole contact
    springs    compliances of a rig that the problem contains and the results do not, normal and
               tangential
    """
    released = np.concatenate([shifting.is_held, problem.closing.is_held])
    wanted = [one for one in zip(changes, units, (*springs, 0.0), strict=True) if np.any(one[1])]
    found: dict[str, float] = {}
    try:
        tangents = {
            continues: _tangent(problem, _zones(problem, tractions, motion, continues), shifting)
            for continues in {changes[name] for name, *_ in wanted}
        }
    except NotConverged:
        return found
    for name, unit, spring in wanted:
        stiffness = _stiffness_along(tangents[changes[name]], released, unit)
        found[name] = stiffness / (1 - spring * stiffness)
    return found


def _zones(
    problem: CoupledProblem, tractions: Field, motion: Vector | None, continues: bool
) -> Zones:
    """Return the zones of a solution if slip continues, else those of stick in the whole contact.

    In gross slip under prescribed forces all points slide on in the direction of their shear, with
    the largest slip compliance.
    """
    if continues and motion is not None:
        natural = natural_map(problem, evaluate_point(problem, tractions, motion)[0])
        return zones_of(natural, problem)
    q, p = tractions[:2], tractions[2]
    slips = (p > 0) & np.any(q, axis=0) & continues
    slip = np.flatnonzero(slips)
    normal = q[:, slip] / magnitude(q[:, slip])
    return Zones(
        contact=p > 0,
        stick=(problem.friction_limit(p) > 0) & (not continues),
        slip=slip,
        normal=normal,
        friction_slope=problem.friction_slope(p)[slip] * normal,
        slip_compliance=np.full(slip.size, MAX_SLIP_COMPLIANCE * problem.self_compliance),
    )


def _tangent(problem: CoupledProblem, zones: Zones, shifting: RigidMotions) -> Matrix:
    """Compute the derivative of the forces by the motions in given zones (k, k)."""
    shifts, n = len(shifting), zones.contact.size
    shapes = np.zeros((shifts + len(problem.closing), 3, n))
    for shape, one in zip(shapes, shifting.each, strict=False):
        shape[:2] = one.shape
    for shape, one in zip(shapes[shifts:], problem.closing.each, strict=True):
        shape[2] = one.shape
    if np.all(zones.slip_compliance >= MAX_SLIP_COMPLIANCE * problem.self_compliance):
        shapes[:shifts] *= np.any(zones.stick)
    inverse = problem.inverse.in_zones(zones)

    def apply_operator(rows: Vector) -> tuple[Vector, Vector, Vector]:
        free = inverse(rows[None])[0]
        u = problem.together(zones.tractions(free))
        return free, zones.free(u) + zones.slip_terms(free), np.zeros(0)

    tangent = np.zeros((len(shapes), len(shapes)))
    for number, shape in enumerate(shapes):
        right = zones.free(shape)
        none = np.empty((0, right.size))
        found = least_residual(apply_operator, right, none, 0, REDUCTION, MAX_ITERATIONS)
        left = float(np.linalg.norm(right - found.image))
        if left > 10 * REDUCTION * float(np.linalg.norm(right)):
            raise NotConverged("the contact stiffness", found.iterations, left, REDUCTION)
        tangent[:, number] = np.einsum("kcn,cn->k", shapes, zones.tractions(found.solution))
    return tangent


def _stiffness_along(tangent: Matrix, released: Mask, unit: Vector) -> float:
    """Compute the change of the force along a motion by this motion.

    released  motions whose force is kept (k,)
    unit      the motion (k,)
    """
    along = unit / np.linalg.norm(unit)
    others = np.eye(len(along))[released]
    others -= np.outer(others @ along, along)
    others = others[np.linalg.norm(others, axis=1) > ROUND_OFF]
    inverse = np.linalg.pinv(others @ tangent @ others.T, rcond=ROUND_OFF)
    followed = others.T @ inverse @ others @ tangent @ unit
    return float(unit @ tangent @ (unit - followed))
