"""tools/reed live [RUN_DIR]: the page in a process of its own, which reads telemetry and nothing else."""

import os
import socket

from reed_tools import folders
from reed_tools.errors import RunError, UsageError
from reed_tools.run.live_page import HOST, PORT

NICENESS = 10  # the loop comes first
EXAMPLE = """examples:
  tools/reed live                  # beside runs: open http://127.0.0.1:8080, now or later
  tools/reed live out/RUN          # a finished run, with a time slider
  tools/reed run --live            # both at once"""


def add_arguments(parser) -> None:
    parser.add_argument("run_dir", nargs="?", metavar="RUN_DIR", type=folders.argument, help="a finished run; without it whatever runs is shown")
    parser.add_argument("--port", type=int, default=PORT, metavar="N", help="on 127.0.0.1; default %(default)s")


def run(arguments) -> int:
    if not 0 < arguments.port < 65536:
        raise UsageError(f"--port {arguments.port}: allowed are 1 to 65535")
    require_free(arguments.port)
    try:
        from reed_tools.live import recorded, running  # they need viser: not before the options are known to be right
        from reed_tools.live.page import Page
    except ModuleNotFoundError as error:
        raise RunError(f"live needs the Python package {error.name}: build/venv-live/bin/python3 -m pip install "
                       "-r tools/requirements-live.txt, or start it as tools/reed live, which does that") from None
    if arguments.run_dir:
        recorded.require(arguments.run_dir)
        show = recorded.Recorded(arguments.run_dir).forever
    else:
        show = running.Running().forever
    os.nice(NICENESS)  # after the feed's threads were started: drawing may wait, datagrams may not
    page = Page(HOST, arguments.port)
    print(f"page    http://{HOST}:{arguments.port}  (Ctrl-C ends it)", flush=True)
    show(page)
    return 0


def require_free(port: int) -> None:
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((HOST, port))
        except OSError:
            raise UsageError(f"--port {port}: is in use, perhaps by another page (http://{HOST}:{port}); choose another, "
                             f"like --port {port + 1 if port < 65535 else port - 1}") from None
