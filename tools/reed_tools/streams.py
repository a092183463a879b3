"""Standard streams that end nothing: what is printed to a closed stream, or after its reader has left, goes nowhere."""

import contextlib
import io
import os
import select
import sys


class Lasting(io.FileIO):
    """A descriptor that can be written to the end. `lost`: why it no longer arrives."""

    lost: OSError | None = None

    def write(self, data) -> int:
        try:
            while (count := super().write(data)) is None:  # the other end made it non-blocking, and is slow
                select.select([], [self.fileno()], [])
            return count
        except OSError as error:
            self.lost = error
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, self.fileno())
            os.close(nowhere)
            return len(data)


def open_closed() -> None:
    """Descriptors 0 to 2 exist from here on: no file of ours takes their place."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)


def install() -> None:
    open_closed()
    if sys.stdin is None:
        sys.stdin = open(0, closefd=False)
    for name, number, errors in (("stdout", 1, "surrogateescape"), ("stderr", 2, "backslashreplace")):
        raw = Lasting(number, "w", closefd=False)
        setattr(sys, name, io.TextIOWrapper(io.BufferedWriter(raw), encoding="utf-8", errors=errors,
                                            line_buffering=number == 2 or raw.isatty()))


def result_alone(wanted: bool):
    """--json: standard output is for the result; what is printed meanwhile goes to standard error."""
    return contextlib.redirect_stdout(sys.stderr) if wanted else contextlib.nullcontext()


def finish(status: int) -> int:
    """The exit status when everything is printed: a reader may leave, a disk that is full is an error."""
    sys.stdout.flush()
    lost = sys.stdout.buffer.raw.lost
    if lost is None or isinstance(lost, BrokenPipeError):
        return status
    print(f"reed: standard output: {lost.strerror.lower()}", file=sys.stderr)
    return status or 3
