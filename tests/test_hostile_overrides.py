"""`--set` with anything after it: a scene, or one refusal that names the option."""

from pathlib import Path

import pytest

from contact_scene import SceneError, read_scene_file

SCENE = Path(__file__).resolve().parents[1] / "scenes" / "coated_fretting.toml"
LONG = 100_000
REFUSED = (
    *("", "=", "a", "=1", ".=1", "a.=1", ".a=1", "a..b=1", "a[1]=1", "loading[0]=1"),
    *("loading[-1]=1", "loading[3]=1", "loading[9999999]=1", "loading[٣]=1", "loading=[]"),
    *("loading={}", "loading[1][1]=2", "loading[1].normal_force[1]=2", "indenter={}", "indenter=1"),
    *("indenter.radius=nan", "indenter.radius=-inf", "indenter.radius=1e999", "indenter.radius=0"),
    *("indenter.radius=1\nbody=2", "indenter.radius=1\0", "indenter.radius=\udcff"),
    *("indenter.radius=\u202e1", "indenter.radius=1;body=2", "indenter.radius=true"),
    *('"indenter".radius=1', "ｉndenter.radius=1", "__class__=1", "indenter.__class__=1"),
    *("body.layers={}", "friction=false", "semi_analytical.cells=[1,2,3]", "accuracy=1%"),
    *("friction.coefficient={map='../x.npy',spacing=1}", "fem_reference.mesh_file='/dev/zero'"),
    *("friction.coefficient={map='/etc/passwd',spacing=1}", "loading[1].increments=1e3"),
    *("title=" + LONG * "a", "title=" + LONG * "[", "title=" + LONG * "{a=", LONG * "a" + "=1"),
    *(LONG * "a." + "a=1", "a" + LONG * "[1]" + "=1", "indenter.radius=" + LONG * "9"),
    *(LONG * "=", LONG * ".", "a" + LONG * ".a", 'title="""' + LONG * "'"),
)


@pytest.mark.parametrize("assignment", REFUSED, ids=lambda given: ascii(given)[:30])
def test_refusal_names_the_option_in_one_line(assignment: str) -> None:
    with pytest.raises(SceneError) as found:
        read_scene_file(SCENE, [assignment])
    named = [str(problem) for problem in found.value.problems if "--set" in str(problem)]
    assert named
    assert all(line.isprintable() and len(line) < 1000 for line in named)


def test_the_last_option_of_a_key_holds() -> None:
    many = [f"indenter.radius={n} mm" for n in range(1, 200)]
    assert read_scene_file(SCENE, many).scene.indenter.radius == 0.199  # type: ignore[union-attr]


def test_an_array_emptied_before_has_no_entry() -> None:
    with pytest.raises(SceneError, match="there is no entry 1, expected none: the array is empty"):
        read_scene_file(SCENE, ["loading=[]", "loading[1].increments=3"])
