"""hil.run_pair as a program of its own, started isolated by its path: `python -I -X utf8 pair.py PLAN.json`."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from reed_tools.run import hil  # noqa: E402

sys.exit(hil.main())
