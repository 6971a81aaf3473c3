"""Description of a contact problem: two bodies, the indenter's shape, friction and loading.

A scene is built in Python from the frozen models listed here, or read from a TOML file by
`load_scene`. Quantities are numbers in SI units, or texts with a unit such as "18 mm".
"""

from contact_scene.body import Body, InterfaceStiffness, InterfaceStrength, Layer
from contact_scene.discretisation import (
    FiniteElementDiscretisation,
    RadialDiscretisation,
    SurfaceDiscretisation,
)
from contact_scene.friction import CoulombFriction, FrictionMap
from contact_scene.geometry import (
    Cone,
    Cylinder,
    Ellipsoid,
    FlatPunch,
    HeightMap,
    LineProfile,
    Paraboloid,
    RevolvedProfile,
    Sphere,
    Strip,
    Wedge,
)
from contact_scene.loading import LoadStep
from contact_scene.material import RIGID, IsotropicMaterial, Rigid
from contact_scene.reading.array_file import ArrayFile
from contact_scene.reading.scene_error import (
    Problem,
    SceneError,
)
from contact_scene.reading.scene_file import (
    load_scene,
    read_scene_file,
)
from contact_scene.rig import Rig
from contact_scene.scene import (
    Scene,
    SceneFile,
    scene_schema,
)
from contact_scene.stepping.load_path import (
    ControlKind,
    LoadRamp,
    ScalarControl,
    VectorControl,
)

__all__ = [
    "RIGID",
    "ArrayFile",
    "Body",
    "Cone",
    "ControlKind",
    "CoulombFriction",
    "Ellipsoid",
    "FiniteElementDiscretisation",
    "FlatPunch",
    "FrictionMap",
    "HeightMap",
    "InterfaceStiffness",
    "InterfaceStrength",
    "IsotropicMaterial",
    "Layer",
    "LoadRamp",
    "LoadStep",
    "Paraboloid",
    "Problem",
    "RadialDiscretisation",
    "RevolvedProfile",
    "Rig",
    "Rigid",
    "ScalarControl",
    "Scene",
    "SceneError",
    "SceneFile",
    "Sphere",
    "SurfaceDiscretisation",
    "VectorControl",
    "Cylinder",
    "LineProfile",
    "Strip",
    "Wedge",
    "load_scene",
    "read_scene_file",
    "scene_schema",
]
