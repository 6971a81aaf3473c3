"""Features of a contact on which the convergence of its scalars depends, measured in cells.

A solver measures the features of its results. They decide whether its cells, elements or rings
resolve the contact, and with which order the error of each scalar falls.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from contact_scene.accuracy import LARGEST_TENSION
from contact_scene.geometry import ShapedBody
from contact_scene.quantities.increment import STIFFNESSES
from contact_scene.quantities.summary import OF_CYCLES

# Convergence orders in the cell size: of means of smooth fields, of values at the edge of a zone
# that lies within a cell, and of values near a square-root singularity.
SMOOTH = 2.0
EDGE = 1.0
ROOT = 0.5

# Reason why an error is not converged.
HIDDEN = "a stick or slip zone smaller than a cell is possible"

# Features that cells have to resolve.
CONTACT = "semi-axis of the contact"
WAVE = "wavelength of the surface"
LAYER = "thickness of a layer"
STICK = "semi-axis of the stick zone"
# Smallest resolved size of each feature in cells. Elements and rings count as two cells, because
# their shape functions are linear.
LIMITS: Mapping[str, float] = MappingProxyType(
    {CONTACT: 4.0, WAVE: 4.0, LAYER: 1.0, STICK: 1.0}  # STICK: of its radius, and of a cusp
)
# Smallest stick zone in cells whose fitted edge converges with the order 2.
FITTED_STICK = 3.0

CONTACT_EDGE = frozenset({"contact_radius", "contact_area"})
STICK_EDGE = frozenset({"stick_radius", "stick_area", "stick_centre"})
# Scalars that are largest values at the contact edge.
AT_EDGES = frozenset({"slip_amplitude", "ruiz_f1", "ruiz_f2"})
PEAK = "peak_pressure"
OF_SLIP = frozenset(
    {
        *("tangential_shift", "tangential_force", "twist", "torque", "dissipated_energy"),
        *("actuator_shift", "input_work", *OF_CYCLES),
    }
)


@dataclass(frozen=True)
class Features:
    """Features of the contact at the end of a load step on which the errors of the scalars depend.

    The sizes determine if the cells resolve the contact, and the flags determine the convergence
    orders. Sizes are in cells; an element or a ring counts as two cells. None stands for an absent
    feature.

    contact       smaller semi-axis of the contact
    layer         thickness of the thinnest layer
    wave          mean wavelength of the heights of a rough surface
    stick         smaller semi-axis of the stick zone
    annulus       width of the slip zone around the stick zone; 0 if all cells slip, but a stick
                  zone may be hidden within a cell
    fitted        true if the contact edge is fitted within the cells
    stick_fitted  true if the edge of the stick zone is fitted within the cells
    largest_order  largest convergence order of all scalars: ½ on cells below a rim, which cuts them
                  at any position and at which the pressure has a root singularity; 1 below a tip,
                  if the contact edge is not fitted
    infinite      true if the exact peak pressure is infinite
    cusp          true if the pressure has a cusp, because shear changes the pressure or the gap is
                  a power between 1 and 2 of the distance
    peak_by_edge  true if the error of the peak pressure depends on the position of the contact
                  edge within a cell: the peak is nearer to the edge than to the middle, or is the
                  value at one ring of nodes (at a node the edge causes 7 times the error that it
                  causes in the middle of an element)
    slip_fitted   true if the slip amplitude is fitted at the edge of the contact within the cells
    slip_by_line  true if the largest slip amplitude and F1 lie on a line through rings of nodes to
                  the edge, which leaves an error of the order 2
    slides        true in gross slip, if no stick zone can be hidden within a cell
    left          relative errors of scalars, by name, that remain when the iteration of the edge
                  correction (subcell pressure at the contact edge) stops
    layer_at_edge  smallest thickness of a layer that resolves the edge of the contact
    largest       largest errors of scalars, by name, that elements can cause: the edge of the
                  contact lies within an element [unit of the scalar]
    least         least errors of scalars, by name, that rings cause: coarse solves with a ring at
                  the same edge of the contact show none [unit of the scalar]
    """

    contact: float
    layer: float | None = None
    wave: float | None = None
    stick: float | None = None
    annulus: float | None = None
    fitted: bool = False
    stick_fitted: bool = False
    largest_order: float = SMOOTH
    infinite: bool = False
    cusp: bool = False
    peak_by_edge: bool = False
    slip_fitted: bool = False
    slip_by_line: bool = False
    slides: bool = False
    layer_at_edge: float = LIMITS[LAYER]
    left: Mapping[str, float] = field(default_factory=dict)
    largest: Mapping[str, float] = field(default_factory=dict)
    least: Mapping[str, float] = field(default_factory=dict)

    def convergence_order(self, name: str) -> float:
        """Return the theoretical convergence order p of a scalar in the cell size h: error ~ h^p.

        The order is 2 for means of smooth fields, 1 for values at an edge of the contact or stick
        zone that lies within a cell, and ½ for values near a square-root singularity.

        name  name of the scalar, such as "peak_pressure"
        """
        if name == "ruiz_f2" or (name == PEAK and self.cusp):
            return ROOT
        # Without slip the edge of the stick zone is that of the contact.
        small = self.stick is not None and self.stick < FITTED_STICK
        stick_fitted = self.fitted if self.annulus is None else self.stick_fitted and not small
        first = (
            name == LARGEST_TENSION  # at the edge of the contact, or inside
            or (name in AT_EDGES and not self.slip_by_line)
            or (name == PEAK and self.peak_by_edge)
            or (name in CONTACT_EDGE and not self.fitted)
            or (name in STICK_EDGE and not stick_fitted)
            or name in STIFFNESSES
        )
        return min(self.largest_order, EDGE if first else SMOOTH)

    def unresolved(self, name: str, finest: float = 1.0) -> str | None:
        """Return the reason if a feature of the contact on which a scalar depends is unresolved.

        Features are the contact, layers, waves of a rough surface and the stick zone. Each must be
        at least as large as its limit in the cells of the finest solve. Scalars that depend on slip
        also require that no stick zone is hidden within a cell. Otherwise the error estimate is
        unreliable. The result is None if all features are resolved.

        name    name of the scalar, such as "stick_radius"
        finest  cell size of the finest of the compared solves over that of the run
        """
        # Below the friction limit a stick zone exists, even if it contains no cell.
        hidden = self.annulus == 0 or (self.stick == 0 and not self.slides)
        if hidden and name in OF_SLIP:
            return HIDDEN
        of_stick = name in STICK_EDGE or (name == PEAK and self.cusp and not self.slides)
        sizes = {
            CONTACT: self.contact,
            LAYER: self.layer,
            WAVE: self.wave,
            STICK: self.stick if of_stick else None,
        }
        for feature, size in sizes.items():
            at_edge = feature == LAYER and name in CONTACT_EDGE
            least = self.layer_at_edge if at_edge else LIMITS[feature]
            if size is not None and size / finest < least:
                limit = f"{least:g} (half elements and half rings count as cells)"
                return f"the {feature} is {size:.2g} cells, below the limit {limit}"
        return None


def is_singular(indenter: ShapedBody) -> bool:
    """Return true if the exact pressure is infinite below a rim or a tip of the indenter.

    The error of the peak pressure is then undefined, and other scalars converge with a lower order.

    indenter  body with its shape
    """
    return indenter.rim is not None or indenter.gap_exponent == 1


def has_cusp(indenter: ShapedBody) -> bool:
    """Return true if the pressure below a smooth indenter has a cusp at the point of first contact.

    The pressure has a cusp if the gap between the undeformed surfaces is a power between 1 and 2 of
    the distance from this point. The cusp reduces the convergence order of the peak pressure.

    indenter  body with its shape
    """
    return indenter.gap_exponent is not None and 1 < indenter.gap_exponent < 2
