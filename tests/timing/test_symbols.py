"""What one cycle can call (virtual calls are not followed: the transports are searched from their own functions). The object
file of a cycle also holds its set-up, so not its symbols are asked but its calls:
from the loop along every direct call in the disassembly, nothing leads to an allocator, to an exception or to a lock."""

import re
import subprocess
from pathlib import Path

import pytest

from reed_tools.paths import BUILD

FORBIDDEN = re.compile(r"\b(malloc|calloc|realloc|free|aligned_alloc|posix_memalign)\b|operator (new|delete)|__cxa_(throw|allocate_exception|rethrow)|"
                       r"_Unwind_Resume|std::__throw|pthread_(mutex|cond|rwlock)|std::mutex|\b(printf|puts|fwrite|syslog)\b")
FUNCTION = re.compile(r"^[0-9a-f]+ <(.+)>:$")
CALL = re.compile(r"\b(?:call|jmp)\s+[0-9a-f]+ <([^>+]+(?:<.*>)?[^>+]*)>$")
ROOT_FUNCTION = re.compile(r"^reed::(Cycle<\d+, \d+>::Run|bus::DatagramTransport::(Receive|Send)|bus::(Udp|SocketCan)Transport::(Read|Write)|"
                           r"RunRealtime|RunOnPausingHost|RunLockstep)\(")


def calls(program: Path) -> dict[str, set[str]]:
    graph, here = {}, None
    text = subprocess.run(["objdump", "-d", "-C", "--no-show-raw-insn", str(program)], capture_output=True, text=True).stdout
    for line in text.splitlines():
        if found := FUNCTION.match(line):
            here = graph.setdefault(found.group(1), set())
        elif here is not None and (found := CALL.search(line)):
            here.add(found.group(1).removesuffix("@plt"))
    return graph


def reachable(graph: dict[str, set[str]], roots: list[str]) -> dict[str, str]:
    """Every function that a root leads to, with the calls that lead there."""
    found, todo = {root: root for root in roots}, list(roots)
    while todo:
        caller = todo.pop()
        for callee in graph.get(caller, set()) - found.keys():
            found[callee] = f"{found[caller]} -> {callee}"
            todo.append(callee)
    return found


@pytest.fixture(scope="module")
def firmware():
    return calls(BUILD / "bin" / "reed_firmware")


def test_a_cycle_reaches_no_allocator_no_exception_and_no_lock(firmware):
    roots = [name for name in firmware if ROOT_FUNCTION.match(name)]
    assert roots, "no Cycle::Run in the program: the name has changed"
    found = reachable(firmware, roots)
    assert [path for name, path in sorted(found.items()) if FORBIDDEN.search(name)] == []
    assert any("recvmmsg" in name or "sincos" in name or "sin" == name for name in found), "the graph is cut off"


def test_the_check_sees_what_set_up_calls(firmware):
    """The same search from main finds an allocator at once: it can fail."""
    assert any(FORBIDDEN.search(name) for name in reachable(firmware, ["main"]))
