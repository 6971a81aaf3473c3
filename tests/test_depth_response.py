"""Tests of fields at depth in wavenumber space: values of 60 digits, and limits."""

from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from stack_strategies import stacks

from semi_analytical.frf.depth import Descent, Level
from semi_analytical.frf.stack import Stack

# Rounding of one evaluation, relative to the largest entry of its kind.
ROUNDING = 1e-14


class Case(NamedTuple):
    layers: list[tuple[float, float, float]]
    base: tuple[float, float] | None
    alpha: float
    level: Level
    # (U, u_z) and (tau_s, tau_z) row by row, then u_t and tau_t
    values: list[float]


# fmt: off
CASES = {
    "one layer below": Case(
        [(3.0, 0.2, 0.7)], (1.0, 0.4), 2.5, Level(1.1, 1),
        [
            -0.01451876133526405, -0.02406618367570404,
            0.027026762235145555, 0.03764717254650364,
            -0.08152809303337848, -0.13003162471480564,
            0.12619952481866956, 0.1785351563962328,
            0.012981577071468265, 0.03245394267867066,
        ],
    ),
    "incompressible layer": Case(
        [(3.0, 0.2, 0.7), (0.25, 0.5, 0.4)], (1.0, 0.5), 1.3, Level(0.9, 1),
        [
            -0.04689444400575478, -0.20117376175291993,
            0.13906898282240918, 0.31500016709912043,
            -0.02071998735566202, -0.14451690997217073,
            0.3449897604406819, 0.7626654606295605,
            0.13166508934716178, 0.09024778313569115,
        ],
    ),
    "rigid base": Case(
        [(1.0, 0.5, 0.7)], None, 0.01, Level(0.5, 0),
        [
            0.19997716871283824, -0.0011999037418827828,
            -0.00019997656876285377, 1.266567922089108e-06,
            0.9998975091710525, -0.004999572538346768,
            0.004999712525211277, 0.9999875011467695,
            0.19999523343013303, 0.9999775004518661,
        ],
    ),
    "stiff thin film": Case(
        [(1000000.0, 0.3, 1e-06)], (1.0, 0.3), 1.0, Level(5e-07, 0),
        [
            0.2333333888889796, 0.06666667063484337,
            0.06666705158712795, 0.6619045929704778,
            0.666666563491477, -0.0952385515871048,
            4.166666388887105e-07, 0.9999999761903424,
            0.5000000000001459, 0.7499999999998229,
        ],
    ),
    "soft film": Case(
        [(1e-06, 0.49, 1.0)], (1.0, 0.3), 0.001, Level(1.2, 1),
        [
            699.9581835711068, 199.18760995218554,
            200.7594540374327, 699.7674433744572,
            0.9995974170939738, -0.0011603593519146167,
            0.0011999580266256213, 0.9999993074926288,
            999.7995190990658, 0.9997995190990658,
        ],
    ),
    "thick": Case(
        [(3.0, -0.5, 10.0)], (1.0, 0.3), 20.0, Level(9.0, 0),
        [
            -9.9034218251121e-79, -9.959373360847196e-79,
            1.0183179503787584e-78, 1.0239131039522681e-78,
            -1.2018389875898753e-76, -1.2085531718780868e-76,
            1.2085531718780868e-76, 1.2152673561662983e-76,
            1.1190307147019321e-80, 6.714184288211594e-79,
        ],
    ),
}


def flat(fields):
    """Displacements, tractions, transverse displacement and traction as four rows of entries."""
    return [np.asarray(part).reshape(-1, np.shape(part)[-1]) for part in fields]


def assert_same(one, other, tolerance=ROUNDING):
    """Equal up to a tolerance relative to the largest entry of the same kind and wavenumber."""
    for a, b in zip(flat(one), flat(other), strict=True):
        assert np.all(np.abs(a - b) <= tolerance * np.abs(b).max(axis=0) + 1e-300)


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_fields_agree_with_sixty_digits(case):
    fields = Descent(Stack(case.layers, case.base), np.array([case.alpha])).at(case.level)
    values = np.array(case.values)[:, None]
    expected = values[:4].reshape(2, 2, 1), values[4:8].reshape(2, 2, 1), values[8], values[9]
    assert_same(fields, expected)


@given(stacks(), st.floats(4, 8))
def test_short_waves_die_out_without_overflow(stack, decade):
    fields, top = Descent(stack, np.array([10**decade])), 0.0
    below = [] if stack.base is None else [20.0]
    for layer, size in enumerate([*(film.thickness for film in stack.layers), *below]):
        found = fields.at(Level(top + size / 2, layer))
        assert np.all(np.isfinite(np.concatenate(flat(found))))
        top += size


def test_nothing_is_known_within_a_rigid_base():
    stack = Stack([(1.0, 0.3, 1.0)])
    assert np.all(Descent(stack, np.array([1.0])).at(Level(1.0, 0)).displacement == 0)
    with pytest.raises(ValueError, match="rigid base"):
        Descent(stack, np.array([1.0])).at(Level(1.0, 1))
