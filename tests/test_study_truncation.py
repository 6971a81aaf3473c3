"""Studies of what is cut off: the section's outside, the window's, and samples of the response."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from contact_scene.solver_errors import NotConverged
from fem_reference import Method
from fem_reference.elasticity.factored_section import FactoredSection
from semi_analytical import (
    UnsupportedScene,
    pressing,
)
from semi_analytical.influence.closed_form import HalfSpaceCoefficients
from semi_analytical.operator import spectra
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.report.svg import inline_svg
from verification.running.row_files import row_files
from verification.running.study import Conclusion, Settings, Study
from verification.studies.refinement import window
from verification.studies.refinement.domain import domain_study
from verification.studies.refinement.expected import by_box
from verification.studies.refinement.sampled_level import SampledLevel
from verification.studies.refinement.sampling import sampling_study
from verification.studies.refinement.studied_scene import CannotRefine, StudiedScene
from verification.studies.refinement.surface_start import SurfaceStart
from verification.studies.refinement.window import window_study

MATERIAL = 'material = { young_modulus = "420 GPa", poisson_ratio = 0.3 }'
SCENE = f"""
title = "Pressed and pushed"
[indenter]
shape = "paraboloid"
radius = "18 mm"
{MATERIAL}
[body]
{MATERIAL}
[friction]
coefficient = 0.1
[[loading]]
normal_force = "1 kN"
[[loading]]
tangential_force = ["60 N", 0]
increments = 2
[semi_analytical]
cells = [24, 24]
window = ["0.9 mm", "0.9 mm"]
[fem_reference]
elements_per_radius = 32
"""
ON_RIGID_BASE = SCENE.replace(
    f"[body]\n{MATERIAL}",
    f'[body]\nmaterial = "rigid"\n[[body.layers]]\nthickness = "0.3 mm"\n{MATERIAL}',
)
RIGID_BALL = ON_RIGID_BASE.replace(f'"18 mm"\n{MATERIAL}', '"18 mm"\nmaterial = "rigid"')
FIRST_STEP = 1


@pytest.fixture
def scene_file(tmp_path: Path) -> Path:
    path = tmp_path / "pushed.toml"
    path.write_text(SCENE)
    return path


def concluded(study: Study, settings: Settings) -> Conclusion:
    records = {case.name: case.compute() for case in study.cases(settings)}
    conclusion = study.conclude(settings, records)
    assert all(inline_svg(chart) for chart in conclusion.charts)
    assert {"rows.csv", "seconds.csv"} <= set(row_files(records, conclusion.rows))
    return conclusion


def outcomes(conclusion: Conclusion) -> dict[str, Status | None]:
    return {statement.claim: statement.outcome for statement in conclusion.statements}


def of_domain(path: Path) -> dict[str, Status | None]:
    study = domain_study(path, (), FIRST_STEP, Method.COMPLEMENTARITY)
    return outcomes(concluded(study, Settings(Level.STANDARD)))


CHOSEN = "what a section of 100 contact radii leaves"
APPROACH = "order of the approach"


def test_what_a_section_leaves_falls_with_the_third_power_of_its_size(scene_file: Path) -> None:
    found = of_domain(scene_file)
    assert found[CHOSEN] is Status.PASS
    assert found[APPROACH] is Status.PASS
    assert found["order of the peak pressure"] is Status.PASS


def test_wrong_far_field_is_seen(
    scene_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A tenth too little: what is left falls with the first power, and is ten times as much."""
    right = FactoredSection._prescribed
    monkeypatch.setenv("SLIPSTICK_CACHE_DIR", str(tmp_path / "planted"))
    monkeypatch.setattr(FactoredSection, "_prescribed", lambda *given: 0.9 * right(*given))
    found = of_domain(scene_file)
    assert found[CHOSEN] is Status.FAIL
    assert found[APPROACH] is Status.FAIL


def test_sections_differ_in_size_alone(scene_file: Path) -> None:
    study = domain_study(scene_file, (), FIRST_STEP, None)
    cases = study.cases(Settings(Level.STANDARD))
    boxes = np.array([case.box * case.laid_out for case in cases])
    np.testing.assert_allclose(boxes[1:] / boxes[:-1], 2.0, rtol=1e-12)
    assert len({(case.elements, case.laid_out, case.reach) for case in cases}) == 1


@pytest.mark.parametrize(
    ("text", "order"), [(SCENE, 3.0), (ON_RIGID_BASE, 3.0), (RIGID_BALL, None)],
    ids=["half-spaces", "ball on a rigid base", "rigid"],
)  # fmt: skip
def test_power_is_expected_where_a_body_has_no_end(
    text: str, order: float | None, scene_file: Path
) -> None:
    scene_file.write_text(text)
    scene = StudiedScene.of(scene_file, (), FIRST_STEP).read().scene
    expected = by_box(scene, couples=False).get("approach")
    assert (expected and expected.order) == order


def test_forces_feel_under_a_motion_what_motions_feel_under_a_force(scene_file: Path) -> None:
    led = SCENE.replace('normal_force = "1 kN"', 'approach = "8 um"')
    scene_file.write_text(led)
    scene = StudiedScene.of(scene_file, (), FIRST_STEP).read().scene
    assert by_box(scene, couples=False)["normal_force"].order == 3.0


