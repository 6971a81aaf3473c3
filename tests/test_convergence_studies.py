"""Tests of `slipstick convergence`: it finds the known limits of textbook scenes."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import radial
from contact_errors.error_formula import values_of
from contact_scene import SceneFile, read_scene_file
from contact_scene.quantities.increment import numbers
from slipstick import solve
from slipstick.convergence.levels import StudiedScene, plan_of
from slipstick.convergence.limits import Estimate, estimates
from verification.closed_forms.cattaneo_mindlin import PartialSlip, TangentialHistory
from verification.closed_forms.flat_punch import ConeContact, FlatPunchContact
from verification.closed_forms.hertz import PointContact, tangential_modulus

R = 18e-3
W = 1e3
MU = 0.1
E = 210e9 / 0.91  # contact modulus of a rigid body on steel, or of two bodies of twice the modulus
HERTZ = PointContact.under_load(W, R, E)
A = HERTZ.contact_radius
CELLS = "semi-analytical"
FEM = "fem-complementarity"

STEEL = 'material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }'
ALIKE = 'material = { young_modulus = "420 GPa", poisson_ratio = 0.3 }'
PLAIN = f"material = {{ young_modulus = {2 * E}, poisson_ratio = 0 }}"
RIGID = 'material = "rigid"'
BALL = 'shape = "paraboloid"\nradius = "18 mm"'
FRICTION = "\n[friction]\ncoefficient = 0.1"


@pytest.fixture(autouse=True)
def solve_once(monkeypatch):
    """No test judges the CPU time, for which short solves are repeated."""
    monkeypatch.setattr("verification.running.cold_cache.MAX_REPEATS", 1)


def text(shape: str, indenter: str, body: str, *steps: str, more: str = "") -> str:
    loading = "".join(f"\n[[loading]]\n{step}" for step in ('normal_force = "1 kN"', *steps))
    return f"[indenter]\n{shape}\n{indenter}\n[body]\n{body}{more}{loading}\n"


def coating(ratio: float, thickness: float) -> str:
    modulus = f"young_modulus = {ratio * 210e9}, poisson_ratio = 0.3"
    return f"\n[[body.layers]]\nthickness = {thickness}\nmaterial = {{ {modulus} }}"


def pushed(part: float) -> PartialSlip:
    modulus = tangential_modulus((2 * E, 0.0), (2 * E, 0.0))
    return PartialSlip(W, A, MU, modulus, part * MU * W)


def read(text: str, folder: Path) -> SceneFile:
    path = folder / "scene.toml"
    path.write_text(text)
    return read_scene_file(path)


def by_radial(contents: SceneFile) -> Mapping[str, Any]:
    found = numbers(radial.solve(contents.scene, contents.radial).steps[-1])
    return {name: value for name, value in found.items() if name != "peak_pressure"}  # of a ring


@dataclass(frozen=True)
class Scene:
    """A scene file with limits that are known otherwise.

    most    largest uncertainty of the first limit by the levels, relative
    mesh    cells along a side, or elements over the radius
    u       relative error of the known limits
    reason  words of a reason why the limits are uncertain
    """

    text: str
    known: Mapping[str, float] | None
    most: float
    mesh: int = 32
    solver: str = CELLS
    u: float = 1e-9
    reason: str = ""

    def estimates(self, folder: Path) -> tuple[Estimate, ...]:
        n = self.mesh
        cells = n if "cylinder" in self.text else [n, n]
        mesh = f"[semi_analytical]\ncells = {cells}\n[fem_reference]\nelements_per_radius = {n}"
        contents = read(f"{self.text}{mesh}", folder)
        plan = plan_of(StudiedScene(contents, len(contents.loading), self.solver), None)
        return estimates(plan, {level.name: level.compute() for level in plan.cases})


def loop_end() -> TangentialHistory:
    history = TangentialHistory(pushed(0.0))
    for part in (0.9, -0.9, 0.9):
        history = history.loaded_to(part * MU * W)
    return history


PUNCH = FlatPunchContact(0.4e-3, E, W)
CONE = ConeContact.under_load(W, 0.02, E)
LOOP = [
    f'tangential_force = ["{force} N", 0]\nincrements = {count}'
    for force, count in ((90, 6), (-90, 12), (90, 12))
]
CATTANEO = text(BALL, ALIKE, ALIKE, 'tangential_force = ["60 N", 0]', more=FRICTION)
ROUGH_FRICTION = "\n[friction]\ncoefficient = 0.3"
INDENTED = text(BALL, RIGID, STEEL, more=ROUGH_FRICTION)
SMOOTH = {"approach": HERTZ.approach, "contact_radius": A, "peak_pressure": HERTZ.peak_pressure}
PRESSED = text(BALL, RIGID, STEEL)
LINE = text(BALL.replace("paraboloid", "cylinder"), RIGID, STEEL).replace("1 kN", "1 kN/mm")
HALF_WIDTH = float(np.sqrt(4e6 * R / (np.pi * E)))
SCENES = {
    "smooth Hertz": Scene(PRESSED, SMOOTH, 1e-5),
    "smooth Hertz on elements": Scene(PRESSED, SMOOTH, 1e-5, solver=FEM),
    "edge-singular flat punch": Scene(
        text('shape = "flat_punch"\nradius = "0.4 mm"', RIGID, STEEL),
        # The order is between ½ and 1 by the place of the rim in its cells. The radius is that of
        # the rim on every level.
        {"approach": PUNCH.approach},
        0.15,
    ),
    "edge within a strip": Scene(
        LINE, {"half_width": HALF_WIDTH, "peak_pressure": 2e6 / (np.pi * HALF_WIDTH)}, 0.013, 20
    ),
    "cusp of a cone": Scene(
        text('shape = "cone"\nslope_angle = 0.02', RIGID, STEEL),
        {"approach": CONE.approach, "contact_radius": CONE.contact_radius},
        5e-4,
    ),
    "unresolved film": Scene(
        text(BALL, RIGID, STEEL, more=coating(10, 0.02 * A)),
        None,
        1e-4,
        16,
        reason="the thickness of a layer is",
    ),
    "Cattaneo-Mindlin on rings": Scene(
        text(BALL, PLAIN, PLAIN, LOOP[0], more=FRICTION),
        {"tangential_shift_x": pushed(0.9).shift, "stick_radius": pushed(0.9).stick_radius},
        0.05,
        solver="radial",
    ),
    "fretting loop": Scene(
        text(BALL, PLAIN, PLAIN, *LOOP, more=FRICTION),
        {
            "tangential_shift_x": loop_end().shift,
            "stick_radius": pushed(0.9).stick_radius,
            "energy_per_cycle": 4 * pushed(0.9).dissipated_energy,
        },
        5e-4,
    ),
}


@pytest.mark.parametrize("name", SCENES)
def test_limit_and_error_cover_the_known_value(name, tmp_path):
    scene = SCENES[name]
    found = {one.name: one for one in scene.estimates(tmp_path)}
    known = by_radial(read(scene.text, tmp_path)) if scene.known is None else scene.known
    judged = [quantity for quantity in known if quantity in found]
    assert len(judged) >= min(len(known), 2)
    for quantity in judged:
        one, exact, u = found[quantity], known[quantity], scene.u * abs(known[quantity])
        assert abs(one.limit - exact) <= one.uncertainty + u, quantity
        assert abs(one.own - exact) <= one.error(one.own) * one.largest + u, quantity
    first = found[judged[0]]
    assert sum(effect.bound for effect in first.effects) <= scene.most * abs(first.limit)
    assert any(scene.reason in one.open for one in found.values())
    # A reason names the refined parameter of this solver, and only a mesh has cells to cut.
    for effect in (effect for one in found.values() for effect in one.effects):
        assert effect.kind.key in effect.open or "tolerance" in effect.open or not effect.open
        mesh = effect.kind.noun in ("cells", "elements", "rings")
        assert mesh or "cut" not in effect.open


def test_the_increment_levels_of_a_coupled_push_begin_at_four(tmp_path):
    contents = read(
        INDENTED + "[[loading]]\ntangential_force = ['60 N', 0]\nincrements = 16", tmp_path
    )
    *_, ladder = plan_of(StudiedScene(contents, 2, CELLS), 10).ladders
    first, *_ = [level.fineness.increments for level in ladder.levels.values()]
    assert first == (4, 4)


@pytest.mark.parametrize("shape", ["paraboloid", "cylinder"])
def test_the_order_of_a_section_is_that_of_its_size(shape, tmp_path):
    force = "1 kN" if shape == "paraboloid" else "1 kN/mm"
    pressed = text(BALL.replace("paraboloid", shape), STEEL, STEEL).replace("1 kN", force)
    contents = read(f"{pressed}[fem_reference]\nelements_per_radius = 8", tmp_path)
    ladders = {one.part: one for one in plan_of(StudiedScene(contents, 1, FEM), None).ladders}
    ladder = ladders["section"]
    sizes, levels = zip(*[x for x in ladder.levels.items() if not x[1].is_run], strict=True)
    boxes = np.array([level.fineness.space.box for level in levels])
    np.testing.assert_allclose(boxes[0] / boxes, (np.array(sizes) / sizes[0]) ** ladder.power)


@pytest.mark.parametrize("solver", [CELLS, FEM, "radial"])
def test_the_setting_of_the_scene_is_that_of_a_run(solver, tmp_path):
    contents = read(CATTANEO + "[fem_reference]\nelements_per_radius = 8", tmp_path)
    level = plan_of(StudiedScene(contents, 2, solver), None).run.compute()
    end = values_of(solve(contents, solver))[-1]
    assert level.parts
    for part in level.parts:
        name, of = part.parameters["quantity"], part.parameters["of"]
        assert level.measures[name] in np.atleast_1d(end[of])
