"""JSON Schema of the scene file, for editors and other programs."""

from typing import Any

from contact_scene.document import SceneDocument
from contact_scene.geometry import SHAPES


def scene_schema() -> dict[str, Any]:
    """JSON Schema of a scene file (TOML read as JSON).

    It holds what a schema can say; what the parts must have in common is checked on reading.
    """
    schema = SceneDocument.model_json_schema(mode="validation")
    schema["title"] = "slipstick scene"
    for shape in SHAPES.values():  # in Python the class says it, in a file nothing else does
        schema["$defs"][shape.__name__]["required"].insert(0, "shape")
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}
