"""Laws that come in from outside: as a plug-in, as a Python file, and against the installed package."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import own_address
import pytest

from reed_tools.paths import BUILD, ROOT
from reed_tools.record.signals import join
from reed_tools.record.telemetry_log import load

BUS = own_address.bus()
EXAMPLE = ROOT / "examples" / "own_law"
LAW = """
#include <reed/law.h>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <unistd.h>
extern "C" {
#ifndef WITHOUT_VERSION
uint32_t reed_law_version() { return VERSION; }
#endif
uint32_t reed_law_traits() { return 0; }
size_t reed_law_state_size(const reed_law_setup*) { return 8; }
const char* reed_law_start(const reed_law_setup* setup, void*) { return setup->joints == JOINTS ? nullptr : "written for another number of joints"; }
int* kept;
void offend(const reed_law_input* in, reed_law_output* out) { (void)in; (void)out; SIN; }
void reed_law_step(const reed_law_input* in, void*, reed_law_output* out) {
  for (int i = 0; i < in->joints; ++i) out->torque[i] = 10.0 * in->s[i];
  offend(in, out);
}
}
"""
SINS = {"heap": "kept = new int[100]; delete[] kept", "system_calls": "getppid()", "prints": 'puts("here"); fflush(stdout)',
        "sleeps": "if (in->time_s > 4.0) usleep(1)", "exceptions": 'if (in->time_s > 0.1) throw std::runtime_error("not today")',
        "finite": "if (in->time_s > 0.1) out->torque[0] = NAN"}


def reed(*arguments: str) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, "-I", str(ROOT / "tools" / "reed_tools" / "__main__.py"), *arguments],
                          capture_output=True, text=True, timeout=300, env={**os.environ, "REED_BUILD_DIR": str(BUILD)})


@pytest.fixture(scope="module")
def prefix(tmp_path_factory) -> Path:
    """Where the package is installed."""
    folder = tmp_path_factory.mktemp("prefix")
    done = subprocess.run(["cmake", "--install", str(BUILD), "--prefix", str(folder)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return folder


@pytest.fixture(scope="module")
def example(prefix, tmp_path_factory) -> Path:
    """The example in a build tree of its own, against the installed package."""
    build = tmp_path_factory.mktemp("own_law")
    for command in (["cmake", "-G", "Ninja", "-S", str(EXAMPLE), "-B", str(build), f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Release"],
                    ["cmake", "--build", str(build)]):
        done = subprocess.run(command, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
    return build


@pytest.fixture(scope="module")
def compiled(prefix, tmp_path_factory):
    folder = tmp_path_factory.mktemp("laws")

    def compile_law(name: str, sin: str = "(void)0", *defines: str, version: int = 1, joints: int = 5) -> Path:
        source, library = folder / f"{name}.cc", folder / f"{name}.so"
        source.write_text(LAW)
        done = subprocess.run(["g++", "-std=c++20", "-shared", "-fPIC", "-O1", f"-I{prefix / 'include'}", f"-DSIN={sin}", f"-DVERSION={version}u",
                               f"-DJOINTS={joints}", *defines, str(source), "-o", str(library)], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return library

    return compile_law


def digest(folder: Path, *arguments: str) -> str:
    done = reed("run", "press_known", "--seed", "77", "--duration", "1", "--clock", "lockstep", "--bus", BUS, "--out", str(folder), *arguments)
    assert (folder / "summary.json").exists(), done.stderr
    return json.loads((folder / "summary.json").read_text())["digest"]


def test_pd_from_outside_is_the_built_in_pd_to_the_bit(example, tmp_path):
    built_in = digest(tmp_path / "built_in", "--set", 'control.law="pd"')
    plug_in = digest(tmp_path / "plug_in", "--law", str(example / "libown_law.so"), "--set", "control.Lambda=5")
    python = digest(tmp_path / "python", "--law", str(EXAMPLE / "own_law.py"), "--set", "control.Lambda=5")
    assert plug_in == built_in and python == built_in


def test_the_controller_runs_in_a_program_of_ones_own(example):
    """Two links of 1 m, 1 kg at the end of each, stretched out: g (1 + 2) and g N·m."""
    done = subprocess.run([str(example / "own_controller")], capture_output=True, text=True)
    assert done.stdout == "torque 29.430 9.810 N·m\n"


def test_an_installed_package_of_another_version_is_refused(prefix, tmp_path):
    source = tmp_path / "CMakeLists.txt"
    source.write_text("cmake_minimum_required(VERSION 3.25)\nproject(own LANGUAGES CXX)\nfind_package(reed 7.0 CONFIG REQUIRED)\n")
    done = subprocess.run(["cmake", "-G", "Ninja", "-S", str(tmp_path), "-B", str(tmp_path / "build"), f"-DCMAKE_PREFIX_PATH={prefix}"], capture_output=True, text=True)
    assert done.returncode and "version: 0.2.0" in done.stderr


C_LAW_WITH_VALUES = """
#include <reed/law.h>
uint32_t reed_law_version(void) { return REED_LAW_VERSION; }
uint32_t reed_law_traits(void) { return 0; }
size_t reed_law_state_size(const reed_law_setup* s) { (void)s; return 8; }
const char* reed_law_start(const reed_law_setup* s, void* state) { (void)s; (void)state; return 0; }
const char* const* reed_law_value_names(void) { static const char* const names[] = {NAMES}; return names; }
void reed_law_step(const reed_law_input* in, void* state, reed_law_output* out) {
  (void)state;
  for (int i = 0; i < in->joints; ++i) out->torque[i] = 10.0 * in->s[i];
  out->values[0] = in->time_s;
  out->values[1] = in->theta[1];
}
"""
PYTHON_LAW_WITH_VALUES = """
values = ("seconds", "elbow")
force_loop = deflection = False
def step(input, state):
    state.seconds, state.elbow = float(input.time_s), input.theta[1]
    return 10.0 * input.s
