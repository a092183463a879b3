"""Every scenario at its full length by the whole of reed_one_process: one digest from every compiler, optimisation and processor."""

import os
import re
import shlex
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from processors import OLD_LIBM, PLAIN

from reed_tools.gate import corpus, kept
from reed_tools.paths import BUILD, ROOT, build
from reed_tools.record import tape
from reed_tools.run import joints

pytestmark = pytest.mark.long
JOBS = len(os.sched_getaffinity(0))
CROSS, SYSROOT = "aarch64-linux-gnu-g++", "/usr/aarch64-linux-gnu"
EMULATED = ["qemu-aarch64", "-L", SYSROOT]
BUILDS = {"gcc -O2": ("g++", "-O2", []), "clang -O2": ("clang++-14", "-O2", []), "clang -O3": ("clang++-14", "-O3", []),
          "aarch64 -O2": (CROSS, "-O2", EMULATED), "aarch64 -O3": (CROSS, "-O3", EMULATED)}
HEADERS = ("lcm", "toml++", "CLI", "nlohmann")  # of /usr/include, the same for every processor
NO_LCM = "".join(f"void* {name}() {{ return 0; }}\n" for name in
                 ("lcm_create", "lcm_destroy", "lcm_publish", "lcm_eventlog_create", "lcm_eventlog_destroy", "lcm_eventlog_write_event"))


@pytest.fixture(scope="module")
def scenarios():
    """Each as it is, not cut as in the gate's corpus."""
    build("reed_one_process")
    found = corpus.scenarios(longest_s=3600.0)
    assert len(found) >= 12 and {entry.joints for entry in found} <= joints.built()
    return found


def digests(command: list[str], scenarios, folder: Path, **environment: str) -> dict[str, str]:
    signals = kept.of_checkout().signals

    def one(entry: corpus.Entry) -> str:
        target = folder / f"{entry.name}.reed"
        done = subprocess.run([*command, *entry.options(), "--enable", "--no-lcm", "--quiet", "--tape", str(target)],
                              env={**os.environ, **environment}, capture_output=True, text=True)
        assert done.returncode in (0, 1), f"{entry.name}: {done.stderr[-500:]}"
        found = kept.digest(tape.read(target), signals)
        target.unlink()
        return found

    with ThreadPoolExecutor(JOBS) as pool:
        return dict(zip([entry.name for entry in scenarios], pool.map(one, scenarios)))


@pytest.fixture(scope="module")
def reference(scenarios, tmp_path_factory):
    """By GCC at -O3, on this processor."""
    found = digests([str(BUILD / "bin" / "reed_one_process")], scenarios, tmp_path_factory.mktemp("reference"))
    print("".join(f"\n{name:<22} {digest}" for name, digest in found.items()))
    assert len(set(found.values())) == len(found)
    return found


def translated(command: str, compiler: str, level: str, folder: Path) -> tuple[list[str], Path]:
    """A compile command of the release build for another compiler, and the object that it makes."""
    words = shlex.split(command)
    words = words[next(k for k, word in enumerate(words) if re.search(r"(\+\+|cc)(-\d+)?$", word) and "ccache" not in word) + 1:]
    made = folder / words[words.index("-o") + 1].replace("/", "_")
    out, skip = [], False
    for k, word in enumerate(words):
        if word.endswith("/cmake_pch.hxx"):  # another compiler takes the text and not GCC's precompiled header beside it
            words[k] = str(folder / word.strip("/").replace("/", "_"))
            shutil.copy(word, words[k])
    for word in words:
        if skip or word in ("-MD", "-o", "-MF", "-MT") or re.match(r"-W|-O[0-3s]$|--param=inline", word):
            skip = not skip and word in ("-o", "-MF", "-MT")
            continue
        out.append({"-DTOML_HEADER_ONLY=0": "-DTOML_HEADER_ONLY=1", "-DTOML_SHARED_LIB=1": ""}.get(word, word) if compiler == CROSS else word)
    roots = ["-isystem", str(folder / "include")] if compiler == CROSS else []
    if "-std=c++20" not in out:
        compiler = {"g++": "gcc", "clang++-14": "clang-14", CROSS: CROSS.replace("g++", "gcc")}[compiler]
    return [compiler, *filter(None, out), level, "-w", *roots, "-o", str(made)], made


def built_by(compiler: str, level: str, folder: Path) -> Path:
    """reed_one_process, from the release build's own commands."""
    lines = subprocess.run(["ninja", "-C", str(BUILD), "-t", "commands", "reed_one_process"], check=True, capture_output=True, text=True).stdout.splitlines()
    compiled = [translated(line, compiler, level, folder) for line in lines if re.search(r" -c \S+\.(?:cc?|cxx)$", line)
                and "cmake_pch" not in line.rpartition(" -c ")[2]]
    assert len(compiled) > 80
    (folder / "include").mkdir()
    for name in HEADERS:
        (folder / "include" / name).symlink_to(f"/usr/include/{name}")
    launcher = ["ccache"] if shutil.which("ccache") else []

    def compile_one(job) -> str:
        done = subprocess.run([*launcher, *job[0]], cwd=BUILD, capture_output=True, text=True)
        assert done.returncode == 0, " ".join(job[0]) + "\n" + done.stderr[-2000:]
        return str(job[1])

    with ThreadPoolExecutor(JOBS) as pool:
        objects = list(pool.map(compile_one, compiled))
    libraries = ["-llcm", "-ltomlplusplus"]
    if compiler == CROSS:
        (folder / "no_lcm.c").write_text(NO_LCM)
        libraries = ["-x", "c", str(folder / "no_lcm.c")]
    program = folder / "reed_one_process"
    done = subprocess.run([compiler, *objects, "-o", str(program), "-pthread", "-ldl", *libraries], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-3000:]
    return program


@pytest.mark.parametrize("name", BUILDS)
def test_another_build_gives_the_same(name, scenarios, reference, tmp_path):
    compiler, level, runner = BUILDS[name]
    program = built_by(compiler, level, tmp_path)
    assert digests([*runner, str(program)], scenarios, tmp_path) == reference


@pytest.mark.parametrize("runner, environment", [([], OLD_LIBM), (PLAIN, {})], ids=["glibc without AVX and FMA", "processor without AVX and FMA"])
def test_another_processor_gives_the_same(runner, environment, scenarios, reference, tmp_path):
    assert digests([*runner, str(BUILD / "bin" / "reed_one_process")], scenarios, tmp_path, **environment) == reference
