"""What machine this is."""

import os
import platform
from pathlib import Path


def description() -> dict:
    info = Path("/proc/cpuinfo")
    lines = info.read_text(errors="replace").splitlines() if info.exists() else []
    governor = Path("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor")
    return {"cpu": next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), platform.machine()),
            "cores": len(os.sched_getaffinity(0)), "kernel": platform.release(),
            "preempt_rt": Path("/sys/kernel/realtime").exists(),
            "virtual": any("hypervisor" in line.split() for line in lines if line.startswith("flags")),
            "governor": governor.read_text().strip() if governor.exists() else "unknown"}