"""


def c_law(prefix: Path, folder: Path, names: str) -> Path:
    source, library = folder / "shows.c", folder / "shows.so"
    source.write_text(C_LAW_WITH_VALUES.replace("NAMES", names))
    done = subprocess.run(["gcc", "-shared", "-fPIC", "-O1", f"-I{prefix / 'include'}", str(source), "-o", str(library)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return library


@pytest.mark.parametrize("kind", ["shared library", "Python"])
def test_what_a_law_shows_is_recorded_under_its_names(prefix, tmp_path, kind):
    """In the log, in the signals, in summary.json, on the page and in an exported table: time and second angle as REED_MEASURED has it."""
    if kind == "Python":
        law = tmp_path / "shows.py"
        law.write_text(PYTHON_LAW_WITH_VALUES)
    else:
        law = c_law(prefix, tmp_path, '"seconds", "elbow", 0')
    folder = tmp_path / "run"
    done = reed("run", "press_known", "--duration", "0.5", "--clock", "lockstep", "--bus", "memory", "--out", str(folder), "--law", str(law))
    assert (folder / "summary.json").exists(), done.stderr
    recording = load(folder / "telemetry.lcmlog")
    assert recording.law_names == ["seconds", "elbow"]
    signals = join(recording)
    assert signals.law_names.tolist() == ["seconds", "elbow"] and len(signals.t) > 400
    assert np.array_equal(signals.law_values[:, 0], signals.t) and np.array_equal(signals.law_values[:, 1], signals.position[:, 1])
    scalars = json.loads((folder / "summary.json").read_text())["scalars"]
    assert (scalars["law.seconds"]["min"], scalars["law.seconds"]["last"]) == (0.0, signals.t[-1])
    assert "law.elbow" in (folder / "report.html").read_text()
    assert reed("export", str(folder), "--to", "csv").returncode == 0
    head = next(folder.glob("*.csv")).read_text().splitlines()[0].split(",")
    assert head[-2:] == ["law.seconds", "law.elbow"]


def test_a_law_that_shows_nothing_leaves_nothing(example, tmp_path):
    folder = tmp_path / "run"
    reed("run", "press_known", "--duration", "0.1", "--clock", "lockstep", "--bus", "memory", "--out", str(folder), "--law", str(example / "libown_law.so"))
    recording = load(folder / "telemetry.lcmlog")
    assert recording.law_names == [] and not recording.has("REED_LAW") and recording.has("REED_CONTROL")


@pytest.mark.parametrize("names", ['"a", "a", 0', '"", 0', '"1st", 0', '"a b", 0', ", ".join(f'"n{k}"' for k in range(9)) + ", 0"])
def test_names_that_no_column_can_have_are_refused(prefix, tmp_path, names):
    refuse(tmp_path, "allowed: ", "--law", str(c_law(prefix, tmp_path, names)))


REFUSED = {"another version": (dict(version=7), "built for version 7 of reed/law.h, allowed: 1"),
           "another number of joints": (dict(joints=4), "written for another number of joints"),
           "a missing function": (dict(sin="(void)0", defines=("-DWITHOUT_VERSION",)), "the function reed_law_version is missing")}


@pytest.mark.parametrize("case", REFUSED)
def test_a_library_that_does_not_fit_is_refused_before_anything_moves(compiled, tmp_path, case):
    options, line = REFUSED[case]
    options = dict(options)
    library = compiled(case.replace(" ", "_"), options.pop("sin", "(void)0"), *options.pop("defines", ()), **options)
    refuse(tmp_path, line, "--law", str(library))


def test_a_file_that_is_no_library_is_refused(tmp_path):
    text = tmp_path / "law.so"
    text.write_text("no library\n")
    refuse(tmp_path, "no library that can be loaded", "--law", str(text))
    refuse(tmp_path, "there is no file", "--law", str(tmp_path / "nowhere.so"))


PYTHON_LAWS = {"values = ('x',)\ndef step(input, state):\n    return input.s\n": "values names x, and state.x is no number after step",
               "values = ('x y',)\ndef step(input, state):\n    return input.s\n": "values = ('x y',); allowed: up to 8 different names",
               "def step(input, state):\n    return input.s[:2]\n": "step returned an array of shape (2,); allowed: (5,)",
               "def step(input, state):\n    return 1 / 0\n": "line 2: ZeroDivisionError",
               "def stop(input, state):\n    pass\n": "there is no function step(input, state)",
               "def step(input, state)\n": "SyntaxError"}


@pytest.mark.parametrize("text", PYTHON_LAWS)
def test_a_python_law_that_cannot_run_is_refused_before_anything_moves(tmp_path, text):
    law = tmp_path / "mine.py"
    law.write_text(text)
    refuse(tmp_path, PYTHON_LAWS[text], "--law", str(law))


def test_a_python_law_keeps_no_deadline(tmp_path):
    done = reed("run", "--law", str(EXAMPLE / "own_law.py"), "--out", str(tmp_path / "run"))
    assert done.returncode == 2 and "--clock lockstep" in done.stderr


def refuse(folder: Path, line: str, *arguments: str) -> None:
    done = reed("run", "press_known", "--clock", "lockstep", "--bus", BUS, "--out", str(folder / "run"), *arguments)
    assert done.returncode == 2 and line in done.stderr and done.stderr.count("\n") == 1, done.stderr
    assert not (folder / "run").exists()


def test_a_law_that_answers_no_number_trips(compiled, tmp_path):
    library = compiled("nan", SINS["finite"])
    done = reed("run", "press_known", "--duration", "1", "--clock", "lockstep", "--bus", BUS, "--out", str(tmp_path / "run"), "--law", str(library))
    assert done.returncode == 1 and "not a finite number" in done.stdout


@pytest.mark.parametrize(("sin", "proof"), [("heap", "heap"), ("system_calls", "system_calls"), ("prints", "system_calls"),
                                            ("sleeps", "system_calls"), ("exceptions", "exceptions")])
def test_the_budget_names_the_promise_and_the_function_that_broke_it(compiled, sin, proof):
    done = reed("budget", "--no-pinocchio", "--json", "--law", str(compiled(f"sin_{sin}", SINS[sin])))
    found = json.loads(done.stdout)
    assert done.returncode == 1 and found["broken"][0] == proof
    assert found[proof]["where"].startswith("offend") or found[proof]["where"] == "reed_law_step"


def test_the_budget_names_a_torque_that_is_no_number(compiled):
    done = reed("budget", "--no-pinocchio", "--law", str(compiled("sin_finite", SINS["finite"])))
    assert done.returncode == 1 and "not a finite number" in done.stdout


def test_the_example_keeps_every_promise(example):
    done = reed("budget", "--no-pinocchio", "--json", "--law", str(example / "libown_law.so"))
    found = json.loads(done.stdout)
    assert done.returncode == 0 and found["broken"] == [], done.stdout
    assert found["instructions"]["worst"] > 1000 and found["time"]["median_ns"] > 0
