"""The account of energy, carried on from one solved state to the next."""

from dataclasses import replace

import numpy as np

from semi_analytical.energy import NOTHING_YET, Configuration, after_increment
from semi_analytical.increment import State
from semi_analytical.model import ContactModel
from semi_analytical.sheared import rigid, untouched


def balanced(
    model: ContactModel, before: State | None, after: State, *, path_matters: bool = True
) -> State:
    """The state `after` an increment with its energies; `before` is None at the start.

    Needs no convolution: states know their displacements.

    path_matters  whether `after` depends on how finely its step is cut
    """
    end = configuration(model, after)
    if before is None:
        spent, start = NOTHING_YET, Configuration.at_rest(model.gap, len(end.forces))
    else:
        spent, start = before.energy, configuration(model, before)
    dissipated = 0.0 if after.sheared is None else after.sheared.dissipated_energy
    energy = after_increment(
        spent, start, end, dissipated, model.grid.cell_area, path_matters=path_matters
    )
    return replace(after, energy=energy)


def configuration(model: ContactModel, state: State) -> Configuration:
    """What the balance needs of a state; without friction its tangential part is nothing."""
    pressing = state.pressing
    sheared = state.sheared or untouched(model.grid.cells)
    shift = sheared.shift
    slipped = motions = None
    if shift is not None:
        slipped = sheared.displacement - rigid(model, sheared.motion)
        motions = np.array(
            [pressing.approach, *shift, *(pressing.tilt or ()), *_some(sheared.twist)]
        )
    force = state.target.force
    normal = state.normal_force if force is None else force
    moments = *(state.moment or ()), *_some(sheared.torque)
    return Configuration(
        pressure=pressing.pressure,
        normal_displacement=pressing.displacement,
        gap=model.gap + pressing.displacement - pressing.closure(model),
        shear=sheared.shear,
        friction_limit=model.friction.limit(sheared.pressure),
        tangential_displacement=sheared.displacement,
        slipped=slipped,
        touching=sheared.touching,
        forces=np.array([normal, *sheared.force, *moments]),
        motions=motions,
    )


def _some(value: float | None) -> tuple[float, ...]:
    return () if value is None else (value,)
