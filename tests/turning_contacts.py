"""A rigid ball on a soft body that is pushed, turned and twisted, for the radial solver."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

import radial
from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    IsotropicMaterial,
    LoadStep,
    Paraboloid,
    Scene,
)
from radial.circle import Circle
from radial.coupling import Coupling
from radial.ring_layout import laid
from radial.ring_points import Points

SOFT = IsotropicMaterial(young_modulus=0.91, poisson_ratio=0.3)
LOAD, FRICTION = 4 / 3e6, 0.3  # of a ball with R = 1 and E* = 1: a = 1/100
RADIUS, LIMIT = 0.01, LOAD * FRICTION
TORQUE = 3 * math.pi / 16 * LIMIT * RADIUS  # at which all slips, of bodies that do not couple
PRESS = LoadStep(normal_force=LOAD, increments=4)
ALIKE: dict[str, Any] = {
    "indenter": Paraboloid(radius=1.0, material=SOFT),
    "body": Body(material=SOFT),
}
PATH = ((0.6, 0.0), (0.4, 0.5), (0.0, 0.3))


def scene(*steps: LoadStep, **more: Any) -> Scene:
    """A rigid ball on a soft body."""
    return Scene(
        **{
            "indenter": Paraboloid(radius=1.0, material=RIGID),
            "body": Body(material=SOFT),
            "friction": CoulombFriction(coefficient=FRICTION),
            "loading": (PRESS, *steps),
        }
        | more
    )


def push(x: float, y: float, increments: int = 3) -> LoadStep:
    """To shares of µW along x and y."""
    return LoadStep(tangential_force=(x * LIMIT, y * LIMIT), increments=increments)


def twist(share: float, increments: int = 3) -> LoadStep:
    return LoadStep(torque=share * TORQUE, increments=increments)


def rough(asked: Scene, **how: Any) -> radial.Result:
    """On half the rings, which obey the same laws."""
    plan = how.pop("plan", None) or radial.plan(asked)
    return radial.solve(asked, plan=replace(plan, fineness=0.5), **how)


def turned(vector: Any, angle: float) -> Any:
    (x, y), cos, sin = vector, math.cos(angle), math.sin(angle)
    return np.array([x * cos - y * sin, x * sin + y * cos])


@cache
def turning() -> radial.Result:
    return rough(scene(*(push(*end) for end in PATH)))


@cache
def beside() -> radial.Result:
    return rough(scene(twist(0.4), push(0.5, 0.0), twist(-0.3)))


@cache
def at_points(text: str) -> radial.Result:
    """A twist that needs no points, by them."""
    asked = Scene.model_validate_json(text)
    return radial.solve(asked, plan=replace(radial.plan(asked), circle=Circle.ONE))


@cache
def points(circle: Circle) -> Points:
    asked = scene()
    return laid(Coupling.of(asked), asked.indenter, [RADIUS], 6, 4, circle, FRICTION)
