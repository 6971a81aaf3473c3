"""Random distributions of materials, bodies, indenter shapes, load histories and discretisations.

The randomly drawn scenes test the error estimates of the solvers. A distribution is a function of a
random generator `rng`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from scipy.ndimage import gaussian_filter

from contact_errors.error_formula import Values
from contact_results.solvers import SolverName
from contact_scene import (
    RIGID,
    Body,
    Cone,
    CoulombFriction,
    Ellipsoid,
    FiniteElementDiscretisation,
    FlatPunch,
    HeightMap,
    IsotropicMaterial,
    Layer,
    Paraboloid,
    Scene,
    Sphere,
    SurfaceDiscretisation,
)
from contact_scene.array_types import Field
from contact_scene.discretised import DiscretisedSolver
from contact_scene.friction import FrictionMap
from contact_scene.geometry import ShapedBody

CELLS = "semi-analytical"
ELEMENTS = "fem-complementarity"
APPROACH = "approach"
PEAK = "peak_pressure"
RADIUS = "contact_radius"
STICK = "stick_radius"
SHIFT = "tangential_shift"
TWIST = "twist"
TILT = "tilt"
NORMAL = "normal_force"
TANGENTIAL = "tangential_force"
TORQUE = "torque"
MOMENT = "moment"
ENERGY = "dissipated_energy"
CYCLE = "energy_per_cycle"
ELASTIC = "elastic_energy"
WORK = "input_work"
AMPLITUDE = "slip_amplitude"
F1 = "ruiz_f1"
F2 = "ruiz_f2"
TENSION = "max_principal"
MISES = "von_mises"
STRESSES = (TENSION, MISES)
# Kinds of judged numbers, each with the registered quantities that count for the kind.
KINDS = {
    APPROACH: (APPROACH, NORMAL),
    PEAK: (PEAK,),
    RADIUS: (RADIUS,),
    STICK: (STICK,),
    SHIFT: (SHIFT, TANGENTIAL),
    TWIST: (TWIST, TORQUE),
    TILT: (TILT, MOMENT),
    ENERGY: (ENERGY, CYCLE),
    ELASTIC: (ELASTIC,),
    WORK: (WORK,),
    "largest_of_a_cycle": (AMPLITUDE, F1, F2),
    TENSION: (TENSION,),
    MISES: (MISES,),
}
KIND_OF = {quantity: kind for kind, names in KINDS.items() for quantity in names}


@dataclass(frozen=True)
class Truth:
    """Hold one known number of a randomly drawn scene, with which a solver's result is compared.

    step         number of the load step, from 1, at whose end the number is valid
    quantity     registered name of the number; of a vector, the component along x
    value        known number [SI]
    uncertainty  standard uncertainty of the known number [SI]
    """

    step: int
    quantity: str
    value: float
    uncertainty: float

    @property
    def kind(self) -> str:
        """Group in which the number is counted, such as "tangential_shift" for shifts and
        tangential forces.
        """
        return KIND_OF[self.quantity]

    def read(self, steps: Sequence[Values]) -> float | None:
        """Return the number of a solver's result that corresponds to this known number.

        The result is None if the result does not have the number.

        steps  numbers at the end of every load step of the result
        """
        value = steps[self.step - 1].get(self.quantity)
        return None if value is None else float(value[0])


class Fineness(NamedTuple):
    """Hold the discretisation with which a randomly drawn scene is solved and judged.

    solver  name of the solver on the command line
    asked   settings of the cells or of the elements
    """

    solver: str
    asked: SurfaceDiscretisation | FiniteElementDiscretisation


@dataclass(frozen=True)
class KnownScene:
    """Hold a randomly drawn scene with its known numbers and with the discretisation that is
    judged.

    scene     bodies and loads
    truths    known numbers
    fineness  discretisation whose stated errors are judged
    """

    scene: Scene
    truths: tuple[Truth, ...]
    fineness: Fineness

    @property
    def solver(self) -> DiscretisedSolver:
        """Solver of the scene with the judged discretisation."""
        return SolverName(self.fineness.solver).solver(self.scene, self.fineness.asked)


def known(step: int, values: Mapping[str, float], uncertainty: float) -> Iterator[Truth]:
    """Yield known numbers at the end of a load step, which have one relative uncertainty in common.

    step         number of the load step, from 1
    values       numbers by registered name [SI]
    uncertainty  standard uncertainty relative to each number
    """
    for quantity, value in values.items():
        yield Truth(step, quantity, value, uncertainty * abs(value))


Rng = np.random.Generator
Bodies = tuple[Body, Body]
Lower = Callable[[Rng, float], Body]
Pair = Callable[[Rng, float], Bodies]

# bounds of the number of cells per side
FEWEST = 16
MOST = 128
WIDTHS = (2.3, 3.4)  # bounds of the window side over the contact radius
ELEMENTS_PER_RADIUS = (8, 32)
STRAINS = (3e-3, 3e-2)  # bounds of contact radius over radius of curvature
# Height map: number of points per side; side length over the contact radius.
MAP_POINTS = 24
MAP_WIDTH = 4.0
# Increments of a load step of histories with few increments.
FEW_INCREMENTS = (2.0, 24.0)
# Map of friction: number of points per side; side length over the contact radius, enough for
# enlarged windows.
MAP_POINTS_OF_FRICTION = 96
MAP_EXTENT = 16.0


def logarithmic(rng: Rng, low: float, high: float) -> float:
    """Draw a random number between two bounds, whose logarithm is uniformly distributed.

    rng  random generator
    """
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


# ---- bodies: the lower one and that of the indenter; a is the contact radius [length] ----------


def material(rng: Rng, poisson_ratio: float | None = None) -> IsotropicMaterial:
    """Draw a random isotropic material: E between 5 and 400 GPa, ν between 0 and 0.49.

    rng            random generator
    poisson_ratio  ν, if prescribed
    """
    nu = float(rng.uniform(0.0, 0.49)) if poisson_ratio is None else poisson_ratio
    return IsotropicMaterial(young_modulus=logarithmic(rng, 5e9, 4e11), poisson_ratio=nu)


def layered(
    rng: Rng, a: float, contrast: float, thickness: tuple[float, float], most_layers: int = 1
) -> Body:
    """Draw a random body: one or more layers on a base of random material.

    rng          random generator
    a            contact radius [length]
    contrast     largest ratio of Young's moduli of the layer and the base, above or below 1, for
                 one layer; for two layers its square root holds for each layer
    thickness    bounds of the thickness of each layer over the contact radius
    most_layers  largest number of layers
    """
    base, count = material(rng), int(rng.integers(1, most_layers + 1))
    layers = tuple(
        Layer(
            thickness=a * logarithmic(rng, *thickness),
            material=IsotropicMaterial(
                young_modulus=base.young_modulus
                * logarithmic(rng, contrast ** (-1 / count), contrast ** (1 / count)),
                poisson_ratio=float(rng.uniform(0.0, 0.49)),
            ),
        )
        for _ in range(count)
    )
    return Body(material=base, layers=layers)


def coated(rng: Rng, a: float) -> Body:
    """Draw a random body with one or two layers on a base.

    The modulus of one layer is within a factor of 10 of the base modulus, that of each of two
    layers within √10.

    rng  random generator
    a    contact radius [length]
    """
    return layered(rng, a, 10.0, (0.2, 3.0), 2)


def film(rng: Rng, a: float) -> Body:
    """Draw a random body with one film, whose modulus is within a factor of 100 of the base
    modulus.

    rng  random generator
    a    contact radius, which determines the film thickness [length]
    """
    return layered(rng, a, 100.0, (0.03, 3.0))


def bare(rng: Rng, a: float) -> Body:
    """Draw a random body of one material, without coating."""
    return Body(material=material(rng))


def without_poisson(rng: Rng, a: float) -> Body:
    """Draw a random body of one material with ν = 0, without coating."""
    return Body(material=material(rng, 0.0))


def below_rigid(lower: Lower) -> Pair:
    """Return a distribution of pairs of bodies: a random lower body and a rigid indenter.

    lower  distribution of the lower body
    """
    return lambda rng, a: (lower(rng, a), Body(material=RIGID))


def alike(lower: Lower) -> Pair:
    """Return a distribution of pairs of two equal random bodies, which have no coupling of pressure
    and shear.

    lower  distribution of the material and layers of both bodies
    """
    return lambda rng, a: (lower(rng, a),) * 2


def unlike(lower: Lower) -> Pair:
    """Return a distribution of pairs of bodies: a random lower body and another uncoated indenter.

    lower  distribution of the lower body
    """
    return lambda rng, a: (lower(rng, a), bare(rng, a))


# ---- shapes: r is the radius of curvature [length] ----------------------------------------------


class Profile(ShapedBody):
    """Represent an axisymmetric indenter with a power-law gap, optionally around a flat or a ring.

    The gap at radius r is max(|r - ring| - flat, 0)^power / (power scale^(power-1)).

    power  exponent
    scale  length that determines the curvature [length]
    flat   radius of the flat, or half-width of a flat ring [length]
    ring   radius of the ring of first touch [length]
    """

    power: float = 2.0
    scale: float
    flat: float = 0.0
    ring: float = 0.0

    @property
    def is_of_revolution(self) -> bool:
        """True, because the shape is axisymmetric."""
        return True

    @property
    def gap_exponent(self) -> float | None:
        """Exponent of the gap at the point of first touch; None for a flat or a ring."""
        return None if self.flat or self.ring else self.power

    def initial_gap(self, x: Any, y: Any) -> Field:
        """Compute the gap between the undeformed surfaces at points (x, y) [length]."""
        r = np.maximum(np.abs(np.hypot(x, y) - self.ring) - self.flat, 0.0)
        return np.asarray(r**self.power / (self.power * self.scale ** (self.power - 1)))


def ball(rng: Rng, r: float, a: float) -> ShapedBody:
    """Return a paraboloid with radius of curvature r, as indenter shape of a random scene.

    rng  random generator, which is not used
    a    nominal contact radius, which is not used [length]
    """
    return Paraboloid(radius=r, material=RIGID)


def sphere(rng: Rng, r: float, a: float) -> ShapedBody:
    """Return a sphere of radius r, as indenter shape of a random scene.

    rng  random generator, which is not used
    a    nominal contact radius, which is not used [length]
    """
    return Sphere(radius=r, material=RIGID)


def cone(rng: Rng, r: float, a: float) -> ShapedBody:
    """Return a cone that has the height of a paraboloid of radius r at the contact radius a.

    rng  random generator, which is not used
    """
    return Cone(slope_angle=a / (2 * r), material=RIGID)


def punch(rng: Rng, r: float, a: float) -> ShapedBody:
    """Return a flat punch of radius a, as indenter shape of a random scene.

    rng  random generator, which is not used
    r    radius of curvature, which is not used
    """
    return FlatPunch(radius=a, material=RIGID)


def ellipsoid(rng: Rng, r: float, a: float) -> ShapedBody:
    """Draw a random indenter with radii of curvature r along x and 0.3 r to 3 r along y.

    rng  random generator
    a    nominal contact radius, which is not used [length]
    """
    return Ellipsoid(radii=(r, r * logarithmic(rng, 0.3, 3.0)), material=RIGID)


def power_law(rng: Rng, r: float, a: float) -> ShapedBody:
    """Draw a random axisymmetric indenter with a gap ∝ r^k, where k lies between 1.5 and 8.

    For k above 2 the pressure has its maximum near the contact edge. At the nominal contact radius
    a, the gap is a²/(k r), similar to that of a paraboloid of radius r.

    rng  random generator
    """
    k = logarithmic(rng, 1.5, 8.0)
    return Profile(power=k, scale=a * (r / a) ** (1 / (k - 1)), material=RIGID)


def rounded_flat(rng: Rng, r: float, a: float) -> ShapedBody:
    """Draw a random indenter with a central flat of radius 0.2 a to 0.8 a and a rounded edge.

    rng  random generator
    r    radius of curvature of the edge [length]
    a    nominal contact radius [length]
    """
    return Profile(scale=r, flat=a * float(rng.uniform(0.2, 0.8)), material=RIGID)


def ring(rng: Rng, r: float, a: float) -> ShapedBody:
    """Draw a random ring-shaped indenter that first touches at a radius between 0.3 a and 0.7 a.

    rng  random generator
    r    radius of curvature of the ring [length]
    a    nominal contact radius [length]
    """
    return Profile(scale=r, ring=a * float(rng.uniform(0.3, 0.7)), material=RIGID)


def smooth_map(rng: Rng, r: float, a: float) -> ShapedBody:
    """Draw a random height map: a paraboloid with waves of about 2/3 of the contact radius and
    longer.

    rng  random generator
    r    radius of curvature of the paraboloid [length]
    a    nominal contact radius [length]
    """
    return _height_map(rng, r, a, waves=float(rng.uniform(2.0, 4.0)), rough=0.1)


def rough_map(rng: Rng, r: float, a: float) -> ShapedBody:
    """Draw a random height map: a paraboloid with short waves, which make several contact patches.

    rng  random generator
    r    radius of curvature of the paraboloid [length]
    a    nominal contact radius [length]
    """
    return _height_map(rng, r, a, waves=float(rng.uniform(1.0, 1.5)), rough=0.4)


def _height_map(rng: Rng, r: float, a: float, waves: float, rough: float) -> ShapedBody:
    """Draw a random height map: a paraboloid of radius r with smoothed random waves.

    rng    random generator
    a      contact radius [length]
    waves  smoothing length of the waves, in points of the map
    rough  root mean square height of the waves, over the height of the paraboloid at the radius a
    """
    side = MAP_WIDTH * a / MAP_POINTS
    x = (np.arange(MAP_POINTS) - (MAP_POINTS - 1) / 2) * side
    field = gaussian_filter(rng.standard_normal((MAP_POINTS, MAP_POINTS)), waves, mode="wrap")
    parabola = (x[:, None] ** 2 + x**2) / (2 * r)
    heights = parabola + rough * a**2 / (2 * r) * field / np.std(field)
    return HeightMap(file=heights, spacing=side, material=RIGID)  # type: ignore[arg-type]


# ---- histories and grids ------------------------------------------------------------------------


def pushes(rng: Rng) -> tuple[float, ...]:
    """Draw a random history of tangential forces (or torques), as fractions of those at gross slip.

    The fractions belong to the ends of the load steps. The history is one of: two steps in one
    direction, a push followed by a smaller force of either sign, or a fretting loop of one of two
    forms.

    rng  random generator
    """
    most = float(rng.uniform(0.3, 0.95))
    between = most * float(rng.uniform(-0.9, 0.9))
    histories = (
        (most * float(rng.uniform(0.3, 0.8)), most),
        (most, between),
        (most, between, -most, most),
        (most, -most, most),
    )
    return histories[int(rng.integers(len(histories)))]


def near_gross_slip(rng: Rng) -> tuple[float, ...]:
    """Draw one random tangential force between 0.99 and 0.9999 of the friction limit."""
    return (1 - logarithmic(rng, 1e-4, 1e-2),)


def loops_beyond_onset(rng: Rng) -> tuple[float, ...]:
    """Draw a random loop of tangential shifts, over the shift at the onset of gross slip.

    The shift is 1.1 to 5 times that at the onset, so that the reversals reach gross slip, too.

    rng  random generator
    """
    most = logarithmic(rng, 1.1, 5.0)
    return most, -most, most


def friction_map(rng: Rng, a: float, mu: float) -> CoulombFriction:
    """Draw a random map of coefficients of friction between mu and 1.5 mu.

    The coefficient is a wave along each axis, of 2 to 6 contact radii.

    rng  random generator
    a    contact radius [length]
    mu   smallest coefficient of friction
    """
    side = MAP_EXTENT * a / MAP_POINTS_OF_FRICTION
    x = (np.arange(MAP_POINTS_OF_FRICTION) - (MAP_POINTS_OF_FRICTION - 1) / 2) * side
    waves = [
        np.sin(2 * np.pi * x / (a * float(rng.uniform(2.0, 6.0))) + float(rng.uniform(0.0, 6.3)))
        for _ in range(2)
    ]
    values = mu * (1.25 + 0.125 * (waves[0][:, None] + waves[1]))
    mapped = FrictionMap(map=values, spacing=side)  # type: ignore[arg-type]
    return CoulombFriction(coefficient=mapped)


def closes(forces: Sequence[float]) -> bool:
    """Determine if a history of tangential forces contains a closed cycle.

    This is true if the last force is equal to the first.
    """
    return len(forces) > 1 and forces[-1] == forces[0]


def fineness(
    rng: Rng, reach: tuple[float, float], solver: str, limits: tuple[float, float]
) -> Fineness:
    """Draw a random discretisation of a scene: a grid of cells around the contact, or a number of
    elements.

    rng     random generator
    reach   semi-axes of the contact [length]
    solver  name of the solver
    limits  smallest and largest number of cells per contact radius
    """
    if solver == ELEMENTS:
        count = round(logarithmic(rng, *ELEMENTS_PER_RADIUS))
        return Fineness(ELEMENTS, FiniteElementDiscretisation(elements_per_radius=count))
    width = float(rng.uniform(*WIDTHS))
    nx = int(np.clip(round(logarithmic(rng, *limits) * width), FEWEST, MOST - 1))
    window = (width * reach[0], width * float(rng.uniform(0.97, 1.1)) * reach[1])
    grid = SurfaceDiscretisation(cells=(nx, nx + int(rng.integers(0, 2))), window=window)
    return Fineness(CELLS, grid)
