"""What `tools/reed test` consists of: one stage per runner."""

import os
import re
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

from reed_tools.paths import BUILD, PYTHON, ROOT
from reed_tools.run import bus_choice, vm

CORES = len(os.sched_getaffinity(0))
CTEST_CLOSING = re.compile(r"tests passed|tests failed|Total Test time|\(Failed\)|\(Timeout\)|No tests were found|Not Run")
PYTEST_CLOSING = re.compile(r"^(=+ .*(passed|failed|error|deselected|no tests ran).* =+|FAILED |ERROR )")
GTEST_CLOSING = re.compile(r"^\[  (PASSED|FAILED)  \]|Sanitizer: |runtime error:")
TIDY_CLOSING = re.compile(r"(error|warning): .*\[[\w.-]+")
PYTEST_NO_TEST = 5
MOST_WORKERS = 3  # one of them has the runs by the clock, as long as the others together need for the rest

# By Clang: 28 s of processor time for the controller's cycle, GCC's sanitizers take 64.
CLANG = "-DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14"
# Addresses and undefined behaviour: bytes from outside, broken ones too, the laws, the whole cycle with the plant behind it. Both
# in one build, which costs half of two (CMakePresets.json). Threads: those of rt and of the recorder.
SANITIZED = {"asan": ("bus_test", "frame_fuzz_test", "rt_test", "telemetry_test", "strategy_test", "cycle_test", "plant_devices_test", "plant_link_test"),
             "tsan": ("rt_test", "telemetry_test")}


@dataclass
class Stage:
    name: str
    command: list[str]
    closing: re.Pattern
    nothing_to_do: tuple[int, ...] = ()   # statuses that mean: the filter left nothing
    before: str | None = None             # what `command` needs; silent, and what it fails at `command` says
    leaves_time: bool = False             # it waits for clocks: the `before` of later stages may go on beside it
    results: list[Path] = field(default_factory=list)  # JUnit files that its runner writes
    ok: bool = False
    seconds: float = 0.0
    closing_lines: list[str] = field(default_factory=list)


LONGEST_TEST_S = 86400  # in the long mode


def all_stages(filters: list[str], long: bool = False) -> list[Stage]:
    """In the order of running: quick ones first. The sanitizers are compiled while the runs of the Python stage wait for clocks."""
    def wanted(name: str) -> bool:
        return not filters or name in filters

    stages = [layout()] if wanted("layout") else []
    if wanted("tidy"):
        stages.append(tidy(everything="tidy" in filters))
    if wanted("gate"):
        stages.append(gate())
    names = [text for text in filters if text not in ("layout", "tidy", "gate", *SANITIZED)]
    if names or not filters:
        stages += [ctest(names, False, long), ctest(names, True, long), pytest(names)]
    stages += [sanitizer(name) for name in SANITIZED if wanted(name)]
    return [stage for stage in stages if stage]


def tracked(*patterns: str) -> list[str]:
    listed = subprocess.run(["git", "ls-files", *patterns], cwd=ROOT, capture_output=True, text=True).stdout.split()
    return [name for name in listed if (ROOT / name).exists()]


def changed_last(files: list[str]) -> list[str]:
    """Those of `files` that differ from the commit before the last one."""
    done = subprocess.run(["git", "diff", "--name-only", "HEAD~1"], cwd=ROOT, capture_output=True, text=True)
    return [name for name in files if name in set(done.stdout.split())]


def gate() -> Stage:
    """Against the last commit of main, by the digests that it keeps."""
    command = [*PYTHON, str(ROOT / "tools" / "reed_tools" / "__main__.py"), "gate", "--quick"]
    return Stage("gate: behaviour against the last commit of main", command, re.compile("."))


def layout() -> Stage:
    return Stage("layout: clang-format", ["clang-format-14", "--dry-run", "-Werror", *tracked("*.h", "*.cc")], re.compile("error:"))


