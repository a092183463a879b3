"""Names and values of files may hold anything, and are shown as text."""

import own_address
import pytest

from reed_tools import cli
from reed_tools.errors import UsageError
from reed_tools.text import KEPT_AT_END, LONGEST_LINE, one_line, plain


@pytest.mark.parametrize("given, shown", [("plain – μ", "plain – μ"), ("\x1b[31m", "\\x1b[31m"), ("a\x00b\x7f", "a\\x00b\\x7f"),
                                          ("\x9b", "\\x9b"), ("\u202e", "\\u202e"), ("\udcff", "\\udcff"), ("a\nb", "a\\nb")])
def test_control_characters_are_shown_as_numbers(given, shown):
    assert plain(given) == shown


def test_a_complaint_is_one_line_of_bounded_length_with_its_end(monkeypatch, capsys):
    def refuse(argv):
        raise UsageError("scenario.name = " + "x\n" * 100_000 + ": allowed: a name")

    monkeypatch.setattr(cli, "dispatch", refuse)
    assert cli.main(["run"]) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1 and told.endswith(": allowed: a name\n") and len(told) < LONGEST_LINE + 20
    assert one_line("y" * LONGEST_LINE) == "y" * LONGEST_LINE and KEPT_AT_END < LONGEST_LINE


def test_a_name_with_markup_is_a_name(reed, tmp_path):
    name = "[/nope] [bold]<b>"
    done = reed("run", "--bus", own_address.bus(), "--out", tmp_path, "--set", f'scenario.name="{name}"')
    assert done.returncode == 1, done.stderr  # of the stand-in's checks
    assert done.stdout.count("[/nope] [bold]<b> on a5") == 2
    assert "[/nope] [bold]" in (tmp_path / "report.html").read_text() and "<b> on" not in (tmp_path / "report.html").read_text()
