"""Text of other people made fit to be shown: names and values of files may hold anything."""

import difflib

NEAR = 0.6           # share of letters in common, by difflib
LONGEST_LINE = 1200
KEPT_AT_END = 500  # what is allowed comes last


def plain(text: str, keep: str = "") -> str:
    """Control characters, which a terminal obeys and XML refuses, as their numbers; `keep`: those that stay."""
    return "".join(letter if letter.isprintable() or letter in keep else
                   letter.encode("unicode_escape", "backslashreplace").decode() for letter in text)


def did_you_mean(word: str, allowed) -> str:
    """"; did you mean …?" where one of `allowed` is near, else ""."""
    near = difflib.get_close_matches(word, list(allowed), n=1, cutoff=NEAR)
    return f"; did you mean `{near[0]}`?" if near and near[0] != word else ""


def one_line(text: str) -> str:
    """Of a message, however long its values are and whatever they hold."""
    line = plain(" ".join(text.split("\n")))
    if len(line) <= LONGEST_LINE:
        return line
    return f"{line[:LONGEST_LINE - KEPT_AT_END]} … {line[-KEPT_AT_END:]}"
