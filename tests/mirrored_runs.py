"""What runs on a part of the window and on the whole are compared by."""

import pickle
import re
from dataclasses import replace

import numpy as np
import pytest
from contact_scenes import APPROACH, LIMIT, MU, A

from contact_scene import Ellipsoid, FrictionMap
from contact_scene.geometry import Gap
from contact_scene.solver_errors import SolverError
from semi_analytical import plan, solve
from semi_analytical.part import WHOLE
from semi_analytical.plan import MIRROR_PLANES


class Leaf(Ellipsoid):
    """Derived from a shape that is even, which it is not."""

    def initial_gap(self, x, y) -> Gap:
        """Along a diagonal."""
        return super().initial_gap(np.add(x, y), np.subtract(x, y))


def even_map(cells=40, spacing=4 * A / 40, order=1.0):
    """A coefficient of friction that waves along x and along y."""
    x = (np.arange(cells) - 0.5 * (cells - 1)) * spacing / A
    waves = np.cos(2 * x)[:, None] + order * np.cos(3 * x)
    return FrictionMap(map=MU * (1 + 0.2 * waves), spacing=spacing)


def why(decided):
    """What a plan says of mirror planes."""
    return next(e.why for e in decided.effects if e.name == MIRROR_PLANES)


def refuse(monkeypatch, *owners):
    """None of these may be built."""

    def refused(self, *_, **__):
        raise AssertionError(f"a {type(self).__name__} is built")

    for owner in owners:
        monkeypatch.setattr(owner, "__init__", refused)


def pickled(value):
    return pickle.loads(pickle.dumps(value))


def on_part_and_window(described, on, tolerance):
    """The scene as planned, and with its shear on the whole window."""
    decided = plan(described)
    assert decided.told != WHOLE
    return (
        solve(described, on, tolerance, plan=decided),
        solve(described, on, tolerance, plan=replace(decided, told=WHOLE)),
    )


def window_solves(described, on, tolerance):
    """Whether the whole window does; what it cannot solve the part has to refuse alike."""
    try:
        solve(described, on, tolerance, plan=replace(plan(described), told=WHOLE))
    except SolverError as error:
        with pytest.raises(type(error), match=re.escape(str(error)[:40])):
            solve(described, on, tolerance)
        return False
    return True


def assert_same_pressures(of_part, of_window, same):
    """Pressure, gap and what is told of them, to this part of their sizes."""
    for a, b in zip(of_part.increments, of_window.increments, strict=True):
        assert np.max(np.abs(a.pressure - b.pressure)) <= same * np.max(b.pressure)
        open_ = np.isfinite(b.gap)
        size = max(abs(b.approach), 1e-3 * APPROACH)
        assert np.max(np.abs(a.gap[open_] - b.gap[open_])) <= same * size
        assert a.approach == pytest.approx(b.approach, abs=same * size)
        assert a.contact_area == pytest.approx(b.contact_area, rel=same)
        assert a.normal_force == pytest.approx(b.normal_force, rel=same)


def assert_same_shear(of_part, of_window, same, *, steps):
    """Shear, slip and energies, to this part of their sizes.

    steps  by how many iterations and convolutions they may differ
    """
    friction = of_window.scene.friction
    for a, b in zip(of_part.increments, of_window.increments, strict=True):
        assert a.status == b.status
        if b.shear is None:
            continue
        limit = np.max(friction.largest * b.pressure)
        assert np.max(np.abs(a.shear - b.shear)) <= same * limit
        # The least that any motion in these scenes comes to.
        size = max(np.max(np.abs(b.slip)), 1e-3 * APPROACH)
        assert np.max(np.abs(a.slip - b.slip)) <= same * size
        assert np.count_nonzero(a.in_stick != b.in_stick) <= 4
        assert a.tangential_force == pytest.approx(b.tangential_force, abs=same * LIMIT)
        if b.tangential_shift is None:
            assert a.tangential_shift is None
            continue
        assert a.tangential_shift == pytest.approx(b.tangential_shift, abs=same * size)
        work = max(b.input_work, b.elastic_energy)
        for name in ("dissipated_energy", "input_work", "elastic_energy", "unresolved_work"):
            assert getattr(a, name) == pytest.approx(getattr(b, name), abs=same * work)
        for name in ("slip_distance", "dissipation", "slip_before", "dissipation_before"):
            told, whole = getattr(a, name), getattr(b, name)
            assert np.max(np.abs(told - whole)) <= same * max(np.max(np.abs(whole)), 1e-300)
        assert a.stick_area == pytest.approx(b.stick_area, rel=1e-6)
        assert (a.iterations, a.convolutions) == pytest.approx(
            (b.iterations, b.convolutions), abs=steps
        )
