"""What leads the indenter at the end of an increment: a force, or the motion itself."""

from dataclasses import dataclass


@dataclass(frozen=True)
class NormalTarget:
    """Either the normal force [force] or the approach [length]."""

    force: float | None = None
    approach: float | None = None


@dataclass(frozen=True)
class TangentialTarget:
    """Either the load or the motion of the indenter along the shear.

    load    tangential force along the plan's direction [force], or torque [force length]
    motion  shift along that direction [length], or twist [radian]
    """

    load: float | None = None
    motion: float | None = None


STILL = TangentialTarget(motion=0.0)


@dataclass(frozen=True)
class Loads:
    """Loads or motions that are prescribed at the end of an increment, and the strain of the lower
    body since first touch, the same all around."""

    normal: NormalTarget
    tangential: TangentialTarget = STILL
    strain: float = 0.0
