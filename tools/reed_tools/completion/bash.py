"""The script for bash: which words fit at the cursor. Names of scenarios, arms and campaigns are read when they are asked for."""

import shlex

from reed_tools.completion.words import FREE, Command, Value
from reed_tools.paths import ROOT

HEAD = """# Completion of tools/reed for bash: source <(tools/reed completion bash)
_reed_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur"); }

_reed_names() {  # FOLDER: its .toml files by name, or any file by path
  mapfile -t COMPREPLY < <(cd "$1" && compgen -W "$(printf '%s ' *.toml | sed 's/\\.toml//g')" -- "$cur")
  _reed_files
}

_reed_files() { mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$cur"); }

_reed_folders() { mapfile -t COMPREPLY < <(compgen -d -- "${cur:-$1}"); }

_reed() {
  local cur="${COMP_WORDS[COMP_CWORD]}" prev="${COMP_WORDS[COMP_CWORD - 1]}" command="${COMP_WORDS[1]}"
  COMPREPLY=()
  [ "$cur" != "=" ] || cur=""
  [ "$prev" != "=" ] || prev="${COMP_WORDS[COMP_CWORD - 2]}"
"""
FOOT = """}
complete -o filenames -F _reed reed
"""
BUSES = ("auto", "udp", "vm", "memory", "socketcan:vcan0")


def script(commands: list[Command]) -> str:
    values = [f'    "{command.name} {option.name}") {call(option.value)}; return ;;' for command in commands for option in command.options if option.value]
    plain = [f'    {command.name}) case "$cur" in -*) {words([option.name for option in command.options])} ;; *) {call(command.words)} ;; esac ;;'
             for command in commands]
    return "\n".join([HEAD.rstrip("\n"), f'  if [ "$COMP_CWORD" -le 1 ]; then {words([command.name for command in commands])}; return; fi',
                      '  case "$command $prev" in', *values, "  esac", '  case "$command" in', *plain, "  esac", FOOT])


def words(listed: list[str] | tuple[str, ...]) -> str:
    return f"_reed_words {shlex.quote(' '.join(listed))}"


def call(value: Value | None) -> str:
    if value is None or value.kind == FREE:
        return ":"
    if value.kind == "choice":
        return words(value.choices)
    if value.kind == "bus":
        return words(BUSES)
    if value.kind in ("run", "folder"):
        return f"_reed_folders {'out/' if value.kind == 'run' else shlex.quote('')}"
    return "_reed_files" if value.kind == "file" else f"_reed_names {shlex.quote(str(ROOT / 'config' / value.kind))}s"
