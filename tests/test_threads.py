"""Tests of threads of linear algebra: one unless told, and the same bytes by two as by one."""

import os
import re
from pathlib import Path

import pytest
from command import slipstick
from processes import results, run

from contact_results.blas_threads import VARIABLES
from slipstick.cli import main

SCENE = (Path(__file__).resolve().parents[1] / "scenes" / "coated_ball.toml").read_text("utf-8")
QUICK = ("--figures", "none", "--no-error")


@pytest.fixture
def folder(tmp_path):
    scene = re.sub(r"cells = .*", "cells = [64, 64]", SCENE)
    assert scene != SCENE
    (tmp_path / "scene.toml").write_text(scene, encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize(
    "solver",
    ["semi-analytical", *(pytest.param(s, marks=pytest.mark.slow) for s in ("radial", "fem"))],
)
def test_stress_of_a_run_has_the_same_bytes_by_two_threads(folder, solver):
    """Of a run that is read back: the libraries are loaded by the stress itself."""
    slipstick("run", folder / "scene.toml", "--solver", solver, "-o", folder / "run", *QUICK)
    found = []
    for threads in (1, 2):
        out = f"stress-{threads}"
        ended = run(folder, "stress", "run", "-o", out, *QUICK, threads=threads)
        assert ended.code == 0, ended.said
        found.append(results(folder / out))
    assert found[0]
    assert found[0] == found[1]


@pytest.mark.slow
def test_a_table_has_the_same_bytes_by_two_threads(folder):
    words = ("table", "ball", "--over", "E1_over_E2=0.5,2", "--over", "h_over_aH=0.1,1")
    one, two = (run(folder, *words, threads=threads).out for threads in (1, 2))
    assert one.count("\n") > 4
    assert one == two


@pytest.mark.parametrize(("asked", "used"), [(None, "1"), ("3", "3")])
def test_commands_use_one_thread_unless_told(asked, used, monkeypatch):
    for name in VARIABLES:
        monkeypatch.delenv(name, raising=False)
        if asked is not None:
            monkeypatch.setenv(name, asked)
    with pytest.raises(SystemExit):
        main(["--version"])
    assert [os.environ[name] for name in VARIABLES] == [used] * len(VARIABLES)
