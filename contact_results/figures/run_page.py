"""HTML pages of a run and of a stress, self-contained, without scripts and external files."""

from __future__ import annotations

import re
import struct
from base64 import b64encode
from collections.abc import Iterable, Iterator, Mapping, Sequence
from html import escape
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

from contact_results.directory import file_names
from contact_results.figures.overview import DOTS_PER_INCH, PLACE, TITLE
from contact_results.key_numbers import doubts_of, key_numbers
from contact_results.result_report import ResultReport
from contact_results.solvers import NAMES_IN_RESULTS, solver_of

if TYPE_CHECKING:
    from contact_results.surface import Result

STYLE = (
    "body{font:16px/1.5 sans-serif;max-width:84rem;margin:0 auto;padding:1rem;color:#1a1a1a;"
    "background:#fff}h1{font-size:1.5rem}h2{font-size:1.15rem;margin:1rem 0 .3rem}"
    "img{max-width:100%;height:auto}td,th{text-align:left;vertical-align:top;"
    "padding:.15rem 1rem .15rem 0}td{font-variant-numeric:tabular-nums}"
    ".wide{overflow-x:auto}.wide td+td,.wide th+td{white-space:nowrap}"
    "pre{overflow-x:auto;background:#f2f2f2;padding:.5rem}.soft{color:#595959;max-width:46rem}"
    "@media(prefers-color-scheme:dark){body{color:#e8e8e8;background:#16181b}pre{background:#24272c}"
    ".soft{color:#a9adb2}a{color:#7cc4ee}img{background:#fff;padding:.5rem;box-sizing:border-box}}"
    # A figure narrower than this is not readable: on a phone it scrolls.
    "section{overflow-x:auto}section>img{min-width:46rem;max-width:62rem;width:100%}"
    ".panels{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,22rem),1fr))}"
    ".panels>*{background-image:var(--overview);print-color-adjust:exact;background-color:#fff}"
)
PNG_WIDTH = slice(16, 20)  # bytes of the width in an image file
HEADINGS = {
    "stick_slip": "Stick and slip",
}
READ_ON = (
    "The number after ± is the stated error. A question mark means that it has not converged. "
    "summary.json lists the parts of each error (cells or elements, increments, tolerance) under "
    "<code>errors</code>. Further files: increments.csv (scalars of every increment), profiles.csv "
    "(along y = 0), result.h5 (fields), columns.csv (units and meanings). z points into the lower "
    "body; tractions act on the lower body."
)
OF_STRESS = (
    "The number after ± is the stated error. A question mark means that it has not converged. "
    "stress.json lists the parts of each error. stress_axis.csv, stress_interfaces.csv and the VTU "
    "files contain the fields. z points into the body; tension is positive."
)
LOOPS = (
    "E_d: energy per cycle; Q*, δ, δ*: half ranges of force, of the shift of the contact and of a "
    "rig's actuator; δ_g: half the opening of the loop at the middle force; A = E_d/4Q*δ*; µ_e = "
    "E_d/4Wδ_g; to gross slip: 5 E_d/4Q*δ, 1 where Mindlin's loop begins to slip all over; F1, F2: "
    "Ruiz's parameters. The first cycle starts from the virgin state."
)
POLICY = (
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; base-uri 'none'; "
    "form-action 'none'"
)


def write_page(
    report: ResultReport,
    directory: Path,
    cycles: Mapping[str, Sequence[str]] | None = None,
    warnings: Sequence[str] = (),
) -> None:
    """Write the HTML page of a run, with the figures that are in its directory.

    Equal results give equal bytes.

    directory  directory of the run
    cycles     columns of `cycle_columns`; None or empty without load cycles
    warnings   warnings about the result
    """
    scene, end, errors = report.scene, report.steps[-1], report.end_errors
    inputs = _table_html(report.by_inputs) if report.by_inputs else ()
    parts = [
        f"<h2>At the end of step {end.step}</h2><table>",
        _row_html("status", end.status.value),
        *(_row_html(name, text) for name, text in key_numbers(report.steps, errors)),
        "</table>" + ("" if errors is not None else "<p>Errors were left out.</p>"),
        *(_cycle_section(cycles) if cycles else ()),
        *_doubts_html(doubts_of(report)),
        *(("<h2>Uncertainty by inputs</h2>", *inputs) if inputs else ()),
        f'<p class="soft">{READ_ON}</p>',
        *(f"<p><strong>Warning:</strong> {escape(text)}.</p>" for text in warnings),
        *_figures_html(directory / name for name in file_names.FIGURES),
        "<h2>Settings</h2><table>",
        *(_row_html(name, text) for name, text in _setting_rows(report.result)),
        "</table><details><summary>The scene</summary><pre>",
        escape(scene.model_dump_json(indent=2, exclude_none=True)),
        "</pre></details>",
    ]
    _write_html(directory / file_names.PAGE, scene.title or "Contact", parts)


