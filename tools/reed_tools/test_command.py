"""tools/reed test: layout, unit tests, SocketCAN tests, whole runs. The bootstrap has built everything before this starts.

A filter selects by name: FILTER… runs every test whose name contains one of them."""

import os
import re
import subprocess
import sys
import time
from dataclasses import dataclass, field

from reed_tools import bus_choice, vm
from reed_tools.errors import UsageError
from reed_tools.paths import BUILD, ROOT

NOTHING_MATCHED = 5  # pytest's status when a filter leaves no test
CTEST_CLOSING = re.compile(r"tests passed|tests failed|Total Test time|\(Failed\)|\(Timeout\)|No tests were found|Not Run")
PYTEST_CLOSING = re.compile(r"^(=+ .*(passed|failed|error|deselected|no tests ran).* =+|FAILED |ERROR )")


@dataclass
class Stage:
    name: str
    command: list[str]
    closing: re.Pattern
    matched: bool = True
    ok: bool = False
    seconds: float = 0.0
    closing_lines: list[str] = field(default_factory=list)


def add_arguments(parser) -> None:
    parser.add_argument("filters", nargs="*", metavar="FILTER", help="only tests whose name contains one of these")


def run(arguments) -> int:
    stages = [stage for stage in all_stages(arguments.filters) if stage.matched]
    if not stages:
        raise UsageError(f"no test matches {' '.join(arguments.filters)}")
    for stage in stages:
        execute(stage)
    if arguments.filters and not any(stage.closing_lines for stage in stages):
        raise UsageError(f"no test matches {' '.join(arguments.filters)}")
    print()
    for stage in stages:
        print(f"{stage.name} ({stage.seconds:.0f} s)")
        for line in stage.closing_lines:
            print(line)
    return 0 if all(stage.ok for stage in stages) else 1


def all_stages(filters: list[str]) -> list[Stage]:
    layout = Stage("layout", ["clang-format-14", "--dry-run", "-Werror", *cpp_files()], re.compile("error:"))
    layout.matched = not filters or "layout" in filters
    return [layout, ctest("unit tests", filters, socketcan=False), ctest("SocketCAN tests", filters, socketcan=True),
            pytest("Python tests and whole runs", filters)]


def cpp_files() -> list[str]:
    listed = subprocess.run(["git", "ls-files", "*.h", "*.cc"], cwd=ROOT, capture_output=True, text=True).stdout.split()
    return [name for name in listed if (ROOT / name).exists()]


def ctest(name: str, filters: list[str], socketcan: bool) -> Stage:
    """The tests labelled socketcan need a CAN interface: the kernel's own where it has vcan, else the small VM's."""
    selection = ["-L", "socketcan"] if socketcan else ["-LE", "socketcan", "-j", str(len(os.sched_getaffinity(0)))]
    if filters:
        selection += ["-R", "|".join(re.escape(text) for text in filters)]
    junit = BUILD / ("socketcan-tests.xml" if socketcan else "unit-tests.xml")
    base = ["ctest", "--test-dir", str(BUILD), *selection]
    stage = Stage(name, [*base, "--output-on-failure", "--output-junit", str(junit)], CTEST_CLOSING)
    stage.matched = not filters or "Total Tests: 0" not in subprocess.run([*base, "-N"], capture_output=True, text=True).stdout
    if not filters:
        stage.command.append("--no-tests=error")
    if socketcan and not bus_choice.vcan_ready(bus_choice.VCAN):
        stage.name += ", in the small VM"
        stage.command = vm.command(stage.command)
    return stage


def pytest(name: str, filters: list[str]) -> Stage:
    command = [sys.executable, "-m", "pytest", "tests", f"--junit-xml={BUILD / 'python-tests.xml'}"]
    if filters:
        command += ["-k", " or ".join(re.sub(r"\W+", "_", text) for text in filters)]
    return Stage(name, command, PYTEST_CLOSING)


def execute(stage: Stage) -> None:
    print(f"== {stage.name}", flush=True)
    started = time.monotonic()
    environment = {**os.environ, "REED_BUILD_DIR": str(BUILD), "PYTHONDONTWRITEBYTECODE": "1"}
    process = subprocess.Popen(stage.command, cwd=ROOT, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True, errors="replace")
    for line in process.stdout:
        print(line, end="", flush=True)
        if stage.closing.search(line):
            stage.closing_lines.append(line.rstrip())
    status = process.wait()
    stage.seconds = time.monotonic() - started
    nothing = stage.closing is PYTEST_CLOSING and status == NOTHING_MATCHED
    stage.ok = status == 0 or nothing
    if nothing:
        stage.closing_lines.clear()
    elif not stage.closing_lines:
        stage.closing_lines = ["ok" if stage.ok else f"FAILED with status {status}"]
