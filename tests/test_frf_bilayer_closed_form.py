"""The published closed form for one layer on a half-space, as a second implementation of the FRFs.

Papkovich-Neuber potentials, each A exp(-alpha z) + A' exp(+alpha z) in the layer, give the surface
displacements as the equations (8) to (14) of the coated-contact paper that this package started
from. Three of them need a remark:

    (8)   prints a constant R that is defined elsewhere. With R = -1/(alpha^2 D) it is right.
    (12)  prints f_yx = i (D + D')/(2G). The factor n is missing: as printed the entry has another
          dimension and does not agree with f_xy by reciprocity.
    (11)  is right, but B needs the parameter chi of the transverse shear waves, which cannot be
          made from lambda and kappa.

The sum D + D' follows from the in-plane response; with B and chi it separates f_xx into its part
along the wave vector and the one across it.
"""

from dataclasses import dataclass
from math import exp, hypot

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from stack_strategies import ANGLES, RATIOS

from semi_analytical.frf.stack import Stack
from verification.laws.frf_matrix import frf_matrix

# Where the closed form is well conditioned. Thin layers much stiffer than the substrate are not.
DEPTHS = st.floats(0.3, 300)
CONTRASTS = st.floats(-2, 2).map(lambda decade: 10**decade)


@dataclass(frozen=True)
class Bilayer:
    """Layer (G1, nu1, h) on a half-space (G2, nu2), at one wave vector (m, n)."""

    G1: float
    nu1: float
    h: float
    ratio: float  # G1 / G2; 0 for a rigid base
    nu2: float
    m: float
    n: float

    def __post_init__(self):
        mu, nu1 = self.ratio, self.nu1
        alpha = hypot(self.m, self.n)
        x, theta = alpha * self.h, exp(-2 * alpha * self.h)
        lam = 1 - 4 * (1 - nu1) / (1 + mu * (3 - 4 * self.nu2))
        kappa = (mu - 1) / (mu + 3 - 4 * nu1)
        chi = (mu - 1) / (mu + 1)
        determinant = 1 - (lam + kappa + 4 * kappa * x**2) * theta + lam * kappa * theta**2
        for name, value in {
            "alpha": alpha,
            "x": x,
            "theta": theta,
            "lam": lam,
            "kappa": kappa,
            "chi": chi,
            "s": lam - kappa + 4 * kappa * x**2,
            "determinant": determinant,
            "R": -1 / (alpha**2 * determinant),
        }.items():
            object.__setattr__(self, name, value)

    def potential_a(self):
        """A + A' of phi under unit pressure."""
        c = 1 - 2 * self.nu1
        x, theta, lam, kappa = self.x, self.theta, self.lam, self.kappa
        down = -self.R * (c * (1 - (1 - 2 * x) * kappa * theta) + self.s * theta / 2)
        up = -self.R * theta * (-c * kappa * (1 + 2 * x - lam * theta) + self.s / 2)
        return down + up

    def potential_b(self):
        """B + B' of psi_1 under unit shear along x: transverse waves alone."""
        echo = self.chi * self.theta
        return -(1 + echo) / (2 * (1 - self.nu1) * self.alpha * (1 - echo))

    def coupling(self):
        """C12 of the frame along the wave vector."""
        c, theta, kappa = 1 - 2 * self.nu1, self.theta, self.kappa
        echo = (self.lam - kappa + 4 * kappa * self.x**2) * theta
        direct = c * (1 - 2 * kappa * theta + self.lam * kappa * theta**2)
        return (direct + echo) / (2 * self.G1 * self.alpha * self.determinant)

    def potential_c(self):
        """C + C' of psi_3 under unit shear along x."""
        return 1j * self.m / self.alpha * self.G1 / (1 - self.nu1) * self.coupling()

    def potential_d(self):
        """D + D' under unit shear along x, D = A + i dB/dm."""
        squared = self.lam * self.kappa * self.theta**2
        along = 1 - 4 * self.x * self.kappa * self.theta - squared
        f_ss = (1 - self.nu1) * along / (self.G1 * self.alpha * self.determinant)
        echo = self.chi * self.theta
        f_tt = (1 + echo) / (self.G1 * self.alpha * (1 - echo))
        return -2j * self.G1 * self.m / self.alpha**2 * (f_ss - f_tt)

    def f_zz(self):  # eq (8)
        squared = self.lam * self.kappa * self.theta**2
        bracket = 1 + 4 * self.x * self.kappa * self.theta - squared
        return -(1 - self.nu1) * bracket * self.alpha * self.R / self.G1

    def f_xz(self):  # eq (9)
        return 1j * self.m * self.potential_a() / (2 * self.G1)

    def f_yz(self):  # eq (10)
        return 1j * self.n * self.potential_a() / (2 * self.G1)

    def f_xx(self):  # eq (11)
        b = 4 * (1 - self.nu1) * self.potential_b()
        return (1j * self.m * self.potential_d() - b) / (2 * self.G1)

    def f_yx(self):  # eq (12), with the factor n
        return 1j * self.n * self.potential_d() / (2 * self.G1)

    def f_zx(self):  # eq (13)
        return -(1 - self.nu1) * self.potential_c() / self.G1

    def turned(self):
        """The same body with x and y exchanged, for eq (14)."""
        return Bilayer(self.G1, self.nu1, self.h, self.ratio, self.nu2, self.n, self.m)

    def matrix(self):
        f_xy = self.f_yx()  # eq (14), as are the two exchanged ones
        return np.array(
            [
                [self.f_xx(), f_xy, self.f_xz()],
                [self.f_yx(), self.turned().f_xx(), self.f_yz()],
                [self.f_zx(), self.turned().f_zx(), self.f_zz()],
            ]
        )


