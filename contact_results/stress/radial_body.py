"""Stress in a body below the tractions of the radial solver: regions, points, largest values."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from contact_results.stress.body_regions import IN_LAYER, REACH, BodyRegions, adjacent_spacing
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.points import StressPoints
from contact_results.stress.stress_maxima import Extreme
from contact_results.surface import Rings
from contact_scene.array_types import Field
from contact_scene.geometry import ShapedBody
from contact_scene.solver_errors import UnsupportedScene

if TYPE_CHECKING:
    from contact_scene import Body
    from semi_analytical.frf.depth import Level
    from semi_analytical.frf.stack import Stack

Fields = Callable[[Sequence["Level"], Field, Field], Field]


class PointNumbers(NamedTuple):
    """Numbers of the points at which the stress below a circular contact is computed.

    inside  points of the section within the contact radius
    beside  intervals of the section outside the contact radius
    down    depth intervals
    about   points on each side of a maximum in a search
    rounds  refinements of this search, each of which divides the spacing by `about`
    """

    inside: int
    beside: int
    down: int
    about: int
    rounds: int


PRESSED = PointNumbers(32, 32, 48, 3, 6)
SHEARED = PointNumbers(20, 16, 28, 2, 5)
# Points outside the plane of the section, where the tensile stress at the bottom of a layer may be
# largest: distances in contact radii, number of angles, and every n-th depth.
RADII = np.array([0.3, 0.6, 0.8, 0.95, 1.0, 1.15, 1.5])
ANGLES = 7
EVERY = 2


@dataclass(frozen=True)
class RadialBody:
    """One body below a circular contact, in axes in which x points along the load.

    fields     function that computes displacement and stress (levels, 9, n) from depths, x and y
               (n,)
    parts      regions of the body, and the depths of the points
    sampling   numbers of points
    strained   function that adds the stress from a bulk strain
    direction  unit vector of the load in the axes of the scene
    centre     coordinate x of the contact centre [length]
    is_round   True if the fields depend on the radius alone and are computed at x >= 0, y = 0
    reach      extent of the points to the sides, in contact radii
    """

    fields: Fields
    parts: BodyRegions
    sampling: PointNumbers
    strained: Callable[[StressPoints], StressPoints]
    direction: tuple[float, float]
    centre: float = 0.0
    is_round: bool = True
    reach: float = REACH

    @classmethod
    def from_state(
        cls, state: LoadedBodies, indenter: bool, fineness: int = 1, reach: float = REACH
    ) -> RadialBody:
        """Prepare the computation of the stress in the lower body or in the indenter.

        state     bodies and tractions that cause the stress
        indenter  True for the indenter, False for the lower body
        fineness  multiple of the numbers of polynomials and quadrature points; above 1, tractions
                  that depend on the angle have another fit near the contact edge
        reach     extent of the points to the sides, in contact radii

        Raises UnsupportedScene for too few rings, for shear with infinite pressure, and for a
        tangential load that changes direction.
        """
        from semi_analytical.frf.stack import stack_of

        body = state.loaded_body(indenter)
        make = cls._below_shear if is_sheared(state) else cls._below_pressure
        return make(state, indenter, fineness, reach, body, stack_of(body))

    @classmethod
    def _below_pressure(
        cls,
        state: LoadedBodies,
        indenter: bool,
        fineness: int,
        reach: float,
        body: Body,
        stack: Stack,
    ) -> RadialBody:
        """Prepare the stress of a contact without shear, from indenter shape and contact radius.

        state     bodies and tractions that cause the stress
        indenter  True for the indenter, False for the lower body
        fineness  multiple of the numbers of polynomials and quadrature points
        reach     extent of the points to the sides, in contact radii
        body      the body in which the stress is computed
        stack     the elastic layers and the base of this body
        """
        from contact_scene import Scene
        from radial.normal.disc import disc
        from radial.response.bodies import Bodies
        from radial.stress.subsurface_disc import SubsurfaceDisc

        assert state.pressed is not None
        shape, a, approach = state.pressed
        step = {"approach": approach}
        scene = Scene.model_validate({"indenter": shape, "body": state.body, "loading": [step]})
        asked = None if shape.rim is None else approach
        contact = disc(Bodies.of(scene), shape, a, asked, fineness)
        infinite = contact.profile.apex or contact.edge != 0
        parts = BodyRegions.from_body(body, a, PRESSED.down, infinite=infinite)
        below = SubsurfaceDisc(contact, stack, reach, fineness)

        def fields(levels: Sequence[Level], x: Field, _y: Field) -> Field:
            u_r, u_z, rr, tt, zz, rz = np.moveaxis(below.compute_fields(levels, x), 1, 0)
            none = np.zeros_like(rr)
            return np.stack([u_r, none, u_z, rr, tt, zz, none, rz, none], axis=1)

        strained = partial(state.add_bulk_stress, indenter=indenter)
        return cls(fields, parts, PRESSED, strained, state.direction, reach=reach)

    @classmethod
    def _below_shear(
        cls,
        state: LoadedBodies,
        indenter: bool,
        fineness: int,
        reach: float,
        body: Body,
        stack: Stack,
    ) -> RadialBody:
        """Prepare the stress of a contact with shear, from the tractions on rings.

        state     bodies and tractions that cause the stress
        indenter  True for the indenter, False for the lower body
        fineness  multiple of the numbers of polynomials and quadrature points; above 1, tractions
                  that depend on the angle have another fit near the contact edge
        reach     extent of the points to the sides, in contact radii
        body      the body in which the stress is computed
        stack     the elastic layers and the base of this body
        """
        from radial.plan import plan
        from radial.stress.circle_fit import (
            ANOTHER,
            USUAL,
            axisymmetric_circle,
            fit_tangential_circle,
        )
        from radial.stress.subsurface_circle import SubsurfaceCircle

        assert state.pressed is not None
        refuse_infinite(*state.pressed[:2])
        surface, p = state.surface, state.tractions["pressure"]
        assert isinstance(surface, Rings)
        if surface.covers_circle:
            refuse_turned()
        names = ("shear_radial", "shear_circumferential")
        outward, around = (state.tractions.get(name, np.zeros_like(p)) for name in names)
        if surface.angles is None:
            on_points = state.scene is not None and plan(state.scene).circle is not None
            circle = axisymmetric_circle(
                surface.radii, state.pressed[1], outward, around, p, on_points=on_points
            )
            highest = 1
        else:
            fit = USUAL if fineness == 1 else ANOTHER
            circle = fit_tangential_circle(surface.radii, surface.angles, outward, around, p, fit)
            highest = len(surface.angles)
        if indenter:
            circle = circle.tractions_on_upper_body()
        parts = BodyRegions.from_body(body, circle.radius, SHEARED.down)
        below = SubsurfaceCircle(circle, stack, reach, highest, fineness)
        strained = partial(state.add_bulk_stress, indenter=indenter)
        return cls(
            below.compute_fields,
            parts,
            SHEARED,
            strained,
            state.direction,
            circle.centre,
            circle.is_round,
            reach,
        )

    @property
    def radii(self) -> Field:
        """Distances of the points of the section from the contact centre [length].

        The points are denser at the contact edge.
        """
        inside = np.sin(0.5 * np.pi * np.arange(self.sampling.inside) / self.sampling.inside)
        beside = np.arange(self.sampling.beside + 1) / self.sampling.beside
        return self.parts.radius * np.concatenate([inside, 1 + (self.reach - 1) * beside**2])

    @property
    def section(self) -> Field:
        """Coordinates x of the points of the section (n,) [length].

        If all fields depend on the radius alone, these are x >= 0.
        """
        if self.is_round:
            return self.radii
        return np.unique(np.concatenate([self.centre - self.radii, [0], self.centre + self.radii]))

    def stress_points(self, levels: Sequence[Level], x: Field, y: Field) -> StressPoints:
        """Compute displacement and stress at positions x, y and at several depths.

        levels  the depths, each with its material
        x, y    positions (n,) [length]

        Returns points of shape (levels, n). `at_edge` marks the outer and the lower end of the
        computed region, and the first depth below infinite pressure.
        """
        found = np.moveaxis(self.fields(levels, x, y), 1, 0)
        depth = np.array([[level.depth] for level in levels])
        layer = np.array([[level.layer] for level in levels])
        none, parts = np.zeros_like(found[0]), self.parts
        away = np.hypot(x - self.centre, y) >= (1 - 1e-9) * self.reach * parts.radius
        infinite = (depth == parts.first) & (parts.first > 0)
        points = StressPoints(
            none + x,
            none + y,
            none + depth,
            np.broadcast_to(layer, none.shape),
            found[:3],
            found[3:],
            at_edge=away | (depth == parts.deepest) | infinite,
        )
        return self.strained(points)

    def beside(self, levels: Sequence[Level]) -> StressPoints:
        """Compute the stress at points outside the plane of the section, at some of the depths.

        The tensile stress at the bottom of a layer may be largest at these points.

        levels  depths of the section, each with its material, downward
        """
        angles = np.pi * np.arange(1, ANGLES + 1) / (ANGLES + 1)
        r = self.parts.radius * RADII[:, None]
        x, y = self.centre + r * np.cos(angles), r * np.sin(angles)
        last = len(levels) - 1
        sides = [
            n
            for n, level in enumerate(levels)
            if n % EVERY == 0
            or n in (0, last)
            or level.depth in (levels[n - 1].depth, levels[min(n + 1, last)].depth)
        ]
        return self.stress_points([levels[n] for n in sides], x.ravel(), y.ravel())

    def largest(self, extreme: Extreme) -> StressPoints:
        """Refine the maximum of a stress measure in a region, by search around a computed maximum.

        extreme  largest value so far, with its place, region and measure

        Returns the points (n,) of the last refinement.
        """
        from semi_analytical.frf.depth import Level

        material, top, bottom = self.parts.named[extreme.region]
        c, s = self.direction
        x, y, z = c * extreme.x + s * extreme.y, c * extreme.y - s * extreme.x, extreme.depth
        radius, about = self.parts.radius, self.sampling.about
        r, theta = np.hypot(x - self.centre, y), np.arctan2(y, x - self.centre)
        across, down = adjacent_spacing(self.radii, r), adjacent_spacing(self.parts.depths, z)
        down = min(down, (bottom - top) / IN_LAYER)
        around = 0.0
        if not self.is_round:
            # In the plane of the section, the stress may be smallest along its circle, by symmetry.
            turned = np.append(theta, np.pi * np.arange(ANGLES + 2) / (ANGLES + 1))
            at, to = self.centre + r * np.cos(turned), r * np.sin(turned)
            circle = self.stress_points([Level(z, material)], at, to).measures[extreme.measure]
            theta = float(turned[np.argmax(circle)])
            # A maximum in the plane stays in it.
            around = np.pi / (ANGLES + 1) if abs(np.sin(theta)) * r > 1e-9 * radius else 0.0
        steps = np.arange(-about, about + 1) / about
        for _ in range(self.sampling.rounds + 1):
            radii = np.clip(r + across * steps, 0, self.reach * radius)
            if radii[0] < radius < radii[-1]:  # a peak may lie at the contact edge
                radii = np.append(radii, radius)
            depths = np.unique(np.clip(z + down * steps, top, bottom))
            angles = np.unique(np.clip(theta + around * steps, -np.pi, np.pi))
            at, to = (part.ravel() for part in np.meshgrid(np.unique(radii), angles))
            levels = [Level(float(depth), material) for depth in depths]
            found = self.stress_points(levels, self.centre + at * np.cos(to), at * np.sin(to))
            k = int(np.argmax(found.measures[extreme.measure]))
            r, theta = float(at[k % len(at)]), float(to[k % len(at)])
            z = float(found.depth.flat[k])
            across, down, around = across / about, down / about, around / about
        return found.flattened


def is_sheared(state: LoadedBodies) -> bool:
    """Return True if the surface carries a shear traction that is not zero everywhere."""
    return any(np.any(t) for name, t in state.tractions.items() if name != "pressure")


def refuse_infinite(indenter: ShapedBody, radius: float) -> None:
    """Raise UnsupportedScene for shear together with infinite pressure, at a tip or a rim.

    indenter  shape of the indenter
    radius    approximate contact radius [length]
    """
    from radial.normal.profile import profile

    if indenter.rim is not None or profile(indenter, radius).apex:
        where = "a tip" if indenter.rim is None else "a rim"
        raise UnsupportedScene(
            f"there is shear, and the pressure is infinite at {where}: the radial solver computes "
            "the stress below shear only for finite pressure; use another solver"
        )


def refuse_turned() -> None:
    """Raise UnsupportedScene for a tangential load that changes direction or acts with torsion."""
    raise UnsupportedScene(
        "the tangential load changes direction or acts together with torsion: the radial solver "
        "computes the stress below loads along one line or torsion alone; use the semi-analytical "
        "solver"
    )
