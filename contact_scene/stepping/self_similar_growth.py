"""First contact of coupled bodies whose loads grow together from nothing.

The gap of a smooth tip is proportional to r^n. If the loads are in a constant ratio and friction is
uniform, half-spaces in contact have no length but the contact radius a (Spence 1968). The contact
is then self-similar about the point of first contact:

    displacements ~ a^n,    tractions ~ a^(n-1),    forces ~ a^(n+1),    energies ~ a^(2n+1)

The state at the contact radius λa is the state at a, dilated by λ. A single increment is solved
from this state, repeatedly, until the state at its end agrees with that at its start. A
particle that sticks at the end has stuck since the border of the stick zone passed it. With the
relative displacement s_b at the distance r_b of the border on its ray, its displacement is

    s = (r/r_b)^n s_b.

Bodies with layers are self-similar only while the contact is small or large compared with the
layers. Several increments start from their preceding state, so that results converge.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeVar

import numpy as np

from contact_scene.array_types import Field, Mask, Vector
from contact_scene.body_pair import coupling
from contact_scene.geometry import Cone, SmoothTip
from contact_scene.rig import compliances
from contact_scene.scene import Scene
from contact_scene.solver_errors import NotConverged
from contact_scene.stepping.load_path import ControlKind, LoadRamp

S = TypeVar("S")

# Ratio λ of the contact radii at the start and the end of the increment that is solved. Its error
# is that of increments of 10 % of the contact radius.
FACTOR = 0.9
# Least number of points over the contact radius, so that both contact edges are one point apart.
LEAST_POINTS = 1 / (1 - FACTOR)
# Limit of the relative change of the displacements at the start, at which the solves stop. The
# radius of the stick zone is then within 1 %, the shift within 0.1 % of the limit.
SETTLED = 5e-4
# Largest number of solves after the first one. Most contacts need 3 to 12.
MAX_SOLVES = 12
# Relative eigenvalue of the matrix of products below which mixing drops a direction.
DEPENDENT = 1e-12


class Similarity(NamedTuple):
    """Similarity of a self-similar contact to the same contact at another contact radius.

    exponent  exponent n of the gap r^n of the indenter
    factor    ratio λ of the contact radii, after and before the dilation
    """

    exponent: float
    factor: float

    @property
    def displacement(self) -> float:
        """Ratio of displacements and rigid motions."""
        return float(self.factor**self.exponent)

    @property
    def traction(self) -> float:
        """Ratio of pressures and shears."""
        return float(self.factor ** (self.exponent - 1))

    @property
    def force(self) -> float:
        """Ratio of forces."""
        return float(self.factor ** (self.exponent + 1))

    @property
    def energy(self) -> float:
        """Ratio of energies."""
        return float(self.factor ** (2 * self.exponent + 1))

    def relative(self, distance: Field, source: Field) -> Field:
        """Return the ratio of the relative displacements at a point and at its source on its ray.

        distance  distance of the points from first contact [length]
        source    distance of the sources [length]
        """
        return np.asarray((distance / source) ** self.exponent)


def self_similar_exponent(scene: Scene, ramp: LoadRamp, fraction: float) -> float | None:
    """Return the exponent n of the gap if a contact grows self-similarly in one increment.

    The result is None if it does not, and if the load step has several increments: these start
    from their preceding state, and their number determines the error. The bodies are coupled and
    have friction. Normal and tangential loads grow together from 0, both as forces or, without
    springs of a test rig, both as displacements.

    scene     bodies, shape of the indenter and friction
    ramp      load ramp that starts without contact
    fraction  fraction of the ramp at the end of the increment
    """
    if fraction < 1:
        return None
    normal, tangential, friction = ramp.normal, ramp.tangential, scene.friction
    if friction is None or not friction.uniform or not isinstance(scene.indenter, SmoothTip | Cone):
        return None
    if normal.start != 0 or normal.end <= 0 or ramp.strains:
        return None
    if ramp.twisting.end or any(ramp.tilting.end) or not coupling(scene)[0]:
        return None
    displaced = normal.kind is ControlKind.DISPLACEMENT
    if any(tangential.end):
        if tangential.kind is not normal.kind or (displaced and any(compliances(scene.rig))):
            return None
        if tangential.start is None or any(tangential.start):
            return None
    return scene.indenter.gap_exponent


def grow_from_nothing(
    exponent: float | None,
    before: S | None,
    solve: Callable[[S | None], S],
    dilate: Callable[[S, Similarity, Mixing], S | None],
) -> S:
    """Solve an increment of a contact, from its own end if the contact grows self-similarly.

    A solve that does not converge is repeated without mixing. If it does not converge either, the
    result is that of the preceding one.

    exponent  exponent of the gap; None if the contact does not grow self-similarly
    before    state at the start of the increment; None without contact
    solve     function that solves the increment from a state at its start
    dilate    function that dilates a state; None if the rigid motion is undefined or fewer than
              LEAST_POINTS resolve the contact
    """
    state = solve(before)
    if exponent is None:
        return state
    mixing, similarity = Mixing(), Similarity(exponent, FACTOR)
    for _ in range(MAX_SOLVES):
        smaller = dilate(state, similarity, mixing)
        if smaller is None or mixing.change <= SETTLED:
            break
        try:
            state = solve(smaller)
        except NotConverged:
            if mixing.count == 1:
                break
            mixing = Mixing()
    return state


class Mixing:
    """Anderson mixing of the relative displacement at the start of the solves.

    A solve answers a field x with a field F(x). The next field combines the earlier ones so that
    the combined residual F(x) - x is smallest (Anderson 1965).

    change  size of F(x) - x at the last field over that of F(x)
    """

    def __init__(self) -> None:
        self._fields: list[Field] = []
        self._residuals: list[Field] = []
        self._last: Field | None = None
        self.change = np.inf

    @property
    def count(self) -> int:
        """Number of fields so far."""
        return len(self._fields)

    def next_field(self, answer: Field) -> Field:
        """Return the next field, of the shape of the answer to the last one (…).

        answer  field that follows from the last solve; the first solve answers the field 0
        """
        last = np.zeros_like(answer) if self._last is None else self._last
        self._fields.append(last.ravel())
        self._residuals.append((answer - last).ravel())
        size = float(np.sum(answer**2))
        self.change = float(np.sqrt(np.sum((answer - last) ** 2) / size)) if size > 0 else 0.0
        self._last = answer
        if len(self._fields) > 1:
            fields, residuals = np.diff(self._fields, axis=0), np.diff(self._residuals, axis=0)
            products = np.einsum("ik,jk->ij", residuals, residuals)
            right = np.einsum("ik,k->i", residuals, self._residuals[-1])
            shares = np.linalg.lstsq(products, right, DEPENDENT)[0]
            change = np.einsum("i,ik->k", shares, fields + residuals)
            self._last = answer - change.reshape(answer.shape)
        return self._last


class Rays(NamedTuple):
    """Points on rays from first contact, at equal distances on all rays.

    radii  distances from first contact, increasing from 0 (rings,) [length]
    stick  sticking points (rings, rays)
    """

    radii: Vector
    stick: Mask

    def resolve(self, pressure: Field) -> bool:
        """Return True if at least `LEAST_POINTS` rings are in contact.

        pressure  pressure (rings, rays) [force/length^2]
        """
        return bool(np.count_nonzero(np.any(pressure > 0, axis=1)) >= LEAST_POINTS)

    def dilated(self, values: Field, factor: float) -> Field:
        """Interpolate a dilated field, without its change of magnitude (…, rings, rays).

        values  field (…, rings, rays)
        factor  ratio of lengths after and before the dilation
        """
        return self._at(values, np.repeat(self.radii[:, None] / factor, self.stick.shape[1], 1))

    def locked(self, relative: Field, similarity: Similarity) -> Field:
        """Compute the relative displacement at the start of a solve, with which particles stick.

        A particle that sticks at the end has the displacement with which the border of the stick
        zone passed it. Other particles have that of the dilated contact. The shape is that of the
        argument.

        relative    displacement relative to the indenter at the end (…, rings, rays) [length]
        similarity  ratio of the contact radii
        """
        r = self.radii[:, None]
        # The axis has no slip to judge by.
        beyond = np.cumprod(self.stick[1:], axis=0).sum(axis=0) + 1
        border = self.radii[np.minimum(beyond, len(self.radii) - 1)]
        source = np.maximum(r / similarity.factor, border)
        return similarity.relative(r, source) * self._at(relative, source)

    def _at(self, values: Field, places: Field) -> Field:
        """Interpolate a field linearly along its rays, constant beyond the last ring.

        values  field (…, rings, rays)
        places  distances from first contact (rings, rays) [length]
        """
        radii = self.radii
        upper = np.clip(np.searchsorted(radii, places), 1, len(radii) - 1)
        lower = upper - 1
        weight = np.clip((places - radii[lower]) / (radii[upper] - radii[lower]), 0.0, 1.0)
        one, other = (
            np.take_along_axis(values, np.broadcast_to(at, values.shape), axis=-2)
            for at in (lower, upper)
        )
        return np.asarray((1 - weight) * one + weight * other)
