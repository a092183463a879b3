"""Hours of virtual time: both programs' memory stands still, no counter runs over, nothing is lost. In every test 10 s, in the
long mode 24 h, each across the end of the 32-bit cycle number."""

import os
import subprocess
import time

import pytest
from long_mode import LONG, how_many

from reed_tools.paths import build, program
from reed_tools.run import scenario

DURATION_S = how_many(10, 86400)
FIRST = 2**32 - 5_000
GROWTH_KB = 2000     # of the resident set after the first quarter: less than a byte in 30 cycles in the long mode
LOOK_S = 10.0 if LONG else 0.05
# Rigid links, because the physics of bending costs ten times the rest; noise, friction, contact, adaptation and observer are all on.
SETTINGS = [f"scenario.duration_s={DURATION_S}", f"timing.first_cycle={FIRST}", "plant.flexible_links=false", "force.end_s=1000000"]


def resident_kb(pid: int) -> int:
    with open(f"/proc/{pid}/status") as status:
        return int(next(line.split()[1] for line in status if line.startswith("VmRSS")))


@pytest.mark.skipif(not os.path.exists("/proc/self/status"), reason="no /proc")
def test_memory_and_counters_over_the_hours(tmp_path):
    build("reed_one_process")
    scenario.write_effective("press_known", None, SETTINGS, tmp_path / "effective.toml")
    with open(tmp_path / "output.txt", "wb") as output:
        both = subprocess.Popen([str(program("reed_one_process")), "--config", str(tmp_path / "effective.toml"), "--no-lcm", "--enable",
                                 "--log", "/dev/null", "--plant-log", "/dev/null", "--candump", "/dev/null", "--tape", "/dev/null"],
                                stdout=output, stderr=output)
    try:
        seen = []
        while "brakes released" not in (tmp_path / "output.txt").read_text() and both.poll() is None:
            time.sleep(0.05)
        while both.poll() is None:
            try:
                seen.append(resident_kb(both.pid))
            except (OSError, StopIteration):  # it has just ended
                break
            time.sleep(LOOK_S)
    finally:
        both.kill()
        status = both.wait()
    said = (tmp_path / "output.txt").read_text()
    assert status == 0, said
    cycles = round(DURATION_S * 1000)
    done = [line for line in said.splitlines() if line.startswith("done:")]
    assert len(done) == 2 and all(cycles < int(line.split()[1]) < cycles + 3000 for line in done), said
    assert "0 missed, in the loop: 0 heap allocations" in said and "0 frames refused, 0 records dropped" in said
    late = seen[len(seen) // 4:]  # buffers have been used to their ends
    assert late and max(late) - late[0] < GROWTH_KB, seen
