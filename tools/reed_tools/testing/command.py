"""tools/reed test: every test there is. The bootstrap has built everything before this starts.

A filter selects by name: FILTER… runs every test whose name contains one of them, and the stages of that name
(layout, tidy, gate, asan, tsan). Without a filter clang-tidy reads the files that changed last; `test tidy` reads all."""

import os
import signal
import subprocess
import time

from reed_tools.errors import UsageError
from reed_tools.paths import BUILD, ROOT
from reed_tools.testing.skips import complaints
from reed_tools.testing.stages import Stage, all_stages

EXAMPLE = """examples:
  tools/reed test                                      # everything
  tools/reed test test_live force                      # tests whose name contains one of these
  tools/reed test --long fuzz flood                    # those and the long ones in full: an hour, not seconds"""


def add_arguments(parser) -> None:
    parser.add_argument("--ci", action="store_true", help="a test that is skipped fails, but for those that a machine's kernel or rights decide "
                                                          "(tools/reed_tools/testing/skips.py)")
    parser.add_argument("--long", action="store_true", help="the long tests, too, and those of endurance in full: 10^8 broken frames to each receiver, 10^4 broken files of each kind")
    parser.add_argument("filters", nargs="*", metavar="FILTER",
                        help="only tests whose name contains one of these, or a stage: layout, tidy, gate, asan, tsan")


def run(arguments) -> int:
    stages = all_stages(arguments.filters, arguments.long)
    beside = None
    try:
        for place, stage in enumerate(stages):
            if stage.leaves_time and not beside:
                beside = prepare(stages[place + 1:], idle=True)
            execute(stage, no_skips=arguments.ci, long=arguments.long, prepared=beside)
    finally:
        if beside and beside.poll() is None:
            os.killpg(beside.pid, signal.SIGTERM)
    done = [stage for stage in stages if stage.closing_lines]
    if not done:
        raise UsageError(f"no test matches {' '.join(arguments.filters)}")
    print()
    for stage in done:
        print(f"{stage.name} ({stage.seconds:.0f} s)")
        for line in stage.closing_lines:
            print(line)
    return 0 if all(stage.ok for stage in done) else 1


def own_environment() -> dict[str, str]:
    """Without the caller's PYTHON variables."""
    return {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}


def prepare(stages: list[Stage], idle: bool = False) -> subprocess.Popen:
    """Begins what the stages need. idle: it gets the time that a processor has nothing else to do."""
    needed = " ; ".join(stage.before for stage in stages if stage.before) or "true"
    return subprocess.Popen([*(["chrt", "--idle", "0"] if idle else []), "bash", "-c", needed], cwd=ROOT, env=own_environment(),
                            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, process_group=0)


def execute(stage: Stage, no_skips: bool = False, long: bool = False, prepared: subprocess.Popen | None = None) -> None:
    """Streams the stage's output and keeps its runner's closing lines."""
    for path in stage.results:
        path.unlink(missing_ok=True)
    print(f"== {stage.name}", flush=True)
    started = time.monotonic()
    if stage.before:
        (prepared or prepare([stage])).wait()
    environment = {**own_environment(), "REED_BUILD_DIR": str(BUILD), "PYTHONDONTWRITEBYTECODE": "1", "REED_LONG": "1" if long else "0"}
    process = subprocess.Popen(stage.command, cwd=ROOT, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True, errors="replace")
    for line in process.stdout:
        print(line, end="", flush=True)
        if stage.closing.search(line):
            stage.closing_lines.append(line.rstrip())
    status = process.wait()
    stage.seconds = time.monotonic() - started
    if status in stage.nothing_to_do:
        stage.closing_lines.clear()
        return
    skips = complaints(stage.results) if no_skips else []
    stage.ok = status == 0 and not skips
    stage.closing_lines += skips
    if not stage.closing_lines:
        stage.closing_lines = ["ok" if stage.ok else f"FAILED with status {status}"]
