"""Studies of refinement: orders from planted records, levels of a scene, and what is written."""

import csv
import shutil
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from contact_scenes import LOAD, scene
from scene_texts import RIGID_BALL

from fem_reference import Method
from fem_reference.contact.ring_compliance import RingCompliance
from slipstick.cli import main
from verification.convergence.stored_field import SHEAR, StoredField, at_centres, change
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.quantities import unit_of
from verification.running.row import CaseRecord
from verification.running.study import Settings, Study
from verification.studies.refinement import section_level
from verification.studies.refinement.expected import Expected, by_elements
from verification.studies.refinement.fit import Fit, fits
from verification.studies.refinement.increments import increments_study
from verification.studies.refinement.mesh import mesh_study
from verification.studies.refinement.page import order_row, order_table, statement
from verification.studies.refinement.refinement import Refinement
from verification.studies.refinement.section_level import SectionLevel
from verification.studies.refinement.studied_scene import CannotRefine
from verification.studies.refinement.surface_level import SurfaceLevel

TOLERANCE = 1e-8
FIRST, SECOND = Expected(1.0, "planted"), Expected(2.0, "planted")
APPROACH = 8e-6

SCENE = """
title = "Turning"
[indenter]
shape = "paraboloid"
radius = "18 mm"
material = { young_modulus = "420 GPa", poisson_ratio = 0 }
[body]
material = { young_modulus = "420 GPa", poisson_ratio = 0 }
[friction]
coefficient = 0.1
[[loading]]
normal_force = "1 kN"
[[loading]]
tangential_force = ["60 N", 0]
increments = 3
[[loading]]
tangential_force = [0, "60 N"]
increments = 16
[semi_analytical]
cells = [24, 24]
window = ["0.9 mm", "0.9 mm"]
"""
PUSHED = f"""{RIGID_BALL}
[[loading]]
normal_force = "1 kN"
increments = 2
[[loading]]
tangential_force = ["60 N", 0]
increments = 8
[semi_analytical]
cells = [48, 48]
window = ["0.9 mm", "0.9 mm"]
"""


@pytest.fixture
def scene_file(tmp_path: Path) -> Path:
    path = tmp_path / "turning.toml"
    path.write_text(SCENE)
    return path


def planted(size: float, relative_error: float, bump: float = 0.0) -> CaseRecord:
    """A level whose approach and shear have this relative error."""
    x = np.linspace(-1, 1, 16)
    shape = np.exp(-4 * (x[:, None] ** 2 + x[None, :] ** 2))
    shear = np.stack([(1 + relative_error) * shape, bump * shape])
    values = {
        "normal_force": 1e3,
        "approach": APPROACH * (1 + relative_error),
        "contact_radius": 4e-4,
        "tangential_shift_x": 1e-6,
        "tangential_shift_y": 1e-18 * size,
    }
    return CaseRecord(
        parameters={"level": "16 x 16 cells", "size": size},
        measures={**values, "largest_residual": 1e-9},
        units={name: unit_of(name) for name in values},
        counters={"increments": 1 + round(1 / size), "convolutions": 100},
        fields={SHEAR: StoredField.of(shear, float(2 * shape.mean()))},
    )


@dataclass(frozen=True)
class PlantedLevel:
    """A level of a study with this error."""

    size: float
    error: float

    @property
    def name(self) -> str:
        return f"{self.size}"

    def compute(self) -> CaseRecord:
        return planted(self.size, self.error)


SIZES = 0.25 * 2.0 ** -np.arange(6)
GRIDS = 0.25 * 2.0 ** (-np.arange(6) / 2)


def of_planted(errors: np.ndarray, expected: Expected, sizes: np.ndarray = SIZES) -> dict[str, Fit]:
    records = [planted(h, e) for h, e in zip(sizes, errors, strict=True)]
    found = fits(records, {"approach": expected, SHEAR: expected}, TOLERANCE)
    return {fit.name: fit for fit in found}


@pytest.mark.parametrize("expected", [FIRST, SECOND], ids=["first", "second"])
def test_planted_order_and_limit_are_found(expected: Expected) -> None:
    found = of_planted(0.1 * SIZES**expected.order, expected)
    assert {fit.status for fit in found.values()} == {Status.PASS}
    assert found["approach"].limit == pytest.approx(APPROACH, rel=1e-9)
    assert found["approach"].remaining == pytest.approx(0.1 * SIZES[-1] ** expected.order, rel=1e-2)
    assert found[SHEAR].remaining == pytest.approx(0.05 * SIZES[-1] ** expected.order, rel=1e-2)


