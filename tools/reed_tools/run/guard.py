"""Ends programs whose tool was killed outright, so that no half of a run keeps the bus busy. The kernel's own signal for that
is cleared where a program has file capabilities, as the firmware advises for SCHED_FIFO."""

import subprocess

# Lines are process numbers; the last one is "done", or missing because the tool is gone.
SCRIPT = 'pids=; while read -r line; do [ "$line" = done ] && exit; pids="$pids $line"; done; kill -TERM $pids'


class Guard:
    def __enter__(self):
        self.shell = subprocess.Popen(["/bin/sh", "-c", SCRIPT], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                                      stderr=subprocess.DEVNULL, start_new_session=True, text=True)
        return self

    def watch(self, process: subprocess.Popen) -> None:
        self.say(str(process.pid))

    def __exit__(self, *_) -> None:
        self.say("done")
        self.shell.stdin.close()
        self.shell.wait()

    def say(self, line: str) -> None:
        try:
            print(line, file=self.shell.stdin, flush=True)
        except BrokenPipeError:  # somebody ended it: the run goes on
            pass
