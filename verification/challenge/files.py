"""Files of a challenge: export for another contact code, and reader of the returned answer.

The exported files describe the problem, list the required quantities, and contain an empty record
for the answer. The record becomes the same `Answer` objects that a solver function returns.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field as Described

from contact_results.directory.atomic_file import Refused
from contact_results.directory.json_record import read_record
from contact_results.directory.run_directory import files_at_once
from contact_scene import Scene
from contact_scene.reading.description import Description
from contact_scene.stepping.load_path import ControlKind, LoadRamp
from verification.challenge.answer import Answer, Field, Solver
from verification.challenge.cases import challenges
from verification.challenge.python_api import checked
from verification.challenge.requested_quantities import Challenge, Grade, Patch
from verification.challenge.solver_process import plain_answer
from verification.running.study import csv_text, json_text


def toml_text(scene: Scene | Patch) -> str:
    """Return a scene as the text of a TOML scene file, with all values that differ from the
    defaults."""
    if isinstance(scene, Patch):
        tables = scene.document(exclude_defaults=True)
        return "\n".join(_toml_lines(tables, ())).lstrip("\n") + "\n"
    content = scene.model_dump(mode="json", exclude_defaults=True, exclude_none=True)
    shape = scene.model_dump(mode="json")["indenter"]["shape"]
    content["indenter"] = {"shape": shape, **content["indenter"]}
    return "\n".join(_toml_lines(content, ())).lstrip("\n") + "\n"


def _toml_lines(content: Mapping[str, Any], path: tuple[str, ...]) -> Iterator[str]:
    """Yield the TOML lines of a table of a scene file: its values, then its subtables and table
    arrays.

    content  values of the table by key
    path     keys of the enclosing tables
    """
    deeper = {name: v for name, v in content.items() if _is_table(v) or _is_tables(v)}
    for name, value in content.items():
        if name not in deeper:
            yield f"{name} = {_toml_value(value)}"
    for name, value in deeper.items():
        here = (*path, name)
        for one in [value] if _is_table(value) else value:
            head = ".".join(here)
            yield f"\n[{head}]" if _is_table(value) else f"\n[[{head}]]"
            yield from _toml_lines(one, here)


def _is_table(value: Any) -> bool:
    return isinstance(value, dict)


def _is_tables(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(map(_is_table, value))


def _toml_value(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_toml_value, value))}]"
    if isinstance(value, float):
        return repr(value)
    return json.dumps(value, ensure_ascii=False)


ANSWERS = "answers.json"
POINTS = "points.csv"
REMEDY = "correct it, or export the challenge again to another folder"
TEMPLATES = Path(__file__).parent / "templates"


# Texts and truth values are no numbers.
Number = Annotated[float, Described(strict=True)]
Whole = Annotated[int, Described(strict=True)]
Order = Annotated[float, Described(strict=True, gt=0)]


class GivenSolver(Description):
    """Description of the code that answers, and of the accuracy that it claims."""

    name: str = Described(min_length=1)
    version: str = ""
    url: str = ""
    sampling: Literal["point", "cell"] = "point"
    """Values of fields: "point", or "cell" for means over squares of the areas."""

    claimed_grade: Grade | None = None
    claimed_orders: dict[str, Order] = Described(default_factory=dict)


class GivenNumber(Description):
    """Number at the end of a load step, or numbers at the points of the challenge [SI]."""

    quantity: str
    load_step: Whole
    value: Number | tuple[Number, ...] | None = None
    u: Number | None = Described(default=None, ge=0)
    """Standard uncertainty of one number."""


class GivenField(Description):
    """Traction on the lower body at points of the code's own choice [SI]."""

    quantity: str
    load_step: Whole
    x: tuple[Number, ...]
    y: tuple[Number, ...]
    value: tuple[Number, ...]
    area: tuple[Number, ...]


