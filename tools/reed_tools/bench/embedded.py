"""The controller on a Cortex-M7: cross-compiled, linked without a heap, run under qemu over a recorded closed loop; its torques beside the
host's and the firmware's."""

import re
import shutil
import struct
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from reed_tools.bench import programs
from reed_tools.errors import RunError
from reed_tools.paths import BUILD, PYTHON, ROOT, program
from reed_tools.record.telemetry_log import load

# Scenario and cycles: approach, contact and force mode; until after the sensor is lost, 2.0 s after the arm is active.
GENERATED = BUILD / "bus" / "generated"
RUNS = {"press_known": 1100, "press_sensor_loss": 2300}
JOINTS = 5
PORT = 46331
SAME_BITS = ["-ffp-contract=off"]  # cmake/ReedSameBits.cmake
MACHINE = ["-mcpu=cortex-m7", "-mthumb", "-mfpu=fpv5-d16", "-mfloat-abi=hard"]
COMMON = ["-std=c++20", "-O2", "-DNDEBUG", *SAME_BITS, "-DEIGEN_DONT_VECTORIZE", "-isystem", "/usr/include/eigen3"]
BARE = ["-fno-exceptions", "-fno-rtti", "-fno-threadsafe-statics", "-fno-use-cxa-atexit", "-ffunction-sections", "-fdata-sections"]
SOURCES = ["embedded/target/run_loop.cc", "bus/codec/messages.cc", "bus/codec/e2e_profile5.cc"]
ROOMS = ["reed_core", "reed_math", "reed_law_interface", "reed_law_names", "reed_frame", "reed_codec", "reed_embedded", "reed_sizes"]
# What must not be in a program without heap, exceptions, RTTI or locks.
FORBIDDEN = re.compile(r"malloc|calloc|realloc|\b_?free\b|operator new|operator delete|_sbrk|__cxa_throw|__cxa_allocate|_Unwind_(Raise|Resume)|"
                       r"__gxx_personality|__dynamic_cast|typeinfo|pthread|mutex")


@dataclass
class Loop:
    """One recorded loop, a row per cycle. target, host: torque commanded and torque as the drive reads it."""

    recorded: np.ndarray  # torque that the firmware commanded
    modes: np.ndarray
    sources: np.ndarray
    target: np.ndarray
    host: np.ndarray


@dataclass
class Proof:
    loops: dict[str, Loop]
    instructions: int         # of the longest step
    instructions_median: int
    stack_bytes: int
    flash_bytes: int          # without the recorded input
    ram_bytes: int            # static, without the stack's reserve
    symbols: list[str]        # that should not be there


def missing() -> list[str]:
    """What this machine lacks, with how to get it."""
    wanted = {"arm-none-eabi-g++": "gcc-arm-none-eabi libstdc++-arm-none-eabi-newlib", "qemu-system-arm": "qemu-system-arm"}
    return [f"{tool} (sudo apt install {packages})" for tool, packages in wanted.items() if not shutil.which(tool)]


