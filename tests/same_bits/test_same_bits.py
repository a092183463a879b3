"""One digest from every compiler, at every optimisation and on every processor that this machine can show."""

import json
import os
import re
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from processors import OLD_LIBM, PLAIN

from reed_tools.paths import BUILD, PYTHON, ROOT, program

CYCLES = "1000"  # through the start, the approach and 0.5 s of pressing
SOURCES = [ROOT / "tests" / "same_bits" / "closed_loop.cc", *(BUILD / "firmware" / "controller" / f"{part}_5.cc" for part in ("controller", "set_up")), *sorted((ROOT / "plant_sim" / "dynamics").glob("*.cc")),
           *(ROOT / name for name in ("plant_sim/endpoint/robot.cc", "plant_sim/endpoint/journal.cc", "plant_sim/drive/drive_chain.cc", "plant_sim/drive/torque_excitation.cc",
                                      "plant_sim/sensor/wrench_sensor.cc", "config/schema/halves.cc", "config/schema/known_mass.cc"))]
FLAGS = ["-std=c++20", "-DNDEBUG", "-ffp-contract=off", "-DEIGEN_DONT_VECTORIZE"]
BUILDS = {  # name: (compiler, its flags, what runs the program)
    "gcc -O2 with AVX2 and FMA throughout": ("g++", ["-O2", "-march=x86-64-v3"], []),
    "clang -O2": ("clang++-14", ["-O2"], []),
    "aarch64 -O2": ("aarch64-linux-gnu-g++", ["-O2", "-static"], ["qemu-aarch64"]),
}
SCENARIOS = ["press_known", "free_motion", "press_sensor_loss"]
RUN = ["--duration", "0.6", "--seed", "77", "--bus", "memory", "--clock", "lockstep"]


def build(name: str, folder: Path) -> list[str]:
    """The closed loop by this compiler; the command that runs it."""
    compiler, flags, runner = BUILDS[name]
    if missing := [tool for tool in (compiler, *runner) if not shutil.which(tool)]:
        pytest.skip(f"{name}: no {', '.join(missing)}")
    eigen = folder / "include"  # alone: beside it the machine's own headers would come before those of another processor
    eigen.mkdir()
    (eigen / "Eigen").symlink_to("/usr/include/eigen3/Eigen")
    (folder / "rooms" / "reed").mkdir(parents=True)
    (folder / "rooms" / "reed" / "tests").symlink_to(ROOT / "tests")
    roots = [f"-I{root}" for root in (*sorted((BUILD / "rooms").glob("reed_*")), folder / "rooms", BUILD / "bus" / "generated")]
    launcher = ["ccache"] if shutil.which("ccache") else []

    read_once = folder / "read_once.h"  # half of the time goes into Eigen's headers
    read_once.write_text("#include <Eigen/Dense>\n")
    common = [compiler, *FLAGS, *flags, "-isystem", str(eigen)]
    subprocess.run([*common, "-x", "c++-header", str(read_once), "-o", f"{read_once}.{'pch' if 'clang' in compiler else 'gch'}"], check=True)

    def compiled(source: Path) -> str:
        out = folder / f"{source.stem}.o"
        subprocess.run([*launcher, *common, "-include", str(read_once), *roots, "-c", str(source), "-o", str(out)], check=True)
        return str(out)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        objects = list(pool.map(compiled, SOURCES))
    linked = folder / "closed_loop"
    subprocess.run([compiler, *flags, *objects, "-o", str(linked)], check=True)
    return [*runner, str(linked), CYCLES]


def output(command: list[str], **environment: str) -> str:
    return subprocess.run(command, env={**os.environ, **environment}, check=True, capture_output=True, text=True, timeout=240).stdout


@pytest.fixture(scope="module")
def reference():
    """With the libraries of the release build, gcc -O3."""
    return [str(program("closed_loop")), CYCLES]


def test_the_closed_loop_presses(reference):
    found = re.fullmatch(r"[0-9a-f]{16} mode 2 force (\S+)\n", output(reference))
    assert found and float(found.group(1)) > 5.0
    assert output([*reference[:-1], "999"]) != output(reference)


def test_the_processor_changes_nothing(reference):
    """Its own copy of the clones and of the C library's functions, and the plain one."""
    if not shutil.which(PLAIN[0]):
        pytest.skip(f"no {PLAIN[0]} (sudo apt install qemu-user)")
    assert output([*PLAIN, *reference]) == output(reference) == output(reference, **OLD_LIBM)


@pytest.mark.parametrize("name", BUILDS)
def test_another_build_gives_the_same(reference, name, tmp_path):
    if "AVX2" in name and not {"avx2", "fma"} <= set(re.search(r"^flags\s*:(.*)$", Path("/proc/cpuinfo").read_text(), re.M).group(1).split()):
        pytest.skip(f"{name}: this processor has none")
    assert output(build(name, tmp_path)) == output(reference)


def digest(folder: Path, scenario: str, **environment: str) -> str:
    done = subprocess.run([*PYTHON, str(ROOT / "tools" / "reed_tools" / "__main__.py"), "run", scenario, *RUN, "--out", str(folder)],
                          env={**os.environ, "REED_BUILD_DIR": str(BUILD), **environment}, capture_output=True, text=True, timeout=240)
    assert done.returncode in (0, 1), done.stdout + done.stderr
    return json.loads((folder / "summary.json").read_text())["digest"]


@pytest.mark.parametrize("scenario", SCENARIOS)
def test_a_run_has_the_same_digest_on_a_processor_without_avx_and_fma(scenario, tmp_path):
    assert digest(tmp_path / "own", scenario) == digest(tmp_path / "without", scenario, **OLD_LIBM)


ELEMENTARY = re.compile(r" U (a?(sin|cos|tan)h?|sincos|atan2|exp(2|10|m1)?|log(2|10|1p)?|pow|hypot|cbrt)f?(@.*)?$", re.M)


@pytest.mark.parametrize("library", ["firmware/libreed_cycle.a", "firmware/controller/libreed_controller_5.a", "plant_sim/dynamics/libreed_plant_dynamics.a",
                                     "plant_sim/libreed_plant_devices.a", "plant_sim/libreed_plant_endpoint.a"])
def test_no_elementary_function_is_the_c_librarys(library):
    symbols = subprocess.run(["nm", str(BUILD / library)], check=True, capture_output=True, text=True).stdout
    assert re.search(r" [TW] ", symbols) and [found[0] for found in ELEMENTARY.findall(symbols)] == []


def test_every_source_is_compiled_for_the_same_bits():
    commands = json.loads((BUILD / "compile_commands.json").read_text())
    wrong = {entry["file"] for entry in commands
             if "-ffp-contract=off" not in entry["command"] or (".cc" in entry["file"] and "-DEIGEN_DONT_VECTORIZE" not in entry["command"])}
    assert len(commands) > 50 and wrong == set()
