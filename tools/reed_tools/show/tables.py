"""Tables on a terminal, and numbers in them."""

from rich import box
from rich.console import Console
from rich.table import Table

PLAIN_WIDTH = 110


def console() -> Console:
    found = Console()
    return found if found.is_terminal else Console(width=PLAIN_WIDTH)


def number(value, digits: int = 4) -> str:
    if value is None:
        return "–"
    if isinstance(value, int):
        return str(value)
    return f"{value:.{digits}g}"


def grid(title: str, *columns: str, numbers: bool = True) -> Table:
    table = Table(title=title, title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    for k, column in enumerate(columns):
        table.add_column(column, justify="right" if numbers and k > 0 else "left")
    return table