def tidy(everything: bool) -> Stage | None:
    database = database_for_clang()
    built = (database / "compile_commands.json").read_text()  # the other side of a bench is built only where it is installed
    files = [name for name in tracked("*.cc") if f'{ROOT / name}"' in built]
    if not everything:
        files = changed_last(files)
    if not files:
        return None
    # It counts what it suppresses in the headers of others; a finding of ours is an error with its own lines.
    run = (f"printf '%s\\n' {' '.join(files)} | xargs -P {CORES} -n 1 clang-tidy-14 --quiet -p {database} "
           "2> >(grep -Ev '^[0-9]+ warnings? generated' >&2)")
    return Stage(f"tidy: {len(files)} files", ["bash", "-c", run], TIDY_CLOSING)


def database_for_clang() -> Path:
    """The folder of a compilation database without GCC's precompiled headers, which clang cannot read."""
    folder = BUILD / "tidy"
    folder.mkdir(exist_ok=True)
    commands = (BUILD / "compile_commands.json").read_text()
    (folder / "compile_commands.json").write_text(re.sub(r"-Winvalid-pch -include \S+/cmake_pch\.hxx ", "", commands))
    return folder


def ctest(names: list[str], socketcan: bool, long: bool = False) -> Stage | None:
    """The tests labelled socketcan need a CAN interface: the kernel's own where it has vcan, else the small VM's."""
    selection = ["-L", "socketcan"] if socketcan else ["-LE", "socketcan", "-j", str(CORES)]
    if long:
        selection += ["--timeout", str(LONGEST_TEST_S)]
    if names:
        selection += ["-R", "|".join(re.escape(text) for text in names)]
    base = ["ctest", "--test-dir", str(BUILD), *selection]
    if names and "Total Tests: 0" in subprocess.run([*base, "-N"], capture_output=True, text=True).stdout:
        return None
    junit = BUILD / ("socketcan-tests.xml" if socketcan else "unit-tests.xml")
    stage = Stage("SocketCAN tests" if socketcan else "unit tests",
                  [*base, "--no-tests=error", "--output-on-failure", "--output-junit", str(junit)], CTEST_CLOSING,
                  results=[junit])
    if socketcan and not bus_choice.vcan_ready(bus_choice.VCAN):
        stage.name += ", in the small VM"
        stage.command = vm.command(stage.command)
    return stage


def pytest(names: list[str]) -> Stage:
    junit = BUILD / "python-tests.xml"
    command = [sys.executable, "-m", "pytest", "tests", f"--junit-xml={junit}"]
    if not names:
        command += ["-n", str(min(CORES, MOST_WORKERS)), "--dist", "loadscope"]  # tests/conftest.py says what stays together
    else:
        command += ["-k", " or ".join(re.sub(r"\W+", "_", text) for text in names)]
    return Stage("Python tests and whole runs", command, PYTEST_CLOSING, nothing_to_do=(PYTEST_NO_TEST,) if names else (), leaves_time=True, results=[junit])


def sanitizer(name: str) -> Stage:
    build, targets = ROOT / "build" / name, SANITIZED[name]
    compiled = f"ninja -C {build} -j {CORES} {' '.join(targets)} >>{build}.log"
    configured = f"cmake --fresh --preset {name} {CLANG} -DREED_PYTHON={sys.executable} -DREED_JOINTS=5 >{build}.log"
    steps = [compiled,
             # A sanitizer has an allocator of its own, which HeapCountTest cannot count, and makes system calls of its own, which
             # the guard of the loop's calls rightly kills; a thread sanitizer's shadow memory is too large to be locked.
             *(f"{build}/bin/{target} --gtest_brief=1 --gtest_filter=-SyscallGuard.*:RealtimeScope.*:HeapCountTest.* --gtest_output=xml:{build / target}.xml"
               for target in targets)]
    return Stage(f"{name}: {', '.join(targets)}", ["bash", "-c", " && ".join(steps) + f" || {{ tail -5 {build}.log; exit 1; }}"],
                 GTEST_CLOSING, before=f"{configured} && {compiled}", results=[build / f"{target}.xml" for target in targets])
