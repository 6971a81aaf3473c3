"""Files that contain one record as JSON: one clear message for an invalid file, equal bytes."""

import json
from codecs import BOM_UTF8
from pathlib import Path
from typing import TypeVar

from pydantic import ValidationError

from contact_results.directory.atomic_file import Refused, atomic_file
from contact_scene.reading.description import Description
from contact_scene.reading.scene_error import dotted_key, shown

R = TypeVar("R", bound=Description)
# Start of pydantic's message about a value of another kind or size.
INVALID = "Input should be "
# Names that pydantic adds to the key of a number that may be a list as well.
ALTERNATIVES = ("float", "tuple[float, ...]")


def record_text(record: Description) -> str:
    """Convert a record to JSON text with all keys and digits. Equal records give equal text."""
    content = record.model_dump(mode="json")
    return json.dumps(content, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def write_record(path: Path, record: Description) -> None:
    """Write a record as JSON to a file, which is replaced atomically.

    Raises OutputRefused if the file cannot be written.
    """
    with atomic_file(path) as temporary:
        temporary.write_text(record_text(record), encoding="utf-8", newline="\n")


def read_record(
    path: Path, model: type[R], what: str, remedy: str, refused: type[Refused] = Refused
) -> R:
    """Read the record in a JSON file.

    path     path of the file
    model    class of the record
    what     noun for the file, for messages
    remedy   command or action that repairs the file, for messages
    refused  exception for a file that cannot be used

    Raises the exception with path, first wrong key, received and expected value, and remedy.
    """
    if path.exists() and not path.is_file():
        raise refused(f"{what} {path} is not a regular file; {remedy}")
    try:
        return model.model_validate_json(path.read_bytes().removeprefix(BOM_UTF8))
    except OSError as error:
        raise refused(f"{what} {path} cannot be read: {error.strerror}; {remedy}") from error
    except ValidationError as error:
        raise refused(f"{what} {path} is damaged: {first_mistake(error)}; {remedy}") from None


def first_mistake(error: ValidationError) -> str:
    """Describe the first mistake of an invalid record by its key, received and expected value."""
    first = error.errors(include_url=False)[0]
    kind, message = first["type"], first["msg"].removeprefix("Value error, ")
    sentences = {
        "missing": "the key is missing",
        "extra_forbidden": "unknown key",
        "string_too_short": "got an empty text",
    }
    sentence = sentences.get(kind, message.replace("Invalid JSON: ", "got no JSON: "))
    if message.startswith(INVALID):
        sentence = f"got {shown(first['input'])}, expected {message.removeprefix(INVALID)}"
    key = dotted_key(tuple(part for part in first["loc"] if part not in ALTERNATIVES))
    return f"key {key}: {sentence}" if key else sentence
