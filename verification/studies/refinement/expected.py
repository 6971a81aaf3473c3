"""Orders of convergence that theory, or a measurement on known solutions, leads one to expect."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from contact_scene import RIGID, ControlKind, Scene
from contact_scene.geometry import SmoothTip
from verification.convergence.stored_field import PRESSURE, SHEAR

PAIRS = ("tangential_shift", "tangential_force")
SHIFTS = ("tangential_shift_x", "tangential_shift_y")


@dataclass(frozen=True)
class Expected:
    """An order p of h^p, and why.

    allowance  how far from it the order may be on meshes of a usual size, and the reason says why
    """

    order: float
    because: str
    allowance: float = 0.0


FIRST_ORDER = Expected(
    1.0,
    "an increment decides once what slips, and where to (backward Euler): first order where the "
    "direction of slip changes along the path",
)
SELF_SIMILAR = Expected(
    2.0,
    "slip keeps its direction while the contact grows; what the increments miss of the stick zone "
    "alternates and cancels in a mean",
)
STUCK_SHEAR = Expected(
    1.5,
    "the shear of a ring is fixed where the edge of stick passes; next to it the shear leaves the "
    "friction limit as a square root: O(√h) on bands of width h",
)
EDGES = Expected(
    1.5,
    "square-root edges of stick zone and contact: O(√h) on rings one cell wide leaves O(h^3/2) in "
    "L1",
)
MEAN = Expected(
    2.0, "a weighted mean of the displacement: errors at the edges alternate and cancel"
)
BETWEEN_APPROACHES = Expected(
    2.5,
    "between alike bodies shift and energy follow from the approaches of the contact and of the "
    "stick zone (Cattaneo), which cells make wrong by the same 0.04 h²/R; what is left depends on "
    "how circles cut the cells",
)
RADIUS = Expected(1.0, "the edge is known to a part of a cell")
PEAK = Expected(
    2.0, "even counts of cells put the centre h/√2 from the next cell centre, on a smooth top"
)

ENERGY = Expected(
    2.0,
    "tractions that are linear on rings follow the square root at the edge to O(h) in the norm of "
    "the energy; approach and load follow from the energy, which errs by the square of that",
)
CENTRE = Expected(2.0, "what the rings at the edge miss of the load, O(h²) of it, is felt here")
EDGE = Expected(
    2.0,
    "the edge is read off the last two pressures by the square root; the next term of the profile "
    "moves it by O(h/a) of a ring, and it lies in the middle of a ring on every mesh. How the last "
    "pressures tell the edge is tabulated for square elements, by their Poisson's ratio: what that "
    "leaves, 0.0003 h, is far below 0.12 h²/a up to 100 rings",
    allowance=0.1,
)
BETWEEN_MESHED_APPROACHES = Expected(
    2.0,
    "between alike bodies shift and energy follow from the approaches of the contact and of the "
    "stick zone (Cattaneo), each wrong by h²/R times a number of where in its element the edge is",
)
CUSPS = Expected(1.5, "cusps of the shear at the edges of stick, which move over the rings")
AUGMENTED = Expected(
    2.0,
    "springs become stiffer as elements become smaller, ε = cE*/h; an augmentation leaves O(1/ε²), "
    "and the mesh itself O(h²)",
)
AUGMENTED_LAYER = Expected(
    2.0,
    f"{AUGMENTED.because}; whole numbers of elements over a layer's thickness, and what the layer "
    "itself leaves of a higher order, make 2.3 of it up to 64 elements per radius",
    allowance=0.3,
)
SPRINGS = Expected(
    1.0, "springs become stiffer as elements become smaller, ε = cE*/h: they give way by O(1/ε)"
)
RESULTANT = Expected(
    3.0,
    "the section's outside feels the resultant alone; that the load is spread over the contact, "
    "a term (a/R)² smaller than the 1/R that is prescribed, moves all inside",
)
LAYER = Expected(
    2.0,
    "the displacements prescribed outside are those of the substrate; a layer adds a term h/R "
    "smaller than their 1/R, which moves all inside",
)
MOMENT = Expected(
    2.0,
    "shear moves the pressure sideways, and its moment adds a term a/R smaller than the 1/R that "
    "is prescribed outside",
)
STRAIN = Expected(
    2.0,
    "prescribed displacements know the resultant only, so the compliance is made symmetric: half "
    "of the strain, and under a tangential force of the rotation, that the resultant leads to at "
    "O(1/R²) is lost, and where pressure and shear act on each other all of them feel it",
)
SPREAD = Expected(
    3.0,
    "prescribed displacements know the resultant only, so the compliance is made symmetric: half "
    "of the term (a/R)² that is left out then varies over the contact",
)
IMAGES = Expected(
    1.0,
    "the samples next to zero take the place of an integral over a cusp 1/α: a constant in "
    "proportion to one over the period, by which the whole surface is lifted",
)
IMAGES_SHAPE = Expected(
    3.0,
    "under a force a constant does not matter; images of the load in a square lattice then bend "
    "the surface as r² over the third power of the period",
)


def by_increments(scene: Scene, couples: bool) -> Mapping[str, Expected]:
    """Orders in the increment size, by the names of `named_values` and of fields.

    couples  whether pressure and shear act on each other
    Orders are expected at the end of the last step, and first order everywhere once something
    pushes sideways.
    """
    ramps = scene.load_path()
    sideways = any(any(r.tangential.end) or r.twisting.end != 0 for r in ramps)
    names = ("approach", "peak_pressure", "contact_radius", "dissipated_energy", "twist", "torque")
    named = (*names, *(f"{name}_{axis}" for name in PAIRS for axis in "xy"))
    if sideways or len(ramps) > 1:
        return dict.fromkeys((*named, PRESSURE, SHEAR, "stick_radius", "normal_force"), FIRST_ORDER)
    if not couples:
        return {}
    averaged = dict.fromkeys(("approach", "normal_force", "contact_radius"), SELF_SIMILAR)
    return {**averaged, SHEAR: STUCK_SHEAR}


def by_cells(scene: Scene, couples: bool) -> Mapping[str, Expected]:
    """Orders in the side of a cell of the surface grid, by the same names; of smooth shapes only.

    couples  whether pressure and shear act on each other
    """
    if not isinstance(scene.indenter, SmoothTip):
        return {}
    orders = {"approach": MEAN, "contact_radius": RADIUS, "stick_radius": RADIUS}
    orders |= dict.fromkeys((*SHIFTS, "twist"), MEAN) | dict.fromkeys((PRESSURE, SHEAR), EDGES)
    if couples:
        return orders
    means = dict.fromkeys((*SHIFTS, "dissipated_energy"), BETWEEN_APPROACHES)
    return {**orders, **means, "peak_pressure": PEAK}


def by_elements(
    scene: Scene, couples: bool, augmentations: int | None, *, squares: bool
) -> Mapping[str, Expected]:
    """Orders in the side of an element at the contact, by the same names; of smooth shapes only.

    couples        whether pressure and shear act on each other
    augmentations  of the penalty method; None without a penalty
    squares        whether elements at the contact are squares, for which the edge is tabulated
    """
    if not isinstance(scene.indenter, SmoothTip):
        return {}
    means = CUSPS if couples else BETWEEN_MESHED_APPROACHES
    orders = {PRESSURE: EDGES, SHEAR: EDGES, "twist": CUSPS}
    orders |= dict.fromkeys((*SHIFTS, "dissipated_energy"), means)
    if augmentations is None:
        edge = {"contact_radius": EDGE} if squares else {}
        return orders | edge | {"approach": ENERGY, "peak_pressure": CENTRE}
    layered = any(body.layers for body in (scene.body, scene.indenter))
    springs = (AUGMENTED_LAYER if layered else AUGMENTED) if augmentations else SPRINGS
    if not augmentations:
        orders = dict.fromkeys(orders, SPRINGS)
    return orders | dict.fromkeys(("approach", "peak_pressure"), springs)


def by_box(scene: Scene, couples: bool) -> Mapping[str, Expected]:
    """Orders in one over the size of a section, by the same names.

    couples  whether pressure and shear act on each other
    Above a rigid base displacements die out faster than by any power.
    """
    endless = [body for body in (scene.body, scene.indenter) if body.deforms]
    endless = [body for body in endless if body.material != RIGID]
    if not endless:
        return {}
    layered = any(body.layers for body in endless)
    tractions = ("peak_pressure", "contact_radius", PRESSURE, SHEAR)
    motions = ("approach", *SHIFTS)
    if not _by_force(scene):
        forces = ("normal_force", "tangential_force_x", "tangential_force_y")
        by_motion = LAYER if layered else STRAIN if couples else RESULTANT
        return dict.fromkeys((*forces, *motions, *tractions), by_motion)
    orders = dict.fromkeys(tractions, SPREAD) | dict.fromkeys(motions, RESULTANT)
    if couples:
        orders = dict.fromkeys((*tractions, "approach", "dissipated_energy"), STRAIN)
        orders |= dict.fromkeys(SHIFTS, MOMENT)
    return orders | dict.fromkeys(motions, LAYER) if layered else orders


def by_period(scene: Scene, couples: bool) -> Mapping[str, Expected]:
    """Orders in one over the period of a sampled frequency response, by the same names.

    couples  whether pressure and shear act on each other: images then also stretch the surface
    """
    if not _by_force(scene):
        return {}
    # A layer adds a constant to the response at long waves, which the samples next to zero miss:
    # two terms of the period, of which the first decides only where periods are huge.
    layered = any(body.layers for body in (scene.body, scene.indenter))
    orders = {} if layered else dict.fromkeys(("approach", *SHIFTS), IMAGES)
    shapes = () if couples else ("peak_pressure", "contact_radius", PRESSURE, SHEAR)
    return orders | dict.fromkeys(shapes, IMAGES_SHAPE)


def _by_force(scene: Scene) -> bool:
    """Whether forces lead all the way."""
    controls = [control for ramp in scene.load_path() for control in (ramp.normal, ramp.tangential)]
    return all(control.kind is ControlKind.FORCE for control in controls)
