"""Writer of the image files of a result: overview, profiles, maps."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from contact_results.cycles import FrettingCycle
from contact_results.directory.file_names import OVERVIEW_FIGURE
from contact_results.figures.map_panels import Above, RingsAbove
from contact_results.figures.maps import FIELDS, field_map, fretting_map, stick_slip_map
from contact_results.figures.overview import DOTS_PER_INCH as OF_OVERVIEW
from contact_results.figures.overview import overview
from contact_results.figures.profile_plot import profile_plot
from contact_results.figures.style import DOTS_PER_INCH, figure_style, save
from contact_results.surface import Cells, Rings, surface_of
from contact_scene.quantities.stated_error import StatedError

if TYPE_CHECKING:
    from contact_results.surface import Result


def write_figures(
    result: Result,
    cycles: Sequence[FrettingCycle],
    directory: Path,
    errors: Mapping[str, StatedError] | None = None,
    *,
    everything: bool = False,
) -> None:
    """Write the overview, or all figures of a result and of its last load cycle.

    Equal results give equal bytes with equal libraries.

    cycles      closed load cycles of the result
    directory   output directory
    errors      stated errors of the last load step, for the numbers of the overview; None if they
                were not computed
    everything  write all figures, not only the overview
    """
    with figure_style():
        for name, figure in _draw_figures(result, cycles, errors):
            dots = DOTS_PER_INCH if name != OVERVIEW_FIGURE else OF_OVERVIEW
            save(figure, directory / name, dots)
            if not everything:
                break
            # Reference cycles between the artists keep a figure in memory until it is cleared.
            figure.clear()


def _draw_figures(
    result: Result, cycles: Sequence[FrettingCycle], errors: Mapping[str, StatedError] | None
) -> Iterator[tuple[str, Figure]]:
    """Yield file name and figure of each figure of a result, with the overview first.

    Figures of fields that are zero or missing are omitted. A line contact has no maps.

    cycles  closed load cycles of the result
    errors  stated errors of the last load step, for the numbers of the overview
    """
    surface = surface_of(result)
    above = seen_from_above(result)
    yield OVERVIEW_FIGURE, overview(result, above, errors)
    yield "profiles.png", profile_plot(result, surface)
    if isinstance(surface, Cells) and surface.of_strips:
        return
    for field in FIELDS:
        if (figure := field_map(result, above, field)) is not None:
            yield f"{field}.png", figure
    if result.steps[-1].in_stick is not None:
        yield "stick_slip.png", stick_slip_map(result, above)
    if cycles and isinstance(surface, Cells):
        yield "fretting.png", fretting_map(result, surface, cycles[-1])


def seen_from_above(result: Result) -> Above:
    """Return the surface grid for the maps of a result: its cells, or a sampling of its rings."""
    surface = surface_of(result)
    if isinstance(surface, Cells):
        return surface
    assert isinstance(surface, Rings)
    return RingsAbove.around_contact(result, surface)
