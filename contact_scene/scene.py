"""Scene: two bodies, the friction between them, and their load history; and the scene file."""

from collections.abc import Mapping, Sequence
from typing import Any

from pydantic import Field, model_validator

from contact_scene.accuracy import AccuracyRequest
from contact_scene.body import Body
from contact_scene.checks.consistency import inconsistencies
from contact_scene.discretisation import (
    FiniteElementDiscretisation,
    RadialDiscretisation,
    SurfaceDiscretisation,
)
from contact_scene.friction import CoulombFriction
from contact_scene.geometry import SHAPES, Indenter
from contact_scene.loading import MAX_STEPS, LoadStep
from contact_scene.reading.array_file import ArrayFile
from contact_scene.reading.description import (
    MAX_TITLE,
    DescribedSchema,
    Description,
)
from contact_scene.reading.scene_error import SceneError
from contact_scene.rig import Rig
from contact_scene.stepping.load_path import (
    LoadRamp,
    load_path,
)


class Scene(Description):
    """Contact problem, without discretisation and tolerances.

    Raises `SceneError` if its tables are valid individually but contradict each other.
    """

    title: str = Field(default="", max_length=MAX_TITLE)
    """Title for reports."""

    indenter: Indenter
    """Upper body, with its shape."""

    body: Body
    """Lower body, a half-space."""

    friction: CoulombFriction | None = None
    """Friction between the bodies; absent: frictionless."""

    rig: Rig | None = None
    """Springs between the actuator and the indenter; absent: none."""

    loading: tuple[LoadStep, ...] = Field(min_length=1, max_length=MAX_STEPS)
    """Load steps in order, each a linear ramp from the end of the preceding step."""

    contact_stiffness: bool | None = None
    """True to compute the contact stiffnesses dW/dδ, dT/dδ and dM/dφ at the end of each step;
    absent: not computed."""

    @model_validator(mode="after")
    def _is_consistent(self) -> "Scene":
        problems = inconsistencies(dict(self))
        if problems:
            raise SceneError(problems)
        return self

    @property
    def array_files(self) -> dict[str, ArrayFile]:
        """Arrays that the scene reads from files, by their keys.

        The keys are `file` for a height map and `map` for a friction map.
        """
        found = {"file": getattr(self.indenter, "file", None)}
        if self.friction is not None:
            found["map"] = getattr(self.friction.coefficient, "map", None)
        return {key: array for key, array in found.items() if array is not None}

    def replace(self, changes: Mapping[str, Any]) -> "Scene":
        """Return the scene with other values of some keys, checked like a scene file.

        Parameters
        ----------
        changes : mapping
            Dotted keys with their values: `{"indenter.radius": "12 mm", "loading[2].increments":
            5}`. Array entries count from 1. None removes an optional key.

        Raises
        ------
        SceneError
            With every mistake in the changed scene.
        """
        from contact_scene.reading.scene_file import replace_keys

        return replace_keys(self, changes)

    def with_increments(self, increments: Sequence[int]) -> "Scene":
        """Return a copy of the scene with other numbers of increments in its load steps.

        increments  number of increments of each load step, in order
        """
        steps = zip(self.loading, increments, strict=True)
        loading = tuple(step.model_copy(update={"increments": count}) for step, count in steps)
        return self.model_copy(update={"loading": loading})

    def with_loads_multiplied(self, factor: float) -> "Scene":
        """Return a copy of the scene whose loads and prescribed displacements are multiplied.

        factor  factor of all controls of all load steps
        """
        loading = tuple(step.multiplied(factor) for step in self.loading)
        return self.model_copy(update={"loading": loading})

    def load_path(self) -> tuple[LoadRamp, ...]:
        """Return the load ramps of the scene: the linear changes of all loads in each load step.

        There is one ramp per load step, with the prescribed force or displacement of every
        coordinate. A coordinate that a load step does not prescribe keeps its last value.
        """
        return load_path(self.loading, self.body.material, line=self.indenter.is_line)


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
        """Scene of the scene file, without the discretisations and the requested accuracy."""
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
