"""Verification cases of a test rig of finite stiffness, and of contacts on a strained body.

The rig is a spring in series with the tangential load of a fretting loop. The bulk strain of the
lower body acts along the surface.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from contact_results.cycles import fretting_cycles
from contact_scene import Ellipsoid, LoadStep, Rig
from contact_scene.array_types import Field
from contact_scene.quantities.summary import OF_CYCLES
from verification.closed_forms.cattaneo_mindlin import TangentialHistory
from verification.closed_forms.hertz import EllipticalContact
from verification.judging.case import Case, Level
from verification.judging.declared_case import (
    ENERGY,
    SHEAR,
    SHIFT,
    SQUARE_ROOTS,
    STICK_RADIUS,
    Falls,
    Observable,
    RefinementLevels,
    Row,
    Within,
    case,
    error_norm,
    judged,
    number,
    on_cells,
    on_elements,
    on_radii,
    on_springs,
    part_of_side,
    refinement,
)
from verification.judging.drawings import Drawn, profile
from verification.problems.cattaneo_mindlin import (
    OVER_SLIDING_SHIFT,
    SLIDING_SHIFT,
)
from verification.problems.problem import (
    CONTACT_MODULUS,
    FRICTION,
    FRICTION_LIMIT,
    HERTZ,
    NORMAL_FORCE,
    NU_ZERO,
    UNLIKE,
    Problem,
    ReferenceKind,
    frictional,
    paraboloid,
    partial_slip,
)
from verification.quantities import shear_of
from verification.references import load_reference


@dataclass(frozen=True)
class EccentricContact:
    """Hold the exact state of an elliptical contact under a tangential force T and a bulk strain ε.

    T and ε have grown in proportion from zero. The centre of the stick zone is then shifted along
    x. Both materials have ν = 0. Fields are functions of x and y.

    contact           normal contact with the contact modulus E*, which is also the tangential
                      modulus
    friction          coefficient of friction µ
    tangential_force  T along x [force]
    strain            strain ε of the lower body along x
    """

    contact: EllipticalContact
    friction: float
    tangential_force: float
    strain: float

    def __post_init__(self) -> None:
        if self.eccentricity + self.stick.semi_axes[0] > self.contact.semi_axes[0]:
            raise ValueError("the stick zone reaches the edge of the contact: slip turns back")

    @property
    def stick(self) -> EllipticalContact:
        """Normal contact under the reduced load W - T/µ; the ellipse of this contact is the stick
        zone.
        """
        load = self.contact.load - self.tangential_force / self.friction
        modulus = self.contact.contact_modulus
        return EllipticalContact.under_load(load, self.contact.radii, modulus)

    @property
    def eccentricity(self) -> float:
        """Distance of the centre of the stick zone from the centre of the contact, along x
        [length].
        """
        return self.strain * self.contact.radii[0] / self.friction

    @property
    def shift(self) -> float:
        """Tangential shift of the indenter along x [length]."""
        drawn = 0.5 * self.strain * self.eccentricity
        return self.friction * (self.contact.approach - self.stick.approach) + drawn

    @property
    def stick_radius(self) -> float:
        """Radius √(area/π) of the stick zone [length]."""
        a, b = self.stick.semi_axes
        return float(np.sqrt(a * b))

    def shear(self, x: ArrayLike, y: ArrayLike) -> Field:
        """Compute the shear along x on the lower body at points (x, y) [force/length²]."""
        xs = np.asarray(x, dtype=float)
        lacking = self.stick.pressure(xs - self.eccentricity, y)
        return self.friction * (self.contact.pressure(xs, y) - lacking)

    @property
    def dissipated_energy(self) -> float:
        """Energy ∫ µp s dA that friction dissipates by the slip s [force*length].

        The slip is µ times the gap of the normal contact that has the stick zone as contact area.
        The integral follows from the reciprocity of the two contacts and ∫ p x² dA = W a²/5.
        """
        whole, stick, e = self.contact, self.stick, self.eccentricity
        (R_x, R_y), lost = whole.radii, 0.0
        for sign, of in ((1, whole), (-1, stick)):
            a, b = of.semi_axes
            lost += sign * of.load * ((a**2 / 5 + e**2) / R_x + b**2 / (5 * R_y)) / 2
        lost += whole.approach * stick.load - stick.approach * whole.load
        return self.friction**2 * lost


OVER_FORCE = "µW"
# Stiffness of the rig [N/m], and shift of the actuator, in turn positive and negative [m].
STIFFNESS = 100e6
ACTUATED = 1.5e-6
AT_ENDS = {1: 1.0, 2: -1.0, 3: 1.0}  # of the largest shift of the actuator, by loading step
# Accepted error of force and shift; 24 rings, 16 elements and 64 x 64 cells have smaller errors.
ON_ALL = 1e-3


def _moved_to(state: TangentialHistory, actuator: float) -> TangentialHistory:
    """Compute the state of a contact in series with the spring after the actuator has moved.

    state     state of the contact before; it follows Mindlin and Deresiewicz
    actuator  shift of the actuator: shift of the indenter plus extension of the spring [length]
    """

    def missed(force: float) -> float:
        return state.loaded_to(force).shift + force / STIFFNESS - actuator

    return state.loaded_to(brentq(missed, -FRICTION_LIMIT, FRICTION_LIMIT))


def _spring_loop_problem() -> Problem:
    states = [TangentialHistory(partial_slip(NU_ZERO, 0.0))]
    steps = []
    for step, part in AT_ENDS.items():
        states.append(_moved_to(states[-1], part * ACTUATED))
        shift = (part * ACTUATED, 0.0)
        steps.append(LoadStep(tangential_shift=shift, increments=4 if step == 1 else 8))
    scene = frictional("Loop through a spring, ν = 0", paraboloid(NU_ZERO), NU_ZERO, *steps)
    return Problem(
        scene.model_copy(update={"rig": Rig(tangential_stiffness=STIFFNESS)}),
        (HERTZ, *states[1:]),
        HERTZ.contact_radius,
        "Mindlin and Deresiewicz 1953, in series with a spring",
        scales={OVER_SLIDING_SHIFT: SLIDING_SHIFT, OVER_FORCE: FRICTION_LIMIT},
        equations=(r"\delta^* = \delta(T) + T/k",),
    )


FORCE = number(
    "force",
    "tangential force{when}",
    quantity="tangential_force_x",
    exact="tangential_force",
    over=OVER_FORCE,
)


def _loop_observable(name: str) -> Observable:
    """Create the observable of one number by which fretting tests describe a hysteresis loop.

    name  "loop_opening", "energy_ratio", "energy_friction" or "gross_slip_share"
    """

    def measure(result: Any, *_: Any) -> float:
        (cycle,) = fretting_cycles(result)
        return float(cycle.numbers[name])

    def exact(end: TangentialHistory) -> float:
        force, opening = abs(end.tangential_force), abs(end.loaded_to(0.0).shift)
        # By Masing's rule a cycle dissipates four times the energy of the first loading.
        lost = 4 * replace(end.virgin, tangential_force=force).dissipated_energy
        numbers = {
            "loop_opening": opening,
            "energy_ratio": lost / (4 * force * ACTUATED),
            "energy_friction": lost / (4 * NORMAL_FORCE * opening),
            "gross_slip_share": 5 * lost / (4 * force * end.shift),
        }
        return float(numbers[name])

    mark = OF_CYCLES[name]
    return Observable(name, mark.meaning, mark.unit, measure, exact, scalar=(name, 0))


def series_spring(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a fretting loop with a rig of finite stiffness, by all
    solvers.

    Force, shift, dissipated energy and loop numbers are compared with the closed form of a contact
    in series with a spring, for ν = 0.
    """
    problem = _spring_loop_problem()
    why = "set by hand: error of 64 x 64 cells, 16 elements or 24 rings for a loop of 0.87 µW"
    rows: tuple[Row, ...] = (
        *(
            Within(what.at(step, AT_ENDS[step], "of the largest actuator shift"), most, why)
            for what, most in ((FORCE, ON_ALL), (SHIFT, ON_ALL), (ENERGY, 2e-2))
            for step in (2, 3)  # both depend on the first reversal
        ),
    )
    loops = tuple(
        Within(_loop_observable(name), 5e-3, why)
        for name in ("loop_opening", "energy_ratio", "energy_friction", "gross_slip_share")
    )
    cells = 64 if level is Level.QUICK else 128
    return case(
        "series_spring",
        "Fretting loop with a rig of finite stiffness, ν = 0",
        "The paper's contact with ν = 0 in series with a spring of 100 N/µm, which is softer "
        "than the contact. The shift of the actuator is 1.5 µm, -1.5 µm and 1.5 µm. The spring "
        "adds a constant to the compliance in all three solvers.",
        judged(on_cells(problem, (cells,), of="cells"), (*rows, *loops)),
        judged(on_elements(problem, (16,), over=0.97, of="elements"), (*rows, *loops)),
        judged(on_radii(problem, "rings"), (*rows, *loops)),
        no_order="the constant compliance has no error; fretting_loop judges the contact",
        shows=("rig",),
    )


