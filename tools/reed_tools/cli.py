"""The command line. A command is a module with EXAMPLE, add_arguments(parser) and run(arguments) -> exit status, or with
pass_through(argv) when another program reads the options. Only the module of the command that was asked for is imported: starting stays quick."""

import argparse
import importlib
import json
import os
import sys
import traceback
from pathlib import Path

from reed_tools.errors import ReedError, RunError, UsageError
from reed_tools.text import did_you_mean, one_line

COMMANDS = {
    "run": ("run.command", "one hardware-in-the-loop run: figures, plots, report"),
    "campaign": ("campaign.command", "many runs with drawn parameters, walls and seeds: distributions and worst cases"),
    "worst": ("worst.command", "the worst case of a campaign: searched for, reduced to what it needs, kept for the tests"),
    "faults": ("faults.command", "every fault in every phase of a scenario: what is noticed, how soon, and is the arm safe?"),
    "map": ("map.command", "margin over delay, jitter and loss of commands and measurements, and over the rate"),
    "report": ("figures.command", "rebuild figures, plots and report of a run folder"),
    "compare": ("compare.command", "two or more runs, or campaigns, beside each other: differences first"),
    "live": ("live.command", "a page that shows a run as it happens, or a finished one"),
    "replay": ("replay.command", "a run through the controller's own code again: the same to the bit, or the first difference"),
    "gate": ("gate.command", "did the controller's behaviour change between two commits, and does one of them say so?"),
    "export": ("export.command", "a run as MCAP, CSV, Parquet, or its bus as ASC, BLF"),
    "decode": ("export.decode_command", "frames of the bus in engineering units, live or recorded"),
    "inspect": ("robots.command", "the model and the law as numbers, by the code the firmware runs"),
    "arm": ("arms.command", "arm files from and to URDF, judged, drawn"),
    "scenario": ("scenarios.command", "a new scenario for an arm: a press on a wall, or free motion"),
    "identify": ("identify.command", "inertial parameters and friction from recorded runs, or the motion to record"),
    "bode": ("bode.command", "gain, phase and margins of one joint's loop, measured with a multisine"),
    "tune": ("tune.command", "better gains of a scenario within the rules, with what each step brought"),
    "spy": ("machine.spy", "watch every telemetry channel live with lcm-spy"),
    "doctor": ("machine.doctor", "what this machine can and cannot do, with the exact fixes"),
    "paper": ("paper.command", "the paper's experiments, reproduced on one page"),
    "budget": ("bench.budget", "checks of a law from outside: heap, system calls, exceptions, time"),
    "bench": ("bench.command", "speed and latency beside what they are compared with"),
    "test": ("testing.command", "all tests, or those that match a filter"),
    "completion": ("completion.command", "a script with which bash or zsh completes these commands"),
}

EXIT_STATUS = """exit status: 0 done and every check passed; 1 a check or test failed; 2 wrong usage or configuration;
             3 a program died or the bus was lost"""


class OneLineParser(argparse.ArgumentParser):
    """Says what is wrong in one line; the page of usage is what --help is for."""

    def error(self, message: str):
        unknown = message.partition("unrecognized arguments: ")[2].split()
        options = [option for action in self._actions for option in action.option_strings]
        hint = did_you_mean(unknown[0].partition("=")[0], options) if unknown and unknown[0].startswith("-") else ""
        raise UsageError(f"{message}{hint} (see `{self.prog} --help`)")


def overview() -> str:
    rows = "\n".join(f"  {name:<11}{text}" for name, (_, text) in COMMANDS.items())
    return f"usage: tools/reed COMMAND [options]\n\n{rows}\n\n{EXIT_STATUS}\ntools/reed COMMAND --help has the options and an example; --version prints the version, with --json as JSON."


def main(argv: list[str]) -> int:
    try:
        return dispatch(argv)
    except ReedError as error:
        return complain(str(error), error.exit_status)
    except SystemExit as done:  # --help
        return done.code or 0
    except KeyboardInterrupt:
        print("reed: interrupted", file=sys.stderr)
        return 130
    except OSError as error:  # a disk that is full, a folder without rights: no error of the tools
        where = f"{os.fsdecode(error.filename)}: " if isinstance(error.filename, (str, bytes)) else ""
        return complain(where + (error.strerror or str(error)).lower(), RunError.exit_status)
    except Exception as error:  # a mistake of ours: one line that says what and where
        place = traceback.extract_tb(error.__traceback__)[-1]
        return complain(f"internal error, {type(error).__name__} at {Path(place.filename).name}:{place.lineno}: {error}",
                        RunError.exit_status)


def complain(text: str, status: int) -> int:
    print(f"reed: {one_line(text)}", file=sys.stderr)
    return status


def dispatch(argv: list[str]) -> int:
    if not argv or argv[0] in ("help", "-h", "--help"):
        print(overview())
        return 0
    name, rest = argv[0], argv[1:]
    if name == "--version" or (name in COMMANDS and "--version" in rest):
        print(version_json() if "--json" in argv else version())
        return 0
    if name not in COMMANDS:
        raise UsageError(f"unknown command `{name}`{did_you_mean(name, COMMANDS)}; commands: {', '.join(COMMANDS)}")
    module = module_of(name)
    if hasattr(module, "pass_through"):
        return module.pass_through(rest)
    return module.run(parser_of(name).parse_args(rest))


def version() -> str:
    from reed_tools import versions  # asks git: only when it is asked for

    return f"reed {versions.reed()}, commit {versions.commit() or 'unknown: no git, or no checkout of this user'}"


def version_json() -> str:
    from reed_tools import versions

    return json.dumps(versions.of_tools() | {"build": versions.build()})


def module_of(name: str):
    return importlib.import_module(f"reed_tools.{COMMANDS[name][0]}")


def parser_of(name: str) -> OneLineParser:
    module = module_of(name)
    parser = OneLineParser(prog=f"tools/reed {name}", description=COMMANDS[name][1] + ".", epilog=f"{module.EXAMPLE}\n\n{EXIT_STATUS}",
                           formatter_class=argparse.RawDescriptionHelpFormatter)
    module.add_arguments(parser)
    return parser
