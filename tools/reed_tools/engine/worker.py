"""What runs in a worker's process beside the runs: whether they shall end."""

stop_requests: dict[str, list] = {}  # by session; a session's list is empty until its runs shall end


def stop(session: str) -> None:
    stop_requests.setdefault(session, []).append(True)


def call(function, item, session: str):
    """None: the session was stopped before the end."""
    interrupted = stop_requests.setdefault(session, [])
    return None if interrupted else function(item, interrupted)
