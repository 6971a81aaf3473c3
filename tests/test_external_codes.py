"""Tests of reference results of other codes, and of the environment in which they are installed."""

import subprocess

import numpy as np
import pytest

from verification.cases.cross_check import Recorded
from verification.peers.environment import FAILED, PEERS, TIMED_OUT, made_environment

RUNS = ((16, 1000.0), (32, 1000.0), (32, 500.0))  # elements, stiffness


def synthetic(limit, per_stiffness, per_element):
    """Three runs with the force limit + per_stiffness / k + per_element / n, and the pressure that
    less the radius."""
    runs = []
    for elements, stiffness in RUNS:
        value = limit + per_stiffness / stiffness + per_element / elements
        radii = [n / elements for n in range(elements)]
        run = {"elements": elements, "stiffness": stiffness, "normal_force": value}
        runs.append({**run, "radii": radii, "pressure": [value - r for r in radii]})
    return {"runs": runs}


def test_extrapolation_removes_the_penalty():
    record = Recorded(synthetic(2.0, 5.0, 0.0))
    assert record.normal_force.value == pytest.approx(2.0, rel=1e-14)
    radii, values, _ = record.profile("pressure", 0.1, 0.5)
    assert values == pytest.approx(2.0 - radii, rel=1e-14)


def test_uncertainty_covers_what_the_mesh_leaves():
    record = Recorded(synthetic(2.0, 5.0, 0.01))
    value, uncertainty = record.normal_force
    profile = record.profile("pressure", 0.1, 0.5)
    assert abs(value - 2) <= uncertainty * (1 + 1e-9)
    assert np.max(np.abs(profile.values - (2 - profile.radii))) <= profile.uncertainty * (1 + 1e-9)


def test_only_a_lasting_failure_of_an_installation_is_remembered(tmp_path):
    """A time-out is tried again, other failures once their file is removed."""
    asked = set()
    python = tmp_path / "bin" / "python"

    def run(command, *, check, timeout=None, **options):
        if timeout is not None:
            asked.add(command[-1])
        if command[-1] == PEERS[-1].distribution:
            raise subprocess.TimeoutExpired(command, timeout)
        done = subprocess.CompletedProcess(command, 1, "", "first\nno compiler\n")
        if check:
            done.check_returncode()
        return done

    with pytest.raises(subprocess.CalledProcessError):
        made_environment(tmp_path, run)
    python.parent.mkdir()
    python.touch()
    *others, last = (peer.distribution for peer in PEERS)
    for tried in ({*others, last}, {last}):
        missing = made_environment(tmp_path, run).missing
        assert missing.pop(last).startswith(TIMED_OUT)
        assert missing == dict.fromkeys(others, "no compiler")
        assert asked == tried
        asked.clear()
    (tmp_path / FAILED).unlink()
    made_environment(tmp_path, run)
    assert asked == {*others, last}
