"""Tests of the lines of keys in TOML files: right in valid documents, harmless in all others."""

import tomllib

import pytest

from contact_scene.reading.toml_file import (
    MAX_DEPTH,
    NestedTooDeep,
    locate_keys,
)

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
LINES = {
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
def test_every_form_of_key_is_found(newline):
    document = EXAMPLE.replace("\n", newline)
    located = locate_keys(document)
    assert {path: located.get(path) for path in LINES} == LINES
    assert set(located) == paths_in(tomllib.loads(document))


def paths_in(value, path=()):
    """Every key and array entry of a parsed document."""
    entries = ()
    if isinstance(value, dict):
        entries = value.items()
    elif isinstance(value, list):
        entries = enumerate(value)
    found = {path} if path else set()
    return found.union(*(paths_in(entry, (*path, key)) for key, entry in entries))


@pytest.mark.parametrize(
    "text",
    ["a = " + "[" * 5000, "a = " + "{a=" * 5000, "a." * 5000 + "a = 1", "[" + "a." * 5000 + "a]"],
    ids=["arrays", "tables", "keys", "headers"],
)
def test_nesting_beyond_all_use_is_refused_with_its_line(text):
    with pytest.raises(NestedTooDeep, match="line 3"):
        locate_keys("\n\n" + text)
    at_most = "a = " + "[" * (MAX_DEPTH - 1) + "]" * (MAX_DEPTH - 1)
    assert locate_keys(at_most)[("a",)] == 1
