"""Which numbers of a step are no result: the load gives them."""

from contact_scene import LoadRamp
from contact_scene.load_path import ControlKind


def prescribed(ramp: LoadRamp) -> frozenset[str]:
    """Names of what the load gives at the end of a step."""
    controls = (
        (ramp.normal.kind, "normal_force", "approach"),
        (ramp.tangential.kind, "tangential_force", "tangential_shift"),
        (ramp.twisting.kind, "torque", "twist"),
        (ramp.tilting.kind, "moment", "tilt"),
    )
    return frozenset(
        force if kind is ControlKind.FORCE else motion for kind, force, motion in controls
    )
