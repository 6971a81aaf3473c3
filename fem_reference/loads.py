"""Prescribed loads or motions of the indenter at the end of an increment."""

from dataclasses import dataclass


@dataclass(frozen=True)
class NormalTarget:
    """Prescribed normal force [force] or approach [length]."""

    force: float | None = None
    approach: float | None = None


@dataclass(frozen=True)
class TangentialTarget:
    """Prescribed load or motion of the indenter along the shear.

    load    tangential force along the plan's direction [force], or torque [force length]
    motion  shift along this direction [length], or twist [radian]
    """

    load: float | None = None
    motion: float | None = None


STILL = TangentialTarget(motion=0.0)


@dataclass(frozen=True)
class Loads:
    """Prescribed loads or motions at the end of an increment.

    strain  of the lower body since first contact, equal in all directions
    """

    normal: NormalTarget
    tangential: TangentialTarget = STILL
    strain: float = 0.0
