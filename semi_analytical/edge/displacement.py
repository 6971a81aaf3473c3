"""Surface displacements by the variation of tractions within cells.

`Within` stores this variation. `EdgeOperator` computes its displacements at the cell centres. The
edge correction adds these displacements to those of tractions that are uniform in each cell.
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
    """Variation of one traction component within cells: slopes, and remainders in edge cells.

    The component is the pressure or one component of the shear. Edge cells are the cells along the
    edge of the contact or stick zone, with PARTS x PARTS subcells.

    slopes  change of the traction across each cell along x and y (2, nx, ny) [force/length^2]
    i, j    indices of the edge cells (n,)
    rest    subcell tractions of the edge cells minus cell mean and slopes (n, PARTS, PARTS)
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
        """Compute the variation of a traction within cells from cell means and subcell values.

        Slopes are central differences of the means. In edge cells the slopes are fitted to the
        subcell values, and the remainder is the difference.

        means   cell means of the traction (nx, ny)
        i, j    indices of the edge cells, which have subcell values (n,)
        parts   subcell values of the edge cells (n, PARTS, PARTS)
        domain  domain of `means`: full window or reduced domain
        """
        slopes = domain.differences(means) * (means != 0)
        values = parts.reshape(-1, PARTS**2)
        linear = values @ (LINEAR / [1, 1 / MOMENT, 1 / MOMENT] / PARTS**2)
        slopes[:, i, j] = linear[:, 1:].T
        rest = values - linear @ LINEAR.T
        return cls(slopes, i, j, rest.reshape(parts.shape))

    def along(self, n: Field, component: Field) -> Within:
        """Return the variation of one shear component within cells, from that of the magnitude.

        The present object is the variation of the magnitude, the friction limit. The direction of
        the shear is smooth. In edge cells the result is n times the present variation; in other
        cells the slopes are differences of the component.

        n          direction cosine of the component (nx, ny)
        component  cell means of the component (nx, ny)
        """
        slopes = np.stack(list(np.gradient(component)))
        at = self.i, self.j
        slopes[:, *at] = n[at] * self.slopes[:, *at]
        return Within(slopes, self.i, self.j, n[at][:, None, None] * self.rest)

    @classmethod
    def zero(cls, cells: tuple[int, ...]) -> Within:
        """Return the variation within cells of a traction that is zero everywhere.

        cells  number of cells along x and y
        """
        none = np.zeros(0, dtype=int)
        return cls(np.zeros((2, *cells)), none, none, np.zeros((0, PARTS, PARTS)))

    def extend_to_window(self, domain: ReducedDomain) -> Within:
        """Extend the variation within cells from the reduced domain to the full window.

        The traction is even about the mirror planes, as a pressure.

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
        """Return a variation within cells with given slopes and a weighted sum of remainders.

        Used for the shear, which combines the friction limit in the slip zone with the shear of
        preceding increments in the stick zone. Remainders of the same cell are added, so that the
        number of edge cells does not grow over load cycles.

        slopes  slopes of the result (2, nx, ny)
        terms   pairs of a smooth weight (nx, ny) and a variation whose remainder is added
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
    """Operator from variations of tractions within cells to displacements at the cell centres.

    The edge correction applies this operator in each iteration. One application costs half a
    convolution per displacement component and one per traction component.
    """

    def __init__(
        self,
        kernels: Matrix,
        shape: Pair,
        counter: Convolutions,
        domain: ReducedDomain = WINDOW,
    ) -> None:
        """Compute the Fourier spectra of the slope kernels, and the displacements by unit subcell
        tractions.

        kernels  sign and kernels; one row per displacement component, one column per traction
                 component
        shape    number of cells of the domain along x and y
        counter  counter of convolutions, which each application increases
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
        """Compute the surface displacements [length] by variations of tractions within cells.

        The result (components, nx, ny) is at the cell centres. Cell means of the tractions do not
        contribute.

        within  variation within cells of each traction component
        """
        slopes = np.concatenate([w.slopes for w in within])
        self._counter.count += 0.5 * (len(self._matrix) + len(slopes))
        u = self._transforms.filter_fields(slopes, *self._sides, self._multiply_amplitudes)
        for traction, near in zip(within, self._near, strict=True):
            for total, moved in zip(u, around(traction, near, len(self._matrix)), strict=True):
                total += self._domain.fold_frame(moved, REACH)
        return u

    def _multiply_amplitudes(self, amplitudes: Sequence[Array], columns: slice) -> list[Array]:
        """Multiply the transformed slopes of the tractions by the spectra of the slope kernels.

        The results are the transformed displacement components in some columns of the transforms.

        amplitudes  transforms of the slopes, along x and y of each traction component
        columns     columns of the transforms to which the amplitudes belong
        """
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
    """Compute the displacements that the remainders in edge cells cause at most REACH cells away.

    A remainder is the traction in the subcells of a cell minus its mean and its slopes. The result
    (count, nx + 2 REACH, ny + 2 REACH) includes a margin of REACH cells on each side.

    within  variation of one traction component within cells
    near    displacement by unit traction on each subcell (count * offsets, PARTS²)
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
