"""Which tractions a scene is solved for."""

from enum import Enum


class Path(Enum):
    """Which tractions are solved for, and on which harmonics."""

    PRESSING = "pressure alone"
    PRESSING_WITH_FRICTION = "pressure and radial shear, coupled"
    TWISTING = "pressure, then circumferential shear"
    SHEARING = "pressure, then shear along the load"
    HARMONICS = "pressure and shear, coupled, on many harmonics"
