"""Tests of file names in scenes: a name that leads elsewhere is refused."""

import os
import sys
from typing import Any

import numpy as np
import pytest

from contact_scene import (
    SceneError,
    read_scene_file,
)

# OUT is a folder beside that of the scene; its height map would be taken if it were read.
NAMES = (
    *("../out/h.npy", "OUT/h.npy", "a/../../out/h.npy", "..//out//h.npy", "a/../h.npy", "..", ""),
    *("/", "../out", "a/", "link.npy", "linked/h.npy", "dangling.npy", "loop.npy", "queue.npy"),
    *("..\\\\out\\\\h.npy", "C:\\\\h.npy", "\\\\\\\\server\\\\h.npy", "//server/h", "~/h.npy"),
    *("file://OUT/h.npy", "http://localhost:9/h.npy", "$HOME/h.npy", "%2e%2e/out/h.npy"),
    *("．．/out/h.npy", "..\\u2215out\\u2215h.npy", "h.npy\\u0000.txt", "h.npy\\n", "\\u202eh.npy"),
    *("/dev/zero", "/dev/stdin", "/proc/self/environ", "/etc/passwd", "CON", "h.npy:x", "|id"),
    *("$(id)", "`id`", "a" * 5000, 300 * "a/" + "h.npy", "-o", "*.npy"),
)
MAPS = (
    'friction = { coefficient = 0 }\n[indenter]\nshape = "height_map"\nfile = "NAME"\n'
    'spacing = "10 um"',
    'friction = { coefficient = { map = "NAME", spacing = "10 um" } }\n[indenter]\n'
    'shape = "sphere"\nradius = "10 mm"',
)
REST = (
    '\nmaterial = "rigid"\n[body]\nmaterial = { young_modulus = 2e11, poisson_ratio = 0.3 }\n'
    "[[loading]]\nnormal_force = 1\n"
)
opened = None


def listen(event: str, given: tuple[Any, ...]) -> None:
    if opened is not None and event in ("open", "os.listdir", "socket.connect"):
        opened.append(str(given[0]))


@pytest.fixture(scope="module")
def audited():
    sys.addaudithook(listen)  # it cannot be removed


@pytest.mark.parametrize("text", MAPS, ids=["height map", "friction map"])
@pytest.mark.parametrize("name", NAMES)
def test_a_name_that_leads_elsewhere_is_refused(name, text, tmp_path, audited):
    global opened
    scenes, out = tmp_path / "scenes", tmp_path / "out"
    (scenes / "a").mkdir(parents=True)
    out.mkdir()
    for place in (scenes / "h.npy", out / "h.npy"):
        np.save(place, np.zeros((8, 8)))
    for link, target in (
        ("link.npy", out / "h.npy"),
        ("linked", out),
        ("dangling.npy", out / "x"),
        ("loop.npy", scenes / "loop.npy"),
    ):
        (scenes / link).symlink_to(target)
    os.mkfifo(scenes / "queue.npy")
    (scenes / "scene.toml").write_text(text.replace("NAME", "h.npy") + REST)
    read_scene_file(scenes / "scene.toml")  # the mistake is the name alone
    (scenes / "scene.toml").write_text(text.replace("NAME", name.replace("OUT", str(out))) + REST)
    before = sorted(map(str, tmp_path.rglob("*")))
    opened = []
    try:
        with pytest.raises(SceneError) as refused:
            read_scene_file(scenes / "scene.toml")
        heard = opened
    finally:
        opened = None
    assert all(str(p).isprintable() and len(str(p)) < 1000 for p in refused.value.problems)
    elsewhere = (str(out), "/dev/", "/proc/", "/etc/")
    assert [path for path in heard if os.path.realpath(path).startswith(elsewhere)] == []
    assert sorted(map(str, tmp_path.rglob("*"))) == before
