"""What leads the indenter at the end of an increment: a force, or the motion itself."""

from dataclasses import dataclass


@dataclass(frozen=True)
class NormalTarget:
    """Either the normal force [force] or the approach [length]."""

    force: float | None = None
    approach: float | None = None


@dataclass(frozen=True)
class TangentialTarget:
    """Either the tangential force [force] or the shift [length], along the plan's direction."""

    force: float | None = None
    shift: float | None = None


@dataclass(frozen=True)
class TwistTarget:
    """Either the torque [force length] or the twist [radian]."""

    torque: float | None = None
    twist: float | None = None


@dataclass(frozen=True)
class Loads:
    """Everything that is prescribed at the end of an increment.

    tangential, twisting  None where the plan's path has no such motion
    """

    normal: NormalTarget
    tangential: TangentialTarget | None = None
    twisting: TwistTarget | None = None
