"""Writes docs/safety.md from safety/*.toml and safety/matrix.jsonl.

    build/venv/bin/python3 docs/make_safety.py"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))

from reed_tools.faults import safety_page  # noqa: E402

safety_page.write()
print(f"wrote {safety_page.PAGE}")
