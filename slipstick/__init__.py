"""Frictional slip-stick contact of coated bodies, from Python.

    scene = slipstick.load_scene("scene.toml")     # or slipstick.Scene(...)
    result = slipstick.solve(scene)                # or solver="fem", "radial"
    errors = slipstick.stated_errors(result)       # error of every scalar
    slipstick.save(result, "out", errors=errors)   # summary, tables, fields, figures
    run = slipstick.load("out")                    # arrays with units and meanings
    slipstick.critical_loads(scene)                # load factors of first yield, cracks
    slipstick.surface_response(body, m, n)         # displacement of a body by a wave of traction

The names of this module are imported on first use. The solvers' own interfaces are in
`semi_analytical`, `fem_reference` and `radial`.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from contact_results.files.stored_run import StoredRun, load
    from contact_scene import (
        RIGID,
        Body,
        Cone,
        CoulombFriction,
        Cylinder,
        Ellipsoid,
        FiniteElementDiscretisation,
        FlatPunch,
        FrictionMap,
        HeightMap,
        InterfaceStiffness,
        InterfaceStrength,
        IsotropicMaterial,
        Layer,
        LineProfile,
        LoadStep,
        Paraboloid,
        RadialDiscretisation,
        RevolvedProfile,
        Scene,
        Sphere,
        Strip,
        SurfaceDiscretisation,
        Wedge,
        load_scene,
    )
    from semi_analytical.frf.response_matrix import surface_response
    from slipstick.critical_load import critical_loads
    from slipstick.solving import plan, save, solve, stated_errors

__all__ = [
    "load_scene",
    "Scene",
    "Body",
    "Layer",
    "InterfaceStiffness",
    "InterfaceStrength",
    "IsotropicMaterial",
    "RIGID",
    "Sphere",
    "Paraboloid",
    "Ellipsoid",
    "Cone",
    "FlatPunch",
    "HeightMap",
    "RevolvedProfile",
    "Cylinder",
    "Strip",
    "Wedge",
    "LineProfile",
    "CoulombFriction",
    "FrictionMap",
    "LoadStep",
    "SurfaceDiscretisation",
    "FiniteElementDiscretisation",
    "RadialDiscretisation",
    "plan",
    "solve",
    "stated_errors",
    "critical_loads",
    "save",
    "load",
    "StoredRun",
    "surface_response",
]

HOMES = {
    **dict.fromkeys(__all__, "contact_scene"),
    **dict.fromkeys(("plan", "solve", "stated_errors", "save"), "slipstick.solving"),
    **dict.fromkeys(("load", "StoredRun"), "contact_results.files.stored_run"),
    "critical_loads": "slipstick.critical_load",
    "surface_response": "semi_analytical.frf.response_matrix",
}


def __getattr__(name: str) -> Any:
    if name in HOMES:
        return getattr(import_module(HOMES[name]), name)
    raise AttributeError(f"module 'slipstick' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *HOMES})
