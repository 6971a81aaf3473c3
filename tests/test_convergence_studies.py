"""Tests of convergence studies: they find the known limits of textbook scenes."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from command import outcome

import radial
from contact_errors.error_formula import PER_TOLERANCE
from contact_scene import read_scene_file
from contact_scene.quantities.increment import numbers
from semi_analytical.edge_correction.pressure import SETTLED
from verification.closed_forms.cattaneo_mindlin import PartialSlip, TangentialHistory
from verification.closed_forms.flat_punch import ConeContact, FlatPunchContact
from verification.closed_forms.hertz import EllipticalContact, PointContact, tangential_modulus
from verification.closed_forms.torsion import TorsionalPartialSlip
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.references import load_reference
from verification.running.study import Conclusion, Settings
from verification.studies.refinement import FLOOR, SceneStudyOf, increments_study, mesh_study

R, W, MU = 18e-3, 1e3, 0.1
E = 210e9 / 0.91  # contact modulus of a rigid body on steel, or of two bodies of twice the modulus
HERTZ = PointContact.under_load(W, R, E)
A = HERTZ.contact_radius
CELLS, FEM = "semi-analytical", "fem-complementarity"

STEEL = 'material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }'
ALIKE = 'material = { young_modulus = "420 GPa", poisson_ratio = 0.3 }'
PLAIN = f"material = {{ young_modulus = {2 * E}, poisson_ratio = 0 }}"
RIGID = 'material = "rigid"'
BALL = 'shape = "paraboloid"\nradius = "18 mm"'
FRICTION = "\n[friction]\ncoefficient = 0.1"


def text(shape: str, indenter: str, body: str, *steps: str, more: str = "") -> str:
    loading = "".join(f"\n[[loading]]\n{step}" for step in ('normal_force = "1 kN"', *steps))
    return f"[indenter]\n{shape}\n{indenter}\n[body]\n{body}{more}{loading}\n"


def coating(ratio: float, thickness: float) -> str:
    modulus = f"young_modulus = {ratio * 210e9}, poisson_ratio = 0.3"
    return f"\n[[body.layers]]\nthickness = {thickness}\nmaterial = {{ {modulus} }}"


def coated_row(ratio: float, thickness: float) -> Mapping[str, float]:
    rows = load_reference("coated_frictionless_paraboloid")["rows"]
    (row,) = (r for r in rows if (r["E1_over_E2"], r["h_over_aH"]) == (ratio, thickness))
    return {
        "approach": row["delta_over_deltaH"] * HERTZ.approach,
        "contact_radius": row["a_over_aH"] * A,
        # A stiff thin film is pressed most near the edge.
        **({} if thickness < 1 else {"peak_pressure": row["p0_over_pH"] * HERTZ.peak_pressure}),
    }


def spence(nu: float, mu: float) -> Mapping[str, float]:
    rows = load_reference("frictional_indentation_homogeneous")["rows"]
    (row,) = (r for r in rows if (r["nu"], r["mu"]) == (nu, mu))
    return {
        "approach": row["delta_over_deltaH"] * HERTZ.approach,
        "contact_radius": row["a_over_aH"] * A,
        "stick_radius": row["c_over_a"] * row["a_over_aH"] * A,
    }


def pushed(part: float) -> PartialSlip:
    modulus = tangential_modulus((2 * E, 0.0), (2 * E, 0.0))
    return PartialSlip(W, A, MU, modulus, part * MU * W)


def by_radial(tmp_path: Path, scene: str) -> Mapping[str, Any]:
    path = tmp_path / "radial.toml"
    path.write_text(scene)
    contents = read_scene_file(path)
    found = numbers(radial.solve(contents.scene, contents.radial).steps[-1])
    return {name: value for name, value in found.items() if name != "peak_pressure"}  # of a ring


@dataclass(frozen=True)
class Scene:
    """A scene file with limits that are known otherwise.

    u       relative error of the known limits
    most    largest uncertainty of the first limit by the levels, relative
    reason  words of a reason why the levels are not asymptotic
    levels  number of levels; None for the default
    """

    text: str
    known: Mapping[str, float] | None
    most: float
    cells: int | None = 48
    study: SceneStudyOf = mesh_study
    solver: str = CELLS
    u: float = 1e-9
    reason: str = ""
    levels: int | None = None


def loop_end() -> TangentialHistory:
    history = TangentialHistory(pushed(0.0))
    for part in (0.9, -0.9, 0.9):
        history = history.loaded_to(part * MU * W)
    return history


def twisted(torque: float) -> TorsionalPartialSlip:
    modulus = 420e9 / 2.6 / 2
    return TorsionalPartialSlip.under_moment(torque, A, HERTZ.peak_pressure, MU, modulus)


TORQUE = 0.5 * twisted(0.0).sliding_moment
PUNCH = FlatPunchContact.under_load(W, 0.4e-3, E)
CONE = ConeContact.under_load(W, 0.02, E)
ELLIPSE = EllipticalContact.under_load(W, (18e-3, 9e-3), E)
LOOP = [
    f'tangential_force = ["{force} N", 0]\nincrements = {count}'
    for force, count in ((90, 6), (-90, 12), (90, 12))
]
CATTANEO = text(BALL, ALIKE, ALIKE, 'tangential_force = ["60 N", 0]', more=FRICTION)
ROUGH_FRICTION = "\n[friction]\ncoefficient = 0.3"
INDENTED = text(BALL, RIGID, STEEL, more=ROUGH_FRICTION)
DRAGGED = 'tangential_shift = ["12 um", 0]\nincrements = 4'
SMOOTH = {"approach": HERTZ.approach, "contact_radius": A, "peak_pressure": HERTZ.peak_pressure}
PRESSED = text(BALL, RIGID, STEEL)
ALUMINIUM = """
[indenter]
shape = "paraboloid"
radius = "10 mm"
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[body]
material = { young_modulus = "70 GPa", poisson_ratio = 0.33 }
[[loading]]
normal_force = "30 N"
"""
LIGHT = PointContact.under_load(30.0, 10e-3, 1 / (0.91 / 210e9 + (1 - 0.33**2) / 70e9))
ON_ALUMINIUM = {
    "approach": LIGHT.approach,
    "contact_radius": LIGHT.contact_radius,
    "peak_pressure": LIGHT.peak_pressure,
}

SCENES = {
    "smooth Hertz": Scene(PRESSED, SMOOTH, 1e-5),
    "smooth Hertz on elements": Scene(PRESSED, SMOOTH, 3e-5, None, solver=FEM),
    # Few levels hardly determine the order, and the end of the section is not refined.
    "steel on aluminium": Scene(ALUMINIUM, ON_ALUMINIUM, 1e-4, None, solver=FEM, levels=4),
    "steel on aluminium, fine": Scene(ALUMINIUM, ON_ALUMINIUM, 3e-6, 96, solver=FEM, levels=4),
    "steel on aluminium, penalty": Scene(ALUMINIUM, ON_ALUMINIUM, 3e-5, 48, solver="fem", levels=4),
    "steel on aluminium, cells": Scene(ALUMINIUM, ON_ALUMINIUM, 3e-6, 96, levels=4),
    "edge-singular flat punch": Scene(
        text('shape = "flat_punch"\nradius = "0.4 mm"', RIGID, STEEL),
        # The order is between ½ and 1 by the place of the rim in its cells. The radius is that of
        # the rim on every level.
        {"approach": PUNCH.approach}, 0.15,
    ),
    "cusp of a cone": Scene(
        text('shape = "cone"\nslope_angle = 0.02', RIGID, STEEL),
        {"approach": CONE.approach, "contact_radius": CONE.contact_radius}, 5e-4,
    ),
    "pre-asymptotic film": Scene(
        text(BALL, RIGID, STEEL, more=coating(10, 0.02 * A)), None, 1e-5, 32,
        reason="the thickness of a layer is",
    ),
    "thin film": Scene(
        text(BALL, RIGID, STEEL, more=coating(10, 0.25 * A)), coated_row(10, 0.25), 1e-5
    ),
    "coated ball": Scene(text(BALL, RIGID, STEEL, more=coating(2, A)), coated_row(2, 1), 2e-5),
    "gross slip": Scene(
        text(BALL, ALIKE, ALIKE, DRAGGED, more=FRICTION), {"tangential_force_x": MU * W}, 1e-6
    ),
    "increments of gross slip": Scene(
        text(BALL, ALIKE, ALIKE, DRAGGED, more=FRICTION), {"tangential_force_x": MU * W}, 1e-6,
        24, increments_study,
    ),
    "Cattaneo-Mindlin, ν = 0.3": Scene(CATTANEO, None, 1e-5, u=1e-5),
    "fretting loop": Scene(
        text(BALL, PLAIN, PLAIN, *LOOP, more=FRICTION),
        {"tangential_shift_x": loop_end().shift, "stick_radius": pushed(0.9).stick_radius,
         "energy_per_cycle": 4 * pushed(0.9).dissipated_energy},
        5e-4,
    ),
    "ellipse": Scene(
        text('shape = "ellipsoid"\nradii = ["18 mm", "9 mm"]', RIGID, STEEL),
        {"approach": ELLIPSE.approach, "peak_pressure": ELLIPSE.peak_pressure}, 1e-5,
    ),
    "torsion": Scene(
        text(BALL, ALIKE, ALIKE, f"torque = {TORQUE}", more=FRICTION),
        {"twist": twisted(TORQUE).twist, "stick_radius": twisted(TORQUE).stick_radius}, 2e-3,
    ),
    "frictional indentation": Scene(INDENTED, spence(0.3, 0.3), 3e-5),
    "increments of an indentation": Scene(
        INDENTED, {"approach": spence(0.3, 0.3)["approach"]}, 3e-5, 24, increments_study
    ),
}  # fmt: skip


def concluded(scene: Scene, tmp_path: Path) -> tuple[Conclusion, dict[str, float]]:
    """And the relative errors that the tolerance and the edge correction leave at the finest level,
    by quantity."""
    path = tmp_path / "scene.toml"
    path.write_text(scene.text)
    study = scene.study(path, [], None, scene.solver)
    settings = Settings(Level.QUICK, scene.cells, scene.levels)
    records = {run.name: run.compute() for run in study.cases(settings)}
    parts = list(records.values())[-1].parts
    floors = {str(part.parameters["quantity"]): part.measures[FLOOR] for part in parts}
    return study.conclude(settings, records), floors


@pytest.mark.parametrize("name", SCENES)
def test_limit_and_remaining_error_cover_the_known_value(name: str, tmp_path: Path) -> None:
    scene = SCENES[name]
    study, floors = concluded(scene, tmp_path)
    found = {str(row.parameters["quantity"]): row.measures for row in study.rows}
    known = by_radial(tmp_path, scene.text) if scene.known is None else scene.known
    judged = [quantity for quantity in known if quantity in found]
    assert len(judged) >= min(len(known), 2) or scene.study is not mesh_study
    for quantity in judged:
        finest, limit, uncertainty = (
            found[quantity][part] for part in ("finest", "limit", "uncertainty")
        )
        exact, unrefined = known[quantity], scene.u * abs(known[quantity])
        assert abs(limit - exact) <= uncertainty + unrefined, quantity
        assert abs(finest - exact) <= abs(finest - limit) + uncertainty + unrefined, quantity
    first = found[judged[0]]
    floor = floors[judged[0]]
    assert floor <= SETTLED + PER_TOLERANCE * 1e-7
    by_levels = first["uncertainty"] - first["unrefined"]
    assert by_levels <= (scene.most + floor) * abs(first["limit"])
    # Without a request all are findings; a level that is not asymptotic says why.
    assert {one.outcome for one in study.statements} == {None}
    reasons = [row.words.get("open", "") for row in study.rows]
    assert any(scene.reason in reason for reason in reasons)
    assert all("use more --cells" in reason.lower() for reason in reasons if reason)


@pytest.mark.parametrize("name", ["edge-singular flat punch", "cusp of a cone"])
def test_an_infinite_pressure_has_no_limit(name: str, tmp_path: Path) -> None:
    found, _ = concluded(SCENES[name], tmp_path)
    assert "peak_pressure" not in [row.parameters["quantity"] for row in found.rows]
    assert any("the exact value is infinite" in one.measured for one in found.statements)


@pytest.mark.usefixtures("one_process")
@pytest.mark.parametrize(
    ("share", "cells", "exit_code"), [(1e-4, (48,), 0), (1e-7, (48,), 1), (1e-3, (), 0)]
)
def test_a_request_decides(
    share: float, cells: tuple[int, ...], exit_code: int, tmp_path: Path
) -> None:
    """Without --cells the levels end at those that meet the request."""
    path = tmp_path / "scene.toml"
    path.write_text(f"{PRESSED}\n[accuracy]\napproach = {share}")
    options = ("--cells", *cells) if cells else ()
    command = ["maintain", "study", "mesh", path, *options, "--workers", 1, "-o", "out"]
    assert outcome(*command, cwd=tmp_path).returncode == exit_code


def test_a_refused_level_is_shown_with_its_reason(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(f"{PRESSED}\n[semi_analytical]\nwindow = [3e-2, 3e-2]")
    study, settings = mesh_study(path, [], None, CELLS), Settings(Level.QUICK, 64)
    found = study.conclude(settings, {run.name: run.compute() for run in study.cases(settings)})
    assert found.statements[0].outcome is Status.INCONCLUSIVE
    assert any("ContactNotResolved" in cell for row in found.tables[1].rows for cell in row)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["mesh", "SCENE", "--cells", "16"], "more --cells or fewer levels"),
        (["mesh", "SCENE", "--step", "2"], "step 2 was asked for, and the scene has 1"),
        (["mesh", "SCENE", "--solver", "radial"], "for study mesh"),
        (["mesh"], "needs a scene file"),
    ],
)
def test_what_cannot_be_refined_is_refused(
    arguments: list[str], message: str, tmp_path: Path
) -> None:
    (tmp_path / "SCENE").write_text(PRESSED)
    ended = outcome("maintain", "study", *arguments, cwd=tmp_path)
    assert ended.returncode == 2
    assert message in " ".join(ended.stderr.replace("│", " ").split())


def test_increments_without_an_error_are_not_studied(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(PRESSED)
    study = increments_study(path, [], None, CELLS)
    assert study.cases(Settings(Level.QUICK)) == ()
    assert (
        "nothing was computed" in study.conclude(Settings(Level.QUICK), {}).statements[0].measured
    )
