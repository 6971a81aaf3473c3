"""Reader of tables of numbers in text files: maps of a scene, measured values, and points.

Instruments and spreadsheets write the same numbers in many ways. All uses share one reader, so that
a file with the numbers of one use is read, or refused, in the same way as a file of another.
"""

import codecs
import csv
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from contact_scene.reading.scene_error import refusal, shown
from contact_scene.reading.units import Kind

# Accepted heads of the columns of each quantity, in lower case and without units, with its kind.
# The unit decides between quantities with the same head.
ColumnNames = Mapping[str, tuple[Kind, frozenset[str]]]

TABLE_SUFFIXES = (".csv", ".txt")
_MAX_BYTES = 1 << 28
# Fields for missing values, in lower case. Spreadsheets write the last ones.
_MISSING = {
    *("", "nan", "bad", "na", "n/a", "null", "***", "---"),
    *("#n/a", "#num!", "#div/0!", "#value!", "#ref!"),
}
_COMMENT = re.compile(r'[\s"]*[#%]')
# Value that a spreadsheet could not compute, such as #NAME?, as the first field of a row.
_FAILED_VALUE = re.compile(r'[\s"]*#[^\W\d]')
_HEAD = re.compile(r"(?P<name>[^\[(]*)(?:[\[(](?P<unit>[^\])]*)[\])])?\s*")
_CHOICE = re.compile(r"(?P<name>[^=]+)=\s*(?P<column>\d+)\s*(?P<unit>\S.*)?")
# In a table with spaces between fields, a space may precede the unit of a head.
_SPACED_HEADS = re.compile(r"[^\s\[(]+(?:\s*[\[(][^\])]*[\])])?")


@dataclass(frozen=True, eq=False)
class TextTable:
    """Rows of a table in a text file.

    separator  character between fields; None for spaces
    headings   lines above the first row, without comment signs
    rows       fields of each row: numbers, NaN for missing values, None for words
    lines      position and text of each row in the file; positions count from 1
    """

    separator: str | None
    headings: list[str]
    rows: list[list[float | None]]
    lines: list[tuple[int, str]]

    @property
    def ends_with_separator(self) -> bool:
        """True if every row ends with a separator, so that its last field is empty."""
        mark = self.separator
        return mark is not None and all(line.rstrip(" ").endswith(mark) for _, line in self.lines)


def read_text_table(path: Path, name: str) -> TextTable:
    """Read the rows of a table from a text file.

    The text is UTF-8, UTF-16 with a byte-order mark, or Latin-1. Fields are separated by
    semicolons, tabs, commas or spaces, with or without quotes. Decimals follow a point, or a comma
    if commas do not separate fields. Lines that begin with "#" or "%" are comments. The first row
    is the first line with numbers alone, or with a number and as many fields as the last line.
    Lines above the first row are headings.

    path  path of the file
    name  name of the file, for messages

    Raises a validation error for a file that is not text or has no row, and for decimal commas
    together with decimal points. A comment that may be a row is refused, too: a comment below the
    first row with as many fields, and a value that a spreadsheet could not compute before numbers.
    """
    lines = _read_lines(path, name)
    likely = [line for line in lines if line.strip() and not _COMMENT.match(line)]
    likely = likely or [line for line in lines if line.strip()] or [""]
    # The last line may be cut off, or be the only row below the heads.
    last = max(likely[:-3:-1], key=lambda line: sum(map(line.count, ";\t,")))
    separator = _separator_of(last)
    width = len(_split(last, separator))
    table = TextTable(separator, [], [], [])
    decimal_signs = set[str]()
    for position, line in enumerate(lines, 1):
        # A line of tabs alone is a row of missing values if it has as many fields.
        if not line.strip() and not (separator == "\t" and line.count("\t") + 1 == width):
            continue
        fields = _split(line, separator)
        row = [_read_number(field, separator) for field in fields]
        is_wide = len(row) == width
        has_number = any(number is not None and number == number for number in row)
        if _COMMENT.match(line) and not (is_wide and None not in row):
            failed = _FAILED_VALUE.match(line) and has_number and None not in row[1:]
            if is_wide and (table.rows or failed):
                raise refusal(
                    f"line {position} of {shown(name)} is a comment with as many fields as a row: "
                    f"{shown(line)}",
                    "comments above the first row",
                    'write "nan" for a missing value, or remove the line',
                )
            if not table.rows:
                table.headings.append(line.lstrip(' \t"#%'))
        # Missing values alone are a row only if as wide as one: dashes may underline headings.
        elif (
            table.rows or (has_number and is_wide) or (None not in row and (has_number or is_wide))
        ):
            table.rows.append(row)
            table.lines.append((position, line))
            if any(sign in line for sign in {",", "."} - decimal_signs):
                numbers = "".join(
                    field for field, number in zip(fields, row, strict=True) if number is not None
                )
                decimal_signs |= {",", "."} & set(numbers)
        else:
            table.headings.append(line)
    if not table.rows:
        raise refusal(f"{shown(name)} has no numbers", "equally many numbers in every line")
    if len(decimal_signs) > 1:
        raise refusal(
            f"{shown(name)} has numbers with a comma and numbers with a point",
            "one decimal sign and no sign between thousands",
        )
    return table


