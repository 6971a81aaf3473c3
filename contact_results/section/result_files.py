"""All files of a result on a section, in one call."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from contact_results.section.field_file import write_section_fields
from contact_results.section.increment_table import write_section_increments
from contact_results.section.profile_table import write_section_profiles
from contact_results.section.summary_file import write_section_summary

if TYPE_CHECKING:
    from fem_reference import Method, Result


def write_section_result(
    result: Result, method: Method, directory: Path, *, with_figures: bool = True
) -> None:
    """Write summary, fields, tables and figures into a directory that has none of them."""
    write_section_summary(result, method, directory)
    write_section_profiles(result, directory)
    write_section_increments(result, directory)
    write_section_fields(result, method, directory)
    if with_figures:
        from contact_results.section.figure_files import write_section_figures

        write_section_figures(result, directory)
