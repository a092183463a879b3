"""[[member]] tables: what they say, back and forth, and what is refused."""

import os
import pathlib
import subprocess
import tomllib

import pytest
from arm_of_members import FOREARM, HAND, UPPER_1, UPPER_2, text

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("REED_BUILD_DIR", ROOT / "build" / "release")) / "bin"
STIFFNESSES = "EA = 7.0e6\nEI_y = 900.0\nEI_z = 350.0\nGJ = 400.0\n"
SECTION = "[[sections]]\nlength = 0.2\nEA = 1e7\nEI = 1e3\nGJ = 1e3\nrhoA = 1.0\n"


def read(path, *arguments):
    return subprocess.run([BIN / "reed_config", "--config", "press_known", "--arm", str(path), *map(str, arguments)], capture_output=True, text=True,
                          timeout=30)


def members_of(folder, arm):
    (folder / "arm.toml").write_text(arm)
    done = read(folder / "arm.toml", "--write", folder / "effective.toml")
    assert done.returncode == 0, done.stderr
    return tomllib.loads((folder / "effective.toml").read_text())["arm"]["member"]


def test_tube_and_box_are_what_they_are_by_hand(tmp_path):
    tube, box, given, rod = members_of(tmp_path, text())
    assert set(tube) == {"link", "from_m", "to_m", "y_axis", "EA", "EI_y", "EI_z", "GJ", "rhoA"}
    I = 3.141592653589793 / 64 * (0.03**4 - 0.027**4)
    assert tube["EI_y"] == tube["EI_z"] == pytest.approx(70e9 * I, rel=1e-12) and tube["GJ"] == pytest.approx(26.3e9 * 2 * I, rel=1e-12)
    width, height = 0.03, 0.02  # along y and z of the section
    assert box["EI_y"] == pytest.approx(70e9 * (width * height**3 - (width - 0.003) * (height - 0.003) ** 3) / 12, rel=1e-12)
    assert box["EI_z"] == pytest.approx(70e9 * (height * width**3 - (height - 0.003) * (width - 0.003) ** 3) / 12, rel=1e-12)
    assert box["rhoA"] == pytest.approx(2700 * (width * height - (width - 0.003) * (height - 0.003)), rel=1e-12)
    assert [given[key] for key in ("EA", "EI_y", "EI_z", "GJ", "rhoA")] == [7e6, 900.0, 350.0, 400.0, 0.3]
    assert rod["GJ"] == pytest.approx(26.3e9 * 0.140577 * 0.02**4, rel=5e-3) and rod["rhoA"] == 0.0  # Saint-Venant: a square bar


def test_an_effective_file_says_the_same_members_again(tmp_path):
    first = members_of(tmp_path, text())
    done = subprocess.run([BIN / "reed_config", "--config", str(tmp_path / "effective.toml"), "--write", str(tmp_path / "again.toml")],
                          capture_output=True, text=True, timeout=30)
    assert done.returncode == 0, done.stderr
    assert tomllib.loads((tmp_path / "again.toml").read_text())["arm"]["member"] == first


def test_members_of_several_links_may_stand_in_any_order_of_links(tmp_path):
    assert members_of(tmp_path, text(HAND, UPPER_1, FOREARM, UPPER_2)) == members_of(tmp_path, text())


def long_row(pieces):
    return "\n".join(f"[[member]]\nlink = 2\nfrom_m = [{0.03 * k:g}, 0.0, 0.0]\nto_m = [{0.03 * (k + 1):g}, 0.0, 0.0]\n{STIFFNESSES}" for k in range(pieces))


