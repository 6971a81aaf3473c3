"""The input of CalculiX for one scene on one mesh.

The body is a cylinder of axisymmetric 8-node quadrilaterals (CAX8) that grow away from the contact;
its box moves as the substrate would under the nominal force. The paraboloid is one row of the same
elements, all nodes of which are moved. Quadratic edges hold a parabola exactly. Contact is by
face-to-face penalty, with regularised Coulomb friction.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from verification.external_codes.coated_scene import (
    CONTACT_MODULUS,
    HERTZ,
    POISSON_RATIO,
    RADIUS,
    SUBSTRATE_MODULUS,
    CoatedScene,
    far_displacement,
)

BOX = 100.0  # Hertz radii
GROWTH = 1.3  # from one element to the next
BORE = 1e-3  # Hertz radii; with nodes on the axis the faces of the expanded wedge degenerate
FINE = 1.0  # Hertz radii of equal elements, unless told otherwise
AT_EDGE = 8  # elements in one of the others

# Nodes of a CAX8 by column and row, counterclockwise with rows downwards; its upper face is S3 and
# its lower S1.
_CORNERS_THEN_MIDSIDES = ((0, 2), (2, 2), (2, 0), (0, 0), (1, 2), (2, 1), (1, 0), (0, 1))

Node = tuple[int, int]


@dataclass(frozen=True)
class Fineness:
    """How fine a deck is.

    elements   per Hertz radius; whole where they are equal
    stiffness  of the contact springs k in k E*/a_H per area, normal and tangential
    reach      of the equal elements, in Hertz radii; the contact must end within
    edge       of the contact, in Hertz radii, towards which elements shrink to 1/AT_EDGE of that;
               None: they are equal
    """

    elements: float
    stiffness: float
    reach: float = FINE
    edge: float | None = None

    @property
    def lines(self) -> list[float]:
        """Radii of the ball's elements, over the Hertz radius."""
        if self.edge is None:
            return [n * self.finest for n in range(round(self.reach * self.elements) + 1)]
        inwards, outwards = (
            _without_sliver(_until([0.0], self.finest, end, 1 / self.elements))
            for end in (self.edge, self.reach - self.edge)
        )
        return [*(self.edge - x for x in inwards[:0:-1]), *(self.edge + x for x in outwards)]

    @property
    def finest(self) -> float:
        """The smallest element, over the Hertz radius."""
        return 1 / self.elements / (1 if self.edge is None else AT_EDGE)


class _Section:
    """Numbered nodes and elements over columns and rows of lines."""

    def __init__(self, radii: Sequence[float], rows: int, node: int, element: int) -> None:
        self.radii = _with_midpoints(radii)
        self.rows = 2 * rows + 1
        columns = len(self.radii)
        everywhere = ((i, j) for j in range(self.rows) for i in range(columns))
        places = ((i, j) for i, j in everywhere if not (i % 2 and j % 2))
        self.nodes: dict[Node, int] = {at: node + n for n, at in enumerate(places, 1)}
        starts = ((i, j) for j in range(0, self.rows - 2, 2) for i in range(0, columns - 2, 2))
        self.elements: dict[Node, int] = {at: element + n for n, at in enumerate(starts, 1)}

    def element_lines(self) -> Iterator[str]:
        for (i, j), number in self.elements.items():
            nodes = [self.nodes[i + di, j + dj] for di, dj in _CORNERS_THEN_MIDSIDES]
            yield ", ".join(map(str, [number, *nodes]))


