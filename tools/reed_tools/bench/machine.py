"""What machine a benchmark ran on, and what else kept it busy meanwhile."""

import os
import time
from pathlib import Path

from reed_tools.record.machine import description

BUSY, STOLEN = 0.10, 0.01  # shares from which figures are not to be trusted
LOOK_S = 1.0


def jiffies() -> dict[str, int]:
    names = ("user", "nice", "system", "idle", "iowait", "irq", "softirq", "steal")
    return dict(zip(names, map(int, Path("/proc/stat").read_text().split("\n")[0].split()[1:])))


class Machine:
    """Looks for a second at what others do before anything is measured; finish() looks at what was stolen and done by others."""

    def __init__(self) -> None:
        self.what = description()
        first = jiffies()
        time.sleep(LOOK_S)
        self.start, self.started = jiffies(), os.times()
        self.busy_before = 1.0 - self.share(first, self.start, "idle", "iowait")
        self.stolen = self.others = 0.0

    @staticmethod
    def share(before: dict[str, int], after: dict[str, int], *names: str) -> float:
        total = sum(after.values()) - sum(before.values())
        return sum(after[name] - before[name] for name in names) / total if total else 0.0

    def finish(self) -> None:
        now, mine = jiffies(), os.times()
        total = sum(now.values()) - sum(self.start.values())
        own = sum(mine[:4]) - sum(self.started[:4])
        self.stolen = self.share(self.start, now, "steal")
        busy = self.share(self.start, now, "user", "nice", "system")
        self.others = max(0.0, busy - own * os.sysconf("SC_CLK_TCK") / total) if total else 0.0

    def noise(self) -> str:
        found = [f"{100 * self.busy_before:.0f} % busy before the start"] if self.busy_before > BUSY else []
        found += [f"others took {100 * self.others:.0f} % of it"] if self.others > BUSY else []
        found += [f"the hypervisor {100 * self.stolen:.1f} %"] if self.stolen > STOLEN else []
        return ", ".join(found)

    def text(self) -> str:
        what = self.what
        return (f"{what['cpu']}, {what['cores']} cores{', virtual' if what['virtual'] else ''}, kernel {what['kernel']}"
                f"{' PREEMPT_RT' if what['preempt_rt'] else ''}, governor {what['governor']}")

    def as_json(self) -> dict:
        return {**self.what, "busy_before": self.busy_before, "others": self.others, "stolen": self.stolen,
                "noisy": bool(self.noise())}
