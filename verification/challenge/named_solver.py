"""A solver by its name: FILE.py:FUNCTION or a module's."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

from contact_results.directory.refusal import Refused
from verification.challenge.answer import Answer
from verification.challenge.python_api import Posed

EXPECTED = "expected FILE.py:FUNCTION or MODULE:FUNCTION"


def names_a_solver(text: str) -> bool:
    """Rather than a folder."""
    return ":" in text and not Path(text).exists()


def named_solver(text: str) -> Callable[[Posed, int], Answer]:
    """The function; runs the file that it is in. Raises Refused where there is none, and what the
    file raises."""
    place, _, name = text.rpartition(":")
    module = module_of(Path(place)) if place.endswith(".py") else _imported(place, text)
    found: object = getattr(module, name, None)
    if not callable(found):
        raise Refused(f"{text}: {place} has no function {name!r}; {EXPECTED}")
    return found


def module_of(path: Path) -> ModuleType:
    """A file run as Python runs a script: what lies beside it can be imported. Raises Refused where
    it cannot be read or imports what is not there."""
    if not path.is_file():
        raise Refused(f"{path}: no such file; {EXPECTED}")
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.path.insert(0, str(path.parent.resolve()))
    try:
        spec.loader.exec_module(module)
    except (ImportError, SyntaxError) as error:
        raise Refused(f"{path}: {error}") from error
    return module


def _imported(place: str, text: str) -> ModuleType:
    try:
        return importlib.import_module(place)
    except (ImportError, ValueError) as error:
        raise Refused(f"{text}: {error}; {EXPECTED}") from None