@pytest.mark.parametrize(
    "name", ["approach", SHEAR]
)  # a term of first order, a tenth of the factor: 4e-4 on the finest level
def test_planted_first_order_term_fails_a_second_order_quantity(name: str) -> None:
    found = of_planted(0.1 * SIZES**2 + 0.05 * SIZES, SECOND)
    assert found[name].status is Status.FAIL


def test_planted_floor_is_not_passed() -> None:
    errors = np.maximum(0.1 * SIZES**2, 0.1 * SIZES[3] ** 2) * (1 + 1e-3 * np.arange(6))
    assert of_planted(errors, SECOND)["approach"].status is not Status.PASS


def test_levels_that_alternate_are_inconclusive_although_the_interval_is_narrow() -> None:
    """Even levels off by -3 %, odd ones by +3 %: the mean order is right, triplets disagree."""
    fit = of_planted(0.1 * SIZES * (1 + 0.03 * (-1.0) ** np.arange(6)), FIRST)["approach"]
    assert fit.observed is not None
    assert fit.observed.keeps(1.0)
    assert fit.status is Status.INCONCLUSIVE


def test_planted_noise_is_inconclusive(rng: np.random.Generator) -> None:
    errors = 0.1 * SIZES * (1 + 0.7 * rng.standard_normal(6))
    found = of_planted(errors, FIRST)
    assert found["approach"].status is Status.INCONCLUSIVE
    assert found[SHEAR].status is Status.INCONCLUSIVE


def test_wrong_order_that_hardly_comes_nearer_fails() -> None:
    """First order with a little of the second: triplets drift by hundredths."""
    found = of_planted(0.1 * SIZES - 0.02 * SIZES**2, Expected(3.0, "planted"))
    assert found["approach"].status is found[SHEAR].status is Status.FAIL


@pytest.mark.parametrize("expected", [1.5, 2.0])
def test_wrong_order_that_rises_towards_the_expected_one_fails(expected: float) -> None:
    """First order less of the second, on grids by the root of two: triplets rise by a tenth."""
    found = of_planted(0.1 * GRIDS - 0.09 * GRIDS**2, Expected(expected, "planted"), GRIDS)
    assert found["approach"].status is found[SHEAR].status is Status.FAIL


def test_what_does_not_change_or_vanishes_by_symmetry_is_left_out() -> None:
    assert set(of_planted(0.1 * SIZES, FIRST)) == {"approach", SHEAR}
    assert of_planted(1e-9 * SIZES, FIRST) == {}


def test_without_an_expected_order_nothing_is_judged() -> None:
    records = [planted(h, 0.1 * h) for h in SIZES]
    assert all(fit.status is None for fit in fits(records, {}, TOLERANCE))


def test_fields_are_compared_as_vectors() -> None:
    one, other = planted(0.1, 0.0), planted(0.05, 0.03, bump=0.04)
    assert change(one.fields[SHEAR], other.fields[SHEAR]) == pytest.approx(0.05 / 2, rel=1e-6)


def test_stored_fields_come_back() -> None:
    field = np.random.default_rng(3).standard_normal((2, 5, 7))
    np.testing.assert_allclose(StoredField.of(field, 1.0).field(), field, rtol=1e-7)


@pytest.mark.parametrize("cells", [(8, 12), (16, 12), (21, 10)])
def test_values_at_other_centres_are_exact_for_planes(cells: tuple[int, int]) -> None:
    def plane(nx: int, ny: int) -> np.ndarray:
        x, y = ((np.arange(n) + 0.5) / n for n in (nx, ny))
        return 1 + 2 * x[:, None] - 3 * y[None, :]

    inside = (slice(2, -2), slice(2, -2))
    found = at_centres(cells, plane(16, 12))
    np.testing.assert_allclose(found[inside], plane(*cells)[inside], rtol=1e-12)


def levels(study: Study, settings: Settings) -> list[SurfaceLevel]:
    return list(study.cases(settings))


def sections(study: Study, settings: Settings) -> list[SectionLevel]:
    return list(study.cases(settings))


