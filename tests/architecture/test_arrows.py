"""The arrows between rooms: docs/architecture.md draws them, CMake links them, includes follow them."""

import re
import subprocess

import pytest

from reed_tools.paths import BUILD, ROOT

DOCUMENT = (ROOT / "docs" / "architecture.md").read_text()
ARROW_BLOCK = re.search(r"## The arrows\n.*?```\n(.*?)```", DOCUMENT, re.S).group(1)
SOURCES = [ROOT / name for name in ("math", "rt", "bus", "config", "lcmtypes", "telemetry", "firmware", "plant_sim", "embedded", "bench", "tools")]
OUTSIDE = {"Eigen", "Threads", "LCM", "toml++", "nlohmann-json", "CLI11", "dl"}
GENERATED = {"reed/bus/generated": "reed_layout"}


def drawn(arrow: str = "->") -> dict[str, set[str]]:
    """Target -> targets that it may link, as the document draws them: `A B -> C D`."""
    arrows: dict[str, set[str]] = {}
    for line in ARROW_BLOCK.splitlines():
        if arrow not in line:
            continue
        left, right = re.sub(r"\(.*?\)", "", line).split(arrow)
        for target in left.split():
            arrows.setdefault(target, set()).update(right.split())
    return arrows


def cmake_texts() -> str:
    files = [path for folder in SOURCES if folder.exists() for path in folder.rglob("CMakeLists.txt")]
    return "\n".join(re.sub(r"#.*", "", path.read_text()) for path in files)


def linked() -> dict[str, set[str]]:
    """Target -> the project's targets that CMake links to it."""
    links: dict[str, set[str]] = {}
    for name, rest in re.findall(r"target_link_libraries\((\S+)((?:[^()]|\([^()]*\))*)\)", cmake_texts()):
        links.setdefault(name, set()).update(word for word in rest.split() if word.startswith("reed_") and word != "reed_warnings")
    return {name: targets for name, targets in links.items() if not name.startswith(("${", "reed_bench_"))}


def rooms() -> dict[str, str]:
    """Include prefix -> target, from the links that the build has made: rooms/TARGET/PREFIX is a link to a folder."""
    found = {}
    for target in sorted((BUILD / "rooms").iterdir()):
        for link in target.rglob("*"):
            if link.is_symlink():
                found[str(link.relative_to(target))] = target.name
    return found


def folder_of(prefix: str, target: str):
    return (BUILD / "rooms" / target / prefix).resolve()


ROOMS = {prefix: target for prefix, target in rooms().items() if not target.endswith("_test") and prefix not in ("reed/tests", "reed/bench")}  # tests and benches see what they measure


def reachable(target: str, arrows: dict[str, set[str]]) -> set[str]:
    seen, left = set(), [target]
    while left:
        for following in arrows.get(left.pop(), ()):
            if following not in seen:
                seen.add(following)
                left.append(following)
    return seen


def test_every_link_is_drawn_and_every_drawn_arrow_is_linked():
    arrows, links = drawn(), linked()
    for name, targets in drawn("~>").items():  # linked, but what links `name` sees nothing of it
        arrows[name] = arrows.get(name, set()) | targets
    wanted = {name: {target for target in targets if target not in OUTSIDE} for name, targets in arrows.items()}
    assert {name: targets for name, targets in links.items() if targets} == {name: targets for name, targets in wanted.items() if targets}


@pytest.mark.parametrize("prefix", sorted(ROOMS))
def test_a_room_includes_only_what_its_target_may_reach(prefix):
    target = ROOMS[prefix]
    allowed = reachable(target, drawn()) | {target}
    for file in folder_of(prefix, target).rglob("*"):
        if file.suffix not in (".h", ".cc"):
            continue
        for header in re.findall(r'#include "(reed/[^"]+)"', file.read_text()):
            room = max((known for known in ROOMS if header.startswith(known + "/")), key=len, default=None)
            if header == "reed/law.h":
                continue
            assert room is not None and ROOMS[room] in allowed, f"{file.relative_to(ROOT)} includes {header}"


def test_physics_stays_independent():
    arrows = drawn()
    assert not reachable("reed_plant_dynamics", arrows) & {"reed_core", "reed_setup", "reed_cycle", "reed_codec", "reed_transport"}
    assert not {name for name in reachable("reed_firmware", arrows) if name.startswith("reed_plant")}
    assert not {name for name in reachable("reed_plant_sim", arrows) if name in ("reed_core", "reed_cycle", "reed_setup")}


FORBIDDEN = {"reed_core": "reed/bus/codec/messages.h", "reed_plant_dynamics": "reed/core/model/dynamics.h",
             "reed_setup": "reed/plant/dynamics/wall.h", "reed_transport": "reed/bus/codec/messages.h"}


@pytest.mark.parametrize("target", FORBIDDEN)
def test_a_forbidden_include_does_not_compile(target, tmp_path):
    """With the include roots that the target and all it links have; the header it may have does compile."""
    roots = [f"-I{BUILD / 'rooms' / each}" for each in sorted(reachable(target, drawn()) | {target}) if (BUILD / "rooms" / each).exists()]
    for header, compiles in ((FORBIDDEN[target], False), (own_header(target), True)):
        source = tmp_path / "try.cc"
        source.write_text(f'#include "{header}"\n')
        done = subprocess.run(["g++", "-std=c++20", "-fsyntax-only", *roots, f"-I{BUILD / 'bus' / 'generated'}", "-isystem", "/usr/include/eigen3",
                               str(source)], capture_output=True, text=True)
        assert (done.returncode == 0) == compiles, done.stderr
        assert compiles or f"{header}: No such file or directory" in done.stderr


def own_header(target: str) -> str:
    prefix = next(prefix for prefix, owner in ROOMS.items() if owner == target)
    return f"{prefix}/{sorted(path.relative_to(folder_of(prefix, target)) for path in folder_of(prefix, target).rglob('*.h'))[0]}"
