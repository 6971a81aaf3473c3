"""`slipstick export`: a run or a stress in the formats of other programs."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from contact_results.export.sheets import Stored


class Format(StrEnum):
    """Whose format."""

    MATLAB = "matlab"
    EXCEL = "excel"
    VTU = "vtu"


def export(
    source: Annotated[
        Path,
        typer.Argument(
            metavar="RUN_DIR|STRESS_DIR",
            help="Output of 'slipstick run' or of 'slipstick stress'.",
            show_default=False,
        ),
    ],
    output: Annotated[
        Path,
        typer.Option(
            "--output",
            "-o",
            metavar="DIR|FILE",
            help="A directory, made if absent, or of the first two a file by its name: m.mat, "
            "m.xlsx.",
        ),
    ],
    to: Annotated[
        Format,
        typer.Option(
            "--to",
            help="matlab: a MAT-file of everything; excel: a workbook of the tables; vtu: the "
            "surface at the end of every step of a run, for ParaView.",
            show_default=False,
        ),
    ],
) -> None:
    """Write a run or a stress as MAT-file, workbook or ParaView files: the same names, with units.

    A stress is VTU already.
    """
    stored, name = _loaded(source)
    for place in _written(stored, name, output, to):
        typer.echo(f"{place} written")


def _loaded(source: Path) -> tuple[Stored, str]:
    from contact_results.directory.file_names import STRESS, SUMMARY
    from contact_results.directory.refusal import Refused
    from contact_results.files.stored_run import load
    from contact_results.stress.stored_stress import load_stress

    if not (source / SUMMARY).is_file() and not (source / STRESS).is_file():
        raise typer.BadParameter(
            f"{source} is no run and no stress: it has no {SUMMARY} and no {STRESS}"
        )
    try:
        if (source / SUMMARY).is_file():
            return load(source), "run"
        return load_stress(source), "stress"
    except (ValueError, FileNotFoundError) as error:
        raise Refused(str(error)) from None


def _written(stored: Stored, name: str, output: Path, to: Format) -> list[Path]:
    from contact_results.directory.refusal import Refused

    try:
        if to is Format.MATLAB:
            from contact_results.export.matlab import write_matlab

            file = _file(output, name, ".mat")
            write_matlab(stored, file)
            return [file]
        if to is Format.EXCEL:
            from contact_results.export.excel import write_excel

            file = _file(output, name, ".xlsx")
            write_excel(stored, file)
            return [file]
        from contact_results.export.paraview import COLLECTION, write_paraview
        from contact_results.files.stored_run import StoredRun

        if not isinstance(stored, StoredRun):
            raise typer.BadParameter("a stress is VTU already: open its stress_section.vtu")
        write_paraview(stored, output)
        return [output / COLLECTION]
    except (ValueError, KeyError) as error:
        raise Refused(str(error)) from None


def _file(output: Path, name: str, suffix: str) -> Path:
    """The output itself if it is named like such a file and is no directory, else one in it."""
    if output.suffix == suffix and not output.is_dir():
        return output
    return output / f"{name}{suffix}"
