"""The whole of a scene file, the scene and how fine or how accurate, and its JSON Schema."""

from typing import Any

from contact_scene.accuracy import AccuracyRequest
from contact_scene.checks.consistency import Parts
from contact_scene.discretisation import (
    FiniteElementDiscretisation,
    RadialDiscretisation,
    SurfaceDiscretisation,
)
from contact_scene.geometry import SHAPES
from contact_scene.reading.description import DescribedSchema
from contact_scene.scene import Scene


class SceneFile(Scene):
    """Contents of a scene file: the scene, and the discretisation of each solver or an accuracy."""

    semi_analytical: SurfaceDiscretisation = SurfaceDiscretisation()
    """How fine the semi-analytical solver shall be; absent: chosen for the accuracy."""

    fem_reference: FiniteElementDiscretisation = FiniteElementDiscretisation()
    """How fine the finite-element reference shall be; absent: chosen."""

    radial: RadialDiscretisation = RadialDiscretisation()
    """Where the radial solver shows its fields; absent: chosen."""

    accuracy: AccuracyRequest | None = None
    """How accurate the numbers shall be; it then decides how fine. Absent: as fine as the solvers'
    tables say."""

    @property
    def scene(self) -> Scene:
        """The scene alone."""
        return Scene.model_construct(**{name: getattr(self, name) for name in Scene.model_fields})

    def _parts(self) -> Parts:
        return {**super()._parts(), "semi_analytical": self.semi_analytical}


def scene_schema() -> dict[str, Any]:
    """JSON Schema of a scene file (TOML read as JSON).

    It holds what a schema can say; what the parts must have in common is checked on reading.
    """
    schema = SceneFile.model_json_schema(mode="validation", schema_generator=DescribedSchema)
    schema["title"] = "slipstick scene"
    for shape in SHAPES.values():  # in Python the class says it, in a file nothing else does
        schema["$defs"][shape.__name__]["required"].insert(0, "shape")
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}
