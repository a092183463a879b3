"""Keys of a TOML text that is for people: other values, comments kept."""

import re


def replaced(body: str, key: str, value: str) -> str | None:
    """The part of a text that belongs to one table, with `key = value` in its line; None where it has none."""
    line = re.compile(rf"^{key}[ \t]*=[ \t]*(?:\[[^\]]*\]|[^#\n]*?)([ \t]*#[^\n]*)?$", re.M)
    return line.sub(lambda found: f"{key} = {value}{found[1] or ''}", body, count=1) if line.search(body) else None
