"""What is wrong with the value of an option, in the words of this program."""

from typing import Any

import typer
from typer.core import TyperCommand

# Characters of a message: a value that nobody reads to its end is not repeated to its end.
LONGEST = 600


class WordedCommand(TyperCommand):
    """A command that tells a bad value in our words instead of a validator's."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Parse the command line; raises BadParameter."""
        try:
            return super().parse_args(ctx, args)
        except typer.BadParameter as error:
            error.message = _in_short(_in_our_words(error))
            raise

    def invoke(self, ctx: Any) -> Any:
        """Call the function; raises BadParameter, too."""
        try:
            return super().invoke(ctx)
        except typer.BadParameter as error:
            error.message = _in_short(error.message)
            raise


def _in_short(message: str) -> str:
    """Its begin and its end."""
    left_out = len(message) - LONGEST
    if left_out <= 0:
        return message
    half = LONGEST // 2
    return f"{message[:half]} ... {left_out} characters ... {message[-half:]}"


def _in_our_words(error: typer.BadParameter) -> str:
    """The message; unchanged where no validator is behind it that says what it found."""
    find: Any = getattr(error.__cause__, "errors", None)
    if find is None:
        return error.message
    (found, *_) = find(include_url=False)
    kind, given, context = found["type"], found["input"], found.get("ctx", {})
    if kind == "greater_than_equal":
        return f"got {given}, expected at least {context['ge']}"
    if kind == "less_than_equal":
        return f"got {given}, expected at most {context['le']}"
    if kind.startswith("int_"):
        return f"got '{given}', expected a whole number"
    if kind == "value_error":
        return str(context["error"])
    return error.message
