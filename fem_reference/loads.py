"""Prescribed loads and motions of the indenter at the end of a load increment.

The tangential motions are the shift along the first tangential load of the history, the shift
across this direction, and the twist.
"""

from dataclasses import dataclass

ALONG, ACROSS, TWIST = range(3)
Triple = tuple[float, float, float]


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
    """Prescribed tangential loads at the end of an increment: of each motion a load or its value.

    Values of motions that the points of a contact exclude by symmetry are ignored.

    loads    tangential forces along and across the load [force], torque [force length]; None where
             the motion is prescribed
    motions  shifts along and across the load [length], twist [radian]; None where the load is
             prescribed
    """

    loads: tuple[float | None, ...] = (None, None, None)
    motions: tuple[float | None, ...] = (0.0, 0.0, 0.0)

    @property
    def pushes(self) -> bool:
        """True if a tangential force or shift is prescribed that is not zero."""
        return any(value for pair in (self.loads, self.motions) for value in pair[:TWIST])


STILL = TangentialTarget()


@dataclass(frozen=True)
class Loads:
    """Prescribed loads and motions of the indenter at the end of an increment.

    normal      normal force or approach
    tangential  tangential loads or motions; zero motions by default
    strain      equibiaxial surface strain imposed on the lower body since first contact [1]
    """

    normal: NormalTarget
    tangential: TangentialTarget = STILL
    strain: float = 0.0