def test_only_steps_whose_path_matters_are_refined(scene_file: Path) -> None:
    runs = levels(increments_study(scene_file, (), None, None), Settings(Level.STANDARD))
    assert [run.increments for run in runs] == [(1, 3, 8 * 2**k) for k in range(5)]
    assert [run.size for run in runs] == [1 / (8 * 2**k) for k in range(5)]
    assert {run.cells for run in runs} == {(24, 24)}


def test_grids_become_finer_by_the_root_of_two_at_the_same_increments(scene_file: Path) -> None:
    runs = levels(mesh_study(scene_file, (), 2, None), Settings(Level.QUICK, cells=64))
    assert [run.cells[0] for run in runs] == [16, 22, 32, 46, 64]
    assert {run.increments for run in runs} == {(1, 3)}
    assert {run.window for run in runs} == {(9e-4, 9e-4)}


def test_a_path_that_does_not_matter_is_not_studied(scene_file: Path) -> None:
    study = increments_study(scene_file, (), 2, None)
    assert levels(study, Settings(Level.QUICK)) == []
    (statement,) = study.conclude(Settings(Level.QUICK), {}).statements
    assert "one increment per step is exact" in statement.measured


def test_what_cannot_be_refined_is_refused(scene_file: Path) -> None:
    with pytest.raises(CannotRefine, match="the scene has 3"):
        increments_study(scene_file, (), 4, None)
    study = mesh_study(scene_file, (), None, None)
    with pytest.raises(CannotRefine, match="fewer than 16"):
        study.cases(Settings(Level.QUICK))


def test_other_contents_of_the_file_are_other_cases(scene_file: Path) -> None:
    settings = Settings(Level.QUICK)
    before = levels(increments_study(scene_file, (), None, None), settings)
    scene_file.write_text(SCENE.replace("0.1", "0.2"))
    assert before != levels(increments_study(scene_file, (), None, None), settings)


PRESSED = f"""{RIGID_BALL}
[[loading]]
normal_force = "1 kN"
increments = 6
[fem_reference]
elements_per_radius = 24
"""


@pytest.fixture
def pressed(tmp_path: Path) -> Path:
    path = tmp_path / "pressed.toml"
    path.write_text(PRESSED)
    return path


def test_elements_become_smaller_by_the_root_of_two_in_the_same_section(pressed: Path) -> None:
    study = mesh_study(pressed, (), None, Method.COMPLEMENTARITY)
    cases = sections(study, Settings(Level.STANDARD))
    assert [case.elements for case in cases] == [13, 18, 25, 36, 51, 72]
    assert {case.increments for case in cases} == {(6,)}
    edges = [case.laid_out * (1 + 0.5 / case.elements) for case in cases]
    np.testing.assert_allclose(edges, edges[0], rtol=1e-12)
    np.testing.assert_allclose([c.box * c.laid_out for c in cases], 100 * edges[0], rtol=1e-12)


def test_increments_are_doubled_on_one_mesh(pressed: Path) -> None:
    study = increments_study(pressed, (), None, Method.PENALTY)
    cases = sections(study, Settings(Level.QUICK))
    assert [case.increments for case in cases] == [(3,), (6,), (12,), (24,), (48,)]
    assert len({(case.elements, case.laid_out, case.box, case.method) for case in cases}) == 1


def test_uncoupled_push_of_a_section_needs_no_increments(scene_file: Path) -> None:
    study = increments_study(scene_file, (), 2, Method.COMPLEMENTARITY)
    assert sections(study, Settings(Level.QUICK)) == []


def concluded(study: Study, settings: Settings) -> dict[str, Status | None]:
    records = {case.name: case.compute() for case in study.cases(settings)}
    return {s.claim: s.outcome for s in study.conclude(settings, records).statements}


