"""Loads of bodies of revolution, and refusal of scenes that no solver of such bodies supports."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field
from contact_scene.body_pair import coupling, refuse_contrast
from contact_scene.bulk_strain import requires_bulk_strain
from contact_scene.checks.expected_contact import refuse_equator, refuse_ring
from contact_scene.friction import CoulombFriction
from contact_scene.reading.scene_text import shape_text
from contact_scene.scene import Scene
from contact_scene.solver_errors import UnsupportedScene
from contact_scene.stepping.load_path import ControlKind, LoadRamp, along_one_line

ELSEWHERE = "solve it with the semi-analytical solver"
# Largest asymmetry of a friction map of which a solver of bodies of revolution takes the means over
# circles. Measured coefficients are not known better than 1 %. Stated errors contain the asymmetry.
SYMMETRIC = 0.01


@dataclass(frozen=True)
class AxisymmetricLoads:
    """Loads that act on two bodies of revolution, and the causes of shear.

    ramps       load ramps of the load steps
    friction    True if the scene has friction
    loaded      True if a load step has a tangential force or shift
    curved      True if the tangential loads are not on one line, with friction
    twisted     True if a load step has a torque or twist
    twists      True if the indenter twists, with friction
    couples     True if pressure causes shear: the bodies are coupled and rough
    why         reason why the bodies are coupled or not
    frictional  True if normal loading or an imposed strain causes shear
    """

    ramps: tuple[LoadRamp, ...]
    friction: bool
    loaded: bool
    curved: bool
    twisted: bool
    twists: bool
    couples: bool
    why: str
    frictional: bool

    @classmethod
    def of(cls, scene: Scene, contrast: float, *, lines: bool = False) -> AxisymmetricLoads:
        """Collect the loads of a scene.

        Raise UnsupportedScene if no solver of bodies of revolution supports its shape, moduli,
        tilt or strain.

        scene     contact problem with its load history
        contrast  largest ratio of shear moduli within a body that the solver carries
        lines     True if the solver takes line contacts
        """
        refuse_equator(scene)
        if not (lines and scene.indenter.is_line):
            refuse_shape(scene)
        refuse_contrast(scene, contrast, f", and this solver carries a ratio up to {contrast:.0e}")
        friction, ramps = scene.friction is not None, tuple(scene.load_path())
        loaded = any(any(ramp.tangential.end) for ramp in ramps)
        twisted = any(ramp.twisting.end != 0 for ramp in ramps)
        couples, why = coupling(scene)
        rough = scene.friction is not None and scene.friction.largest > 0
        couples = couples and rough
        refuse_tilt(scene, pushed=loaded, coupled=couples)
        strains = [ramp.stretch[1] for ramp in ramps if ramp.stretch]
        strained = requires_bulk_strain(strains, friction and (loaded or twisted))
        curved = friction and loaded and not along_one_line(ramps)
        # The indenter also twists if its twist is free and the tangential load turns.
        free = any(ramp.twisting.kind is ControlKind.FORCE for ramp in ramps)
        return cls(
            ramps,
            friction,
            loaded,
            curved,
            twisted,
            friction and (twisted or (curved and free)),
            couples,
            why,
            rough and (couples or strained),
        )


def refuse_shape(scene: Scene) -> None:
    """Raise UnsupportedScene if the indenter is no body of revolution that is lowest on the axis.

    scene  contact problem, which contains the shape of the indenter
    """
    indenter = scene.indenter
    if not indenter.is_of_revolution:
        raise UnsupportedScene(
            f"the indenter is not axisymmetric ({shape_text(indenter)}), and this solver requires "
            f"bodies of revolution; {ELSEWHERE}"
        )
    refuse_ring(scene)


def refuse_coefficient_map(scene: Scene, *, symmetric: bool = True) -> None:
    """Raise UnsupportedScene if the coefficient of friction is a map that a solver does not take.

    scene      contact problem with its friction
    symmetric  True if the solver takes a map that depends on the distance from the axis alone
    """
    friction = None if scene.friction is None else scene.friction.coefficient_map
    if friction is None or (symmetric and friction.asymmetry <= SYMMETRIC):
        return
    reason = "this solver requires one number where friction acts under a normal load alone"
    if symmetric:
        reason = (
            f"at equal distance from the axis it varies by {friction.asymmetry:.2g} of its largest "
            f"value; this solver allows {SYMMETRIC:g}"
        )
    raise UnsupportedScene(
        f"the coefficient of friction is a map, and {reason}. Give one number, or {ELSEWHERE}"
    )


def friction_at_radii(friction: CoulombFriction, radii: Field) -> CoulombFriction:
    """Return the friction law with the coefficients of points at distances from the axis.

    Raise UnsupportedScene if a friction map does not cover all points.

    friction  friction law of the scene
    radii     distances of the points from the axis (any shape) [length]
    """
    mapped, farthest = friction.coefficient_map, float(np.max(radii))
    if mapped is not None and farthest > mapped.reach:
        raise UnsupportedScene(
            f"the friction map covers distances up to {mapped.reach:.3g} m from the axis, and the "
            f"rings of this solver extend to {farthest:.3g} m. Use a larger map, or {ELSEWHERE}"
        )
    return friction.at_radii(radii)


def refuse_tilt(scene: Scene, *, pushed: bool, coupled: bool) -> None:
    """Raise UnsupportedScene if the indenter tilts.

    The indenter tilts by a prescribed moment or tilt. If its tilt is free, the indenter also tilts
    by a tangential load on coupled bodies.

    scene    contact problem with its load history
    pushed   True if a load step has a tangential force or shift
    coupled  True if normal loading causes shear
    """
    ramps = scene.load_path()
    free = any(ramp.tilting.kind is ControlKind.FORCE for ramp in ramps)
    if any(any(ramp.tilting.end) for ramp in ramps) or (free and pushed and coupled):
        raise UnsupportedScene(
            "a step has a moment or a tilt, and this solver does not tilt the indenter. Remove it, "
            f"or {ELSEWHERE}"
        )
