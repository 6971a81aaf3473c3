"""Reading nothing but the lower body of a scene file."""

from collections.abc import Iterable
from os import PathLike

from pydantic import ValidationError

from contact_scene.body import Body
from contact_scene.description import Description
from contact_scene.mistakes import mistakes
from contact_scene.problem import SceneError
from contact_scene.quantity import ANY_MAGNITUDE
from contact_scene.source import read_source


class _BodyDocument(Description):
    """The one table of a scene file that is read."""

    body: Body


def read_body(path: str | PathLike[str], overrides: Iterable[str] = ()) -> Body:
    """Read and check the lower body of a scene file; the rest need neither be there nor be right.

    A modulus or thickness may have any magnitude that can be computed with, because a body alone
    makes no problem that has to be well posed.

    path       a TOML file
    overrides  as for `read_scene_file`
    Raises `SceneError` with every mistake in the table [body], each with file, line and key.
    """
    source = read_source(path, overrides)
    document = {name: source.document[name] for name in ("body",) if name in source.document}
    context = {ANY_MAGNITUDE: True}
    with source.placing():
        try:
            return _BodyDocument.model_validate(document, context=context).body
        except ValidationError as error:
            raise SceneError(mistakes(document, error, context)) from None
