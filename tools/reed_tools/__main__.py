"""`tools/reed` starts this file isolated: the caller's PYTHON variables, modules and encodings do not reach the tools.
`python -m reed_tools` starts itself again in that way."""

import os
import sys

ISOLATED = ("-I", "-X", "utf8")

if not (sys.flags.isolated and sys.flags.utf8_mode):
    os.execv(sys.executable, [sys.executable, *ISOLATED, os.path.abspath(__file__), *sys.argv[1:]])
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from reed_tools import streams  # noqa: E402
from reed_tools.cli import main  # noqa: E402

if __name__ == "__main__":
    streams.install()
    sys.exit(streams.finish(main(sys.argv[1:])))
os.setsid()  # a worker's process: Ctrl-C and a closed terminal reach the tool alone, which ends its workers in order
