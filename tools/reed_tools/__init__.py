"""What people type: runs of the two programs, and the figures, plots and pages made from what they recorded.

In a notebook or a script: `import reed_tools`, then run_scenario, load, sweep and plot (docs/tutorial.md)."""

import importlib

WHERE = {"run_scenario": "notebook.runs", "sweep": "notebook.sweeps", "load": "notebook.recorded", "Run": "notebook.recorded", "plot": "notebook.pictures",
         "Point": "notebook.sweeps", "ReedError": "errors", "UsageError": "errors", "RunError": "errors"}
__all__ = list(WHERE)


def __getattr__(name: str):
    """Loaded when it is asked for: the command line starts without numpy."""
    if name not in WHERE:
        raise AttributeError(f"module 'reed_tools' has no attribute {name!r}")
    return getattr(importlib.import_module(f"reed_tools.{WHERE[name]}"), name)
