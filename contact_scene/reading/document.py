"""Model of a scene file, the scene with discretisations and accuracy, and its JSON Schema."""

from typing import Any

from contact_scene.accuracy import AccuracyRequest
from contact_scene.discretisation import (
    FiniteElementDiscretisation,
    RadialDiscretisation,
    SurfaceDiscretisation,
)
from contact_scene.geometry import SHAPES
from contact_scene.reading.description import DescribedSchema
from contact_scene.scene import Scene


class SceneFile(Scene):
    """Contents of a scene file: the scene, the discretisation of each solver, and an accuracy."""

    semi_analytical: SurfaceDiscretisation = SurfaceDiscretisation()
    """Discretisation of the semi-analytical solver; absent: default values."""

    fem_reference: FiniteElementDiscretisation = FiniteElementDiscretisation()
    """Discretisation of the finite-element reference; absent: default values."""

    radial: RadialDiscretisation = RadialDiscretisation()
    """Output points and tolerance of the radial solver; absent: default values."""

    accuracy: AccuracyRequest | None = None
    """Requested accuracy, which then determines the discretisation; absent: the discretisation is
    that of the solver's table."""

    @property
    def scene(self) -> Scene:
        """Scene without discretisations and accuracy."""
        return Scene.model_construct(**{name: getattr(self, name) for name in Scene.model_fields})


def scene_schema() -> dict[str, Any]:
    """Create the JSON Schema of a scene file (TOML read as JSON).

    The consistency of the tables with each other is not part of the schema.
    """
    schema = SceneFile.model_json_schema(mode="validation", schema_generator=DescribedSchema)
    schema["title"] = "slipstick scene"
    for shape in SHAPES.values():  # optional in Python, where the class defines the shape
        schema["$defs"][shape.__name__]["required"].insert(0, "shape")
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}
