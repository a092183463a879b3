"""The control core on a Cortex-M7: cross-compiled, linked without a heap, run under qemu; its results beside the host's."""

import re
import shutil
import struct
import subprocess
from dataclasses import dataclass
from pathlib import Path

from reed_tools.errors import RunError
from reed_tools.paths import BUILD, ROOT

MACHINE = ["-mcpu=cortex-m7", "-mthumb", "-mfpu=fpv5-d16", "-mfloat-abi=hard"]
COMMON = ["-std=c++20", "-O2", "-DNDEBUG", f"-I{ROOT}", "-isystem", "/usr/include/eigen3"]
BARE = ["-fno-exceptions", "-fno-rtti", "-fno-threadsafe-statics", "-fno-use-cxa-atexit", "-ffunction-sections", "-fdata-sections"]
CORE = ["embedded/core.cc", "embedded/run_cases.cc", "bus/messages.cc", "bus/e2e_profile5.cc"]
CASES = ROOT / "tests" / "data" / "cases" / "ctrl_A5.json"
# What must not be in a program without heap, exceptions, RTTI or locks.
FORBIDDEN = re.compile(r"malloc|calloc|realloc|\b_?free\b|operator new|operator delete|_sbrk|__cxa_throw|__cxa_allocate|_Unwind_(Raise|Resume)|"
                       r"__gxx_personality|__dynamic_cast|typeinfo|pthread|mutex")


@dataclass
class Proof:
    target: list[list[float]]  # one row of numbers per case
    host: list[list[float]]
    instructions: int          # of the longest step
    stack_bytes: int
    flash_bytes: int
    ram_bytes: int             # static, without the stack's reserve
    symbols: list[str]         # that should not be there


def missing() -> list[str]:
    """What this machine lacks, with how to get it."""
    wanted = {"arm-none-eabi-g++": "gcc-arm-none-eabi libstdc++-arm-none-eabi-newlib", "qemu-system-arm": "qemu-system-arm"}
    return [f"{tool} (sudo apt install {packages})" for tool, packages in wanted.items() if not shutil.which(tool)]


def prove(folder: Path) -> Proof:
    image = folder / "arm_image.inc"
    image.write_text(run([str(BUILD / "bin" / "reed_export_arm"), "a5"]))
    run(["python3", str(ROOT / "embedded" / "generate_cases.py"), str(image), str(CASES), str(folder / "embedded_data.h")])
    generated = BUILD / "bus" / "generated"
    include = [f"-I{folder}", f"-I{generated}"]
    codec = compile_one("arm-none-eabi-gcc", generated / "reed.c", folder, [*MACHINE, "-O2", "-ffunction-sections", *include])
    objects = [compile_one("arm-none-eabi-g++", ROOT / source, folder, [*MACHINE, *COMMON, *BARE, *include])
               for source in (*CORE, "embedded/platform_mps2.cc")]
    elf = folder / "core.elf"
    run(["arm-none-eabi-g++", *MACHINE, "-nostartfiles", "-Wl,--gc-sections", "-T", str(ROOT / "embedded" / "mps2_an500.ld"),
         *map(str, objects), str(codec), "-o", str(elf)])
    done = subprocess.run(["qemu-system-arm", "-M", "mps2-an500", "-nographic", "-semihosting-config", "enable=on,target=native",
                           "-icount", "shift=0", "-kernel", str(elf)], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120)
    if done.returncode:
        raise RunError(f"the core under qemu ended with status {done.returncode}: {done.stderr[-200:]}")
    target, figures = parse(done.stderr + done.stdout)
    host_codec = compile_one("gcc", generated / "reed.c", folder, ["-O2", *include])
    program = folder / "core_host"
    run(["g++", *COMMON, *include, *(str(ROOT / source) for source in (*CORE, "embedded/platform_host.cc")), str(host_codec), "-o", str(program)])
    host, _ = parse(run([str(program)]))
    sections = dict(re.findall(r"^(\.\S+)\s+(\d+)", run(["arm-none-eabi-size", "-A", str(elf)]), re.M))
    size = {name: int(value) for name, value in sections.items()}
    symbols = [line.split(maxsplit=2)[-1] for line in run(["arm-none-eabi-nm", "-C", str(elf)]).splitlines() if FORBIDDEN.search(line)]
    return Proof(target, host, figures["instructions"], figures["stack"], size.get(".text", 0) + size.get(".data", 0),
                 size.get(".data", 0) + size.get(".bss", 0), symbols)


def compile_one(compiler: str, source: Path, folder: Path, flags: list[str]) -> Path:
    target = folder / f"{source.stem}-{compiler}.o"
    run([compiler, *flags, "-c", str(source), "-o", str(target)])
    return target


def parse(text: str) -> tuple[list[list[float]], dict[str, int]]:
    rows, figures = [], {}
    for words in (line.split() for line in text.splitlines()):
        if len(words) == 2 and words[0] in ("instructions", "stack"):
            figures[words[0]] = int(words[1], 16)
        elif len(words) > 2:
            rows.append([struct.unpack(">d", bytes.fromhex(word))[0] for word in words])
    return rows, figures


def run(command: list[str]) -> str:
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise RunError(f"{command[0]} failed: {(done.stderr or done.stdout)[-600:]}")
    return done.stdout
