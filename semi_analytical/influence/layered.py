"""Influence coefficients of a layered body: integrals of its point response over the loaded cell.

The integration in real space has neither aliasing nor periodic images. The rule depends on the
distance from the loaded cell and is exact to rounding:

    at the origin   closed form of the outer material plus Gauss points for the smooth remainder;
    near            Gauss points on boxes that are small compared with their distance;
    far             nine-point average along x and y of the response at cell centres.
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
from contact_scene.machine import available_bytes
from contact_scene.solver_errors import ResourceRefused
from semi_analytical.frf.stack import Stack
from semi_analytical.influence.layered_cells import cell_integrals
from semi_analytical.influence.layered_response import COUPLING, NORMAL, TANGENTIAL, Components
from semi_analytical.influence.radial_table import RadialTable, radial_table

# Cache of arrays: key, shape and function that computes the array.
Remember = Callable[[str, tuple[int, ...], Callable[[], Field]], Field]

# Arrays of the size of the window at the peak (six results, three point responses and the work
# space of one average), and memory independent of the window [bytes].
ARRAYS = 13
FIXED = 20 << 20

PACKAGE = Path(__file__).resolve().parents[1]
# Folders whose sources determine the coefficients.
FOLDERS = ("frf", "influence")


def computed_afresh(identity: str, shape: tuple[int, ...], compute: Callable[[], Field]) -> Field:
    """Compute an array without a cache.

    Default of `LayeredCoefficients.remember`, which may instead read arrays from a disk cache.

    identity  cache key, not used
    shape     shape of the array, not used
    compute   function that computes the array
    """
    return compute()


@dataclass(frozen=True)
class LayeredCoefficients:
    """Influence coefficients of layers on a half-space or a rigid base, exact up to rounding.

    Displacement per unit traction [length^3/force], with an error of about 1e-15 of the value at
    the loaded cell (1e-12 if the cell is large compared with the layers on a rigid base). Each
    group of components is computed on first use.

    stack     layered body, not rigid
    spacing   cell sides [length]
    shape     number of offsets along x and y, including zero
    remember  cache of arrays, for instance `disk_cache.remembered`

    Raises ValueError for a rigid body, and ResourceRefused if the arrays exceed the free memory.
    """

    stack: Stack
    spacing: tuple[float, float]
    shape: tuple[int, int]
    remember: Remember = computed_afresh

    def __post_init__(self) -> None:
        if self.stack.is_rigid:
            raise ValueError("a rigid body has no influence coefficients. Omit it")
        refuse_beyond_memory(self.shape)

    @cached_property
    def _table(self) -> RadialTable:
        """Radial table of the point response, up to four cells beyond the farthest corner of the
        window."""
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
        """Normal displacement u_z by a unit pressure on one cell, at all cell offsets (nx, ny).

        The unit is [length^3/force].
        """
        return self._normal[0]

    @property
    def xx(self) -> Field:
        """Tangential displacement u_x by a unit shear q_x on one cell, at all cell offsets (nx,
        ny).

        The unit is [length^3/force].
        """
        return self._tangential[0]

    @property
    def yy(self) -> Field:
        """Tangential displacement u_y by a unit shear q_y on one cell, at all cell offsets (nx,
        ny).

        The unit is [length^3/force].
        """
        return self._tangential[1]

    @property
    def xy(self) -> Field:
        """Tangential displacement u_x by a unit shear q_y on one cell, at all cell offsets (nx,
        ny).

        The unit is [length^3/force].
        """
        return self._tangential[2]

    @property
    def zx(self) -> Field:
        """Normal displacement u_z by a unit shear q_x on one cell, at all cell offsets (nx, ny).

        The unit is [length^3/force].
        """
        return self._coupling[0]

    @property
    def zy(self) -> Field:
        """Normal displacement u_z by a unit shear q_y on one cell, at all cell offsets (nx, ny).

        The unit is [length^3/force].
        """
        return self._coupling[1]


def required_bytes(shape: tuple[int, int]) -> int:
    """Estimate the peak memory of `LayeredCoefficients` [bytes].

    shape  number of offsets along x and y
    """
    return 8 * ARRAYS * (shape[0] + 9) * (shape[1] + 9) + FIXED


def refuse_beyond_memory(shape: tuple[int, int]) -> None:
    """Raise ResourceRefused if influence coefficients of this shape do not fit into the free
    memory.

    shape  number of offsets along x and y
    """
    required, available = required_bytes(shape), available_bytes()
    if required > available:
        raise ResourceRefused(
            f"influence coefficients for {shape[0]} x {shape[1]} offsets need "
            f"{required / 2**30:.2g} GiB of memory, {available / 2**30:.2g} GiB are available. "
            "Use fewer cells"
        )


@cache
def sources_digest(package: Path = PACKAGE) -> str:
    """Compute a digest of the source files in FOLDERS and of the library versions, for cache keys.

    package  folder that contains FOLDERS
    """
    digest = sha256(f"numpy {np.__version__}, scipy {scipy.__version__}\n".encode())
    for folder in FOLDERS:
        for source in sorted((package / folder).rglob("*.py")):
            content = sha256(source.read_bytes()).hexdigest()
            digest.update(f"{source.relative_to(package).as_posix()} {content}\n".encode())
    return digest.hexdigest()
