"""A scenario with other gains: a copy of its file, comments kept."""

import re
from pathlib import Path

from reed_tools.errors import UsageError
from reed_tools.record.whole_file import write_text
from reed_tools.tune.gains import Gains, text


def with_gains(scenario: str, gains: Gains) -> str:
    for key, value in gains.values:
        section, _, name = key.partition(".")
        scenario = with_value(scenario, section, name, text(value))
    return scenario


def with_value(scenario: str, section: str, key: str, value: str) -> str:
    header = re.search(rf"^\[{section}\][ \t]*(?:#[^\n]*)?$", scenario, re.M)
    if not header:
        return f"{scenario.rstrip()}\n\n[{section}]\n{key} = {value}\n"
    following = re.search(r"^\[", scenario[header.end():], re.M)
    end = header.end() + following.start() if following else len(scenario)
    body = scenario[header.end():end]
    line = re.compile(rf"^{key}[ \t]*=[ \t]*(?:\[[^\]]*\]|[^#\n]*?)([ \t]*#[^\n]*)?$", re.M)
    if line.search(body):
        body = line.sub(lambda found: f"{key} = {value}{found[1] or ''}", body, count=1)
    else:
        body = f"{body.rstrip()}\n{key} = {value}\n" + ("\n" if following else "")
    return scenario[:header.end()] + body + scenario[end:]


def write(target: Path, text_of_scenario: str) -> None:
    if target.exists():
        raise UsageError(f"--out {target}: is there already; nothing was overwritten")
    try:
        write_text(target, text_of_scenario)
    except OSError as error:
        raise UsageError(f"--out {target}: {(error.strerror or str(error)).lower()}") from None
