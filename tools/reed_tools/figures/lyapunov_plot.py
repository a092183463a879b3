"""V with its parts, and its derivative as predicted and as seen, on two axes."""

import numpy as np

from reed_tools.figures.lyapunov import Bookkeeping

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00")
SMALLEST = 1e-6          # of V's largest value: parts below it are not drawn


def draw(top, bottom, book: Bookkeeping) -> None:
    largest = float(np.max(book.V))
    floor = max(SMALLEST * largest, 1e-12)
    top.semilogy(book.t, np.maximum(book.V, floor), color="black", linewidth=2.6, alpha=0.45, label="V")  # seen under its largest part
    for (name, part), colour in zip(book.parts.items(), COLOURS):
        if np.max(part) > floor:
            top.semilogy(book.t, np.maximum(part, floor), color=colour, linewidth=0.8, label=name)
    top.set_ylim(bottom=floor)
    bottom.plot(book.t, book.seen, color="#56B4E9", linewidth=0.8, label="differences of V")
    bottom.plot(book.t, book.predicted, color="#D55E00", linewidth=0.8, label="(44)" if book.force_known else "bound (46)")
    bottom.set_yscale("symlog", linthresh=1e-2)
