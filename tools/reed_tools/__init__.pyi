from reed_tools.errors import ReedError as ReedError, RunError as RunError, UsageError as UsageError
from reed_tools.notebook.pictures import plot as plot
from reed_tools.notebook.recorded import Run as Run, load as load
from reed_tools.notebook.runs import run_scenario as run_scenario
from reed_tools.notebook.sweeps import Point as Point, sweep as sweep
