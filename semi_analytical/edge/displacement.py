"""Surface displacements by the variation of tractions within their cells.

`Within` holds this variation. `EdgeOperator` maps it to displacements at the cell centres. The edge
correction adds these displacements to those of tractions that are uniform in each cell.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np

from contact_scene.array_types import Field, Indices
from semi_analytical.edge.kernels import PARTS, REACH, EdgeKernels, part_centres
from semi_analytical.operator.domain import WINDOW, Pair, ReducedDomain
from semi_analytical.operator.operator import Array, Response, response
from semi_analytical.operator.spectra import kernel_spectrum
from semi_analytical.operator.transforms import Convolutions, Transforms

# Sign and kernels of a component: rows are displacements, columns tractions.
Matrix = Sequence[Sequence[tuple[int, EdgeKernels]]]

# Slope over the first moment: 12 for a linear function, corrected for constant subcells.
MOMENT = 12 / (1 - 1 / PARTS**2)
X, Y = (at.ravel() for at in np.meshgrid(part_centres(), part_centres(), indexing="ij"))
# Basis 1, x, y of linear functions at the subcells of a cell.
LINEAR = np.stack([np.ones(PARTS**2), X, Y], axis=-1)


@dataclass(frozen=True)
class Within:
    """Variation of one traction component about its cell means: slopes, and a remainder in edge
    cells.

    slopes  (2, nx, ny) change of the traction across a cell along x and y [force/length^2]
    i, j    indices of the edge cells (n,)
    rest    (n, PARTS, PARTS) subcell tractions of the edge cells minus cell mean and slopes
            [force/length^2]
    """

    slopes: Field
    i: Indices
    j: Indices
    rest: Field

    @classmethod
    def from_subcells(
        cls,
        means: Field,
        i: Indices,
        j: Indices,
        parts: Field,
        domain: ReducedDomain = WINDOW,
    ) -> Within:
        """Compute the variation of a traction from its cell means and its subcell values in edge
        cells.

        Slopes are central differences of the means. In edge cells they are fitted to the subcell
        values.

        means   (nx, ny) cell means on the domain
        i, j    indices of the edge cells (n,)
        parts   (n, PARTS, PARTS) subcell values of the edge cells
        domain  domain of `means`
        """
        slopes = domain.differences(means) * (means != 0)
        values = parts.reshape(-1, PARTS**2)
        linear = values @ (LINEAR / [1, 1 / MOMENT, 1 / MOMENT] / PARTS**2)
        slopes[:, i, j] = linear[:, 1:].T
        rest = values - linear @ LINEAR.T
        return cls(slopes, i, j, rest.reshape(parts.shape))

    def along(self, n: Field, component: Field) -> Within:
        """Return the variation within cells of one component of a vector traction from that of its
        magnitude.

        Used for the shear at the friction limit, whose direction is smooth. In edge cells the
        variation is n times the present one; elsewhere the slopes are differences of the component.

        n          direction cosine of the component (nx, ny)
        component  cell means of the component (nx, ny)
        """
        slopes = np.stack(list(np.gradient(component)))
        at = self.i, self.j
        slopes[:, *at] = n[at] * self.slopes[:, *at]
        return Within(slopes, self.i, self.j, n[at][:, None, None] * self.rest)

    @classmethod
    def zero(cls, cells: tuple[int, ...]) -> Within:
        """Return the variation within cells of a traction that is zero everywhere on `cells`
        (nx, ny)."""
        none = np.zeros(0, dtype=int)
        return cls(np.zeros((2, *cells)), none, none, np.zeros((0, PARTS, PARTS)))

    def extend_to_window(self, domain: ReducedDomain) -> Within:
        """Extend the variation of a traction that is even about the mirror planes to the full
        window.

        domain  reduced domain of the present variation
        """
        at, rest = np.stack([self.i, self.j]), self.rest
        for axis in domain.planes:
            count = self.slopes.shape[1 + axis]
            images = at.copy()
            images[axis], at[axis] = count - 1 - at[axis], count + at[axis]
            at = np.concatenate([images, at], axis=1)
            rest = np.concatenate([np.flip(rest, axis + 1), rest])
        slopes = ReducedDomain(domain.mirrors).extend(self.slopes)
        return Within(slopes, at[0], at[1], rest)

    @classmethod
    def combine(cls, slopes: Field, terms: Sequence[tuple[Field, Within]]) -> Within:
        """Combine given slopes with the sum of the remainders of several variations times smooth
        fields.

        Remainders of the same cell are added, so that the number of cells does not grow over load
        cycles.

        slopes  slopes of the result (2, nx, ny)
        terms   pairs of a smooth factor (nx, ny) and a variation
        """
        ny = slopes.shape[2]
        some = [factor[w.i, w.j] != 0 for factor, w in terms]
        each = [(w.i * ny + w.j)[of] for of, (_, w) in zip(some, terms, strict=True)]
        cells = np.unique(np.concatenate(each))
        rest = np.zeros((len(cells), PARTS, PARTS))
        for of, at, (factor, w) in zip(some, each, terms, strict=True):
            scale = factor[w.i[of], w.j[of], None, None]
            rest[np.searchsorted(cells, at)] += scale * w.rest[of]
        return cls(slopes, cells // ny, cells % ny, rest)


class EdgeOperator:
    """Operator from variations of tractions within cells to surface displacements at the cell
    centres.

    A call costs half a convolution per displacement component and one per traction component.
    """

    def __init__(
        self,
        kernels: Matrix,
        shape: Pair,
        counter: Convolutions,
        domain: ReducedDomain = WINDOW,
    ) -> None:
        """Compute the Fourier spectra of the slope kernels and the displacement tables of the edge
        cells.

        kernels  sign and kernels; one row per displacement component, one column per traction
                 component
        shape    number of cells of the domain along x and y
        counter  counter of convolutions, which a call increases
        domain   domain of all fields; a reduced domain is for pressures only
        """
        self._transforms = Transforms(shape, ReducedDomain(domain.mirrors), counter)
        columns, self._counter, self._domain = len(kernels[0]), counter, domain
        # The slopes of a scalar field have the parities of a vector.
        reduced = domain.images > 1
        inputs = "xy" if reduced else "zz" * columns
        self._sides = self._transforms.axis_transforms(inputs, "z" * len(kernels))
        self._components: dict[str, Sequence[Response]] = {}
        for _, of in chain.from_iterable(kernels):
            if of.component not in self._components:
                (s_x, s_y), reach = of.parity, self._transforms.reach
                parities = (-s_x, s_y), (s_x, -s_y)
                moments = [
                    kernel_spectrum(moment, parity, reach)
                    for moment, parity in zip(of.moments, parities, strict=True)
                ]
                pairs = zip(("xz", "yz"), moments, strict=True)
                self._components[of.component] = (
                    [response(self._transforms, *pair) for pair in pairs] if reduced else moments
                )
        self._matrix = [
            [(sign * (-1j if of.even and not reduced else 1), of.component) for sign, of in row]
            for row in kernels
        ]
        self._near = [
            np.concatenate([sign * of.near.reshape(-1, PARTS**2) for sign, of in column])
            for column in zip(*kernels, strict=True)
        ]

    def __call__(self, *within: Within) -> Field:
        """Compute displacements (rows, nx, ny) [length] from the variations of tractions within
        cells.

        within  one variation per traction component
        """
        slopes = np.concatenate([w.slopes for w in within])
        self._counter.count += 0.5 * (len(self._matrix) + len(slopes))
        u = self._transforms.filter_fields(slopes, *self._sides, self._multiply_amplitudes)
        for traction, near in zip(within, self._near, strict=True):
            for total, moved in zip(u, around(traction, near, len(self._matrix)), strict=True):
                total += self._domain.fold_frame(moved, REACH)
        return u

    def _multiply_amplitudes(self, amplitudes: Sequence[Array], columns: slice) -> list[Array]:
        symbols = {name: [one[columns] for one in pair] for name, pair in self._components.items()}
        u = []
        for row in self._matrix:
            total: Array | float = 0.0
            for k, (factor, name) in enumerate(row):
                along_x, along_y = symbols[name]
                part = along_x * amplitudes[2 * k] + along_y * amplitudes[2 * k + 1]
                total = total + factor * part
            u.append(np.asarray(total))
        return u


def around(within: Within, near: Field, count: int) -> Field:
    """Compute the displacements that the tractions of edge cells cause at most REACH cells away.

    Only the remainders of the tractions act: subcell tractions minus mean and slopes of the cell.
    The result (count, nx + 2 REACH, ny + 2 REACH) includes a margin of REACH cells on each side.

    within  variation of one traction component within the cells
    near    (count * offsets, PARTS²) displacement by unit traction on each subcell
    count   number of displacement components
    """
    shape = np.array(within.slopes.shape[1:]) + 2 * REACH
    moved = near @ within.rest.reshape(-1, PARTS**2).T
    offset = np.arange(2 * REACH + 1)
    at = (within.i + offset[:, None])[:, None] * shape[1] + (within.j + offset[:, None])
    u = np.empty((count, *shape))
    for total, one in zip(u, moved.reshape(count, -1), strict=True):
        total.flat = np.bincount(at.ravel(), weights=one, minlength=total.size)
    return u
