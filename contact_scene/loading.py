"""Load steps of a scene: the entries of `[[loading]]`, as the user writes them."""

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
    Torque,
    WholeNumber,
)
from contact_scene.reading.scene_error import refusal

MAX_STEPS = 20_000
Increments = Annotated[int, WholeNumber(1, 100_000)]

# Pairs of controls, force and displacement. A load step prescribes at most one of each pair.
CONTROLS = (
    ("normal_force", "approach"),
    ("tangential_force", "tangential_shift"),
    ("torque", "twist"),
    ("moment", "tilt"),
    ("bulk_stress", "bulk_strain"),
)


class LoadStep(Description):
    """Load step: a linear ramp of the prescribed forces and displacements to their given values.

    All other coordinates keep their last control, at a constant value. Until a step prescribes
    them, shifts are free and rotations are fixed at zero. Forces, moments and displacements are
    those of the indenter relative to the body; moments refer to the origin.
    """

    normal_force: PressingForce | None = None
    """Normal force at the end of the step [force]; 0 separates the bodies. All forces and moments
    of a line contact are per length, such as "100 N/mm"; plain numbers are N/m."""

    approach: PressingLength | None = None
    """Approach at the end of the step, measured from first contact [length]; 0 separates the
    bodies. With a normal spring in [rig], the approach of the actuator."""

    tangential_force: tuple[Force, Force] | None = None
    """Tangential force (Tx, Ty) at the end of the step [force]."""

    tangential_shift: tuple[Length, Length] | None = None
    """Tangential shift (x, y) at the end of the step [length]. With a tangential spring in [rig],
    the shift of the actuator."""

    torque: Torque | None = None
    """Torque about z at the end of the step [force length]."""

    twist: Rotation | None = None
    """Twist, the rotation about z, at the end of the step."""

    moment: tuple[Moment, Moment] | None = None
    """Moment (Mx, My) = (sum of p y, sum of p x) at the end of the step [force length]: the normal
    force acts at (My, Mx) / W. (0, 0) lets the indenter tilt freely."""

    tilt: tuple[Rotation, Rotation] | None = None
    """Tilt (x, y) at the end of the step: slopes that close the gap at positive y and x."""

    bulk_strain: tuple[BulkStrain, BulkStrain, BulkStrain] | None = None
    """Uniform strain (exx, eyy, exy) of the lower body parallel to its surface at the end of the
    step; the origin does not move. Layers have the same strain, the indenter has none. A specimen
    in plane strain under a stress along x has exx = stress (1 - nu^2)/E and eyy = 0."""

    bulk_stress: tuple[Stress, Stress, Stress] | None = None
    """Bulk strain, given by the stress (sxx, syy, sxy) of the substrate in plane stress
    [force/length^2]. Line contacts: (sxx, 0, 0) in plane strain."""

    increments: Increments | None = None
    """Number of increments of the step; absent: chosen by the solver."""

    @model_validator(mode="after")
    def _names_one_control_each(self) -> "LoadStep":
        for force, displacement in CONTROLS:
            if self._prescribes(force) and self._prescribes(displacement):
                raise refusal(f"got both {force} and {displacement}", "one of them")
        if not any(self._prescribes(control) for pair in CONTROLS for control in pair):
            keys = ", ".join(control for pair in CONTROLS for control in pair)
            raise refusal("the step names no load", f"at least one of {keys}")
        return self

    def multiplied(self, factor: float) -> "LoadStep":
        """Return the load step with all prescribed forces and displacements times a factor."""
        values = {name: getattr(self, name) for pair in CONTROLS for name in pair}
        changes = {
            name: tuple(factor * part for part in value)
            if isinstance(value, tuple)
            else factor * value
            for name, value in values.items()
            if value is not None
        }
        return self.model_copy(update=changes)

    def _prescribes(self, key: str) -> bool:
        return getattr(self, key) is not None

    @property
    def prescribes_normal(self) -> bool:
        """True if the load step prescribes a normal force or an approach."""
        return self._prescribes("normal_force") or self._prescribes("approach")