def calculix_deck(scene: CoatedScene, fineness: Fineness) -> str:
    """The whole input file; its lines depend on nothing but the arguments."""
    touching, per_radius = fineness.lines, f"{fineness.elements:g} per Hertz radius"
    radii = _grown(touching)
    radii[0] = BORE
    film = _until([0.0], fineness.finest, scene.thickness)
    depths = _with_midpoints(_grown(film))
    body = _Section(radii, (len(depths) - 1) // 2, 0, 0)
    ball = _Section(radii[: len(touching)], 1, max(body.nodes.values()),
                    max(body.elements.values()))  # fmt: skip
    return "\n".join(
        (
            "*HEADING",
            f"{scene.name}: {per_radius}, stiffness {fineness.stiffness:g}",
            *_mesh(scene, body, ball, depths, len(film) - 1),
            *_contact(scene, fineness),
            *_loading(scene, body, depths),
            "",
        )
    )


def _mesh(
    scene: CoatedScene, body: _Section, ball: _Section, depths: Sequence[float], layers: int
) -> Iterator[str]:
    yield "*NODE, NSET=BODY"
    for (i, j), number in body.nodes.items():
        yield _numbers(
            number, body.radii[i] * HERTZ.contact_radius, -depths[j] * HERTZ.contact_radius
        )
    yield "*NODE, NSET=BALL"
    for (i, j), number in ball.nodes.items():
        r = ball.radii[i] * HERTZ.contact_radius
        yield _numbers(number, r, r**2 / (2 * RADIUS) + (2 - j) / 2 * HERTZ.contact_radius)
    yield from ("*ELEMENT, TYPE=CAX8, ELSET=BODY", *body.element_lines())
    yield from ("*ELEMENT, TYPE=CAX8, ELSET=BALL", *ball.element_lines())
    touching = len(ball.elements)
    coating = [n for (_, j), n in body.elements.items() if j < 2 * layers]
    base = [n for (_, j), n in body.elements.items() if j >= 2 * layers]
    upper = list(body.elements.values())[:touching]
    yield from _set("ELSET=COATING", coating)
    yield from _set("ELSET=BASE", base)
    yield from _set("ELSET=UPPER", upper)
    axis = [n for (i, j), n in body.nodes.items() if i == 0 and depths[j] < BOX]
    yield from _set("NSET=AXIS", axis)
    for name, modulus in (("COATING", scene.modulus_ratio * SUBSTRATE_MODULUS),
                          ("BASE", SUBSTRATE_MODULUS)):  # fmt: skip
        yield from (f"*MATERIAL, NAME={name}", "*ELASTIC", _numbers(modulus, POISSON_RATIO))
    for elements, material in (("COATING", "COATING"), ("BASE", "BASE"), ("BALL", "BASE")):
        yield f"*SOLID SECTION, ELSET={elements}, MATERIAL={material}"


def _contact(scene: CoatedScene, fineness: Fineness) -> Iterator[str]:
    spring = fineness.stiffness * CONTACT_MODULUS / HERTZ.contact_radius
    yield from ("*SURFACE, NAME=SLAVE", "UPPER, S3", "*SURFACE, NAME=MASTER", "BALL, S1")
    yield from ("*SURFACE INTERACTION, NAME=TOUCH",
                "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", _numbers(spring))  # fmt: skip
    if scene.friction:
        yield from ("*FRICTION", _numbers(scene.friction, spring))
    yield "*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE"
    yield "SLAVE, MASTER"


def _loading(scene: CoatedScene, body: _Section, depths: Sequence[float]) -> Iterator[str]:
    yield from ("*BOUNDARY", "AXIS, 1, 1", "BALL, 1, 1")
    for name, power in (("APPROACH", 2), ("FORCE", 3)):
        yield f"*AMPLITUDE, NAME={name}"
        for n in range(scene.increments + 1):
            time = n / scene.increments
            yield _numbers(time, time**power)
    yield from ("*STEP, INC=1000", "*STATIC, DIRECT", _numbers(1 / scene.increments, 1.0))
    yield "*BOUNDARY, AMPLITUDE=APPROACH"
    yield _numbers("BALL", 2, 2, -scene.approach * HERTZ.approach)
    yield "*BOUNDARY, AMPLITUDE=FORCE"
    for (i, j), number in body.nodes.items():
        if i == len(body.radii) - 1 or j == body.rows - 1:
            at = body.radii[i] * HERTZ.contact_radius, depths[j] * HERTZ.contact_radius
            outward, inward = far_displacement(*at)
            yield _numbers(number, 1, 1, outward)
            yield _numbers(number, 2, 2, -inward)
    yield from (f"*NODE PRINT, NSET=BALL, TOTALS=ONLY, FREQUENCY={scene.increments}", "RF")
    yield from (f"*CONTACT FILE, FREQUENCY={scene.increments}", "CSTR", "*END STEP")


def _grown(lines: list[float]) -> list[float]:
    """The lines and more, each step longer than the last, out to the box."""
    step = (lines[-1] - lines[-2]) * GROWTH
    return _without_sliver(_until(lines, step, BOX))


def _until(lines: list[float], step: float, end: float, largest: float = math.inf) -> list[float]:
    """The lines and more from `step` on, the last at `end`."""
    more = list(lines)
    while more[-1] + step < end:
        more.append(more[-1] + step)
        step = min(step * GROWTH, largest)
    return [*more, end]


def _without_sliver(lines: list[float]) -> list[float]:
    """Less the last but one if it is too close to the last."""
    if len(lines) > 2 and lines[-1] - lines[-2] < 0.5 * (lines[-2] - lines[-3]):
        return [*lines[:-2], lines[-1]]
    return lines


def _with_midpoints(lines: Sequence[float]) -> list[float]:
    return [place for a, b in pairwise(lines) for place in (a, (a + b) / 2)] + [lines[-1]]


def _set(name: str, members: Sequence[int]) -> Iterator[str]:
    """Sixteen to a line, which is the most that CalculiX reads."""
    keyword = "*NSET" if name.startswith("NSET") else "*ELSET"
    yield f"{keyword}, {name}"
    for start in range(0, len(members), 16):
        yield ", ".join(map(str, members[start : start + 16]))


def _numbers(*values: float | str) -> str:
    return ", ".join(f"{v:.9e}" if isinstance(v, float) else str(v) for v in values)