class GivenLevel(Description):
    """Answer on one refinement level."""

    h: Number
    """Side of a cell or element at the contact edge [m]."""

    label: str = ""
    unknowns: Whole | None = Described(default=None, ge=0)
    seconds: Number | None = Described(default=None, ge=0)
    gave_up: str | None = None
    """Reason of a level without an answer."""

    numbers: tuple[GivenNumber, ...] = ()
    fields: tuple[GivenField, ...] = ()

    def answer(self, level: int) -> Answer:
        """Convert the level to the answer that a solver function returns; refused alike."""
        scalars: dict[Any, Any] = {}
        points: dict[Any, Any] = {}
        for one in self.numbers:
            key = one.quantity, one.load_step
            if key in scalars or key in points:
                raise Refused(f"level {level}: {one.quantity} of step {one.load_step} twice")
            if one.u is not None and not isinstance(one.value, float):
                raise Refused(f"level {level}: {one.quantity}: u belongs to one number")
            if isinstance(one.value, tuple):
                points[key] = one.value
            elif one.value is not None:
                scalars[key] = one.value if one.u is None else (one.value, one.u)
        fields: dict[Any, Any] = {}
        for field in self.fields:
            key = field.quantity, field.load_step
            if key in fields:
                raise Refused(f"level {level}: {key[0]} of step {key[1]} twice")
            fields[key] = Field(*map(np.array, (field.x, field.y, field.value, field.area)))
        given = Answer(
            self.h,
            scalars,
            fields,
            {} if self.gave_up is None else {0: self.gave_up},
            self.unknowns,
            self.seconds,
            self.label or str(level),
            points,
        )
        return plain_answer(given, level)


class GivenAnswers(Description):
    """Content of the file `answers.json` of a challenge."""

    case: str
    case_version: str
    solver: GivenSolver
    levels: tuple[GivenLevel, ...] = Described(min_length=1)
    """Refinement levels from coarse to fine."""


def read_answers(directory: Path) -> tuple[Challenge, Solver, tuple[Answer, ...]]:
    """Read the answer of another code to a challenge from its folder.

    Returns the challenge, the description of the code, and one `Answer` per refinement level, from
    coarse to fine. Raises Refused with file, key, found and expected value.
    """
    path = directory / ANSWERS
    if not path.exists():
        raise Refused(
            f"{path}: no such file; expected the folder of 'slipstick challenge export', or "
            "FILE.py:FUNCTION"
        )
    given = read_record(path, GivenAnswers, "answer", REMEDY)
    challenge = challenges().get(given.case)
    if challenge is None or challenge.version != given.case_version:
        raise Refused(
            f"{path}: the answers are for version {given.case_version} of {given.case}, here it is "
            f"{challenge.version if challenge else 'not known'}; export it again"
        )
    try:
        answers = [one.answer(level) for level, one in enumerate(given.levels, start=1)]
        return challenge, Solver(**given.solver.model_dump()), checked(challenge, answers)
    except (Refused, ValueError) as error:
        raise Refused(f"{path}: {error}") from None


def export(challenge: Challenge, directory: Path, *, blind: bool) -> None:
    """Write the files of a challenge, which another code reads and fills in, to a folder.

    Raises Refused if the folder already contains answers.

    blind  True if the reference values are withheld
    """
    if (directory / ANSWERS).exists():
        raise Refused(f"{directory / ANSWERS} exists: take another folder, or delete it")
    files = {
        "scene.toml": toml_text(challenge.scene),
        "asked.csv": csv_text(_required_quantities(challenge, blind=blind)),
        "problem.md": _problem_text(challenge),
        ANSWERS: _empty_answers(challenge),
    }
    if challenge.points:
        files[POINTS] = csv_text(_places(challenge))
    if not blind:
        files["reference.json"] = json.dumps(challenge.reference(), indent=1) + "\n"
    with files_at_once(directory, ANSWERS, ()) as staging:
        for name, text in files.items():
            (staging / name).write_text(text, encoding="utf-8")


