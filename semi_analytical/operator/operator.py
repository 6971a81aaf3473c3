"""Operator from tractions to surface displacements, and its approximate inverses.

The operator is a convolution of the tractions with influence coefficients.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field
from contact_solver.slip_compliance_bins import COMPLIANCES
from semi_analytical.influence.coefficients import PARITY, InfluenceCoefficients
from semi_analytical.operator.domain import Pair, ReducedDomain
from semi_analytical.operator.spectra import KernelSpectrum, kernel_spectrum
from semi_analytical.operator.transforms import Convolutions, Transforms

Array = NDArray[Any]
# Real symmetric response between the amplitudes of two components.
Response = KernelSpectrum | Field

BINS = "".join(str(number) for number in range(len(COMPLIANCES)))


def response(transforms: Transforms, pair: str, spectrum: KernelSpectrum) -> Response:
    """Compute the real factors from traction amplitudes to displacement amplitudes.

    Fields are represented by Fourier, cosine or sine amplitudes. The factors follow from the
    spectrum of the influence coefficients.

    transforms  transforms of the domain
    pair        names of the displacement and the traction component, e.g. "zx"
    spectrum    real spectrum S; the coefficients have the spectrum i S if one component is z, else
                S
    """
    if transforms.whole:  # the phases cancel
        return spectrum
    row, column = pair[0], pair[1]
    factor = 1j if row != "z" == column else 1.0
    sign = round((transforms.phase(row).conjugate() * factor * transforms.phase(column)).real)
    x, y = zip(transforms.parity(row), transforms.parity(column), strict=True)
    along_x = _sort_factors(sign * spectrum.quarter.T, *x)
    return np.ascontiguousarray(_sort_factors(along_x.T, *y))


def _sort_factors(lines: Field, one: int, other: int) -> Field:
    """Sort factors like amplitudes: two per wavenumber without a mirror plane (parity 0);
    sine transforms have the largest in the place of 0, where factors to cosines vanish."""
    if one == 0:
        return np.repeat(lines, 2, axis=0)
    if one == other == -1:
        return np.concatenate([lines[-1:], lines[1:-1]])
    return lines[:-1]


class Product:
    """Convolution of several fields with a matrix of kernels, by transforms on a domain.

    A call transforms the fields, multiplies their amplitudes by the matrix of factors of
    `response`, and transforms the products back.

    transforms       transforms of the domain
    entries          factors by pairs of component names, e.g. "xy"
    inputs, outputs  names of the components of the input and output fields
    padded           True for zero padding to twice the window (linear convolution)
    """

    def __init__(
        self,
        transforms: Transforms,
        entries: Mapping[str, Response],
        inputs: str,
        outputs: str,
        *,
        padded: bool = True,
    ) -> None:
        self._transforms = transforms
        self._sides = transforms.axis_transforms(inputs, outputs, padded=padded)
        names = [["".join(sorted(row + column)) for column in inputs] for row in outputs]
        self._rows = [[(k, name) for k, name in enumerate(row) if name in entries] for row in names]
        self._entries = {name: entries[name] for row in self._rows for _, name in row}
        self._block = slice(0), dict[str, Array]()

    def __call__(self, values: Array) -> Array:
        """Compute the convolution of fields with the matrix of kernels (outputs, nx, ny).

        values  input fields (inputs, nx, ny)
        """
        return self._transforms.filter_fields(values, *self._sides, self._multiply_amplitudes)

    def _multiply_amplitudes(self, amplitudes: Sequence[Array], columns: slice) -> list[Array]:
        """Multiply the amplitudes of the input fields by the matrix of factors.

        The results are the amplitudes of the output fields.

        amplitudes  amplitudes of each input field at some wavenumbers along y; may be overwritten
        columns     slice of these wavenumbers
        """
        known, some = self._block
        if columns != known:  # a small grid is one block, whose factors are kept
            kind = amplitudes[0].dtype
            some = {n: one[columns].astype(kind, copy=False) for n, one in self._entries.items()}
            self._block = columns, some  # at once: a signal leaves no factors of other columns
        found = []
        for row in self._rows:
            (first, name), *others = row
            out = amplitudes[first] if len(self._rows) == 1 else None
            total = np.multiply(some[name], amplitudes[first], out=out)
            for k, name in others:
                total += some[name] * amplitudes[k]
            found.append(total)
        return found


class DisplacementOperator:
    """Operator from tractions on a box of cells to the surface displacements of these cells.

    Displacements are relative: those of the lower minus those of the upper body. A call counts as
    1/2 convolution per transformed component. Spectra, factors and approximate inverses are
    computed on first use.

    coefficients  influence coefficients of both bodies
    shape         number of cells of the box along x and y
    domain        full window or reduced domain that contains the box
    counter       counter of convolutions
    """

    def __init__(
        self,
        coefficients: InfluenceCoefficients,
        shape: Pair,
        domain: ReducedDomain,
        counter: Convolutions,
    ) -> None:
        self._coefficients = coefficients
        self.transforms = Transforms(shape, domain, counter)
        self._spectra: dict[str, KernelSpectrum] = {}
        self._responses: dict[str, Response] = {}
        self._products: dict[tuple[str, str], Product] = {}

    def normal(self, pressure: Field) -> Field:
        """Compute the normal displacement u_z (nx, ny) by a pressure (nx, ny) [length].

        pressure  pressure of the cells (nx, ny) [force/length^2]
        """
        return self._apply_product("z", "z", pressure[None])[0]

    def tangential(self, shear: Field) -> Field:
        """Compute the tangential displacement (2, nx, ny) by a shear (2, nx, ny) [length].

        shear  shear of the cells (2, nx, ny) [force/length^2]
        """
        return self._apply_product("xy", "xy", shear)

    def normal_by_shear(self, shear: Field) -> Field:
        """Compute the normal displacement u_z (nx, ny) by a shear (2, nx, ny) [length].

        The displacement is zero for two identical bodies.

        shear  shear of the cells (2, nx, ny) [force/length^2]
        """
        return self._apply_product("xy", "z", shear)[0]

    def tangential_by_pressure(self, pressure: Field) -> Field:
        """Compute the tangential displacement (2, nx, ny) by a pressure [length].

        The displacement is zero for two identical bodies.

        pressure  pressure of the cells (nx, ny) [force/length^2]
        """
        return self._apply_product("z", "xy", pressure[None])

    def together(self, tractions: Field) -> Field:
        """Compute all surface displacements (3, nx, ny) by all tractions (3, nx, ny) [length].

        The displacements are (u_x, u_y, u_z). The cost is that of six transforms.

        tractions  (q_x, q_y, p) of the cells (3, nx, ny) [force/length^2]
        """
        return self._apply_product("xyz", "xyz", tractions)

    def _apply_product(self, inputs: str, outputs: str, values: Field) -> Field:
        """Compute some displacement components from some traction components, by convolution.

        inputs   names of the traction components, e.g. "xy"
        outputs  names of the displacement components
        values   tractions of the cells (inputs, nx, ny)
        """
        self.transforms.counter.count += 0.5 * (len(inputs) + len(outputs))
        if (inputs, outputs) not in self._products:
            pairs = {"".join(sorted(a + b)) for a in inputs for b in outputs}
            for pair in sorted(pairs - self._responses.keys()):
                self._responses[pair] = response(self.transforms, pair, self.spectrum(pair))
            self._products[inputs, outputs] = Product(
                self.transforms, self._responses, inputs, outputs
            )
        return self._products[inputs, outputs](values)

    def spectrum(self, pair: str) -> KernelSpectrum:
        """Compute the real Fourier spectrum of one component of the influence coefficients.

        The spectrum has the zero-padded period. It is stored after the first call.

        pair  names of displacement and traction component in alphabetical order, e.g. "xz"
        """
        if pair not in self._spectra:
            name = pair if pair in PARITY else pair[::-1]
            self._spectra[pair] = kernel_spectrum(
                self._coefficients[name], PARITY[name], self.transforms.reach
            )
        return self._spectra[pair]

    @property
    def self_compliance(self) -> float:
        """Tangential displacement of a cell by a unit shear on the same cell, mean of x and y.

        The dimension is [length^3/force].
        """
        return float(0.5 * (self._coefficients["xx"][0, 0] + self._coefficients["yy"][0, 0]))

    def precondition(self, displacement: Field) -> Field:
        """Apply the approximate inverse of the map from pressure to normal displacement.

        The result is a pressure (nx, ny). Used to precondition the conjugate gradients of the
        normal problem.

        displacement  normal displacement of the cells (nx, ny)
        """
        return self._pressure_inverse(displacement[None])[0]

    @cached_property
    def _pressure_inverse(self) -> ApproximateInverse:
        """Approximate inverse of the map from pressure to normal displacement."""
        return ApproximateInverse(self.transforms, {"zz": self._inverse_normal()})

    @cached_property
    def shear_inverse(self) -> ApproximateInverse:
        """Approximate inverse of the map from shear to tangential displacement.

        It includes the bins of slip compliance, and preconditions the tangential problem.
        """
        return ApproximateInverse(self.transforms, self._inverse_tangential())

    @cached_property
    def inverse(self) -> ApproximateInverse:
        """Approximate inverse of the map from all tractions to displacements.

        Used to precondition the coupled problem.
        """
        spectra = self._inverse_tangential() | {"zz": self._inverse_normal()}
        return ApproximateInverse(self.transforms, spectra)

    def _inverse_normal(self) -> Field:
        """Invert the spectrum of the influence coefficients without zero padding."""
        return positive_inverse(self.spectrum("zz").quarter[::2, ::2])

    def _inverse_tangential(self) -> dict[str, Field]:
        """Compute the spectra of the approximate inverse of the tangential displacement operator.

        The results are the components xx, yy, xy, and one scalar spectrum per bin of slip
        compliance. A scalar spectrum inverts the mean tangential compliance plus the compliance of
        the bin.
        """
        xx, yy, xy = (self.spectrum(pair).quarter[::2, ::2] for pair in ("xx", "yy", "xy"))
        found = dict(zip(("xx", "yy", "xy"), inverse_2x2(xx, yy, xy), strict=True))
        mean = np.abs(0.5 * (xx + yy))
        for number, bin_compliance in zip(BINS, COMPLIANCES, strict=True):
            found[2 * number] = 1 / (mean + self.self_compliance * bin_compliance)
        return found


class ApproximateInverse:
    """Approximate inverse of the displacement operator, without normal-tangential coupling.

    This preconditioner maps displacements to tractions. The spectra are those of the influence
    coefficients without zero padding. A component costs 1/4 convolution. Components are x, y and z
    if they have spectra, then the bins of slip compliance. A bin is a scalar shear, for which the
    mean tangential compliance plus the compliance of the bin is inverted.

    transforms  transforms of the domain
    spectra     spectra of the inverse (quarters) by pairs of components; real and symmetric
    """

    def __init__(self, transforms: Transforms, spectra: Mapping[str, Field]) -> None:
        self._transforms, self._spectra = transforms, spectra
        entries = {}
        for pair, quarter in spectra.items():
            inverse = KernelSpectrum(quarter, -1 if pair == "xy" else 1)
            entries[pair] = response(transforms, pair, inverse)
        names = "".join(name for name in "xyz" + BINS if 2 * name in spectra)
        self._apply_product = Product(transforms, entries, names, names, padded=False)

    def __call__(self, displacements: Array) -> Array:
        """Compute approximate tractions that cause given surface displacements (components, nx,
        ny).

        displacements  displacement components and bins (components, nx, ny)
        """
        return self._apply_product(displacements)

    def with_compliance(self, compliance: float) -> ApproximateInverse:
        """Return the approximate inverse for surfaces with an additional compliance in each cell.

        The proximal-point method adds this compliance. The compliances of the bins increase in
        proportion to the self-compliance of a cell.

        compliance  additional displacement of a cell by unit traction on the same cell
                    [length^3/force]
        """
        xx, yy, xy = (self._spectra[pair] for pair in ("xx", "yy", "xy"))
        # (F + ρ)⁻¹ = F⁻¹ (1 + ρ F⁻¹)⁻¹
        both = compliance * (xx * yy - xy * xy)
        total = 1 + compliance * (xx + yy + both)
        more = dict(zip(BINS, compliance * (1 + COMPLIANCES), strict=True))
        alone = {pair: one for pair, one in self._spectra.items() if pair[0] not in "xy"}
        spectra = {
            "xx": (xx + both) / total,
            "yy": (yy + both) / total,
            "xy": xy / total,
            **{p: one / (1 + more.get(p[0], compliance) * one) for p, one in alone.items()},
        }
        return ApproximateInverse(self._transforms, spectra)


def positive_inverse(spectrum: Field) -> Field:
    """Compute 1/|S| of a Fourier spectrum S, finite by a lower bound on |S|.

    Used for preconditioners: conjugate gradients require a positive matrix. Values of S can be
    negative for films much stiffer than their base, because the displacements reach beyond the
    period.

    spectrum  spectrum of influence coefficients, by wavenumber
    """
    size = np.abs(spectrum)
    return np.asarray(1 / np.maximum(size, np.finfo(float).eps * np.max(size)))


def inverse_2x2(xx: Field, yy: Field, xy: Field) -> tuple[Field, Field, Field]:
    """Invert the tangential spectrum, a symmetric matrix [[xx, xy], [xy, yy]], at each wavenumber.

    The results are the entries xx, yy, xy of the inverse, used for preconditioners. Eigenvalues are
    replaced by their magnitudes, with a lower bound, because conjugate gradients require a positive
    matrix.

    xx, yy, xy  spectra of the tangential influence coefficients, by wavenumber
    """
    mean, half = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    least = np.finfo(float).eps * np.max(mean + half)
    # Increase of each eigenvalue: exactly zero for positive eigenvalues.
    lower, upper = (np.maximum(np.abs(e), least) - e for e in (mean - half, mean + half))
    turned = 0.5 * (upper - lower) / np.where(half > 0, half, 1.0)
    raised = 0.5 * (upper + lower) - turned * mean
    xx, yy, xy = xx + raised + turned * xx, yy + raised + turned * yy, xy + turned * xy
    determinant = xx * yy - xy * xy
    return yy / determinant, xx / determinant, -xy / determinant
