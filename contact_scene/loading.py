"""The load history as it is written: one step after the other."""

from typing import Annotated

from pydantic import model_validator

from contact_scene.reading.description import Description
from contact_scene.reading.quantity import (
    BulkStrain,
    Force,
    Length,
    Moment,
    PressingForce,
    PressingLength,
    Rotation,
    Stress,
    WholeNumber,
)
from contact_scene.reading.validator_error import refusal

MAX_STEPS = 20_000
Increments = Annotated[int, WholeNumber(1, 100_000)]

# Every coordinate of the indenter's rigid motion is led by its force or by itself, and the strain
# of the lower body by its stress or by itself.
CONTROLS = (
    ("normal_force", "approach"),
    ("tangential_force", "tangential_shift"),
    ("torque", "twist"),
    ("moment", "tilt"),
    ("bulk_stress", "bulk_strain"),
)


class LoadStep(Description):
    """One step: what it names ramps linearly to the value given, all else is held.

    Forces, moments and motions are of the indenter relative to the body, with components along x
    and y; moments are about the origin. Rotations that no step has named yet are held at zero.
    """

    normal_force: PressingForce | None = None
    """Normal force at the end of the step [force]; 0 separates the bodies."""

    approach: PressingLength | None = None
    """Approach at the end of the step, counted from first touch [length]; 0 separates the
    bodies. With a normal spring in [rig]: that of the actuator."""

    tangential_force: tuple[Force, Force] | None = None
    """Tangential force (Tx, Ty) at the end of the step [force]."""

    tangential_shift: tuple[Length, Length] | None = None
    """Tangential shift (x, y) at the end of the step [length]. With a tangential spring in [rig]:
    that of the actuator."""

    torque: Moment | None = None
    """Torque about z at the end of the step [force length]."""

    twist: Rotation | None = None
    """Twist, the rotation about z, at the end of the step."""

    moment: tuple[Moment, Moment] | None = None
    """Moment (Mx, My) = (sum of p y, sum of p x) at the end of the step [force length]: the normal
    force acts at (My, Mx) / W. (0, 0) lets the indenter tilt freely."""

    tilt: tuple[Rotation, Rotation] | None = None
    """Tilt (x, y) at the end of the step: slopes that close the gap at positive y and x."""

    bulk_strain: tuple[BulkStrain, BulkStrain, BulkStrain] | None = None
    """Uniform strain (exx, eyy, exy) of the lower body along its surface at the end of the step,
    about the origin; layers are strained as much. A specimen in plane strain, pulled along x by a
    stress, has exx = stress (1 - nu^2)/E and eyy = 0. The indenter is not strained."""

    bulk_stress: tuple[Stress, Stress, Stress] | None = None
    """The same by the stress (sxx, syy, sxy) of the substrate, free to contract [force/length^2].
    """

    increments: Increments | None = None
    """Number of the solver's increments within the step; absent: chosen by the solver."""

    @model_validator(mode="after")
    def _names_one_control_each(self) -> "LoadStep":
        for force, displacement in CONTROLS:
            if self._names(force) and self._names(displacement):
                raise refusal(f"got both {force} and {displacement}", "one of them")
        if not any(self._names(control) for pair in CONTROLS for control in pair):
            keys = ", ".join(control for pair in CONTROLS for control in pair)
            raise refusal("the step names no load", f"at least one of {keys}")
        return self

    def _names(self, key: str) -> bool:
        return getattr(self, key) is not None

    @property
    def names_normal(self) -> bool:
        """Whether the step changes the normal load."""
        return self._names("normal_force") or self._names("approach")
