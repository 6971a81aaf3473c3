"""Influence coefficients of a layered body: its point response integrated over the loaded cell.

No transform over the plane is involved: there is neither aliasing nor a periodic image, and
nothing to choose. Three ways to integrate, by distance, each exact to rounding where it is used:

    at the origin   closed form of the outer material + Gauss points for the smooth remainder;
    near            Gauss points on boxes small against their distance;
    far             the response at cell centres, averaged by a nine-point formula along x and y.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from hashlib import sha256
from math import hypot
from pathlib import Path

import numpy as np
import scipy

from contact_scene.array_types import Field
from contact_scene.machine.free_memory import available_bytes
from contact_scene.solver_errors import ResourceRefused
from semi_analytical.frf.stack import Stack
from semi_analytical.influence.layered_cells import cell_integrals
from semi_analytical.influence.layered_response import COUPLING, NORMAL, TANGENTIAL, Components
from semi_analytical.influence.radial_table import RadialTable, radial_table

# From what determines an array and its shape, and the means to compute it, to the array.
Remember = Callable[[str, tuple[int, ...], Callable[[], Field]], Field]

# Arrays of the size of the window alive at the peak (six results, three point responses and
# the work space of one average), and everything that does not grow with the window.
ARRAYS = 13
FIXED = 20 << 20

PACKAGE = Path(__file__).resolve().parents[1]
# All that decides the bits of a coefficient, from the point response to its integral over a cell.
FOLDERS = ("frf", "influence")


def computed_afresh(identity: str, shape: tuple[int, ...], compute: Callable[[], Field]) -> Field:
    """Remember nothing."""
    return compute()


@dataclass(frozen=True)
class LayeredCoefficients:
    """Exact influence coefficients of layers on a half-space or a rigid base.

    Displacement per unit traction [length^3/force], right to about 1e-15 of the own cell's; to
    1e-12 where a cell is large against everything above a rigid base. Computed when first asked
    for, only what is asked for.

    stack     the body, not a rigid one
    spacing   cell sides [length]
    shape     number of offsets along x and y, the zero offset included
    remember  where arrays are kept between runs, for instance `disk_cache.remembered`

    Raises ResourceRefused, before any work, if the arrays do not fit into the free memory.
    """

    stack: Stack
    spacing: tuple[float, float]
    shape: tuple[int, int]
    remember: Remember = computed_afresh

    def __post_init__(self) -> None:
        if self.stack.is_rigid:
            raise ValueError("a rigid body has no influence coefficients: leave it out")
        refuse_beyond_memory(self.shape)

    @cached_property
    def _table(self) -> RadialTable:
        """The point response to a little beyond the farthest corner of the window."""
        (dx, dy), (nx, ny) = self.spacing, self.shape
        return radial_table(self.stack, hypot((nx + 4) * dx, (ny + 4) * dy))

    def _of(self, components: Components) -> tuple[Field, ...]:
        def compute() -> Field:
            return cell_integrals(self._table, self.stack, components, self.spacing, self.shape)

        (dx, dy), (nx, ny) = self.spacing, self.shape
        given = (self.stack.layers, self.stack.base, float(dx), float(dy), int(nx), int(ny))
        identity = repr((sources_digest(), components.names, *given))
        return tuple(self.remember(identity, (len(components.names), nx, ny), compute))

    @cached_property
    def _normal(self) -> tuple[Field, ...]:
        return self._of(NORMAL)

    @cached_property
    def _tangential(self) -> tuple[Field, ...]:
        return self._of(TANGENTIAL)

    @cached_property
    def _coupling(self) -> tuple[Field, ...]:
        return self._of(COUPLING)

    @property
    def zz(self) -> Field:
        """u_z by pressure."""
        return self._normal[0]

    @property
    def xx(self) -> Field:
        """u_x by q_x."""
        return self._tangential[0]

    @property
    def yy(self) -> Field:
        """u_y by q_y."""
        return self._tangential[1]

    @property
    def xy(self) -> Field:
        """u_x by q_y."""
        return self._tangential[2]

    @property
    def zx(self) -> Field:
        """u_z by q_x."""
        return self._coupling[0]

    @property
    def zy(self) -> Field:
        """u_z by q_y."""
        return self._coupling[1]


def required_bytes(shape: tuple[int, int]) -> int:
    """Peak memory of all `LayeredCoefficients` for offsets of this shape."""
    return 8 * ARRAYS * (shape[0] + 9) * (shape[1] + 9) + FIXED


def refuse_beyond_memory(shape: tuple[int, int]) -> None:
    """Raise ResourceRefused if coefficients of this shape do not fit into the free memory."""
    required, available = required_bytes(shape), available_bytes()
    if required > available:
        raise ResourceRefused(
            f"influence coefficients for {shape[0]} x {shape[1]} offsets need "
            f"{required / 2**30:.2g} GiB of memory, {available / 2**30:.2g} GiB are available; "
            "take fewer cells"
        )


@cache
def sources_digest(package: Path = PACKAGE) -> str:
    """Of the sources of FRF and influence coefficients as they are now, and of the libraries.

    package  the folder that holds FOLDERS
    """
    digest = sha256(f"numpy {np.__version__}, scipy {scipy.__version__}\n".encode())
    for folder in FOLDERS:
        for source in sorted((package / folder).rglob("*.py")):
            content = sha256(source.read_bytes()).hexdigest()
            digest.update(f"{source.relative_to(package).as_posix()} {content}\n".encode())
    return digest.hexdigest()
