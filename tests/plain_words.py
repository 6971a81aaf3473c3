"""Checker of technical English in docstrings, messages and Markdown, for unclear habits.

A *text* is a docstring, a message (`raise`, `echo(...)`, `help=`) or a paragraph of Markdown.
"""

import ast
import re
from collections.abc import Iterable
from pathlib import Path

WORDS = {
    "speaks": r"tells?|told|telling|says?|said|saying|knows?|known of|asks?|asked|answers to",
    "metaphor": r"besides?|alike|rungs?|climbs?|ladders?|companions?|dear(?:er|est)?|nobody|"
    r"whoever|at rest|led|for want of|lies? behind|march(?:es)?|its own",
    "amount": r"as many|so many|as much|so much|as far as|half as|half again|by as much|"
    r"a (?:third|quarter|tenth|twentieth|hundredth|millionth) (?:more|less|of)",
}
FIRST = {
    "wh-word": "what whether how where which who when why",
    "preposition": "of by from for on in at to up with below above under into along about between",
}
VERBS = """add applies apply are assemble be build calculate call can change check choose close
collect combine compare compute construct contain convert copy correct count create decide
decompose define delete derive describe detect determine display divide do does draw ensure
estimate evaluate export extend extract extrapolate factorise filter find finish fit generate get
give handle has have help hold implement import initialise integrate interpolate invert is iterate
keep limit linearise list load locate make map mark match may measure modify move multiply must
normalise open optimise order parse perform plot predict print produce provide put raise read
record reduce refine refuse remove render repeat replace report represent require reset resolve
restore restrict return run sample save scale select pad separate set should show simulate skip
solve specifies specify split start store substitute subtract sum support take test transform
translate transpose try turn update use validate verify warn was were will wrap write yield"""
VERB = re.compile(rf"\b(?:{'|'.join(VERBS.split())})(?:s|es|d|ed)?\b", re.I)
SECTION = re.compile(r"\n\s*(?:[A-Z]\w+\s*\n\s*---|\*\*[A-Z]\w+:?\*\*|Args:|:param|\.\. |>>>|```)")


def prose(text: str) -> str:
    """Return a docstring without its sections, argument tables, formulas and code."""
    text = SECTION.split("\n" + text)[0]
    lines = [x for x in text.splitlines() if not re.match(r"\s{4,}\S|\s*\S+ {2,}\S|\s*\|", x)]
    return re.sub(r"`[^`]*`|\$[^$]*\$|https?:\S+", "X", "\n".join(lines)).strip()


def habits(text: str, kind: str) -> list[str]:
    """Return the habits found in one text."""
    text = prose(text)
    found = [k for k, words in WORDS.items() if re.search(rf"\b(?:{words})\b", text, re.I)]
    sentences = re.split(r"(?<=[.!?:;])\s+|\n\s*\n|\n\s*[-*] ", text)
    first = re.findall(r"[a-z'’-]+", sentences[0].lower())
    if first and kind != "paragraph":
        found += [k for k, words in FIRST.items() if first[0] in words.split()]
    found += ["no verb"] if first and kind == "function" and not VERB.search(sentences[0]) else []
    if any(len(re.findall(r"[A-Za-z]{2,}", s)) > 35 for s in sentences):
        found.append("long")
    return found


def texts_of(path: Path) -> Iterable[tuple[int, str, str]]:
    """Yield (line, kind, text) of all texts of a file."""
    source = path.read_text(encoding="utf-8", errors="replace")
    if path.suffix == ".md":
        plain = re.sub(r"```.*?```", lambda m: "\n" * m[0].count("\n"), source, flags=re.S)
        for m in re.finditer(r"(?:^(?!    |#|\|).*\S.*\n?)+", plain, re.M):
            yield plain.count("\n", 0, m.start()) + 1, "paragraph", m[0]
    for node in ast.walk(ast.parse(source if path.suffix == ".py" else "")):
        line = getattr(node, "lineno", 1)
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
            decorators = " ".join(ast.unparse(d) for d in getattr(node, "decorator_list", ()))
            noun = isinstance(node, ast.Module | ast.ClassDef) or "property" in decorators
            if text := ast.get_docstring(node):
                yield line, "noun" if noun else "function", text
        said = [node.exc] if isinstance(node, ast.Raise) and node.exc else []
        if isinstance(node, ast.Call):
            said += [k.value for k in node.keywords if k.arg == "help"]
            said += node.args if ast.unparse(node.func).endswith("echo") else []
        for one in said:
            parts = [p.value for p in ast.walk(one) if isinstance(p, ast.Constant)]
            text = "X".join(p for p in parts if isinstance(p, str))
            if len(text.split()) > 3:
                yield line, "message", text


def long_docstrings(path: Path) -> Iterable[tuple[int, str]]:
    """Yield (line, name) of private functions of at most 5 statements with a docstring of more than
    2 lines, which would outweigh the code."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if not isinstance(node, ast.FunctionDef) or not re.match(r"_(?!_)", node.name):
            continue
        if text := ast.get_docstring(node):
            statements = sum(isinstance(x, ast.stmt) for x in ast.walk(node)) - 2
            if statements <= 5 and len(text.splitlines()) > 2:
                yield node.lineno, node.name
