"""Surface displacements by tractions that vary within the cells of a contact model.

The edge correction of pressure and shear adds these displacements to those of tractions that are
uniform in each cell.
"""

from functools import cached_property

from contact_scene.array_types import Mask, VectorField
from semi_analytical.edge.displacement import EdgeOperator
from semi_analytical.edge.film import FilmLaw, film_law
from semi_analytical.edge.kernels import PART_OFFSETS, PARTS, EdgeKernels
from semi_analytical.edge.shape import inscribed_radius
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.influence.coefficients import PARITY
from semi_analytical.model import ContactModel
from semi_analytical.operator.domain import WINDOW, ReducedDomain

Row = tuple[tuple[int, str], ...]
Matrix = tuple[Row, ...]

PRESSURE: Matrix = (((1, "zz"),),)
SHEAR: Matrix = (((1, "xx"), (1, "xy")), ((1, "xy"), (1, "yy")))
APART: Matrix = (((1, "zx"), (1, "zy"), (1, "zz")),)


class EdgeOperators:
    """Operators of the edge correction of a contact model; each is computed at its first use.

    The operators map variations of tractions within cells to surface displacements at the cell
    centres.
    """

    def __init__(self, model: ContactModel) -> None:
        self.model = model

    @cached_property
    def displace_by_pressure(self) -> EdgeOperator:
        """Operator from pressure variations within cells to the normal displacement of the surface
        [length].

        Its fields are on the reduced domain.
        """
        return self._build_operator(PRESSURE, self.model.domain)

    @cached_property
    def displace_by_shear(self) -> EdgeOperator:
        """Operator from shear variations within cells to the tangential surface displacement
        [length].

        Its fields are on the full window. Shear and displacement have the components x and y.
        """
        return self._build_operator(SHEAR, WINDOW)

    def displace_means(self, shear: VectorField) -> VectorField:
        """Compute the tangential surface displacement by a shear that is uniform in each cell.

        shear  shear on the full window (2, nx, ny) [force/length^2]
        """
        domain, operator = self.model.domain, self.model.operator(self.model.grid.cells)
        return domain.extend(operator.tangential(domain.restrict(shear)))

    @cached_property
    def apart(self) -> EdgeOperator:
        """Operator from variations of (q_x, q_y, p) within cells to the normal displacement u_z
        [length].

        q_x and q_y are the components of the shear, p is the pressure. Used on the full window for
        coupled bodies, whose shear causes normal displacements.
        """
        return self._build_operator(APART, WINDOW)

    def film(self, contact: Mask, domain: ReducedDomain) -> FilmLaw | None:
        """Return the law of the pressure near the contact edge of layered bodies.

        None is returned if no layer changes the pressure within a few cells of the edge, or if the
        contact is narrow compared with the layers. The pressure then follows a power of the
        distance from the edge.

        contact  cells in contact (nx, ny)
        domain   domain of `contact`: full window or reduced domain
        """
        law = self._film_law
        return law if law and law.holds_within(inscribed_radius(contact, domain)) else None

    @cached_property
    def _film_law(self) -> FilmLaw | None:
        scene = self.model.scene
        return film_law(scene.body, scene.indenter, self.model.grid.spacing)

    def _build_operator(self, rows: Matrix, domain: ReducedDomain) -> EdgeOperator:
        model = self.model
        kernels = [[(sign, self._edge_kernels[name]) for sign, name in row] for row in rows]
        cells = domain.cells(model.window.cells)
        return EdgeOperator(kernels, cells, model.convolutions, domain)

    @cached_property
    def _edge_kernels(self) -> dict[str, EdgeKernels]:
        model = self.model
        dx, dy = model.grid.spacing
        parts = influence_coefficients(
            model.scene.body,
            model.scene.indenter,
            (dx / PARTS, dy / PARTS),
            (PART_OFFSETS, PART_OFFSETS),
            model.scene.rig,
        )
        return {name: EdgeKernels(name, model.coefficients, parts) for name in PARITY}