def write_stress_page(
    columns: Mapping[str, Sequence[str]],
    title: str,
    figures: Sequence[str],
    directory: Path,
    doubts: Sequence[str] = (),
) -> None:
    """Write the HTML page of a stress, with the figures that are in its directory.

    columns    table of the largest stresses, as columns by heading
    title      title of the page
    figures    file names of the figures
    directory  output directory
    doubts     texts of `stress_doubts`: reasons of the question marks
    """
    parts = [
        *("<h2>Largest stresses</h2>", *_table_html(columns), *_doubts_html(doubts)),
        f'<p class="soft">{OF_STRESS}</p>',
        *_figures_html(directory / name for name in figures),
    ]
    _write_html(directory / file_names.STRESS_PAGE, title, parts)


def _write_html(path: Path, title: str, parts: Iterable[str]) -> None:
    title = escape(title)
    page = [
        '<!doctype html><html lang="en"><head><meta charset="utf-8">',
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">',
        '<meta name="viewport" content="width=device-width,initial-scale=1">',
        '<meta name="color-scheme" content="light dark">',
        f"<title>{title}</title><style>{STYLE}</style></head><body><h1>{title}</h1>",
        *parts,
        "</body></html>\n",
    ]
    path.write_text("\n".join(page), encoding="utf-8")


def _setting_rows(result: Result) -> Iterator[tuple[str, str]]:
    """Yield name and text of each setting of a run, such as solver, grid and tolerance."""
    yield "solver", NAMES_IN_RESULTS[result.solver]
    yield from solver_of(result).describe_result(result)
    yield "tolerance of every residual", f"{result.tolerance:.3g}"
    yield "increments", str(len(result.increments))
    for effect in result.plan.effects:
        yield effect.name, f"{'on' if effect.on else 'off'}: {effect.why}"


def _cycle_section(columns: Mapping[str, Sequence[str]]) -> Iterator[str]:
    """Yield the HTML of the section on load cycles, with table and legend.

    The table has one row per number, so that it fits a narrow page.

    columns  table of the load cycles, as columns by heading
    """
    yield '<h2>Load cycles</h2><div class="wide"><table>'
    for heading, texts in columns.items():
        *words, unit = heading.split("\n") if "\n" in heading else (heading, "")
        name = _text_html(" ".join(words) + (f" ({unit})" if unit else ""))
        cells = "".join(f"<td>{_text_html(text)}</td>" for text in texts)
        yield f'<tr><th scope="row">{name}</th>{cells}</tr>'
    yield f'</table></div><p class="soft">{_text_html(LOOPS)}</p>'


def _table_html(columns: Mapping[str, Sequence[str]]) -> Iterator[str]:
    yield '<div class="wide"><table><tr>'
    yield from (f'<th scope="col">{_text_html(heading)}</th>' for heading in columns)
    for texts in zip(*columns.values(), strict=True):
        yield "</tr><tr>" + "".join(f"<td>{_text_html(text)}</td>" for text in texts)
    yield "</tr></table></div>"


def _doubts_html(doubts: Sequence[str]) -> Iterator[str]:
    yield from (f'<p class="soft">{escape(text)}.</p>' for text in doubts)


def _row_html(name: str, text: str) -> str:
    return f'<tr><th scope="row">{_text_html(name)}</th><td>{_text_html(text)}</td></tr>'


def _text_html(text: str) -> str:
    """Return the HTML of a text: subscripts of symbols such as E_d, and spaces in names."""
    symbols = re.sub(r"_(\w)\b", r"<sub>\1</sub>", escape(text))
    return symbols.replace("_", " ").replace("\n", "<br>")


def _figures_html(paths: Iterable[Path]) -> Iterator[str]:
    for path in paths:
        if path.is_file():
            overview = path.name == file_names.OVERVIEW_FIGURE
            yield (_panels_html if overview else _figure_html)(path)


def _panels_html(path: Path) -> str:
    """Return the HTML of the overview, with its panels side by side or, on a phone, in a column.

    The panel of key numbers is left out, because the page has a table of them.
    """
    image = path.read_bytes()
    (width,) = struct.unpack(">I", image[PNG_WIDTH])
    columns = 2 + (width > 2.5 * PLACE[0] * DOTS_PER_INCH)  # without stress, or with it
    rows = 2 + TITLE / PLACE[1]
    size = f"background-size:{100 * columns}% {100 * rows:.2f}%;aspect-ratio:{PLACE[0] / PLACE[1]}"
    panels = []
    for row, column in product(range(2), range(columns)):
        across, down = column / (columns - 1), (rows - 2 + row) / (rows - 1)
        place = f"background-position:{across:.0%} {down:.2%}"
        label = f"panel {columns * row + column + 1} of {path.name}"
        panels.append(f'<div role="img" aria-label="{label}" style="{size};{place}"></div>')
    data = b64encode(image).decode("ascii")
    return (
        '<section><h2>Overview</h2><div class="panels" '
        f'style="--overview:url(data:image/png;base64,{data})">{"".join(panels[:-1])}</div>'
        "</section>"
    )


def _figure_html(path: Path) -> str:
    name = HEADINGS.get(path.stem, path.stem.replace("_", " ").capitalize())
    data = b64encode(path.read_bytes()).decode("ascii")
    return (
        f'<section><h2>{name}</h2><img alt="{name}" src="data:image/png;base64,{data}"></section>'
    )
