"""How much a test of endurance does: little in every test, all of it in the long mode (tools/reed test --long)."""

import os

LONG = os.environ.get("REED_LONG") == "1"


def how_many(ordinary: int, in_long_mode: int) -> int:
    return in_long_mode if LONG else ordinary
