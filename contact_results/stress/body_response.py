"""Response of one body to the surface tractions of a contact: its stress, whatever the solver."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar, Self

from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.points import MEASURES, ON_INTERFACES, StressField, StressPoints
from contact_scene import Body
from contact_scene.array_types import Field
from contact_scene.quantities.stated_error import Part

if TYPE_CHECKING:
    from semi_analytical.frf.depth import Level

THIN = 0.125


@dataclass(frozen=True, eq=False)
class BodyResponse(ABC):
    """One body below the surface tractions of a contact result.

    `below_contact.body_response` creates the response of the solver of the result.

    state     bodies and tractions that cause the stress
    indenter  True for the stress in the indenter, False for the lower body
    """

    state: LoadedBodies
    indenter: bool = False

    # Part of the error of a stress that the discretisation of the tractions causes.
    part: ClassVar[Part]

    @property
    def body(self) -> Body:
        """Layers and base of the body in which the stress is computed."""
        return self.state.loaded_body(self.indenter)

    @property
    def decaying(self) -> Collection[str]:
        """Names of the stress measures that decay far from the contact.

        A bulk strain causes stress at any distance, but none on interfaces.
        """
        strained = self.state.strain is not None and not self.indenter
        return ON_INTERFACES if strained else tuple(MEASURES)

    @abstractmethod
    def stress(self, depths: Sequence[float] | None = None, *, volume: bool = False) -> StressField:
        """Compute the stress at the points of the solver: cells, radii, or nodes of elements.

        depths  depths at which the stress is computed [length]; None for those of the solver.
                Without effect on elements
        volume  True for the stress in the volume as well; on cells only

        Raises ValueError for a depth outside the body, ResourceRefused for too little memory, and
        UnsupportedScene for shear that the radial solver does not resolve.
        """

    @abstractmethod
    def stress_at(self, x: Field, y: Field, levels: Sequence[Level]) -> StressPoints:
        """Compute the stress at given points.

        x, y    coordinates of the points (n,) [length]
        levels  depth and layer of each point (n,)

        Raises ResourceRefused if a point is too far from the contact, or for too little memory, and
        UnsupportedScene if the solver has no stress at chosen points.
        """

    @abstractmethod
    def compared(self) -> Sequence[BodyResponse]:
        """Return responses of another fineness, whose stress is compared for an error estimate."""

    def with_more_shear(self, share: float) -> Self:
        """Return the response to tractions whose shear is larger by a share of itself."""
        tractions = {
            name: field if name == "pressure" else (1 + share) * field
            for name, field in self.state.tractions.items()
        }
        return replace(self, state=replace(self.state, tractions=tractions))

    def on_wider_section(self, factor: float) -> BodyResponse | None:
        """Return the first of the compared responses on a wider section; None without a section.

        factor  ratio of the outer radii of the sections
        """
        return None

    @abstractmethod
    def drawn_stress(self) -> StressField | None:
        """Compute the stress that the overview of a run shows; None if it would take too long."""


def are_layers_thin(body: Body, depth: float) -> bool:
    """Return True if the layers together are thinner than THIN times a depth.

    Figures that show this depth stretch the layers, and need further depths within them.

    body   layers and base
    depth  largest depth of a figure [length]
    """
    return 0 < sum(layer.thickness for layer in body.layers) < THIN * depth
