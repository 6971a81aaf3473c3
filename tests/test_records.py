"""Tests of stored records: they contain a digest of the source code that made them."""

import json
import shutil
from pathlib import Path

import pytest
from command import slipstick
from report_examples import made_by, study

from verification.running import provenance
from verification.running.provenance import age_text, closure, is_current
from verification.running.report_record import stored_records
from verification.running.study import dump_study
from verification.studies.catalogue import STUDIES

ROOT = Path(__file__).resolve().parents[1]
# Files that a root depends on, and files that it does not.
DEPENDS = {
    "verification.norms": (
        {"verification/norms.py", "verification/__init__.py"},
        "verification/cases",
    ),
    "verification.cases": (
        {"verification/cases/indenters.py", "semi_analytical/discretised.py"},
        "slipstick",
    ),
    "verification.studies.seeded_defects": ({"verification/cases/indenters.py"}, "slipstick"),
    "verification.studies.stability.study": ({"semi_analytical/solve.py"}, "verification/report"),
}


@pytest.mark.parametrize(("module", "expected"), DEPENDS.items(), ids=DEPENDS)
def test_a_record_depends_on_what_its_modules_import(module, expected):
    found = closure([module])
    needed, foreign = expected
    assert needed <= found
    assert not any(path.startswith(f"{foreign}/") for path in found)
    assert all((ROOT / path).is_file() for path in found)


def test_imports_are_found_in_every_form(tmp_path):
    path = tmp_path / "imports.py"
    of_a_function = "from contact_solver import (\n krylov,  # (1)\n shear as zones,\n )"
    path.write_text(f"import radial.history as model\n\n\ndef f():\n    {of_a_function}\n")
    names = ("contact_solver/{}", "krylov", "shear"), ("radial/{}", "history")
    expected = {f.format(f"{m}.py") for f, *modules in names for m in ("__init__", *modules)}
    assert {*provenance._imported_files(str(path))} == expected


def test_a_record_is_older_where_a_source_of_its_closure_changes(
    monkeypatch,
):
    made = made_by()
    assert is_current(made)
    real = provenance._file_digest
    for path, current in (("contact_scene/body_pair.py", True), ("verification/norms.py", False)):
        provenance.source_digest.cache_clear()
        monkeypatch.setattr(provenance, "_file_digest", lambda f, p=path: real(f) + "x" * (f == p))
        assert is_current(made) is current
        assert age_text(made) == ("" if current else "older than the code")
    monkeypatch.undo()
    provenance.source_digest.cache_clear()
    assert not is_current(made.model_copy(update={"modules": ()}))


def test_texts_and_format_of_a_source_do_not_count(tmp_path, monkeypatch):
    monkeypatch.setattr(provenance, "ROOT", tmp_path)
    texts = {
        "a.py": '"""Old."""\nX = 1.5\n\n\ndef f():\n    """Old."""\n    return "x", X\n',
        "c.py": '"""Old."""\nX = 1.6\n\n\ndef f():\n    """Old."""\n    return "x", X\n',
        "d.py": '"""Old."""\nX = 1.5\n\n\ndef f():\n    """Old."""\n    return "y", X\n',
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    assert provenance._file_digest("a.py") != provenance._file_digest("c.py")
    assert provenance._file_digest("a.py") != provenance._file_digest("d.py")
    (tmp_path / "e.py").write_text(texts["a.py"].replace("Old.", "New.").replace("5\n", "5  # w\n"))
    assert provenance._file_digest("a.py") == provenance._file_digest("e.py")


def test_every_study_names_the_module_that_makes_it():
    for name, known in STUDIES.items():
        assert len(closure([known.cases.__module__])) > 100, name


def test_records_are_listed_by_cost_and_old_ones_are_red(tmp_path, capsys):
    for name, seconds in (("stability", 50.0), ("promises", 5.0)):
        place = tmp_path / "studies" / name
        place.mkdir(parents=True)
        made = made_by().model_copy(update={"seconds": {"all": seconds}})
        record = study(name).model_copy(update={"provenance": made})
        (place / "study.json").write_text(dump_study(record))
    assert [r.path.parent.name for r in stored_records(tmp_path)] == ["promises", "stability"]
    assert slipstick("maintain", "records", tmp_path, "--check") == 0
    (place / "earlier").mkdir()  # as a regeneration that was killed leaves it
    (place / "study.json").rename(place / "earlier" / "study.json")
    assert [r.name for r in stored_records(tmp_path)] == ["promises", "stability"]
    (place / "earlier" / "study.json").rename(place / "study.json")
    content = json.loads((place / "study.json").read_text())
    content["provenance"]["sources"] = "those"
    (place / "study.json").write_text(json.dumps(content))
    assert slipstick("maintain", "records", tmp_path) == 0
    assert slipstick("maintain", "records", tmp_path, "--check") == 7
    assert slipstick("maintain", "records", tmp_path, "--check", "--only", "stability") == 0
    assert slipstick("maintain", "records", tmp_path, "--only", "stabilities") == 2
    assert "older than the code" in capsys.readouterr().out
    shutil.rmtree(tmp_path / "studies")
    assert stored_records(tmp_path) == []