# Along x and y, and strain over that of e = a µ/R [1].
SHAPES = {"ball": (18e-3, 18e-3), "barrel across": (10e-3, 40e-3), "barrel along": (40e-3, 10e-3)}
ECCENTRICITY = 0.14
SHEARED = 0.5


def eccentric(name: str) -> Problem:
    """Create the problem of a bulk strain of the lower body that grows in proportion to a
    tangential force.

    Both act along x. The exact stick zone is eccentric.

    name  shape of the indenter: "ball", "barrel across" or "barrel along"
    """
    radii = SHAPES[name]
    contact = EllipticalContact.under_load(NORMAL_FORCE, radii, CONTACT_MODULUS)
    a, b = contact.semi_axes
    force, strain = SHEARED * FRICTION_LIMIT, ECCENTRICITY * a * FRICTION / radii[0]
    exact = EccentricContact(contact, FRICTION, force, strain)
    step = LoadStep(tangential_force=(force, 0.0), bulk_strain=(strain, 0.0, 0.0), increments=1)
    title = f"Sheared and strained {name}, ν = 0"
    return Problem(
        frictional(title, Ellipsoid(radii=radii, material=NU_ZERO), NU_ZERO, step),
        (contact, exact),
        a,
        "Hertz, Cattaneo; derived in verification.cases.rig_and_strain",
        across=b,
        scales={OVER_SLIDING_SHIFT: FRICTION * contact.approach},
        equations=(
            r"q = \mu \left[p(x, y; W) - p(x - e, y; W - T/\mu)\right],\quad e = \frac{\epsilon R}"
            r"{\mu},\quad \delta = \mu \left[\delta_z(W) - \delta_z(W - T/\mu)\right] + "
            r"\frac{\epsilon e}{2}",
        ),
    )


