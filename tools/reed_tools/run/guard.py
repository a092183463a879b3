"""Ends programs whose tool was killed outright, so that no half of a run keeps the bus busy. The kernel's own signal for that
is cleared where a program has file capabilities, as the firmware advises for SCHED_FIFO."""

import os
import subprocess

# Lines are numbers of processes, "-NUMBER" of one that has ended; the last line is "done", or missing because the tool is gone.
SCRIPT = """pids=
while read -r line; do
  case $line in
    done) exit ;;
    -*) left=; for pid in $pids; do [ "-$pid" = "$line" ] || left="$left $pid"; done; pids=$left ;;
    *) pids="$pids $line" ;;
  esac
done
[ -z "$pids" ] || kill -TERM $pids"""


class Guard:
    def __init__(self):
        self.shell = subprocess.Popen(["/bin/sh", "-c", SCRIPT], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                                      stderr=subprocess.DEVNULL, start_new_session=True, text=True)

    def __enter__(self):
        return self

    def watch(self, process: subprocess.Popen) -> None:
        self.say(str(process.pid))

    def forget(self, process: subprocess.Popen) -> None:
        """It has ended: its number may be given to another one."""
        self.say(f"-{process.pid}")

    def __exit__(self, *_) -> None:
        self.say("done")
        self.shell.stdin.close()
        self.shell.wait()

    def say(self, line: str) -> None:
        try:
            print(line, file=self.shell.stdin, flush=True)
        except BrokenPipeError:  # somebody ended it: the run goes on
            pass


_of_this_tool: dict[int, Guard] = {}  # by number of the process: a child has its own


def of_this_tool() -> Guard:
    """One for all runs of this process: a shell for each of a thousand draws costs more than a tenth of their time."""
    guard = _of_this_tool.get(os.getpid())
    if guard is None or guard.shell.poll() is not None:
        guard = _of_this_tool[os.getpid()] = Guard()
    return guard
