"""Names of cases and studies that nothing has."""

from collections.abc import Collection, Iterable
from difflib import get_close_matches

ALMOST, ALIKE = 0.85, 0.5  # similarity of two names, from 0 to 1


def unknown_names(kind: str, given: Iterable[str], known: Collection[str], listing: str) -> str:
    """What to say of the names that are not known, each with those it is near to; else "".

    kind     what the names are of
    listing  the command that names all
    """
    told = [_unknown_name(kind, name, known) for name in given if name not in known]
    return "; ".join([*told, f"'{listing}' names all"] if told else [])


def _unknown_name(kind: str, name: str, known: Collection[str]) -> str:
    near = _near(name[:100].lower(), known)
    meant = f", did you mean {' or '.join(near)}?" if near else ""
    return f"no {kind} is called '{name}'{meant}"


def _near(name: str, known: Collection[str]) -> list[str]:
    """The name that differs by a letter or two; failing that, those that resemble it."""
    spelt = {one.replace("-", "_"): one for one in known}
    name = name.replace("-", "_")
    found = get_close_matches(name, spelt, 1, ALMOST) or get_close_matches(name, spelt, 3, ALIKE)
    return [spelt[one] for one in found]
