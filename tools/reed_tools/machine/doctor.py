"""tools/reed doctor: what this machine can and cannot do, with the exact fix for each."""

import ctypes
import json
import os
import platform
import shutil
from dataclasses import asdict, dataclass
from pathlib import Path

from rich.text import Text

from reed_tools.machine import spy
from reed_tools.paths import ROOT
from reed_tools.run import bus_choice
from reed_tools.show.tables import console, grid
from reed_tools.text import plain

EXAMPLE = """examples:
  tools/reed doctor                                    # what is missing, with the command that adds it
  tools/reed doctor --json                             # the same for a script"""

MCL_CURRENT = 1
PRIORITY = 81  # one above the loop's usual one
ARPHRD_CAN = "280"
LIMITS_FIX = "echo '@realtime - rtprio 99\n@realtime - memlock unlimited' | sudo tee /etc/security/limits.d/reed.conf; " \
             "sudo groupadd -f realtime; sudo usermod -aG realtime $USER; log in again"


@dataclass
class Finding:
    subject: str
    good: bool
    detail: str
    fix: str = ""


def text(path: Path | str) -> str | None:
    """Of a file of the kernel's; None where this system has none."""
    try:
        return Path(path).read_text(errors="replace").strip()
    except OSError:
        return None


def can() -> Finding:
    if bus_choice.kernel_has_can():
        return Finding("SocketCAN", True, "in the kernel")
    return Finding("SocketCAN", False, f"kernel {platform.release()} has none",
                   "sudo modprobe can_raw (a kernel built with CAN); until then --bus vm or --bus udp")


def vcan() -> Finding:
    name = bus_choice.VCAN
    if bus_choice.interface_exists(name):
        return Finding(name, True, "exists")
    return Finding(name, False, "does not exist",
                   f"sudo modprobe vcan; sudo ip link add {name} type vcan; sudo ip link set {name} mtu 72 up")


def can_interfaces() -> Finding:
    found = [path.name for path in sorted(Path("/sys/class/net").glob("*"))
             if text(path / "type") == ARPHRD_CAN and not path.name.startswith("vcan")]
    fix = "sudo ip link set can0 up type can bitrate 1000000 dbitrate 5000000 fd on (docs/hil.md)"
    return Finding("CAN hardware", bool(found), ", ".join(found) or "no interface", "" if found else fix)


def small_vm() -> Finding:
    missing = [package for package, path in (("user-mode-linux", "linux.uml"), ("busybox-static", "busybox"), ("can-utils", "candump"))
               if not shutil.which(path)]
    return Finding("small VM (--bus vm)", not missing, "ready" if not missing else f"missing {', '.join(missing)}",
                   f"sudo apt-get install {' '.join(missing)}" if missing else "")


def multicast() -> Finding:
    good = bus_choice.multicast_works()
    return Finding("loopback multicast", good, "works" if good else "no route or switched off on lo",
                   "" if good else " && ".join(f"sudo {command}" for command in bus_choice.ROUTE_FIX))


def telemetry_url() -> Finding:
    url = os.environ.get("LCM_DEFAULT_URL")
    return Finding("telemetry (LCM)", True, f"LCM_DEFAULT_URL={url}" if url else "udpm://239.255.76.67:7667?ttl=0 (default)")


def scheduler() -> Finding:
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(PRIORITY))
        os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
        good = True
    except OSError:
        good = False
    return Finding(f"SCHED_FIFO priority {PRIORITY}", good, "granted" if good else "refused", "" if good else LIMITS_FIX)


def memory_lock() -> Finding:
    libc = ctypes.CDLL(None, use_errno=True)
    good = libc.mlockall(MCL_CURRENT) == 0
    if good:
        libc.munlockall()
    return Finding("memory lock", good, "granted" if good else os.strerror(ctypes.get_errno()), "" if good else LIMITS_FIX)