def _required_quantities(challenge: Challenge, *, blind: bool) -> Iterator[Mapping[str, object]]:
    """Yield the lines of the table of required quantities, as cells by column name."""
    for v in (*challenge.values, *challenge.points):
        at_places = v.places is not None
        yield {
            "quantity": v.quantity,
            "load_step": v.step,
            "unit": v.unit,
            "norm": "largest" if at_places else "abs",
            "scale": "" if blind else f"{v.scale:.10g}",
            "scale_name": v.over,
            "grade": v.par,
            "required": "yes" if v.required else "no",
            "meaning": f"{v.meaning}, at the places of {POINTS}" if at_places else v.meaning,
        }
    for f in challenge.fields:
        yield {
            "quantity": f.quantity,
            "load_step": f.step,
            "unit": "Pa",
            "norm": f.norm,
            "scale_name": "its own norm" if f.norm == "L2" else "µW",
            "grade": f.par,
            "required": "no",
            "meaning": f.meaning,
        }


def _empty_answers(challenge: Challenge) -> str:
    numbers = [
        {"quantity": one.quantity, "load_step": one.step, "value": None}
        for one in challenge.numbers
    ]
    content = {
        "case": challenge.name,
        "case_version": challenge.version,
        "solver": {"name": ""},
        "levels": [{"h": None, "numbers": numbers, "fields": []}],
    }
    return json_text(content)


def _places(challenge: Challenge) -> Iterator[Mapping[str, object]]:
    """Yield the lines of the table of the points at which a challenge requires numbers.

    The points of each quantity are numbered from 1.
    """
    for p in challenge.points:
        for n, place in enumerate(p.places, start=1):
            yield {
                "quantity": p.quantity,
                "load_step": p.step,
                "point": n,
                **{f"{axis} [m]": f"{x:.10g}" for axis, x in zip("xyz", place, strict=True)},
            }


def _problem_text(challenge: Challenge) -> str:
    steps = [f"{ramp.step}. {', '.join(_prescribed_ends(ramp))}" for ramp in challenge.ramps]
    window = (
        f"\nA suitable window: {challenge.window * 1e3:g} mm square; what is cut to the contact "
        "radius knows the answer.\n"
    )
    return _template_text("problem.md").format(
        title=challenge.title,
        problem=challenge.problem,
        steps="\n".join(steps) or "1. the tractions as told above",
        window=window if steps else "",
        source=challenge.source,
        fields=_field_instructions(challenge),
        shares=challenge.shares or "nothing",
    )


def _field_instructions(challenge: Challenge) -> str:
    if not challenge.fields:
        return ""
    names = ", ".join(dict.fromkeys(f"`{one.quantity}`" for one in challenge.fields))
    return "\n" + _template_text("fields.md").format(names=names).rstrip()


def _prescribed_ends(ramp: LoadRamp) -> Iterator[str]:
    """Yield the forces, moments or motions that a load step prescribes at its end, as text with
    units.

    Twist and tilt that are prescribed as zero are left out.
    """
    for words, control in (
        (("W", "N", "approach", "m"), ramp.normal),
        (("T", "N", "tangential shift", "m"), ramp.tangential),
        (("torque about z", "N m", "twist", "rad"), ramp.twisting),
        (("moments", "N m", "tilt", "rad"), ramp.tilting),
    ):
        rotates = control in (ramp.twisting, ramp.tilting)
        if rotates and control.kind is ControlKind.DISPLACEMENT and not np.any(control.end):
            continue
        name, unit = words[:2] if control.kind is ControlKind.FORCE else words[2:]
        end = control.end
        number = f"({end[0]:.17g}, {end[1]:.17g})" if isinstance(end, tuple) else f"{end:.17g}"
        yield f"{name} = {number} {unit}"


def _template_text(name: str) -> str:
    return (TEMPLATES / name).read_text(encoding="utf-8")
