"""Instructions of each stage of a benchmark program, exactly: its `--count` runs every input once inside one marked function,
and callgrind dumps its count after each of those calls."""

import json
import os
import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from reed_tools.errors import RunError

MARKED = "reed_bench_one"
HOW_TO_GET = "sudo apt install valgrind"
PART = re.compile(r"^desc: Trigger: (.*)$|^totals: (\d+)$", re.M)


@dataclass
class Count:
    worst: int   # of all inputs
    mean: float


def available() -> bool:
    return shutil.which("valgrind") is not None


def count(program: Path, *arguments: str) -> dict[str, Count]:
    """By stage."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder, "counts")
        done = subprocess.run(["valgrind", "--tool=callgrind", "--collect-atstart=no", "--combine-dumps=yes",
                               f"--toggle-collect={MARKED}", f"--dump-after={MARKED}",
                               f"--callgrind-out-file={out}", str(program), "--count", *arguments],
                              capture_output=True, text=True, timeout=600, env={**os.environ, "LD_BIND_NOW": "1"})
        if done.returncode:
            raise RunError(f"{program.name} under callgrind ended with status {done.returncode}: {done.stderr.strip()[-300:]}")
        totals = totals_after_calls(out.read_text())
    stages = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
    if len(totals) != sum(stage["calls"] for stage in stages):
        raise RunError(f"{program.name}: {len(totals)} calls counted, {sum(stage['calls'] for stage in stages)} made")
    found, at = {}, 0
    for stage in stages:
        mine = totals[at:at + stage["calls"]]
        found[stage["name"]] = Count(max(mine), sum(mine) / len(mine))
        at += stage["calls"]
    return found


def totals_after_calls(text: str) -> list[int]:
    """The parts that a marked call ended, in order; the last part is what the program's end adds."""
    totals, wanted = [], False
    for trigger, total in PART.findall(text):
        if trigger:
            wanted = MARKED in trigger
        elif wanted:
            totals.append(int(total))
    return totals