def _centre_of_stick(result: Any, step: int, problem: Problem) -> float:
    """Compute the position error of the centre of the stick zone along x, over the contact
    semi-axis [1].

    result   result on cells
    step     index of the load step
    problem  problem with the exact eccentricity of the stick zone
    """
    end, (x, _) = result.steps[step], result.grid.coordinates()
    centre = float(x[end.in_stick].mean())
    return (centre - problem.ends[step].eccentricity) / problem.radius


CENTRE = error_norm(
    "centre_of_stick", "centre of the stick zone along x", _centre_of_stick, "the semi-axis"
)


def eccentric_contact(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a contact under a tangential force and a bulk strain, on
    cells.

    Force and strain grow in proportion, so that the stick zone is eccentric. Shear, shift, energy,
    size and centre of the stick zone are compared with the closed form. The order of convergence of
    the shear is judged.
    """
    most = (128, 192, 256)[level]
    edges = f"{SQUARE_ROOTS}: an error of O(√h) on rings one cell wide leaves O(h^3/2) in L1"
    order = Falls(SHEAR, 1.5, edges)
    of_shear = Within(
        SHEAR, 1.6e-3, "required on 128 x 128; with corrected edges cell means differ by 5e-5"
    )
    rows: tuple[Row, ...] = (
        of_shear,
        Within(SHIFT, 1e-4, "required of the fretting loop"),
        Within(ENERGY, 1e-3, "twice the figure required of the fretting loop's cycle"),
        Within(STICK_RADIUS, part_of_side(0.1), "a tenth of a cell"),
        Within(CENTRE, part_of_side(0.2), "a fifth of a cell: mean of the cells that stick"),
    )
    ladders: dict[str, RefinementLevels] = {
        name: on_cells(eccentric(name), (128,), of=name) for name in SHAPES
    }
    orders = on_cells(eccentric("ball"), refinement(32, most), offsets=UNLIKE, of="orders")
    return case(
        "eccentric_contact",
        "Sheared contact on a strained body",
        "Bodies of one material with ν = 0 under 1 kN. A tangential force of half the friction "
        "limit and a strain of the lower body along this force grow in proportion. The stick "
        "zone has the shape of the contact, and its centre is 0.14 semi-axes from the centre of "
        "the contact.",
        *(judged(one, rows) for one in ladders.values()),
        judged(orders, (order,)),
        charts=(
            profile(
                ladders["ball"],
                "eccentric_shear",
                "Shear next to y = 0",
                "Computed shear, the closed form, and their difference.",
                "qₓ / µp₀",
                FRICTION * HERTZ.peak_pressure,
                Drawn(lambda end: shear_of(end)[0], lambda exact: exact.shear),
            ),
        ),
        shows=("bulk strain",),
    )


STRAIN = 3e-4


def strained_ball(level: Level = Level.QUICK) -> Case:
    """Create the verification case of an equal strain along x and y of the body below a pressed
    ball.

    Stick radius and dissipated energy of all solvers and contact methods are compared with stored
    reference numbers.
    """
    known = load_reference("strained_ball")
    exact = SimpleNamespace(
        stick_radius=known["stick_radius"] * HERTZ.contact_radius,
        dissipated_energy=known["dissipated_energy"],
    )
    step = LoadStep(bulk_strain=(STRAIN, STRAIN, 0.0), increments=1)
    problem = Problem(
        frictional("Ball on a strained body", paraboloid(NU_ZERO), NU_ZERO, step),
        (HERTZ, exact),
        HERTZ.contact_radius,
        known["source"],
        ReferenceKind.OTHER_SOLVER,
        known["uncertainty"],
        equations=(r"\bar u_r - \epsilon r = 0\ \text{where the surfaces stick}",),
    )

    because = "required; radial on twice and four times its rings differs by 1.6e-4 and 3e-4"

    def rows(of_radius: float) -> tuple[Row, ...]:
        return (
            Within(STICK_RADIUS, of_radius, because),
            Within(ENERGY, 5e-3, because),
        )

    cells = on_cells(problem, (128 if level is Level.QUICK else 256,), of="cells")
    elements = on_elements(problem, (64,), of="elements")
    springs = on_springs(
        on_elements(problem, (128,), of="springs"), "springs, 128 elements per radius"
    )
    return case(
        "strained_ball",
        "Ball on a body under equibiaxial strain",
        "The paper's ball with ν = 0 is pressed by 1 kN, and then the lower body is strained by "
        "3e-4 in all directions. The indenter resists the expansion by a radial shear.",
        judged(cells, rows(8e-4)),
        judged(elements, rows(4e-4)),
        judged(springs, rows(1.5e-3)),
        judged(on_radii(problem, "rings"), rows(4e-4)),
        no_order="the reference is a numerical solution by the radial solver; cattaneo_mindlin "
        "and fem_partial_slip judge the orders of cells and elements",
        shows=("bulk strain",),
    )
