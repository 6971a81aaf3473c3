"""The whole of a scene file: the scene, and beside it how fine each solver shall be,
or how accurate the answer."""

from contact_scene.accuracy import AccuracyRequest
from contact_scene.consistency import Parts
from contact_scene.discretisation import (
    FiniteElementDiscretisation,
    RadialDiscretisation,
    SurfaceDiscretisation,
)
from contact_scene.scene import Scene


class SceneDocument(Scene):
    """Contents of a scene file."""

    semi_analytical: SurfaceDiscretisation = SurfaceDiscretisation()
    """How fine the semi-analytical solver shall be; absent: chosen for the accuracy."""

    fem_reference: FiniteElementDiscretisation = FiniteElementDiscretisation()
    """How fine the finite-element reference shall be; absent: chosen."""

    radial: RadialDiscretisation = RadialDiscretisation()
    """Where the radial solver shows its fields; absent: chosen."""

    accuracy: AccuracyRequest | None = None
    """How accurate the numbers shall be; it then decides how fine. Absent: as fine as the solvers'
    tables say."""

    def _parts(self) -> Parts:
        return {**super()._parts(), "semi_analytical": self.semi_analytical}