def prove(folder: Path) -> Proof:
    target_objects = [compile_one("arm-none-eabi-g++", ROOT / source, folder, [*MACHINE, *COMMON, *BARE])
                      for source in (*SOURCES, "embedded/target/platform_mps2.cc")]
    target_objects.append(compile_one("arm-none-eabi-gcc", GENERATED / "reed.c", folder, [*MACHINE, "-O2", *SAME_BITS, "-ffunction-sections"]))
    host_objects = [compile_one("g++", ROOT / source, folder, COMMON) for source in (*SOURCES, "embedded/target/platform_host.cc")]
    host_objects.append(compile_one("gcc", GENERATED / "reed.c", folder, ["-O2", *SAME_BITS]))
    loops, figures = {}, []
    for scenario, cycles in RUNS.items():
        place = folder / scenario
        place.mkdir(parents=True, exist_ok=True)
        log = programs.run_programs(place, PORT, "lockstep", scenario=scenario).log
        recorded = record(place, scenario, log, cycles)
        elf, program_for_host = place / "controller.elf", place / "controller_host"
        data = compile_one("arm-none-eabi-g++", recorded, place, [*MACHINE, *COMMON, *BARE, "-O0"])
        run(["arm-none-eabi-g++", *MACHINE, "-nostartfiles", "-Wl,--gc-sections", "-T", str(ROOT / "embedded" / "target" / "mps2_an500.ld"),
             *map(str, target_objects), str(data), "-o", str(elf)])
        target, counted = run_under_qemu(elf)
        run(["g++", *map(str, host_objects), str(compile_one("g++", recorded, place, [*COMMON, "-O0"])), "-o", str(program_for_host)])
        host, _ = parse(run([str(program_for_host)]))
        control = load(log).tables["REED_CONTROL"]
        loops[scenario] = Loop(control["tau"][:cycles, :JOINTS], control["mode"][:cycles], control["force_source"][:cycles], target, host)
        figures.append(counted)
    sections = dict(re.findall(r"^(\.\S+)\s+(\d+)", run(["arm-none-eabi-size", "-A", str(elf)]), re.M))
    size = {name: int(value) for name, value in sections.items()}
    symbols = [line.split(maxsplit=2)[-1] for line in run(["arm-none-eabi-nm", "-C", str(elf)]).splitlines() if FORBIDDEN.search(line)]
    worst, median, stack = (max(counted[name] for counted in figures) for name in ("instructions", "instructions_median", "stack"))
    return Proof(loops, worst, median, stack, size.get(".text", 0) + size.get(".data", 0), size.get(".data", 0) + size.get(".bss", 0), symbols)


def record(folder: Path, scenario: str, log: Path, cycles: int) -> Path:
    """What the controller saw and was set to, as a source file."""
    settings, out = folder / "settings.inc", folder / "recorded_loop.cc"
    settings.write_text(run([str(program("reed_export_settings")), scenario]))
    types = BUILD / "lcmtypes" / "python"
    script = (f"import sys, runpy; sys.path.insert(0, {str(types)!r}); sys.argv = sys.argv[1:]; "
              "runpy.run_path(sys.argv[0], run_name='__main__')")
    run([*PYTHON, "-c", script, str(ROOT / "embedded" / "generate_loop.py"), str(settings), str(log), str(cycles), str(out)])
    return out


def run_under_qemu(elf: Path) -> tuple[np.ndarray, dict[str, int]]:
    done = subprocess.run(["qemu-system-arm", "-M", "mps2-an500", "-nographic", "-semihosting-config", "enable=on,target=native",
                           "-icount", "shift=0", "-kernel", str(elf)], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300)
    if done.returncode:
        raise RunError(f"the controller under qemu ended with status {done.returncode}: {done.stderr[-200:]}")
    return parse(done.stderr + done.stdout)


def compile_one(compiler: str, source: Path, folder: Path, flags: list[str]) -> Path:
    target = folder / f"{source.stem}-{compiler}.o"
    rooms = [f"-I{BUILD / 'rooms' / room}" for room in ROOMS]
    run([compiler, *flags, *rooms, f"-I{GENERATED}", "-c", str(source), "-o", str(target)])
    return target


def parse(text: str) -> tuple[np.ndarray, dict[str, int]]:
    rows, figures = [], {}
    for words in (line.split() for line in text.splitlines()):
        if len(words) == 2 and words[0].startswith(("instructions", "stack")):
            figures[words[0]] = int(words[1], 16)
        elif len(words) == 2 * JOINTS:
            rows.append([struct.unpack(">d", bytes.fromhex(word))[0] for word in words])
    return np.array(rows), figures


def run(command: list[str]) -> str:
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise RunError(f"{command[0]} failed: {(done.stderr or done.stdout)[-600:]}")
    return done.stdout
