"""Drawings of the fields of one contact for the first page of a report; cases store no fields.

The contact is a rigid ball on a body with a coating of twice its stiffness, pressed with friction
and pushed tangentially. Pressure and stick zone are asymmetric, and the coating bends.
"""

from __future__ import annotations

import io

import matplotlib
from matplotlib.collections import Collection
from matplotlib.figure import Figure

from contact_results.figures import style
from contact_results.figures.maps import field_map, stick_slip_map
from contact_results.figures.stress_plot import section_plot
from contact_results.stress.loaded_bodies import state_of_result
from contact_results.stress.on_cells import stress_on_cells
from contact_results.surface import Cells, surface_of
from contact_scene import CoulombFriction, LoadStep, Scene
from semi_analytical import Result, solve
from verification.exhibits.chart import Picture
from verification.problems.paper_scene import (
    HERTZ,
    NORMAL_FORCE,
    coated,
    film,
    pressing,
    rigid_ball,
    square_grid,
)

FRICTION, PUSH = 0.3, 0.7  # of µW
MODULUS_RATIO, THICKNESS = 2.0, 0.5  # of Hertz's radius
PRESSED_IN, PUSHED_IN = 8, 6  # increments
CELLS, REACH = 64, 1.15  # of Hertz's radius
TOLERANCE = 1e-6
DOTS_PER_INCH = 80  # resolution of the fields; axes and text are vector graphics
NO_METADATA = {"Date": None, "Creator": None, "Format": None, "Type": None}


def showcase() -> tuple[Picture, ...]:
    """Solve one coated contact and draw its fields for the first page of a verification report.

    The pictures show pressure, shear, stick and slip zones, and the stress below the surface. Equal
    versions of the libraries give equal bytes.
    """
    result = solve(_coated_scene(), square_grid(CELLS, REACH * HERTZ.contact_radius), TOLERANCE)
    cells = surface_of(result)
    assert isinstance(cells, Cells)
    with style.figure_style():
        matplotlib.rcParams["svg.fonttype"] = "none"
        stress = stress_on_cells(state_of_result(result, None))
        section = section_plot(stress, result.scene.body, "")
        return (
            _picture_of_figure(
                "pressure", "Pressure", _field_figure(result, "pressure"),
                f"A rigid ball pressed, µ = {FRICTION:g}, on a coating {MODULUS_RATIO:g} "
                f"times as stiff as the body below and {THICKNESS:g} of Hertz's radius thick "
                f"(step 1), then pushed by {PUSH:g} µW (step 2), on {CELLS} x {CELLS} cells.",
            ),
            _picture_of_figure(
                "shear", "Shear and the border of stick", _field_figure(result, "shear"),
                "The same contact: magnitude and direction of the shear; within the white line "
                "the surfaces stick.",
            ),
            _picture_of_figure(
                "zones", "Stick and slip", stick_slip_map(result, cells),
                "The same contact: pressed, its middle sticks and the ring around slips; pushed, "
                "less sticks, and off the centre.",
            ),
            _picture_of_figure(
                "section", "Stress below it", section,
                "The same contact pushed, in the section y = 0: the dashed line is the interface; "
                "behind the contact the coating is pulled, and it bends over the softer body.",
            ),
        )  # fmt: skip


def _field_figure(result: Result, field: str) -> Figure:
    cells = surface_of(result)
    assert isinstance(cells, Cells)
    figure = field_map(result, cells, field)
    assert figure is not None
    return figure


def _coated_scene() -> Scene:
    pushed = (PUSH * FRICTION * NORMAL_FORCE, 0.0)
    return Scene(
        title="A coated contact, pressed and pushed",
        indenter=rigid_ball(),
        body=coated(film(MODULUS_RATIO, THICKNESS)),
        friction=CoulombFriction(coefficient=FRICTION),
        loading=(
            pressing(PRESSED_IN),
            LoadStep(tangential_force=pushed, increments=PUSHED_IN),
        ),
    )


def _picture_of_figure(name: str, title: str, figure: Figure, caption: str) -> Picture:
    """Convert a Matplotlib figure to an SVG drawing with a title and a caption.

    Fields are embedded as raster images, which limits the size of the file.

    name     name of the picture
    title    title in the report
    figure   figure to convert
    caption  caption in the report
    """
    matplotlib.rcParams["svg.hashsalt"] = name
    for fields in figure.findobj(Collection):
        fields.set_rasterized(True)
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", dpi=DOTS_PER_INCH, metadata=NO_METADATA)
    svg = buffer.getvalue()
    return Picture(name=name, title=title, caption=caption, svg=svg[svg.index("<svg") :])
