"""Lines of keys: right for every valid document, harmless for every other."""

import json
import tomllib
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from contact_scene.reading.key_lines import (
    DEEPEST,
    NestedTooDeep,
    locate,
)
from contact_scene.reading.scene_error import Path

EXAMPLE = '''\
# a comment with a = 1
title = "x"   # [no.table]

[indenter]
shape = "sphere"
material = { young_modulus = "1 Pa", inner = { a = [1,
  2], "b.c" = 2 } }
"quoted \\u00e9\\"key" = 1
'literal.key' = 2
a . "b" . c = """
[fake]
fake = 1
\\""" still inside """
[body]
text = \'\'\'
[[fake]]
fake = 2\'\'\'
after = 1979-05-27 07:32:00
[[loading]]
normal_force = 1
[[loading]]
window = [
  "1 mm", # first
  [ 2, { x = 1 } ],
]
[[loading.inner]]
k = 1
[[loading.inner]]
k = 2
[deep.er]
z = 1
[deep]
y = 2
'''

LINES: dict[Path, int] = {
    ("title",): 2,
    ("indenter",): 4,
    ("indenter", "shape"): 5,
    ("indenter", "material", "young_modulus"): 6,
    ("indenter", "material", "inner", "a", 0): 6,
    ("indenter", "material", "inner", "a", 1): 7,
    ("indenter", "material", "inner", "b.c"): 7,
    ("indenter", 'quoted é"key'): 8,
    ("indenter", "literal.key"): 9,
    ("indenter", "a", "b", "c"): 10,
    ("body", "text"): 15,
    ("body", "after"): 18,
    ("loading",): 19,
    ("loading", 0): 19,
    ("loading", 0, "normal_force"): 20,
    ("loading", 1): 21,
    ("loading", 1, "window", 0): 23,
    ("loading", 1, "window", 1, 1, "x"): 24,
    ("loading", 1, "inner", 0, "k"): 27,
    ("loading", 1, "inner", 1): 28,
    ("deep", "er"): 30,
    ("deep",): 32,
    ("deep", "y"): 33,
}


@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_every_form_of_key_is_found(newline: str) -> None:
    document = EXAMPLE.replace("\n", newline)
    located = locate(document)
    assert {path: located.get(path) for path in LINES} == LINES
    assert set(located) == paths_in(tomllib.loads(document))


def paths_in(value: Any, path: Path = ()) -> set[Path]:
    """Every key and array entry of a parsed document."""
    entries: Any = ()
    if isinstance(value, dict):
        entries = value.items()
    elif isinstance(value, list):
        entries = enumerate(value)
    found = {path} if path else set()
    return found.union(*(paths_in(entry, (*path, key)) for key, entry in entries))


KEYS = st.text(st.sampled_from("ab.é\"'# =[]\\"), min_size=1, max_size=4)
SCALARS = st.sampled_from(
    [
        *("1", "-2.5e3", "true", "inf", "0xf", "1979-05-27", "07:32:00", '""', "''"),
        *('"a # ] } , = \\" b"', "'c:\\'", '""""a"""'),
        *('"""\n[x]\ny = 1 \\"""\n"""', "'''\n#\nz = [\n'''"),
    ]
)
COMMENTS = st.sampled_from(["", " # x = [1", "  # [y]", "\t"])


def quoted(key: str) -> str:
    return json.dumps(key)


@st.composite
def inline_values(draw: st.DrawFn, depth: int = 2) -> str:
    kind = draw(st.sampled_from(["scalar", "array", "table"] if depth else ["scalar"]))
    if kind == "scalar":
        return draw(SCALARS)
    items = draw(st.lists(inline_values(depth=depth - 1), max_size=3))
    if kind == "array":
        gap = draw(st.sampled_from(["", " ", "\n", " # ], [\n "]))
        return "[" + gap + "".join(f"{item}{gap},{gap}" for item in items) + "]"
    return "{ " + ", ".join(f"{quoted(f'k{i}')} = {item}" for i, item in enumerate(items)) + " }"


@st.composite
def tables(draw: st.DrawFn, header: str) -> list[str]:
    """Text lines of one table: its header and pairs, with comments and blank lines between."""
    lines = [header + draw(COMMENTS)]
    for key in draw(st.lists(KEYS, unique=True, max_size=4)):
        dotted = ' . "in".x' if draw(st.booleans()) else ""
        pair = f"{quoted(key)}{dotted} = {draw(inline_values())}{draw(COMMENTS)}"
        lines += [*draw(st.lists(COMMENTS, max_size=2)), pair]
    return lines


@st.composite
def toml_texts(draw: st.DrawFn) -> str:
    lines = draw(tables("# top"))
    for number in range(draw(st.integers(0, 3))):
        kind = draw(st.sampled_from(["[t{0}]", "[[l]]", "[t{0}.'s.t']", "[[m.n]]"]))
        lines += draw(tables(kind.format(number)))
        if kind == "[[l]]" and draw(st.booleans()):
            lines += draw(tables("[[ l . inner ]]"))
    return "\n".join(lines) + "\n"


@given(toml_texts())
def test_the_keys_found_are_those_of_the_document(text: str) -> None:
    assert set(locate(text)) == paths_in(tomllib.loads(text))


@given(st.text(st.sampled_from("ab.\"'#=[]{},\n \\u0")) | st.text())
def test_no_text_whatsoever_upsets_the_scanner(text: str) -> None:
    assert all(1 <= line <= text.count("\n") + 1 for line in locate(text).values())


@pytest.mark.parametrize(
    "text",
    ["a = " + "[" * 5000, "a = " + "{a=" * 5000, "a." * 5000 + "a = 1", "[" + "a." * 5000 + "a]"],
    ids=["arrays", "tables", "keys", "headers"],
)
def test_nesting_beyond_all_use_is_refused_with_its_line(text: str) -> None:
    with pytest.raises(NestedTooDeep, match="line 3"):
        locate("\n\n" + text)
    at_most = "a = " + "[" * (DEEPEST - 1) + "]" * (DEEPEST - 1)
    assert locate(at_most)[("a",)] == 1
