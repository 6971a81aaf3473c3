"""A workbook: a sheet per table, numbers as numbers whatever the language of the spreadsheet.

The tables are CSV with points and commas, which a spreadsheet set to a language with decimal commas
takes for words or dates.
"""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np

from contact_results.directory.atomic_file import atomic_file
from contact_results.directory.refusal import Refused
from contact_results.export.sheets import Stored, tables_of, title_of
from contact_results.files.csv_file import Column
from contact_results.files.stored_table import StoredTable

MOST_ROWS = 1_048_576  # of a sheet
# Nothing in a file is a formula or a link, and equal results give equal bytes.
AS_IT_IS = {
    "strings_to_numbers": False,
    "strings_to_formulas": False,
    "strings_to_urls": False,
}
NO_TIME = {"created": datetime(1980, 1, 1)}


def write_excel(stored: Stored, path: Path) -> None:
    """Write the sheet `columns`, with the meaning of each, and one per table; what is not there is
    an empty cell. Raises Refused for a table of too many rows, or where XlsxWriter is missing."""
    try:
        from xlsxwriter import Workbook
        from xlsxwriter.exceptions import FileCreateError
    except ImportError:
        raise Refused(
            "a workbook is written by XlsxWriter, which is not installed: pip install "
            "'slipstick[excel]'. The tables (CSV) open in Excel too: Data, From Text/CSV"
        ) from None
    tables = tables_of(stored)
    for name, table in tables.items():
        rows = max((len(values.array) for values in table.values()), default=0)
        if rows >= MOST_ROWS:
            raise Refused(f"{name} has {rows} rows, and a sheet holds {MOST_ROWS}; read its CSV")
    with atomic_file(path) as temporary:
        book = Workbook(str(temporary), AS_IT_IS)
        book.set_properties(NO_TIME)
        bold = book.add_format({"bold": True})
        _explain(book.add_worksheet("columns"), stored, tables, bold)
        for name, table in tables.items():
            _fill(book.add_worksheet(name), table, bold)
        try:
            book.close()
        except FileCreateError as error:  # an OSError, wrapped
            raise error.args[0] from None


def _explain(sheet: Any, stored: Stored, tables: Any, bold: Any) -> None:
    sheet.write_string(0, 0, title_of(stored), bold)
    sheet.write_string(1, 0, stored.convention)
    sheet.write_row(3, 0, ("sheet", "column", "unit", "meaning"), bold)
    rows = (
        (table, name, _unit(values), values.meaning)
        for table, columns in tables.items()
        for name, values in columns.items()
    )
    for number, row in enumerate(rows, 4):
        for column, text in enumerate(row):
            sheet.write_string(number, column, text)
    sheet.set_column(0, 2, 20)


def _fill(sheet: Any, table: StoredTable, bold: Any) -> None:
    sheet.freeze_panes(1, 0)
    for column, (name, values) in enumerate(table.items()):
        unit = _unit(values)
        sheet.write_string(0, column, Column(name, unit or None, "").header, bold)
        sheet.set_column(column, column, max(12, len(name) + len(unit) + 4))
        words = values.array.dtype.kind == "U"
        for row, value in enumerate(values.array.tolist(), 1):
            if words:
                sheet.write_string(row, column, value)
            elif np.isfinite(value):
                sheet.write_number(row, column, value)


def _unit(values: Any) -> str:
    """Empty for words and for whole numbers, which name rows or count."""
    return (values.unit or "1") if values.array.dtype.kind == "f" else ""
