"""Tables on a terminal, plain lines in a pipe, and numbers in them."""

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

PLAIN_WIDTH = 10_000  # of a line in a pipe: nothing is cut or wrapped


def console() -> Console:
    """Text is text: names with brackets are no markup. What has a style says so as a Text."""
    found = Console(markup=False, emoji=False)
    return found if found.is_terminal else Console(markup=False, emoji=False, width=PLAIN_WIDTH)


def mark(ok: bool, good: str = "ok", bad: str = "FAIL") -> Text:
    return Text(good, "green") if ok else Text(bad, "bold red")


def number(value, digits: int = 4) -> str:
    if value is None:
        return "–"
    if isinstance(value, int):
        return str(value)
    return f"{value:.{digits}g}"


def grid(title: str, *columns: str, numbers: bool = True) -> Table:
    frame = box.SIMPLE_HEAD if console().is_terminal else None
    table = Table(title=Text(title, no_wrap=True, overflow="ignore"), title_justify="left", box=frame, pad_edge=False)
    for k, column in enumerate(columns):
        table.add_column(column, justify="right" if numbers and k > 0 else "left")
    return table
