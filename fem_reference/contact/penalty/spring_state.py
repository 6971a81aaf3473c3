"""What the penalty method carries from one increment to the next."""

from dataclasses import dataclass, replace
from enum import Enum
from typing import Self

import numpy as np
from numpy.typing import NDArray

from contact_scene.residuals import Residuals
from fem_reference.contact.one_component import Led
from fem_reference.contact.penalty.newton import Iterate
from fem_reference.loads import Loads, NormalTarget

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]


class Solution(Enum):
    """How an increment was solved."""

    NEWTON = "newton"
    SPRINGS = "springs"


@dataclass(frozen=True)
class PenaltyState(Led):
    """The end of an increment. Arrays have the component first: pressure, then shear if any.

    loads        that were reached
    traction     (c, n) [force/length^2]
    overlap      (c, n) [length]; along the surface the slip memory of the next increment
    motion       approach, then shift or twist (c,); nan where undefined: at the friction limit
                 under force control
    resultant    normal force, then tangential force or torque (c,)
    in_slip      points in contact that slipped in this increment (n,)
    slip         along the surface, accumulated in contact (n,); None without shear
    dissipated   energy since the start [force length]; None where the motion is undefined
    first_pass   before any augmentation, where the next increment starts; None before first touch
    edges        (c, n) tractions by which the edges of contact and stick are found: of the first
                 pass that does not move them, as later ones ripple there
    augmentations  updates of the multipliers
    change       of the first pass since the increment before: tractions and coordinates; None
                 where there was none
    solution     by springs if any of the passes was
    iterations   linear systems solved
    sweeps       alternations between the two halves of the springs
    """

    loads: Loads
    traction: Field
    overlap: Field
    motion: Field
    resultant: Field
    in_slip: Mask
    slip: Field | None
    dissipated: float | None
    first_pass: Iterate | None
    edges: Field
    change: tuple[Field, Field] | None
    residuals: Residuals
    solution: Solution
    iterations: int
    sweeps: int
    augmentations: int

    @property
    def in_contact(self) -> Mask:
        """Points that carry pressure (n,)."""
        return np.asarray(self.traction[0] > 0)

    @property
    def normal_force(self) -> float:
        """As prescribed or carried [force]."""
        prescribed = self.loads.normal.force
        return float(self.resultant[0]) if prescribed is None else prescribed

    @property
    def approach(self) -> float:
        """[length]"""
        return float(self.motion[0])

    @property
    def carried(self) -> float:
        """By the shear [force] or [force length]."""
        return float(self.resultant[1])

    @property
    def moved(self) -> float | None:
        """Along the shear [length] or [radian]."""
        return None if np.isnan(self.motion[1]) else float(self.motion[1])

    def pressing_alone(self) -> Self:
        """The same without its shear."""
        first, change = self.first_pass, self.change
        if first is not None:
            first = replace(first, traction=first.traction[:1], coordinates=first.coordinates[:1])
        return replace(
            self,
            traction=self.traction[:1],
            overlap=self.overlap[:1],
            motion=self.motion[:1],
            slip=None,
            first_pass=first,
            edges=self.edges[:1],
            change=None if change is None else (change[0][:1], change[1][:1]),
        )


def untouched(gap: Field) -> PenaltyState:
    """Before first touch.

    gap  undeformed, (c, n) [length]
    """
    components, points = gap.shape
    nothing = np.zeros_like(gap)
    return PenaltyState(
        loads=Loads(NormalTarget(force=0.0)),
        traction=nothing,
        overlap=-gap,
        motion=np.zeros(components),
        resultant=np.zeros(components),
        in_slip=np.zeros(points, dtype=bool),
        slip=np.zeros(points) if components > 1 else None,
        dissipated=0.0,
        first_pass=None,
        edges=nothing,
        augmentations=0,
        change=None,
        residuals=Residuals(0.0, 0.0),
        solution=Solution.SPRINGS,
        iterations=0,
        sweeps=0,
    )
