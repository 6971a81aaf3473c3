"""Energy balance along the load history: adds the energies to each converged state."""

from dataclasses import replace

import numpy as np

from semi_analytical.increments.energy import (
    NOTHING_YET,
    Configuration,
    add_increment_energy,
)
from semi_analytical.increments.increment import State
from semi_analytical.increments.tangential_state import (
    bulk_strain_displacement,
    rigid,
    strain_moments,
)
from semi_analytical.model import ContactModel, everywhere


def add_energies(
    model: ContactModel, before: State | None, after: State, *, path_matters: bool = True
) -> State:
    """Return the state at the end of an increment, completed by its energies.

    The energies are elastic energy, work of the loads and dissipated energy since the start. They
    need no convolution, because states include their displacements.

    model         contact model
    before        state at the start of the increment; None at the start of the history
    after         converged state at the end of the increment
    path_matters  True if `after` depends on the number of increments of its load step
    """
    end = configuration(model, after)
    if before is None:
        spent, start = NOTHING_YET, Configuration.unloaded(model.gap, end)
    else:
        spent, start = before.energy, configuration(model, before)
    dissipated = 0.0 if after.sheared is None else after.sheared.dissipated_energy
    energy = add_increment_energy(
        spent, start, end, dissipated, model.grid.cell_area, path_matters=path_matters
    )
    return replace(after, energy=energy)


def configuration(model: ContactModel, state: State) -> Configuration:
    """Collect tractions, displacements and loads of a contact state for the energy balance.

    Without shear the tangential fields are empty. The springs of a test rig store no energy of the
    bodies: their extension is subtracted from motions and displacements.

    model  contact model
    state  converged state
    """
    pressing, sheared = state.pressing, state.sheared
    pressure, (down, along) = pressing.pressure, model.springs
    gap = model.gap + pressing.displacement - pressing.closure(model)
    spring = down * float(np.sum(pressure))
    displacement, approach = pressing.displacement - spring, pressing.approach - spring
    force = state.target.force
    normal = state.normal_force if force is None else force
    if sheared is None:
        nothing = np.zeros((2, 0, 0))
        return Configuration(
            pressure=pressure,
            normal_displacement=displacement,
            gap=gap,
            shear=nothing,
            friction_limit=nothing[0],
            tangential_displacement=nothing,
            slipped=nothing,
            free=nothing,
            contact_fraction=nothing[0],
            forces=np.array([normal, *(state.moment or ())]),
            motions=np.array([approach, *(pressing.tilt or ())]),
        )
    shift = sheared.shift
    extension = along * model.domain.resultant(sheared.shear)
    slipped, motions = np.zeros_like(sheared.shear), None
    moments = [*(state.moment or ()), *_present_values(sheared.torque)]
    rotations = [*(pressing.tilt or ()), *_present_values(sheared.twist)]
    if sheared.strain is not None:
        # The strain moves the lower body, so its work has the opposite sign.
        moments += [*strain_moments(model, sheared.shear)]
        rotations += [-part for part in sheared.strain]
    if shift is not None:
        slipped = sheared.displacement - rigid(model, sheared.motion)
        slipped = slipped + bulk_strain_displacement(model, sheared.strain)
        motions = np.array([approach, *(shift - extension), *rotations])
    return Configuration(
        pressure=pressure,
        normal_displacement=displacement,
        gap=gap,
        shear=sheared.shear,
        friction_limit=model.friction_limit(sheared.pressure),
        tangential_displacement=sheared.displacement - everywhere(extension),
        slipped=slipped,
        free=np.zeros_like(slipped) if sheared.free is None else sheared.free,
        contact_fraction=sheared.contact_fraction,
        forces=np.array([normal, *sheared.force, *moments]),
        motions=motions,
    )


def _present_values(value: float | None) -> tuple[float, ...]:
    return () if value is None else (value,)