def kernel_preemption() -> Finding:
    realtime = Path("/sys/kernel/realtime").exists()
    version = os.uname().version
    model = "PREEMPT_RT" if realtime else "PREEMPT_DYNAMIC" if "PREEMPT_DYNAMIC" in version else "not PREEMPT_RT"
    return Finding("kernel preemption", realtime, model,
                   "" if realtime else "sudo apt-get install linux-image-rt-amd64; reboot (better wake-up latency)")


def throttling() -> Finding:
    value, period = (text(f"/proc/sys/kernel/sched_rt_{name}_us") for name in ("runtime", "period"))
    if value is None:
        return Finding("real-time throttling", True, "this kernel has none")
    off = value == "-1"
    return Finding("real-time throttling", off, "off" if off else f"{value} of {period} µs",
                   "" if off else "matters only above 95 % load: sudo sysctl kernel.sched_rt_runtime_us=-1")


def governor() -> Finding:
    files = sorted(Path("/sys/devices/system/cpu").glob("cpu[0-9]*/cpufreq/scaling_governor"))
    found = sorted({text(file) or "unknown" for file in files})
    if not files:
        return Finding("CPU governor", True, "not under this system's control")
    good = found == ["performance"]
    return Finding("CPU governor", good, ", ".join(found),
                   "" if good else "echo performance | sudo tee /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor")


def processors() -> Finding:
    count = len(os.sched_getaffinity(0))
    isolated = text("/sys/devices/system/cpu/isolated")
    return Finding("processors", count >= 2, f"{count} usable, isolated: {isolated or 'none'}",
                   "" if count >= 2 else "the loop shares its core with everything else: give the machine a second one")


def java() -> Finding:
    missing = spy.missing_packages()
    return Finding("Java for spy", not missing, "ready" if not missing else f"missing {', '.join(missing)}",
                   f"sudo apt-get install {' '.join(missing)}" if missing else "")


def disk() -> Finding:
    free = shutil.disk_usage(ROOT).free / 2**30
    return Finding("free disk", free > 2, f"{free:.0f} GiB", "" if free > 2 else "a minute of records takes about 0.1 GB")


FINDINGS = (can, vcan, can_interfaces, small_vm, multicast, telemetry_url, scheduler, memory_lock, kernel_preemption,
            throttling, governor, processors, java, disk)


def diagnosed(finding) -> Finding:
    """A machine that does not even answer is one more finding."""
    try:
        return finding()
    except (OSError, ValueError) as error:
        return Finding(finding.__name__.replace("_", " "), False, f"cannot be found out: {error}")


def add_arguments(parser) -> None:
    parser.add_argument("--json", action="store_true", help="print {system, findings: [{subject, good, detail, fix}], buses}")


def run(arguments) -> int:
    system = f"{platform.system()} {platform.release()}, {platform.machine()}"
    found = [diagnosed(finding) for finding in FINDINGS]
    buses = usable_buses(found)
    if arguments.json:
        print(json.dumps({"system": system, "findings": [asdict(item) for item in found], "buses": buses}))
    else:
        show(system, found, buses)
    return 0


def usable_buses(found: list[Finding]) -> list[str]:
    buses = {bus_choice.VCAN: f"socketcan:{bus_choice.VCAN}", "loopback multicast": "udp", "small VM (--bus vm)": "vm"}
    return [buses[item.subject] for item in found if item.good and item.subject in buses]


def show(system: str, found: list[Finding], buses: list[str]) -> None:
    table = grid(system, "what", "", "found", numbers=False)
    for item in found:
        table.add_row(item.subject, Text("yes", "green") if item.good else Text("no", "yellow"), plain(item.detail))
    out = console()
    out.print(table)
    for item in found:
        if item.fix:
            out.print(Text(item.subject, "bold"), f": {item.fix}", sep="", soft_wrap=True, highlight=False)
    out.print(f"run works here with --bus {' or '.join(buses)}" if buses else "run works here over no bus yet, see above", highlight=False)