def test_increments_of_a_section_cost_the_approach_their_square(
    pressed: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    settings = Settings(Level.STANDARD, cells=64)
    study = increments_study(pressed, ["loading[1].increments=4"], None, Method.COMPLEMENTARITY)
    records = [case.compute() for case in sections(study, settings)]
    approach, *_ = fits(records, {"approach": SECOND}, TOLERANCE)
    assert approach.observed is not None
    assert approach.observed.order == pytest.approx(2.0, abs=0.25)
    assert max(approach.errors) == pytest.approx(1e-6, rel=1.0)
    # A path that is not cut as asked for shows no order, and says so.
    monkeypatch.setattr(section_level, "cut_into", lambda scene, increments: scene)
    assert "orders of convergence" in concluded(study, settings)


@pytest.fixture
def frictionless(pressed: Path) -> Path:
    head, rest = PRESSED.split("[friction]\ncoefficient = 0.1\n")
    pressed.write_text(head + rest.replace("increments = 6\n", ""))
    return pressed


def of_elements(path: Path, *overrides: str, finest: int = 64) -> dict[str, Status | None]:
    settings = Settings(Level.STANDARD, cells=finest)
    return concluded(mesh_study(path, overrides, None, Method.COMPLEMENTARITY), settings)


def test_orders_of_pressed_sections_are_those_of_the_energy(frictionless: Path) -> None:
    found = of_elements(frictionless)
    for claim in ("approach", "peak pressure", "contact radius", "pressure (L1)"):
        assert found[f"order of the {claim}"] is Status.PASS, claim


@pytest.mark.parametrize("poisson_ratio", [0.0, 0.15, 0.49])
def test_order_of_the_edge_holds_whatever_elements_are_of(
    frictionless: Path, poisson_ratio: float
) -> None:
    found = of_elements(frictionless, f"body.material.poisson_ratio={poisson_ratio}")
    assert found["order of the contact radius"] is Status.PASS


def test_order_of_the_edge_is_promised_of_square_elements() -> None:
    pressed = scene({"normal_force": LOAD}, friction=None)
    assert "contact_radius" in by_elements(pressed, False, None, squares=True)
    assert "contact_radius" not in by_elements(pressed, False, None, squares=False)


def test_size_of_a_level_is_an_elements_side_over_the_radius(pressed: Path) -> None:
    """Half an element lies between where elements are laid out and the edge."""
    study = mesh_study(pressed, (), None, Method.COMPLEMENTARITY)
    for level in sections(study, Settings(Level.STANDARD)):
        assert level.size == pytest.approx(1 / (level.elements + 0.5), rel=1e-12)


def test_edge_that_is_off_by_a_part_of_an_element_is_seen(
    frictionless: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    right = RingCompliance.contact_edge

    def off(rings: RingCompliance, pressure: np.ndarray) -> float:
        return right(rings, pressure) + 0.1 * float(rings.radii[1])

    monkeypatch.setattr(RingCompliance, "contact_edge", off)
    found = of_elements(frictionless)
    assert found["order of the contact radius"] is Status.FAIL
    assert found["order of the approach"] is Status.PASS


@pytest.mark.slow
def test_orders_of_a_push_between_unlike_bodies_are_first(tmp_path: Path) -> None:
    path = tmp_path / "pushed.toml"
    path.write_text(PUSHED)
    settings = Settings(Level.FULL)
    study = increments_study(path, (), None, None)
    records = {run.name: run.compute() for run in levels(study, settings)}
    outcomes = {s.claim: s.outcome for s in study.conclude(settings, records).statements}
    assert outcomes["order of the shear (L1)"] is Status.PASS
    assert outcomes["order of the tangential shift along x"] is Status.PASS
    assert outcomes["every increment converged"] is Status.PASS


def test_four_levels_give_values_and_no_verdict_on_orders() -> None:
    records = [planted(h, 0.1 * h) for h in SIZES[:4]]
    (approach, shear) = fits(records, {"approach": FIRST, SHEAR: FIRST}, TOLERANCE)
    assert approach.status is shear.status is Status.INCONCLUSIVE
    assert approach.limit == pytest.approx(APPROACH, rel=1e-9)


NO_POWER = np.array([1.0, 1.1, 0.9, 1.05, 1.0, 0.95])


@pytest.mark.parametrize(
    ("errors", "reason"),
    [
        (0.1 * SIZES[:4], "5 levels on, and these are 4"),
        (0.1 * NO_POWER, "no one power"),
        (0.1 * SIZES * (1 + 0.2 * np.sin(3 * np.arange(6))), "wider than ± 0.25"),
        (0.1 * SIZES * (1 + 0.03 * (-1.0) ** np.arange(6)), "triplets"),
    ],
    ids=["few", "no power", "wide", "alternating"],
)
def test_inconclusive_order_says_why(errors: np.ndarray, reason: str) -> None:
    fit = of_planted(errors, FIRST, SIZES[: len(errors)])["approach"]
    said = statement(fit, to_try="that")
    assert said.outcome is Status.INCONCLUSIVE
    assert reason in said.measured
    assert said.measured.endswith("; try that")


def test_judged_order_gives_no_advice() -> None:
    (fit, _) = of_planted(0.1 * SIZES, FIRST).values()
    assert "try" not in statement(fit, to_try="that").measured


@pytest.mark.parametrize(
    ("count", "most", "remedy"),
    [
        (4, 10, "try --levels 5"),
        (4, 4, "try --levels 5 with other --cells: use fewer --cells"),
        (6, 10, "try more --cells"),
    ],
    ids=["levels", "levels that are refused", "fineness"],
)
def test_inconclusive_order_says_what_to_do(count: int, most: int, remedy: str) -> None:
    def levels(settings: Settings) -> list[PlantedLevel]:
        wanted = settings.levels or count
        if wanted > most:
            raise CannotRefine("use fewer --cells")
        return [PlantedLevel(*one) for one in zip(SIZES, 0.1 * NO_POWER[:wanted], strict=False)]

    settings = Settings(Level.QUICK)
    records = {level.name: level.compute() for level in levels(settings)}
    of = Refinement("mesh", levels, {"approach": FIRST}, "size", TOLERANCE, finer="more --cells")
    said = {s.claim: s for s in of.conclusion(settings, records).statements}
    assert said["order of the approach"].measured.endswith(remedy)


@pytest.mark.parametrize("name", ["approach", SHEAR])
def test_order_that_levels_do_not_tell_is_not_printed(name: str) -> None:
    """Wherever one is: no number stands with an interval that holds two whole orders."""
    fit = of_planted(0.1 * NO_POWER, FIRST)[name]
    assert fit.observed is None
    assert statement(fit, to_try="").measured.startswith("no order can be read; left on")
    ((*_, observed, triplets, _),) = order_table([fit]).rows
    assert (observed, triplets) == ("no order can be read", "–")
    assert order_row(fit).measures["order"] is None


def leave_well(arguments: list[str]) -> None:
    with pytest.raises(SystemExit) as leaving:
        main(arguments)
    assert leaving.value.code == 0


def test_study_resumes_to_the_same_bytes(
    scene_file: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(scene_file.parent)
    folder = scene_file.parent
    coarse = ("--cells", "16", "--set", "loading[3].increments=2")
    command = ("maintain", "study", "increments", "turning.toml", *coarse, "--workers", "1")
    leave_well([*command, "--output", "one"])
    shutil.copytree(folder / "one" / "cases", folder / "two" / "cases")
    for record in sorted((folder / "two" / "cases").glob("*.json"))[::2]:
        record.unlink()
    capfd.readouterr()
    leave_well([*command, "--output", "two"])
    assert capfd.readouterr().err.count("already there") == 2
    for name in ("rows.csv", "findings.csv", "figures/increments_errors.svg"):
        assert (folder / "one" / name).read_bytes() == (folder / "two" / name).read_bytes(), name
    with (folder / "one" / "findings.csv").open(encoding="utf-8") as file:
        orders = {line["quantity"]: line for line in csv.DictReader(file)}
    assert orders[SHEAR]["status"] == "inconclusive"
    assert orders[SHEAR]["expected"] == "1.0"
    page = (folder / "one" / "index.html").read_text(encoding="utf-8")
    assert "backward Euler" in page
    assert "<svg" in page


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (("maintain", "study", "increments"), "needs a scene file"),
        (("maintain", "study", "coated-tractions", "turning.toml"), "takes no scene file"),
        (("maintain", "study", "mesh", "turning.toml"), "coarsest of 4 grids"),
        (("maintain", "study", "increments", "turning.toml", "--step", "9"), "the scene has 3"),
        (
            ("maintain", "study", "window", "turning.toml", "--solver", "fem"),
            "is of semi-analytical",
        ),
        (
            ("maintain", "study", "domain", "turning.toml", "--solver", "semi-analytical"),
            "is of fem or fem-complementarity",
        ),
        (("maintain", "study", "domain", "turning.toml", "--solver", "fem"), "takes one direction"),
        (("maintain", "study", "stability", "--step", "2"), "--step is of a scene"),
        (("maintain", "study", "coated-tractions", "--solver", "fem"), "--solver is of a scene"),
    ],
)
def test_mistakes_on_the_command_line_are_named(
    scene_file: Path,
    arguments: tuple[str, ...],
    text: str,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(scene_file.parent)
    with pytest.raises(SystemExit) as leaving:
        main(arguments)
    assert leaving.value.code == 2
    assert text in capfd.readouterr().err
