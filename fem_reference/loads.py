"""Prescribed loads and motions of the indenter at the end of a load increment."""

from dataclasses import dataclass


@dataclass(frozen=True)
class NormalTarget:
    """Prescribed normal load at the end of an increment: either a force or an approach.

    force     normal force [force]; None if the approach is prescribed
    approach  rigid approach of the indenter [length]; None if the force is prescribed
    """

    force: float | None = None
    approach: float | None = None


@dataclass(frozen=True)
class TangentialTarget:
    """Prescribed tangential load at the end of an increment: either a load or a motion.

    load    tangential force along the plan's direction [force], or torque [force length]; None if
            the motion is prescribed
    motion  tangential shift along this direction [length], or twist [radian]; None if the load is
            prescribed
    """

    load: float | None = None
    motion: float | None = None


STILL = TangentialTarget(motion=0.0)


@dataclass(frozen=True)
class Loads:
    """Prescribed loads and motions of the indenter at the end of an increment.

    normal      normal force or approach
    tangential  tangential load or motion; zero motion by default
    strain      equibiaxial surface strain imposed on the lower body since first contact [1]
    """

    normal: NormalTarget
    tangential: TangentialTarget = STILL
    strain: float = 0.0
