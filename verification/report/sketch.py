"""The picture of a scene: its section y = 0 drawn to scale, as SVG in the page's colours."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from html import escape

from contact_scene.engineering_units import quantity
from verification.judging.section_sketch import SectionSketch, SketchedBody
from verification.report.thinned import thinned

WIDTH, PICTURE, MARGIN = 660.0, 400.0, 10.0
ABOVE = 92.0  # of the surface, for indenter and arrows
LEAST_BELOW, MOST_BELOW = 90.0, 200.0
RAISED = 16.0  # the label of the friction above the surface
RIM = 0.99  # of the half width
LINE = 16.0  # between two labels
LEAST_SHOWN = 2.5  # a thinner layer is drawn this thick, and said so
FONT = 'font-size="12"'
SURFACE = MARGIN + ABOVE
MEANINGS = {
    "W": "normal force", "ω_z": "approach", "T": "tangential force", "ω_x": "tangential shift",
    "M_z": "torque or twist", "M": "moment or tilt",
}  # fmt: skip


def sketch_svg(sketch: SectionSketch, name: str, title: str) -> str:
    """The section as an SVG element; equal sketches give equal text.

    name   unique in the page, for ids
    title  of the scene
    """
    scale = PICTURE / 2 / sketch.half_width
    below = _depth(sketch, scale)
    height = ABOVE + below + 2 * MARGIN + 26
    parts = [
        *_body(sketch.body, scale, below),
        *_indenter(sketch, scale, name),
        *_contact(sketch, scale, below),
        *_loads(sketch),
        *_labels(sketch, scale, below),
    ]
    text = escape(description(sketch))
    return (
        f'<svg class="sketch" viewBox="0 0 {WIDTH:g} {height:g}" role="img" '
        f'aria-labelledby="{name}-name {name}-text">'
        f'<title id="{name}-name">{escape(title)}: section, to scale</title>'
        f'<desc id="{name}-text">{text}</desc>'
        f'<clipPath id="{name}-clip"><rect x="{MARGIN:g}" y="{MARGIN:g}" width="{PICTURE:g}" '
        f'height="{ABOVE:g}"/></clipPath>{"".join(parts)}</svg>'
    )


def description(sketch: SectionSketch) -> str:
    """What the picture shows, in words."""
    loads = ", ".join(f"{symbol} ({MEANINGS[symbol]})" for symbol in sketch.loads)
    layers = "; ".join(f"layer {layer.material}" for layer in sketch.body.layers)
    body = f"{layers}; on {sketch.body.substrate}" if layers else sketch.body.substrate
    return (
        f"Indenter: {sketch.indenter.substrate}. Body: {body}. {sketch.friction}. Largest contact "
        f"radius {quantity(sketch.contact_radius, 'm', 3)}. Loads: {loads}. Drawn before loading, "
        "at first touch, both axes to one scale."
    )


def thin_layers(sketch: SectionSketch) -> bool:
    """Whether a layer is too thin to be seen at this scale, and is drawn thicker."""
    scale = PICTURE / 2 / sketch.half_width
    bodies = (sketch.indenter, sketch.body)
    return any(layer.thickness * scale < LEAST_SHOWN for b in bodies for layer in b.layers)


def _depth(sketch: SectionSketch, scale: float) -> float:
    layers = sum(_bands(sketch.body, scale))
    return min(MOST_BELOW, max(LEAST_BELOW, layers + 45.0))


def _bands(body: SketchedBody, scale: float) -> list[float]:
    return [max(LEAST_SHOWN, layer.thickness * scale) for layer in body.layers]


def _x(value: float, scale: float) -> float:
    return MARGIN + PICTURE / 2 + value * scale


def _body(body: SketchedBody, scale: float, below: float) -> Iterator[str]:
    top = SURFACE
    bottom = SURFACE + below
    for number, band in enumerate(_bands(body, scale)):
        end = min(top + band, bottom)
        yield _rect(top, end, f"layer-{number % 3}")
        top = end
    if top < bottom:
        yield _rect(top, bottom, "substrate")
    yield _line(MARGIN, SURFACE, MARGIN + PICTURE, SURFACE, "surface")


def _rect(top: float, bottom: float, kind: str) -> str:
    return (
        f'<rect class="{kind}" x="{MARGIN:g}" y="{top:.2f}" width="{PICTURE:g}" '
        f'height="{bottom - top:.2f}"/>'
    )


def _line(x1: float, y1: float, x2: float, y2: float, kind: str) -> str:
    return f'<line class="{kind}" x1="{x1:.2f}" y1="{y1:.2f}" x2="{x2:.2f}" y2="{y2:.2f}"/>'


def _indenter(sketch: SectionSketch, scale: float, name: str) -> Iterator[str]:
    """The outline closed towards the top; layers are bands along it."""
    outline = _seen([(_x(x, scale), SURFACE - gap * scale) for x, gap in sketch.outline])
    beyond = 0.0 if _has_rim(sketch) else MARGIN  # its sides are cut off with the picture
    left, right = outline[0][0] - beyond, outline[-1][0] + beyond
    closed = [(left, 0.0), (left, outline[0][1]), *outline, (right, outline[-1][1]), (right, 0.0)]
    yield f'<g clip-path="url(#{name}-clip)">'
    yield f'<polygon class="indenter" points="{_points(closed)}"/>'
    top = 0.0
    for band in _bands(sketch.indenter, scale):
        top += band
        raised = [(x, y - top) for x, y in outline]
        yield f'<polyline class="interface" points="{_points(raised)}"/>'
    yield "</g>"


def _seen(outline: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """The outline without points that nobody could see."""
    x, y = zip(*outline, strict=True)
    spans = (MARGIN, MARGIN + PICTURE), (MARGIN, SURFACE)
    return list(zip(*(v.tolist() for v in thinned(x, y, spans, (False, False))), strict=True))


def _points(places: Iterable[tuple[float, float]]) -> str:
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in places)


def _has_rim(sketch: SectionSketch) -> bool:
    """Whether the indenter ends within the picture."""
    return sketch.outline[-1][0] < RIM * sketch.half_width


def _contact(sketch: SectionSketch, scale: float, below: float) -> Iterator[str]:
    """The contact at its largest, and the length that it gives the picture."""
    left, right = _x(-sketch.contact_radius, scale), _x(sketch.contact_radius, scale)
    yield _line(left, SURFACE, right, SURFACE, "contact")
    y = SURFACE + below + 10
    yield _line(left, y, right, y, "measure")
    for x in (left, right):
        yield _line(x, y - 4, x, y + 4, "measure")
    length = quantity(2 * sketch.contact_radius, "m", 3)
    yield _text((left + right) / 2, y + 16, f"2a = {length}", "middle")


def _loads(sketch: SectionSketch) -> Iterator[str]:
    """Arrows for what is prescribed; the first one is normal to the surface."""
    middle = MARGIN + PICTURE / 2
    if normal := [s for s in sketch.loads if s in ("W", "ω_z")]:
        yield _arrow(middle, MARGIN + 8, 0, 34)
        yield _text(middle + 9, MARGIN + 20, ", ".join(normal), "start")
    if along := [s for s in sketch.loads if s in ("T", "ω_x")]:
        yield _arrow(middle + 62, MARGIN + 26, 40, 0)
        yield _text(middle + 62, MARGIN + 18, ", ".join(along), "start")
    if turning := [s for s in sketch.loads if s in ("M_z", "M")]:
        x = middle - 100
        path = f"M{x - 20:g},{MARGIN + 22:g} a20,8 0 1 0 20,-8 m9,-5 l-9,5 l9,5"
        yield f'<path class="arrow" d="{path}"/>'
        yield _text(x - 26, MARGIN + 26, ", ".join(turning), "end")


def _arrow(x: float, y: float, dx: float, dy: float) -> str:
    ex, ey = x + dx, y + dy
    sx, sy = (5, 0) if dy else (0, 5)
    bx, by = ex - (9 if dx else 0), ey - (9 if dy else 0)
    return (
        f'<path class="arrow" d="M{x:g},{y:g} L{ex:g},{ey:g} M{bx - sx:g},{by - sy:g} '
        f'L{ex:g},{ey:g} L{bx + sx:g},{by + sy:g}"/>'
    )


def _labels(sketch: SectionSketch, scale: float, below: float) -> Iterator[str]:
    """Materials beside the picture, joined to what they name."""
    x = MARGIN + PICTURE
    edge = _x(sketch.outline[-1][0], scale)
    wanted = [(SURFACE - 58, f"indenter: {sketch.indenter.substrate}", edge)]
    wanted += [
        (SURFACE - 58 + LINE * n, f"its layer {layer.material}", edge)
        for n, layer in enumerate(sketch.indenter.layers, 1)
    ]
    friction = len(wanted)
    wanted.append((SURFACE, sketch.friction, _x(sketch.contact_radius, scale)))
    top = SURFACE
    for number, (band, layer) in enumerate(
        zip(_bands(sketch.body, scale), sketch.body.layers, strict=True), 1
    ):
        many = f"layer {number}" if len(sketch.body.layers) > 1 else "layer"
        wanted.append((min(top + band / 2, SURFACE + below), f"{many}, {layer.material}", x))
        top += band
    wanted.append((min((top + SURFACE + below) / 2, SURFACE + below), sketch.body.substrate, x))
    last = -LINE
    for number, (y, text, start) in enumerate(wanted):
        place = max(y + 4 - RAISED * (number == friction), last + LINE)
        last = place
        yield _line(start - 6, y, x + 8, place - 4, "leader")
        yield _text(x + 12, place, text, "start")


def _text(x: float, y: float, text: str, anchor: str) -> str:
    return f'<text x="{x:.2f}" y="{y:.2f}" {FONT} text-anchor="{anchor}">{escape(text)}</text>'
