"""One run from Python: the same as tools/reed run, with the same checks of what is asked."""

import contextlib
import io
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from reed_tools import cli
from reed_tools.notebook.recorded import Run


def run_scenario(scenario: str | Path = "press_known", *, arm: str | Path | None = None, duration: float | None = None, rate: float | None = None,
                 seed: int | None = None, law: str | Path | None = None, set: Mapping[str, Any] | None = None, out: str | Path | None = None,
                 bus: str = "memory", clock: str | None = None) -> Run:
    """A run folder, made now. `set`: any number of scenario or arm, {"wall.stiffness_Npm": 2e4}. On the bus in memory a run
    takes lockstep time and is bit-reproducible; with bus="auto" it is the two programs, in real time.

    A run that fails a check is a Run whose `passed` is False. Wrong input raises UsageError, a lost bus or program RunError."""
    options = {"arm": arm, "duration": duration, "rate": rate, "seed": seed, "law": law, "out": out, "bus": bus, "clock": clock}
    words = [str(scenario), *(f"--{name}={value}" for name, value in options.items() if value is not None),
             *(f"--set={key}={cli_value(value)}" for key, value in (set or {}).items())]
    arguments = cli.parser_of("run").parse_args(words)
    with contextlib.redirect_stdout(io.StringIO()):
        folder, _ = cli.module_of("run").one_run(arguments)
    return Run(folder)


def cli_value(value: Any) -> str:
    """As --set reads it: TOML."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (list, tuple)):
        return f"[{','.join(map(cli_value, value))}]"
    return repr(float(value)) if isinstance(value, float) else str(value)
