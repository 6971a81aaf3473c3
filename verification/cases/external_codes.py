"""Comparison with recorded results of CalculiX: coated bodies with and without friction."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact_scene import LoadStep
from verification.closed_forms.hertz import PointContact
from verification.judging.case import Case, Level
from verification.judging.declared_case import (
    NORMAL_FORCE,
    Judged,
    Within,
    case,
    error_norm,
    judged,
)
from verification.judging.field_errors import pressure_at, shear_at
from verification.judging.refinement_levels import (
    on_cells,
    on_elements,
)
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import HERTZ, coated, film, pressed, rigid_ball
from verification.problems.problem import Problem, ReferenceKind
from verification.references import load_reference

Field = NDArray[np.float64]
LEFT_OF_CORRECTION = 1 / 20
NAME = "external_code_calculix"
# The recorded ball: W [N], R [mm], E [MPa], ν. Its gap is measured on the moved surface, which
# raises the load by (1-2ν)(1+ν) p_H / 2E.
MODULUS, RATIO = 210e3, 0.3
RECORDED_BALL = PointContact.under_load(10.0, 1800.0, MODULUS / (1 - RATIO**2))
MOVED_GAP = (1 - 2 * RATIO) * (1 + RATIO) * RECORDED_BALL.peak_pressure / (2 * MODULUS)


class Certain(NamedTuple):
    """Number of the record, with its standard uncertainty."""

    value: float
    uncertainty: float


class Profile(NamedTuple):
    """Recorded traction over p_H at radii over a_H, with one standard uncertainty for all radii.

    p_H and a_H are peak pressure and contact radius of Hertz theory.
    """

    radii: Field
    values: Field
    uncertainty: float


@dataclass(frozen=True)
class Recorded:
    """Recorded CalculiX results of one scene.

    The record has three runs: a coarse mesh, a fine mesh, and the fine mesh with half the contact
    stiffness.
    """

    record: Mapping[str, Any]

    def __post_init__(self) -> None:
        """Check that the record has these three runs; raise ValueError if not."""
        coarse, fine, soft = self.record["runs"]
        if not (
            fine["elements"] == soft["elements"] == 2 * coarse["elements"]
            and fine["stiffness"] == coarse["stiffness"] == 2 * soft["stiffness"]
        ):
            raise ValueError(
                "the record must hold three runs: coarse, twice as fine, and the "
                "fine mesh with half the stiffness. Restore the file of the reference"
            )

    @property
    def normal_force(self) -> Certain:
        """Normal force over the nominal force, corrected for the contact stiffness, with its
        uncertainty."""
        coarse, fine, soft = (float(run["normal_force"]) for run in self.record["runs"])
        correction, refinement = fine - soft, fine - coarse
        errors = (LEFT_OF_CORRECTION * correction, refinement, MOVED_GAP * fine)
        return Certain(fine + correction, math.hypot(*errors))

    @cached_property
    def edge(self) -> float:
        """Smallest of the outermost contact radii of the three runs, over a_H."""
        return float(min(run["radii"][-1] for run in self.record["runs"]))

    def profile(self, traction: str, first: float, last: float) -> Profile:
        """Return the recorded pressure or shear at the radii that both meshes have.

        traction  "pressure" or "shear"
        first     smallest radius, over a_H
        last      largest radius, over a_H
        """
        coarse, fine, soft = self.record["runs"]
        radii = np.array(coarse["radii"])
        chosen = np.flatnonzero((radii >= first) & (radii <= last))

        def at_common_radii(run: Mapping[str, Any]) -> Field:
            every = 1 if run is coarse else 2
            return np.array(run[traction])[every * chosen]

        rough, good, weak = (at_common_radii(run) for run in (coarse, fine, soft))
        correction, refinement = good - weak, good - rough
        errors = np.hypot(LEFT_OF_CORRECTION * correction, refinement)
        return Profile(radii[chosen], good + correction, float(np.max(errors)))


def recorded(name: str) -> Recorded:
    """Return the CalculiX record of a scene; raise KeyError for an unknown name."""
    scenes = {each["name"]: each for each in load_reference(NAME)["scenes"]}
    return Recorded(scenes[name])


FIRST = 0.1  # Hertz radii; nearer to the axis are its bore and, with friction, a cusp
EDGE = 3 / 16  # Hertz radii, three elements of the coarser mesh; its edge ripples that far
FORCE, TRACTION = 2e-4, 1e-3
OURS = (
    "twice the root sum of squares of the recorded uncertainty and that of this program: "
    f"{FORCE:g} of the force, {TRACTION:g} of p_H and µp_H, as for the semi-closed references"
)
NAMES = {
    "coated_frictionless": "coated, no friction",
    "coated_frictional": "coated, µ = 0.1",
}
Reader = Callable[[Any, NDArray[np.float64]], NDArray[np.float64]]


@dataclass(frozen=True)
class Load:
    """Normal force at the end of the recorded load step [force]."""

    load: float


def _parts(name: str, of: Recorded, cells: int, elements: int) -> tuple[Judged, ...]:
    """Create the judged force and tractions of one recorded scene, for finite elements and cells.

    The prescribed approach, over that of Hertz theory, and the increments are those of the record.

    name      label of the scene
    of        record of the scene
    cells     number of cells per side
    elements  number of elements per contact radius
    """
    row, friction = of.record, float(of.record["friction"])
    step = {"increments": row["increments"]} if friction else {}
    scene = pressed(
        f"Rigid ball moved towards a body: {name}",
        rigid_ball(),
        coated(film(row["modulus_ratio"], row["thickness"])),
        LoadStep(approach=row["approach"] * HERTZ.approach, **step),
        friction=friction,
    )
    value, uncertainty = of.normal_force
    problem = Problem(
        scene,
        (Load(value * paper.NORMAL_FORCE),),
        HERTZ.contact_radius,
        "references/external_code_calculix.json: CalculiX 2.20",
        ReferenceKind.EXTERNAL_CODE,
        uncertainty / value,
    )
    force = replace(NORMAL_FORCE, meaning="force at this approach")
    rows = [
        (problem, Within(force, 2 * math.hypot(problem.uncertainty, FORCE), OURS)),
        _traction(problem, of, "pressure", 1.0, "p_H", pressure_at),
    ]
    if friction:
        rows.append(_traction(problem, of, "shear", friction, "µp_H", shear_at))
    return tuple(
        judged(replace(ladder, problem=answer), (within,))
        for ladder in (
            on_elements(problem, (elements,), of=name), on_cells(problem, (cells,), of=name)
        )
        for answer, within in rows
    )  # fmt: skip


def _traction(
    problem: Problem, of: Recorded, name: str, part: float, unit: str, read: Reader
) -> tuple[Problem, Within]:
    """Create the row that judges a recorded traction, and the problem with the uncertainty of the
    record.

    name  "pressure" or "shear"
    part  error scale, as a fraction of p_H
    unit  description of the error scale
    read  function that interpolates the computed traction to given radii
    """
    last = of.edge - EDGE
    known = of.profile(name, FIRST, last)
    uncertainty = known.uncertainty / part

    def largest_difference(result: Any, *_: Any) -> float:
        found = read(result, known.radii * HERTZ.contact_radius) / HERTZ.peak_pressure
        return float(np.max(np.abs(found - known.values[:, None]))) / part

    what = error_norm(
        name, f"largest difference of the {name} from {FIRST:g} to {last:.2g} a_H, over {unit}",
        largest_difference, unit,
    )  # fmt: skip
    within = Within(what, 2 * math.hypot(uncertainty, TRACTION), OURS)
    return replace(problem, uncertainty=uncertainty), within


def external_codes(level: Level = Level.QUICK) -> Case:
    """Create the verification case of the comparison with CalculiX; higher levels have finer
    meshes."""
    sizes = {Level.QUICK: (128, 32), Level.STANDARD: (256, 64), Level.FULL: (512, 64)}[level]
    return case(
        "external_codes",
        "Comparison with CalculiX",
        "The paper's ball, rigid, is moved by a prescribed approach towards a coating twice as "
        "stiff as its base and as thick as the Hertz radius, without friction and with µ = 0.1. "
        "The results of CalculiX for these scenes, with its own elements and contact, are "
        "stored: see docs/studies/calculix.md.",
        *(part for key, name in NAMES.items() for part in _parts(name, recorded(key), *sizes)),
        limits=(
            "In CalculiX the ball has a hundred times the radius and a hundredth of the force, "
            "because CalculiX measures the gap on the deformed surface, unlike linear theory.",
            "Its springs are removed by extrapolation. Near the axis and the edge its nodal "
            "stresses are too coarse for a comparison.",
            "Where shear is judged the contact slips, so that the shear is µp; "
            "frictional_indentation judges the effect of a stick disc.",
        ),
        equations=(
            r"\nabla \cdot \boldsymbol{\sigma} = 0,\quad p = k \max(-g, 0),\quad "
            r"|\mathbf{q}| \le \mu p",
        ),
        no_order="the records of CalculiX have two meshes; this program is judged on one "
        "discretisation",
    )
