"""The contacts of the sliding studies: the paper's coated ones, and pairs that do not couple."""

from __future__ import annotations

from dataclasses import dataclass

from contact_scene import (
    Body,
    IsotropicMaterial,
    LoadStep,
    Scene,
)
from semi_analytical.grid import SurfaceGrid
from verification.problems.layered_scene import (
    SUBSTRATE,
    coated,
    exact_contact,
    film,
    pressed,
    rigid_ball,
)
from verification.problems.paper_scene import (
    CONTACT_MODULUS,
    FRICTION,
    HERTZ,
    NORMAL_FORCE,
    paraboloid,
    square_grid,
)

# Half a window in contact radii: friction and coupling change the radius by less than 2 %.
MARGIN = 1.15
# Share of the coating in the tangential compliance of a layer as thick as the contact radius:
# near enough to place increments, and used for nothing else.
COATING_SHARE = 0.8


@dataclass(frozen=True)
class CoatedContact:
    """Rigid ball on a coating as thick as the Hertz radius (paper, figures 3 and 4).

    modulus_ratio  E1 / E2, coating over substrate
    """

    modulus_ratio: float

    @property
    def name(self) -> str:
        """For file names."""
        return f"coated-{self.modulus_ratio:g}"

    @property
    def contact_radius(self) -> float:
        """Without friction [length]."""
        return exact_contact(self._body).contact_radius

    @property
    def sliding_displacements(self) -> tuple[float, float]:
        """Mindlin's shift at gross sliding, were all of it coating or all of it substrate."""
        sub = _sliding_displacement(SUBSTRATE, self.contact_radius)
        return sub / self.modulus_ratio, sub

    @property
    def sliding_scale(self) -> float:
        """About the shift at which the stick area vanishes, to place increments by."""
        coating, substrate = self.sliding_displacements
        return COATING_SHARE * coating + (1 - COATING_SHARE) * substrate

    @property
    def beyond_sliding(self) -> float:
        """Three times the larger of Mindlin's sliding displacements."""
        return 3 * max(self.sliding_displacements)

    def scene(self, *loading: LoadStep) -> Scene:
        """The scene under these loads."""
        title = f"Rigid ball on a coated half-space, E1/E2 = {self.modulus_ratio:g}"
        return pressed(title, rigid_ball(), self._body, *loading, friction=FRICTION)

    def grid(self, cells: int) -> SurfaceGrid:
        """A square grid on a window around the contact."""
        return square_grid(cells, MARGIN * self.contact_radius)

    @property
    def _body(self) -> Body:
        return coated(film(self.modulus_ratio, 1.0))


@dataclass(frozen=True)
class AlikeContact:
    """Two identical bodies, together as compliant as the paper's one: nothing couples.

    poisson_ratio  0: Cattaneo and Mindlin's solution is exact
    """

    poisson_ratio: float

    @property
    def name(self) -> str:
        """For file names."""
        return f"alike-{self.poisson_ratio:g}"

    @property
    def contact_radius(self) -> float:
        """Hertz's [length]."""
        return HERTZ.contact_radius

    @property
    def sliding_scale(self) -> float:
        """Mindlin's shift at gross sliding [length]."""
        return 2 * _sliding_displacement(self._material, self.contact_radius)

    @property
    def beyond_sliding(self) -> float:
        """Three times Mindlin's sliding displacement."""
        return 3 * self.sliding_scale

    def scene(self, *loading: LoadStep) -> Scene:
        """The scene under these loads."""
        title = f"Two identical bodies, ν = {self.poisson_ratio:g}"
        ball = paraboloid(self._material)
        return pressed(title, ball, Body(material=self._material), *loading, friction=FRICTION)

    def grid(self, cells: int) -> SurfaceGrid:
        """A square grid on a window around the contact."""
        return square_grid(cells, MARGIN * self.contact_radius)

    @property
    def _material(self) -> IsotropicMaterial:
        nu = self.poisson_ratio
        modulus = 2 * CONTACT_MODULUS * (1 - nu**2)
        return IsotropicMaterial(young_modulus=modulus, poisson_ratio=nu)


Contact = CoatedContact | AlikeContact


def _sliding_displacement(material: IsotropicMaterial, contact_radius: float) -> float:
    """3 µW (2 - ν) / (16 a G) of one body (Mindlin 1949)."""
    nu, G = material.poisson_ratio, material.shear_modulus
    return 3 * FRICTION * NORMAL_FORCE * (2 - nu) / (16 * contact_radius * G)
