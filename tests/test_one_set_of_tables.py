"""Every scalar that is registered is in every table of a run, by one name, unit and value."""

import csv
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

import fem_reference
import semi_analytical
from contact_results.directory.file_names import FIELDS, INCREMENTS, SUMMARY
from contact_results.result_files import write_result
from contact_scene import (
    Body,
    CoulombFriction,
    FiniteElementDiscretisation,
    IsotropicMaterial,
    LoadStep,
    Paraboloid,
    Scene,
    SurfaceDiscretisation,
)
from contact_scene.quantities.field_metadata import (
    Kind,
    reported,
)
from contact_scene.quantities.increment import (
    SCALARS,
    components,
)
from fem_reference import Method

STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
BODIES = {
    "title": "all effects",
    "indenter": Paraboloid(radius=18e-3, material=STEEL),
    "body": Body(material=STEEL),
    "friction": CoulombFriction(coefficient=0.1),
}
PRESS = LoadStep(normal_force=1e3)
PUSH, TURN, LIMIT = (
    LoadStep(tangential_force=(60.0, 0.0), increments=2),
    LoadStep(torque=0.01, increments=2),
    LoadStep(tangential_force=(-100.0, 0.0)),
)
TILT = LoadStep(normal_force=1e3, moment=(0.01, 0.02), increments=2)
MESH = FiniteElementDiscretisation(elements_per_radius=6)


def on_cells(*steps: LoadStep, **more: Any) -> Callable[[], Any]:
    scene = Scene(**(BODIES | more), loading=steps)
    return lambda: semi_analytical.solve_discretised(scene, SurfaceDiscretisation(cells=(16, 16)))


def on_rings(method: Method, *steps: LoadStep, **more: Any) -> Callable[[], Any]:
    scene = Scene(**(BODIES | more), loading=steps)
    return lambda: fem_reference.solve(scene, MESH, method)


SOLVES = {
    "cells, pressed": on_cells(PRESS, friction=None),
    "cells, tilted and twisted": on_cells(TILT, PUSH, TURN),
    "cells, at the limit of friction": on_cells(PRESS, LIMIT),
    **{
        f"{method.value}, {name}": on_rings(method, *steps, **more)
        for method in Method
        for name, steps, more in (
            ("pressed", (PRESS,), {"friction": None}),
            ("twisted", (PRESS, TURN), {}),
            ("at the limit of friction", (PRESS, LIMIT), {}),
        )
    },
}


@pytest.fixture(scope="module", params=SOLVES)
def written(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> tuple[Any, Path]:
    result, directory = SOLVES[request.param](), tmp_path_factory.mktemp("written")
    write_result(result, directory, figures="none")
    return result, directory


def table(directory: Path) -> list[dict[str, str]]:
    with open(directory / INCREMENTS, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def headers(name: str) -> list[str]:
    return [f"{part} [{SCALARS[name].unit or 1}]" for part in components(name)]


def test_columns_are_the_registered_scalars_with_their_units(written: tuple[Any, Path]) -> None:
    expected = ["step", "increment", *(part for name in SCALARS for part in headers(name))]
    assert list(table(written[1])[0]) == expected


def test_both_tables_have_the_same_numbers(written: tuple[Any, Path]) -> None:
    """What an increment does not have is empty in one and absent or not a number in the other."""
    result, directory = written
    rows = table(directory)
    with h5py.File(directory / FIELDS) as file:
        group: Any = file["increments"]
        fields = {n for n, m in reported(type(result.steps[0])).items() if m.kind is Kind.FIELD}
        assert set(group) <= {"step", "increment", *SCALARS, *fields}
        for name, mark in SCALARS.items():
            cells = np.array([[row[part] for part in headers(name)] for row in rows])
            if name not in group:
                assert set(cells.ravel()) == {""}, name
                continue
            stored = group[name][:].reshape(cells.shape)
            assert group[name].attrs["unit"] == mark.unit
            empty = cells == ""
            assert not np.all(empty), name
            assert np.array_equal(empty, np.isnan(stored)), name
            assert np.array_equal(cells[~empty].astype(float), stored[~empty]), name


def test_the_increment_says_what_its_tables_say(written: tuple[Any, Path]) -> None:
    result, directory = written
    assert len(SCALARS) > 20
    for row, increment in zip(table(directory), result.increments, strict=True):
        for name in SCALARS:
            value = getattr(increment, name)
            values = [None] * len(components(name)) if value is None else np.ravel(value).tolist()
            assert [row[part] for part in headers(name)] == [
                "" if number is None else repr(number) for number in values
            ], name


def test_a_step_takes_its_increments_together(written: tuple[Any, Path]) -> None:
    result, directory = written
    steps = json.loads((directory / SUMMARY).read_text(encoding="utf-8"))["steps"]
    assert len(steps) == len(result.scene.loading)
    for number, step in enumerate(steps, 1):
        within = [i for i in result.increments if i.step == number]
        for name, mark in SCALARS.items():
            known = [v for i in within if (v := getattr(i, name)) is not None]
            end = getattr(within[-1], name)
            expected = end if end is None else np.asarray(end).tolist()
            if mark.kind is Kind.LARGEST:
                expected = max(known, default=None)
            assert step[name] == expected, name
