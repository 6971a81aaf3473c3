"""Scenes and short names for tests of stated errors."""

import numpy as np

from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    LoadStep,
    Paraboloid,
    Scene,
    SurfaceDiscretisation,
)
from contact_scene.quantities.stated_error import (
    StatedError,
)


def size(error: StatedError) -> float:
    """Largest component of an error that is known."""
    return float(np.max(error.error))


def indented(
    radius,
    load,
    film,
    base,
    mu=None,
    *more,
):
    """A rigid ball of a radius pressed on a film, if there is one, and moved by further steps."""
    return Scene(
        indenter=Paraboloid(radius=radius, material=RIGID),
        body=Body(material=base, layers=() if film is None else (film,)),
        friction=None if mu is None else CoulombFriction(coefficient=mu),
        loading=(LoadStep(normal_force=load), *more),
    )


def cells(count, **more):
    return SurfaceDiscretisation(cells=(count, count), **more)