def disagreement(bilayer, stack):
    F = frf_matrix(stack, bilayer.m, bilayer.n)
    return np.abs(bilayer.matrix() - F).max() / np.abs(F).max()


@given(CONTRASTS, RATIOS, RATIOS, DEPTHS, ANGLES, CONTRASTS)
def test_closed_form_agrees_with_recursion(contrast, nu1, nu2, x, angle, G1):
    alpha = 2.5
    k = alpha * np.cos(angle), alpha * np.sin(angle)
    bilayer = Bilayer(G1, nu1, x / alpha, contrast, nu2, *k)
    stack = Stack([(G1, nu1, x / alpha)], (G1 / contrast, nu2))
    assert disagreement(bilayer, stack) < 1e-13


@given(RATIOS, DEPTHS, ANGLES)
def test_closed_form_agrees_with_recursion_on_a_rigid_base(nu1, x, angle):
    bilayer = Bilayer(1.5, nu1, x, 0.0, 0.3, np.cos(angle), np.sin(angle))
    assert disagreement(bilayer, Stack([(1.5, nu1, x)])) < 1e-13


def test_closed_form_loses_digits_for_thin_layers():
    """Why it is not used: a coating 1e6 times stiffer than its substrate, alpha h = 1e-4."""
    bilayer = Bilayer(3.0, 0.2, 1e-4, 1e6, 0.35, 0.6, 0.8)
    assert 1e-9 < disagreement(bilayer, Stack([(3.0, 0.2, 1e-4)], (3e-6, 0.35))) < 1e-5


def test_equation_12_as_printed_breaks_reciprocity():
    """Without n the entry at (m, n) is not the one at (n, m), which isotropy demands."""
    bilayer = Bilayer(2.0, 0.3, 1.0, 4.0, 0.25, 0.5, 1.5)

    def printed(body):
        return 1j * body.potential_d() / (2 * body.G1)

    assert printed(bilayer) != pytest.approx(printed(bilayer.turned()), rel=0.1)
    assert bilayer.f_yx() == pytest.approx(bilayer.turned().f_yx(), rel=1e-14)


def test_one_parameter_of_its_own_for_transverse_waves():
    """chi from kappa or lambda in place of its own value spoils f_xx, and nothing else does."""
    bilayer = Bilayer(2.0, 0.3, 0.5, 4.0, 0.25, 0.5, 1.5)
    stack = Stack([(2.0, 0.3, 0.5)], (0.5, 0.25))
    assert disagreement(bilayer, stack) < 1e-14
    object.__setattr__(bilayer, "chi", bilayer.kappa)
    assert disagreement(bilayer, stack) > 1e-3