def test_section_that_is_too_small_to_be_studied_is_refused(scene_file: Path) -> None:
    with pytest.raises(CannotRefine, match="the smallest, 5 contact radii"):
        domain_study(scene_file, ["fem_reference.box=20"], FIRST_STEP, None)


UNCHANGED = "a window that holds the contact does not matter"
REFUSED = "a window that does not hold the contact is refused by name"


def of_windows(path: Path) -> dict[str, Status | None]:
    return outcomes(concluded(window_study(path, (), None), Settings(Level.QUICK)))


def test_window_does_not_matter_while_it_holds_the_contact(scene_file: Path) -> None:
    found = of_windows(scene_file)
    assert found[UNCHANGED] is found[REFUSED] is Status.PASS


def test_response_that_ends_with_the_window_is_seen(
    scene_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Displacements counted from the window's corner, as a periodic response has them."""
    right = spectra.even_transform
    monkeypatch.setattr(spectra, "even_transform", lambda values: right(values - values[-1, -1]))
    assert of_windows(scene_file)[UNCHANGED] is Status.FAIL


def test_contact_cut_off_in_silence_is_seen(
    scene_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pressing, "refuse_contact_at_edge", lambda p, model: None)
    found = of_windows(scene_file)
    assert found[UNCHANGED] is Status.FAIL
    assert found[REFUSED] is not Status.PASS


def test_refusal_by_another_name_is_seen(scene_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def gives_up(p: np.ndarray, model: object) -> None:
        if model.grid.cells[0] < 20:  # type: ignore[attr-defined]
            raise NotConverged("the pressure", 1, 1.0, 1e-8)

    monkeypatch.setattr(pressing, "refuse_contact_at_edge", gives_up)
    assert of_windows(scene_file)[REFUSED] is Status.FAIL


def test_cells_of_all_windows_are_the_same(scene_file: Path) -> None:
    cases = window_study(scene_file, (), None).cases(Settings(Level.QUICK))
    grids = [case.solved.grid for case in cases]
    for grid in grids:
        np.testing.assert_allclose(grid.spacing, grids[0].spacing, rtol=1e-12)
        offset = grid.x[0] / grid.spacing[0]
        assert abs(offset - round(offset)) == pytest.approx(0.5, abs=1e-9)


def test_window_of_a_height_map_is_refused(scene_file: Path) -> None:
    x = np.linspace(-1, 1, 24)
    np.save(scene_file.parent / "ball.npy", 1e-5 * (x[:, None] ** 2 + x[None, :] ** 2))
    scene_file.write_text(
        SCENE.replace('"paraboloid"\nradius = "18 mm"', '"height_map"\nfile = "ball.npy"\n'
                      'spacing = ["37.5 um", "37.5 um"]')
    )  # fmt: skip
    with pytest.raises(UnsupportedScene, match="fixes the window"):
        window_study(scene_file, (), None)


def test_window_of_a_friction_map_is_refused(scene_file: Path) -> None:
    np.save(scene_file.parent / "mu.npy", np.full((24, 24), 0.1))
    with pytest.raises(UnsupportedScene, match="bounds the window"):
        window_study(scene_file, ["friction.coefficient={map='mu.npy', spacing='0.1 mm'}"], None)


EXACT = "approach: sampled ever finer and wider it tends to the exact one"


def of_sampling(path: Path) -> dict[str, Status | None]:
    study = sampling_study(path, (), FIRST_STEP)
    return outcomes(concluded(study, Settings(Level.STANDARD, cells=16)))


def test_sampled_response_tends_to_the_exact_one_with_the_period(scene_file: Path) -> None:
    found = of_sampling(scene_file)
    assert found[EXACT] is Status.PASS
    assert found["extension: order of the peak pressure"] is Status.PASS
    assert found["extension: order of the approach"] is Status.PASS


def test_wrong_exact_coefficients_are_seen(
    scene_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    right: Callable[[HalfSpaceCoefficients], np.ndarray] = HalfSpaceCoefficients.zz.fget
    monkeypatch.setattr(HalfSpaceCoefficients, "zz", property(lambda self: 1.005 * right(self)))
    assert of_sampling(scene_file)[EXACT] is not Status.PASS


def test_too_many_samples_are_refused(scene_file: Path) -> None:
    study = sampling_study(scene_file, (), None)
    with pytest.raises(CannotRefine, match="more than 4096"):
        study.cases(Settings(Level.FULL, cells=128))


def test_only_coefficients_differ_from_the_exact_solve(scene_file: Path) -> None:
    study = sampling_study(scene_file, (), None)
    exact, *sampled = study.cases(Settings(Level.QUICK))
    assert all(isinstance(case, SampledLevel) for case in sampled)
    assert {case.solved.grid for case in sampled} == {exact.grid}
    assert {case.solved.increments for case in sampled} == {exact.increments}
    assert SurfaceStart.of(exact.scene).grid.window == exact.window
    assert window.REFUSED == "ContactAtWindowEdge"
