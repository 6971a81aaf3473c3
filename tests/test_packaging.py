"""Tests of the packages: installed files, names, versions and pinned dependencies are
consistent."""

import importlib.metadata
import re
import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
PACKAGES = (
    *("contact_scene", "contact_solver", "semi_analytical", "fem_reference", "radial"),
    *("contact_results", "contact_errors", "verification", "slipstick"),
)
IGNORED = shutil.ignore_patterns("__pycache__", "*.pyc")


def tree(root: Path) -> set[str]:
    """Names of all files of the packages, relative to root."""
    files = (path for package in PACKAGES for path in (root / package).rglob("*") if path.is_file())
    return {path.relative_to(root).as_posix() for path in files}


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    """A copy of what a wheel is made of: building writes into its source tree."""
    copy = tmp_path_factory.mktemp("source")
    for package in PACKAGES:
        shutil.copytree(ROOT / package, copy / package, ignore=IGNORED)
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, copy)
    return copy


@pytest.fixture(scope="module")
def built(source, tmp_path_factory):
    """The wheel."""
    directory = tmp_path_factory.mktemp("built")
    build = f"from setuptools.build_meta import build_wheel; build_wheel({str(directory)!r})"
    subprocess.run([sys.executable, "-c", build], cwd=source, check=True)
    (wheel,) = directory.glob("*.whl")
    return wheel


def test_wheel_holds_every_file_of_the_packages(source, built):
    expected = tree(source)
    with zipfile.ZipFile(built) as wheel:
        packed = {name for name in wheel.namelist() if ".dist-info/" not in name}
    assert sorted(expected - packed) == [], "left out: no __init__.py, or not in package-data"
    assert sorted(packed - expected) == []


def test_citation_and_changelog_are_of_the_version_that_is_installed():
    version = PROJECT["version"]
    assert importlib.metadata.version("slipstick") == version
    assert f"\nversion: {version}\n" in (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    released = re.search(r"^## \[(\d\S*)\]", changes, re.MULTILINE)
    if released is None:
        assert f"\n\nVersion {version} in the making." in changes
    else:
        assert released[1] == version


def test_nothing_is_installed_without_its_pin_and_hash():
    """A file that was exchanged at the registry is refused, and what has no pin is missing."""
    script = (ROOT / "run").read_text(encoding="utf-8")
    assert re.search(r"^ +pip=\(.* --no-deps\)$", script, re.MULTILINE)
    installs = re.findall(r'"\$\{pip\[@\]\}" .*', script)
    assert len(installs) == 2
    assert "--require-hashes" in installs[0]
    assert '-e "$root"' in installs[1]
