"""Tests that did not run: a skip proves nothing, so in CI it fails, but for those that only the machine's kernel or rights decide."""

from fnmatch import fnmatchcase
from pathlib import Path
from xml.etree import ElementTree

# By name, with why a machine may have to skip it.
ALLOWED = {
    "UringTest.*": "a container may forbid io_uring; the programs receive with recvmmsg then, which other tests run",
    "UdpByUring.*": "the same",
    "HostPauseWatch.SeesACoreThatIsTakenAwayToWithinABeat": "SCHED_FIFO needs a right",
    "HostPauseWatch.DoesNotTakeABusyControllerForTheHost": "SCHED_FIFO needs a right",
    "runs.test_host_pause.*": "SCHED_FIFO needs a right",
    "UdpBus.WhatComesByAnotherInterfaceIsNotHeard": "needs a network beside the loopback",
    "tools.test_run_command.test_the_fix_works_where_the_loopback_is_down_and_where_half_of_it_is_done": "needs user namespaces",
}


def allowed(name: str) -> bool:
    return any(fnmatchcase(name, pattern) for pattern in ALLOWED)


def full_name(case: ElementTree.Element) -> str:
    """CTest gives a test's name twice, GoogleTest and pytest in two parts."""
    group, name = case.get("classname", ""), case.get("name", "")
    return name if not group or name.startswith(group) else f"{group}.{name}"


def skipped(results: Path) -> dict[str, str]:
    """Name -> reason, from a JUnit file of CTest, GoogleTest or pytest."""
    found = {}
    for case in ElementTree.parse(results).iter("testcase"):
        mark = case.find("skipped")
        if mark is not None or case.get("status") in ("notrun", "disabled"):
            found[full_name(case)] = (mark is not None and (mark.text or mark.get("message"))) or "it did not run"
    return found


def complaints(results: list[Path]) -> list[str]:
    """One line per skip that is not allowed, and per file of results that a runner did not write."""
    lines = []
    for path in results:
        if not path.exists():
            lines.append(f"SKIPPED all of {path.name}: its runner wrote no results")
            continue
        lines += [f"SKIPPED {name}: {' '.join(reason.split())}" for name, reason in skipped(path).items() if not allowed(name)]
    return lines
