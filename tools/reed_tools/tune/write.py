"""A scenario with other gains: a copy of its file, comments kept."""

import re

from reed_tools.record.toml_text import replaced
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
    added = f"{body.rstrip()}\n{key} = {value}\n" + ("\n" if following else "")
    return scenario[:header.end()] + (replaced(body, key, value) or added) + scenario[end:]