def _separator_of(line: str) -> str | None:
    """Return the mark that separates the fields of a row, None for spaces."""
    unquoted = re.sub('"[^"]*"', "", line)
    separator = next((mark for mark in ";\t," if mark in unquoted), None)
    spaced = unquoted.split()
    if separator == "," and len(spaced) > 1 and all(map(_has_decimal_comma, spaced)):
        return None
    return separator


def read_columns(
    path: Path, names: ColumnNames, chosen: str | None = None
) -> Mapping[str, NDArray[np.float64]]:
    """Read the columns with known heads, or chosen columns, from a text table, in SI units.

    The lowest line with a known head above the first row has the heads. A head is a name with a
    unit, such as `force [N]`. Other columns are ignored, as are columns with a known head and
    blank fields alone, and empty rows at the end.

    path    path of the file
    names   accepted heads of each quantity
    chosen  columns by their numbers, such as "shift=2 um, T=3 N", for a table without known heads;
            a column without a unit has that of its head

    Returns the values of each column (n,) by the name of its quantity.

    Raises a validation error for a table without a known head, without the unit of a column, with
    two columns of a quantity, or with rows of unequal length, and for a value of a known column
    that is not a finite number.
    """
    name = path.name
    table = read_text_table(path, name)
    for line in reversed(table.headings):
        heads = _split_heads(line, table.separator)
        columns = _known_columns(heads, names, name) if chosen is None else {}
        if columns or chosen is not None:
            break
    else:
        heads, columns = [""] * len(table.rows[0]), {}
    if chosen is not None:
        columns = _chosen_columns(chosen, heads, names)
    elif not columns:
        known = ", ".join(sorted({head for _, heads in names.values() for head in heads}))
        raise refusal(
            f"{shown(name)} has no known head above the row {shown(table.lines[0][1])}",
            f'a line of heads with units, such as "{known.partition(",")[0]} [unit]"',
            f"the known heads are {known}",
        )
    rows = list(zip(table.rows, table.lines, strict=True))
    while len(rows) > 1 and not rows[-1][1][1].strip(' \t",;'):
        rows.pop()
    if chosen is None:
        filled = {q: at for q, at in columns.items() if not _is_blank(at[0], table)}
        columns = filled or columns
    width = len(heads) + int(len(table.rows[0]) > len(heads) and table.ends_with_separator)
    for row, (position, line) in rows:
        place = f"line {position} of {shown(name)}"
        if len(row) != width:
            raise refusal(
                f"fields in {place}, {shown(line)}: got {len(row)}",
                f"{width} as in the line of heads",
            )
        for column, _ in columns.values():
            number = row[column]
            if number is None or not np.isfinite(number):
                raise refusal(
                    f"{place} has no finite number in the column {shown(heads[column])}: "
                    f"{shown(line)}",
                    "a number in every row",
                    "" if number is None else "remove rows with missing values",
                )
    return {
        quantity: factor * np.array([row[column] for row, _ in rows], dtype=np.float64)
        for quantity, (column, factor) in columns.items()
    }


def _is_blank(column: int, table: TextTable) -> bool:
    """Return true if the fields of a column are blank in every row, not "nan" or a failed value."""
    rows = (_split(line, table.separator) for _, line in table.lines)
    return all(len(row) > column and not row[column].strip(' \t"') for row in rows)


def _known_columns(heads: list[str], names: ColumnNames, file: str) -> dict[str, tuple[int, float]]:
    """Return index and factor to SI of the column of each quantity.

    Raises a validation error for a known head without a known unit, and for two heads of a
    quantity.
    """
    found = dict[str, tuple[int, float]]()
    for column, head in enumerate(heads):
        match = _HEAD.fullmatch(head)
        name = match["name"].strip().lower() if match else ""
        if match is None or not any(name in accepted for _, accepted in names.values()):
            continue
        unit, got = (match["unit"] or "").strip(), f"{shown(file)}: got the column {shown(head)}"
        quantity, factor = _quantity_of(name, unit, names, got, f"{name} [{{}}]")
        if quantity in found:
            raise refusal(
                f"{shown(file)}: got the columns {shown(heads[found[quantity][0]])} and "
                f"{shown(head)}",
                f"one column of {quantity}",
            )
        found[quantity] = column, factor
    return found


