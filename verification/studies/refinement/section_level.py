"""One level of refinement, solved by finite elements."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact_scene import Scene
from fem_reference import Increment, Method, Result, solve
from verification.convergence.stored_field import PRESSURE, SHEAR, Field, StoredField
from verification.observed.ring_tractions import tractions_at
from verification.running.row import CaseRecord
from verification.studies.refinement.level_row import level_row
from verification.studies.refinement.studied_scene import StudiedScene, cut_into
from verification.studies.work_precision import counted_work

# Tractions are kept on rings of equal area out to a little more than the contact radius, on
# sectors of the half circle where they depend on the angle.
REACH = 1.05
RINGS, SECTORS = 1024, 8


@dataclass(frozen=True)
class SectionLevel:
    """Elements over the contact, a section's size, and increments up to the studied step.

    elements  over `laid_out`, a radius [length]
    box       size of the section over that radius
    reach     radius of the disc whose tractions are recorded [length]
    size      h of the level
    level     in words
    """

    scene: StudiedScene
    method: str
    elements: int
    laid_out: float
    box: float
    reach: float
    increments: tuple[int, ...]
    size: float
    level: str

    @property
    def name(self) -> str:
        return f"{self.method}-{self.elements}-{self.box:.0f}-{sum(self.increments)}"

    def compute(self) -> CaseRecord:
        """Solve; raises what `fem_reference.solve` raises."""
        contents = self.scene.read()
        chosen = {
            "elements_per_radius": self.elements,
            "contact_radius": self.laid_out,
            "box": self.box,
        }
        discretisation = contents.fem_reference.model_copy(update=chosen)
        scene = cut_into(contents.scene, self.increments)
        result = solve(scene, discretisation, Method(self.method))
        return recorded(result, self)


def recorded(result: Result, level: SectionLevel) -> CaseRecord:
    """What is kept of a result."""
    work = {
        "displacements": counted_work.unknowns(result),
        "linear systems": counted_work.systems(result),
    }
    return level_row(level, result, _fields(result, level.reach), work)


def _fields(result: Result, reach: float) -> dict[str, StoredField]:
    end = result.steps[-1]
    shear, pressure = tractions_at(end, *_points(end, reach), (1.0, 0.0))
    mean = float(np.mean(pressure))
    fields = {PRESSURE: StoredField.of(pressure[None], mean)}
    if end.in_stick is not None:
        fields[SHEAR] = StoredField.of(shear, _friction(result.scene) * mean)
    return fields


def _points(increment: Increment, reach: float) -> tuple[Field, Field]:
    """Centres of patches of equal area, angles from the tangential load."""
    sectors = 1 if increment.angles is None else SECTORS
    r = reach * np.sqrt((np.arange(RINGS) + 0.5) / RINGS)
    angle = np.pi * (np.arange(sectors) + 0.5) / sectors
    return np.multiply.outer(r, np.cos(angle)), np.multiply.outer(r, np.sin(angle))


def _friction(scene: Scene) -> float:
    return scene.friction.uniform or 0.0 if scene.friction is not None else 0.0