@pytest.mark.parametrize("members, said", [
    ([UPPER_1.replace("link = 2", "link = 6")], ["member[0].link", "1 ... 5"]),
    ([UPPER_1.replace("link = 2", "link = 0")], ["member[0].link", "1 ... 5"]),
    ([UPPER_1.replace("link = 2", "link = 1.5")], ["member[0].link"]),
    ([UPPER_1.replace("link = 2\n", "")], ["member[0].link", "missing: the number of the link, 1 ... 5"]),
    ([UPPER_1.replace("link = 2", 'link = "upper"')], ["member[0].link"]),
    ([UPPER_1.replace("to_m = [0.15, 0.0, 0.1]\n", "")], ["member[0].to_m", "is 0 m from from_m", "1e-04 m and more"]),
    ([UPPER_2.replace("to_m = [0.35, 0.0, 0.0]", "to_m = [0.15, 0.0, 0.1]")], ["member[0].to_m", "from from_m"]),
    ([UPPER_1.replace("0.15, 0.0, 0.1", "15.0, 0.0, 0.1")], ["member[0].to_m", "-10 ... 10 m"]),
    ([UPPER_1.replace("0.15, 0.0, 0.1", "0.15, 0.0")], ["member[0].to_m"]),
    ([UPPER_1.replace("0.15, 0.0, 0.1", "nan, 0.0, 0.1")], ["member[0].to_m"]),
    ([FOREARM.replace("EI_z = 350.0", "EI_z = -350.0")], ["member[0].EI_z", "-350", "0.001 ... 1e+10 N·m²"]),
    ([FOREARM.replace("EI_y = 900.0", "EI_y = 0.0")], ["member[0].EI_y", "0.001 ... 1e+10 N·m²"]),
    ([FOREARM.replace("GJ = 400.0\n", "")], ["member[0].GJ", "missing"]),
    ([FOREARM.replace("EI_y", "EI")], ["member[0].E"]),
    ([FOREARM.replace("rhoA = 0.3", "rhoA = -0.3")], ["member[0].rhoA", "0 ... 10000 kg/m"]),
    ([UPPER_2 + 'tube = {outer = 0.03, wall = 0.001}\n'], ["member[0].box", "beside tube"]),
    ([UPPER_2 + "EI_y = 900.0\n"], ["member[0].EI_y", "given twice; box says it"]),
    ([UPPER_1 + "GJ = 900.0\n"], ["member[0].GJ", "given twice; tube says it"]),
    ([UPPER_2.replace("wall = 0.0015", "wall = 0.006")], ["member[0].box.wall", "quarter of the smaller side, 0.02 m"]),
    ([UPPER_1.replace("wall = 0.0015", "wall = 0.016")], ["member[0].tube.wall", "half of outer"]),
    ([UPPER_2.replace("width = 0.03, ", "")], ["member[0].box.width", "missing"]),
    ([UPPER_2.replace("box = {", "box = 3 # {")], ["member[0].box", "expected {width = m"]),
    ([UPPER_2.replace('"aluminium"', '"wood"')], ["member[0].box.material", "aluminium, steel, titanium, carbon"]),
    ([UPPER_2.replace("y_axis = [0.0, 1.0, 0.0]", "y_axis = [-0.4, 0.0, 0.2]")], ["member[0].y_axis", "along the member"]),
    ([UPPER_1.replace("link = 2", "link = 2\nlenght = 0.2")], ["member[0].lenght"]),
    ([UPPER_1.replace("outer = 0.03", '"äußerer" = 0.03, outer = 0.03')], ["member[0].tube"]),
    ([UPPER_1, SECTION], ["member", "given beside sections"]),
    ([long_row(11)], ["member", "11 members; allowed: up to 10"]),
    ([UPPER_2, UPPER_1], ["member[1].to_m", "is where member[0] begins", "in order from base to tip"]),
    ([UPPER_1, UPPER_1], ["member[1].from_m", "is where member[0] begins"]),
    ([UPPER_1, UPPER_2.replace("from_m = [0.15, 0.0, 0.1]\nto_m = [0.35, 0.0, 0.0]", "from_m = [0.2, 0.0, 0.0]\nto_m = [0.15, 0.0, 0.1]")],
     ["member[1].to_m", "is where member[0] ends"]),
    ([HAND, HAND.replace("-0.15", "-0.1").replace("-0.05", "0.02")], ["member[1].from_m", "lies on member[0] for 0.05 m"]),
    ([HAND, HAND.replace("-0.15", "-0.06").replace("-0.05", "-0.12")], ["member[1].from_m", "lies on member[0] for 0.06 m"]),
])
def test_what_is_no_member_is_refused(tmp_path, members, said):
    path = tmp_path / "arm.toml"
    path.write_text(text(*members))
    done = read(path)
    assert done.returncode == 2 and done.stdout == "" and len(done.stderr.splitlines()) == 1, done.stderr
    for word in (f"{path}:", *said):
        assert word in done.stderr


def test_a_misspelt_table_is_refused(tmp_path):
    path = tmp_path / "arm.toml"
    path.write_text(text().replace("[[member]]", "[[members]]", 1))
    done = read(path)
    assert done.returncode == 2 and "members" in done.stderr and len(done.stderr.splitlines()) == 1
