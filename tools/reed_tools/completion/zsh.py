"""The script for zsh: specifications for its own _arguments, with the help of every option."""

import shlex

from reed_tools.completion.bash import BUSES
from reed_tools.completion.words import FREE, Command, Option, Value
from reed_tools.paths import ROOT

HEAD = """#compdef reed
# Completion of tools/reed for zsh: source <(tools/reed completion zsh), or as a file _reed in a folder of $fpath
_reed_names() {  # FOLDER: its .toml files by name, or any file by path
  local -a names
  names=("$1"/*.toml(N:t:r))
  _alternative "names:name:($names)" 'files:file:_files'
}

_reed() {
  local -a commands
"""
FOOT = """}
if [ "$funcstack[1]" = _reed ]; then _reed "$@"; else compdef _reed reed; fi
"""


def script(commands: list[Command]) -> str:
    listed = " ".join(shlex.quote(f"{command.name}:{command.help.replace(':', chr(92) + ':')}") for command in commands)
    cases = [f"    {command.name}) _arguments {' '.join(map(shlex.quote, specifications(command)))} ;;" for command in commands]
    return "\n".join([HEAD.rstrip("\n"), f"  commands=({listed})", "  if (( CURRENT == 2 )); then _describe command commands; return; fi",
                      "  local command=$words[2]", "  shift words; (( CURRENT-- ))", "  case $command in", *cases, "  esac", FOOT])


def specifications(command: Command) -> list[str]:
    found = [of_option(option) for option in command.options]
    return [*found, f"*:{command.name}:{action(command.words)}"] if command.words else found


def of_option(option: Option) -> str:
    text = "".join("\\" + letter if letter in "[]:\\" else letter for letter in option.help)
    name = f"{'*' if option.repeatable else ''}{option.name}"
    return f"{name}=[{text}]:value:{action(option.value)}" if option.value else f"{name}[{text}]"


def action(value: Value) -> str:
    if value.kind == FREE:
        return " "
    if value.kind in ("choice", "bus"):
        return f"({' '.join(value.choices or [bus.replace(':', chr(92) + ':') for bus in BUSES])})"
    if value.kind in ("run", "folder"):
        return "_files -/"
    return "_files" if value.kind == "file" else f"_reed_names {shlex.quote(str(ROOT / 'config' / value.kind) + 's')}"
