"""Load steps with an increment error: their end state depends on the number of increments.

The direction of slip is constant within an increment. `has_increment_error` lists the cases that
are proved to have no such error. With ν > 0 the direction of slip rotates while the stick zone
shrinks. A layer responds differently along and across a wave even at ν = 0. In both cases the
result depends on the increments.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot

from contact_scene.body_pair import coupling
from contact_scene.material import IsotropicMaterial
from contact_scene.scene import Scene
from contact_scene.stepping.growing_contact import grows_without_slip
from contact_scene.stepping.load_path import (
    ControlKind,
    LoadRamp,
    along_one_line,
)

# At this fraction of the friction limit shift and energy, which grow as (1 - T/µW)^-½, are 10 times
# their first order, and their leading digit depends on the increments.
NEAR_GROSS_SLIP = 0.99


def has_increment_error(scene: Scene) -> tuple[bool, ...]:
    """Determine for each load step if its end state depends on the number of increments.

    The result is False for histories of the following load steps, which are proved:

    - No shear has acted so far, or there is no friction.
    - The tangential load grows with the normal load by less than µ (`grows_without_slip`).
    - A torsion of bodies of revolution without tilt, under constant pressure, with uniform
      friction and without any other shear.
    - A straight push at constant pressure of two uncoated bodies of one material with ν = 0.
    """
    ramps = scene.load_path()
    return tuple(
        not _is_independent_of_increments(scene, ramps[: number + 1])
        for number in range(len(ramps))
    )


def near_gross_slip(scene: Scene) -> tuple[bool, ...]:
    """Determine for each load step if the tangential force has come close to the friction limit.

    This is the case from the first load step on that has an increment error and, under force
    control, ends above `NEAR_GROSS_SLIP` of the friction limit. Shift and energy then depend
    strongly on the number of increments.

    scene  contact problem with its load history
    """
    reached, found = False, []
    for ramp, matters in zip(scene.load_path(), has_increment_error(scene), strict=True):
        forces = ramp.normal.kind is ramp.tangential.kind is ControlKind.FORCE
        limit = (
            scene.friction.largest_tangential_force(ramp.normal.end)
            if scene.friction and forces
            else None
        )
        share = hypot(*ramp.tangential.end) / limit if limit else 0.0
        reached = reached or (matters and NEAR_GROSS_SLIP < share < 1)
        found.append(reached)
    return tuple(found)


def _is_independent_of_increments(scene: Scene, ramps: Sequence[LoadRamp]) -> bool:
    """Determine if the end state of a load history is proved not to depend on the increments.

    The proof covers histories without shear, loads that grow together without slip, and two cases
    at constant pressure: torsion of bodies of revolution, and a straight tangential load on equal
    bodies without layers and with Poisson's ratio 0.

    scene  bodies and friction
    ramps  load ramps of the history, one for each load step up to this state
    """
    if scene.friction is None or scene.friction.uniform == 0:
        return True
    if any(r.stretch and any(r.stretch[1]) for r in ramps):
        return False
    sheared = [r for r in ramps if any(r.tangential.end) or r.twisting.end or _follows_force(r)]
    if coupling(scene)[0]:
        return False
    if not sheared:
        return True
    slipping = [r for r in ramps[sheared[0].step - 1 :] if not grows_without_slip(scene, r)]
    if not slipping:
        return True
    constant = all(
        r.normal.start == r.normal.end and r.tilting.start == r.tilting.end for r in slipping
    )
    if not constant:
        return False
    pushed = any(any(r.tangential.end) for r in sheared)
    if any(r.twisting.end for r in sheared):
        tilted = any(any(r.tilting.end) for r in ramps)
        revolved = scene.indenter.is_of_revolution and scene.friction.uniform is not None
        return not pushed and not tilted and revolved
    return along_one_line(ramps) and _are_equal_without_poisson(scene)


def _follows_force(ramp: LoadRamp) -> bool:
    """Determine if the control of shift or twist changes between force and displacement.
    The step then starts from a result of the solve, which may cause shear."""
    return ramp.tangential.start is None or ramp.twisting.start is None


def _are_equal_without_poisson(scene: Scene) -> bool:
    """Return True if both bodies have no layers and Poisson's ratio 0. Slip under a straight
    load then has a constant direction, so that the result does not depend on the increments."""
    materials = {body.material for body in (scene.body, scene.indenter)}
    layers = scene.body.layers or scene.indenter.layers
    return not layers and all(
        isinstance(material, IsotropicMaterial) and material.poisson_ratio == 0
        for material in materials
    )