def _quantity_of(
    name: str, unit: str, names: ColumnNames, got: str, example: str
) -> tuple[str, float]:
    """Return the quantity of a column with a known name, and the factor of its unit to SI.

    Raises a validation error for a unit of no quantity with this name.

    got, example  received column, and an expected one with {} in place of the unit, for the message
    """
    kinds = {quantity: kind for quantity, (kind, accepted) in names.items() if name in accepted}
    for quantity, kind in kinds.items():
        if unit in kind.units:
            return quantity, float(kind.units[unit])
    units = [unit for kind in kinds.values() for unit in kind.units if unit.isascii()]
    first = next(iter(kinds.values()))
    raise refusal(
        got,
        f"the unit of its numbers, such as {shown(example.format(first.si))}",
        f"the units are {', '.join(units)}",
    )


def _chosen_columns(
    chosen: str, heads: list[str], names: ColumnNames
) -> dict[str, tuple[int, float]]:
    """Return index and factor to SI of the column that is chosen for each quantity.

    Raises a validation error for an unknown name, a missing column and a missing unit.

    chosen  names and numbers of columns, see `read_columns`
    heads   heads of the columns, empty where the table has none
    """
    found = dict[str, tuple[int, float]]()
    known = ", ".join(sorted({head for _, accepted in names.values() for head in accepted}))
    for item in chosen.split(","):
        match = _CHOICE.fullmatch(item)
        name = match["name"].strip().lower() if match else ""
        of_name = {quantity for quantity, (_, accepted) in names.items() if name in accepted}
        if match is None or not of_name or of_name & found.keys():
            raise refusal(
                f"got the choice {shown(item.strip())}",
                'different names with the number of a column, such as "shift=2 um, T=3 N"',
                f"the known names are {known}",
            )
        column = int(match["column"]) - 1
        if not 0 <= column < len(heads):
            raise refusal(
                f"got column {column + 1}", f"1 to {len(heads)}, the columns of the table"
            )
        head = _HEAD.fullmatch(heads[column])
        unit = (match["unit"] or (head and head["unit"]) or "").strip()
        got = f"got {shown(item.strip())} and the head {shown(heads[column])}"
        quantity, factor = _quantity_of(name, unit, names, got, f"{name}={column + 1} {{}}")
        found[quantity] = column, factor
    return found


def _split_heads(line: str, separator: str | None) -> list[str]:
    """Split a line into heads, without empty ones at the end."""
    heads = _SPACED_HEADS.findall(line) if separator is None else _split(line, separator)
    heads = [head.strip(' \t"') for head in heads]
    while heads and not heads[-1]:
        heads.pop()
    return heads


def _split(line: str, separator: str | None) -> list[str]:
    """Split a line into fields; a quoted field may have the separator in it."""
    if separator is None or '"' not in line:
        return line.split(separator)
    try:
        return next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
    except csv.Error:  # a field of more than 131072 characters
        return line.split(separator)


def _read_number(field: str, separator: str | None) -> float | None:
    """Return the number in a field of a text file, NaN for a missing value, or None for a word."""
    text = field.strip(' \t"').lower()
    if text in _MISSING:
        return np.nan
    if "_" in text:  # which float ignores
        return None
    if "," in text and separator != ",":
        text = text.replace(",", ".")
    try:
        return float(text)
    except ValueError:
        pass
    # Fortran writes 1.0D-3; typesetters a minus sign that is no hyphen.
    text = text.replace("d", "e").replace("\N{MINUS SIGN}", "-")
    try:
        return float(text)
    except ValueError:
        return None


def _has_decimal_comma(field: str) -> bool:
    """Return True for a number in which a comma is no separator, at an end of the field."""
    return field.strip(",") == field and _read_number(field, None) is not None


def _read_lines(path: Path, name: str) -> list[str]:
    """Return the lines of a text file.

    Raises a validation error for a file that is too long or not text.
    """
    if path.exists() and not path.is_file():
        raise refusal(f"{shown(name)} is no file", "a text file")
    if path.stat().st_size > _MAX_BYTES:
        raise refusal(f"the file {shown(name)} is too long", f"at most {_MAX_BYTES >> 20} MiB")
    data = path.read_bytes()
    is_utf16 = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    text = "\0"
    for encoding in ("utf-16",) if is_utf16 else ("utf-8-sig", "latin-1"):
        try:
            text = data.decode(encoding)
            break
        except UnicodeDecodeError:
            pass
    if "\0" in text:
        raise refusal(
            f"{shown(name)} is no text, or has an unknown encoding",
            "text in UTF-8, in UTF-16 with a byte-order mark, or in Latin-1",
            'save it as "CSV UTF-8"',
        )
    return text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
