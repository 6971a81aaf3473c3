"""What a study by finite elements starts from: the contact of a scene, and its section."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from contact_scene import FiniteElementDiscretisation, Scene, SceneFile
from fem_reference import Method, Path, plan, solve
from fem_reference.mesh.section_outline import sufficient_box
from fem_reference.model import outermost_modulus
from fem_reference.scales import Scales
from verification.studies.refinement.section_level import REACH, SectionLevel
from verification.studies.refinement.studied_scene import StudiedScene, cut_into

SCOUT_ELEMENTS = 32
# A history may outgrow the contact at its end by so much, and still fit the zone of fine elements.
OUTGROWN = 1.02


@dataclass(frozen=True)
class SectionStart:
    """A scene, a method, and what was found of its contact on a coarse mesh.

    radius  of the contact at the end, or the largest of the history if that is larger [length]
    box     size of the section [length]
    """

    scene: StudiedScene
    method: Method
    contents: SceneFile
    radius: float
    box: float

    @classmethod
    def of(cls, scene: StudiedScene, method: Method) -> SectionStart:
        """The contact is found on a coarse mesh unless the scene's file says how large it is.

        Raises what `fem_reference.solve` raises.
        """
        return cls(scene, method, scene.read(), *_scouted(scene))

    @property
    def asked(self) -> FiniteElementDiscretisation:
        """What the file says of the mesh."""
        return self.contents.fem_reference

    @property
    def tolerance(self) -> float:
        """Of the solver."""
        return self.asked.tolerance

    @property
    def couples(self) -> bool:
        """Whether pressure and shear act on each other."""
        path = plan(self.contents.scene).path
        return path in (Path.PRESSING_WITH_FRICTION, Path.HARMONICS)

    @property
    def increments(self) -> tuple[int, ...]:
        """Of each step, as asked for or chosen."""
        return plan(self.contents.scene).increments

    @property
    def path_matters(self) -> tuple[bool, ...]:
        """Of each step: whether it is cut into more than one increment if it names none."""
        open_ = cut_into(self.contents.scene, [None] * len(self.contents.scene.loading))
        return tuple(count > 1 for count in plan(open_).increments)

    def level(
        self,
        size: float,
        level: str,
        *,
        fineness: int | None = None,
        box: float | None = None,
        increments: tuple[int, ...] | None = None,
    ) -> SectionLevel:
        """A level: what is not given is as the scene's file has it.

        fineness  elements per contact radius
        box       size of the section [length]
        """
        count = fineness or self.asked.elements_per_radius
        laid_out = count * self.element(count)
        return SectionLevel(
            self.scene,
            self.method.value,
            count,
            laid_out,
            (box or self.box) / laid_out,
            REACH * self.radius,
            increments or self.increments,
            size,
            level,
        )

    def element(self, count: int) -> float:
        """Side of an element at the contact, of so many over its radius [length].

        Elements are laid out half of one short of the edge unless the radius is known, so that it
        lies in the middle of one on every mesh: where in an element it lies moves the error as much
        as some more elements do, and would hide the order.
        """
        rim, given = self.contents.scene.indenter.rim, self.asked.contact_radius
        return self.radius / (count + 0.5 if rim is None and given is None else count)


@cache
def _scouted(scene: StudiedScene) -> tuple[float, float]:
    """Radius of the contact, and size of the section [length]."""
    contents = scene.read()
    asked = contents.fem_reference
    coarse = asked.model_copy(update={"elements_per_radius": SCOUT_ELEMENTS})
    result = solve(contents.scene, coarse)
    end = result.steps[-1].contact_radius
    largest = max(increment.contact_radius for increment in result.increments)
    radius = asked.contact_radius or (end if largest <= OUTGROWN * end else largest)
    return radius, radius * (asked.box or _chosen_box(contents.scene, radius))


def _chosen_box(scene: Scene, radius: float) -> float:
    """What the finite elements choose for contacts of this radius, over the radius."""
    scales = Scales(radius, outermost_modulus(scene))
    bodies = (scales.dimensionless(body) for body in (scene.body, scene.indenter) if body.deforms)
    return max(sufficient_box(body) for body in bodies)
