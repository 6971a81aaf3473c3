"""Tests of coupled bodies whose loads grow together from nothing, in one and in many increments."""

from functools import cache

import pytest

import slipstick
from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    FiniteElementDiscretisation,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.stepping import self_similar_growth

STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
ALUMINIUM = IsotropicMaterial(young_modulus=70e9, poisson_ratio=0.33)
FILM = IsotropicMaterial(young_modulus=630e9, poisson_ratio=0.25)
NO_POISSON = IsotropicMaterial(young_modulus=1e6, poisson_ratio=0.0)
SOLVERS = "radial", "semi-analytical", "fem-complementarity"
LOAD = 100.0


def pushed(body: Body, increments: int = 1) -> Scene:
    """A steel ball of 10 mm pressed on with 100 N and pushed with 20 N, at µ = 0.3."""
    return Scene(
        indenter=Paraboloid(radius=0.01, material=STEEL),
        body=body,
        friction=CoulombFriction(coefficient=0.3),
        loading=[
            LoadStep(normal_force=LOAD, tangential_force=(0.2 * LOAD, 0.0), increments=increments)
        ],
    )


def pressed(increments: int = 1, **more) -> Scene:
    """A rigid ball pressed on a soft body without Poisson's ratio (example `spence` of CONTACT)."""
    return Scene(
        indenter=Paraboloid(radius=0.121477162, material=RIGID),
        body=Body(material=NO_POISSON),
        friction=CoulombFriction(coefficient=0.2986),
        loading=[LoadStep(normal_force=0.4705, increments=increments)],
    ).model_copy(update=more)


BARE = Body(material=ALUMINIUM)
COATED = Body(material=STEEL, layers=(Layer(thickness=0.0933128e-3, material=FILM),))
# Shift [m] and stick radius over contact radius from 80, 320 and 640 increments of the radial
# solver, extrapolated, and the error of the shift by increments of 10 % of the contact radius. From
# no shear, one increment is off by 19 % and 22 %.
SHIFTS = {"bare": (BARE, 1.3653e-6, 0.951, 0.015), "coated": (COATED, 6.901e-7, 0.995, 0.035)}
COARSE = FiniteElementDiscretisation(elements_per_radius=20, harmonics=6)


@pytest.mark.parametrize("name", SHIFTS)
@pytest.mark.parametrize("solver", SOLVERS)
def test_one_increment_of_loads_that_grow_together_gives_the_shift_of_many(solver, name):
    body, shift, stick, error = SHIFTS[name]
    mesh = COARSE if solver == "fem-complementarity" else None
    end = slipstick.solve(pushed(body), solver, mesh).steps[-1]
    assert end.tangential_shift[0] == pytest.approx(shift, rel=error)
    # The slip annulus is as wide as the contact grows in the increment that is solved.
    assert end.stick_radius / end.contact_radius == pytest.approx(stick, rel=0.075)


@pytest.mark.parametrize("solver", ["semi-analytical", "fem-complementarity", "fem"])
def test_stick_radius_of_a_pressing_is_that_of_spence_in_one_increment(solver):
    """From no shear, it is 0.22 of the contact radius."""
    end = slipstick.solve(pressed(), solver).steps[-1]
    assert end.stick_radius / end.contact_radius == pytest.approx(0.4994, abs=0.03)


@cache
def dissipated(solver: str, increments: int) -> float:
    return slipstick.solve(pressed(increments), solver).steps[-1].dissipated_energy


@pytest.mark.parametrize("solver", ["semi-analytical", "fem-complementarity"])
def test_one_increment_dissipates_what_many_do(solver):
    """From no shear, the error is 33 %."""
    assert dissipated(solver, 1) == pytest.approx(dissipated(solver, 20), rel=0.08)


@pytest.mark.parametrize("solver", SOLVERS[:2])
def test_dissipation_never_falls_while_loads_grow(solver):
    lost = [one.dissipated_energy for one in slipstick.solve(pushed(COATED, 6), solver).increments]
    assert lost == sorted(lost)
    assert lost[0] >= 0


def test_several_increments_and_uncoupled_bodies_start_from_their_last_state(monkeypatch):
    dilated = []
    kept = self_similar_growth.Mixing.next_field

    def counted(self, answer):
        dilated.append(answer)
        return kept(self, answer)

    monkeypatch.setattr(self_similar_growth.Mixing, "next_field", counted)
    slipstick.solve(pushed(Body(material=STEEL)), "radial")
    slipstick.solve(pushed(BARE, 2), "radial")
    assert not dilated
    slipstick.solve(pushed(BARE), "radial")
    assert 1 < len(dilated) <= self_similar_growth.MAX_SOLVES
