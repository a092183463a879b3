"""The ways a command can fail; each carries the exit status and one line for people."""


class ReedError(Exception):
    exit_status = 3


class UsageError(ReedError):
    """Wrong usage or configuration: what, where, what is allowed."""

    exit_status = 2


class RunError(ReedError):
    """A program died, the bus was lost, or the machine lacks something."""

    exit_status = 3
