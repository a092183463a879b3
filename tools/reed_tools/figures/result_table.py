"""The result of a run as a control engineer wants to read it: verdict and checks, then error by second, bus, timing."""

from rich.table import Table
from rich.text import Text

from reed_tools.show.tables import console, grid, mark, number
from reed_tools.text import plain


def checks(summary: dict) -> Table:
    table = grid("checks", "figure", "value", "limit", "", "")
    for check in summary["checks"]:
        table.add_row(check["name"], number(check["value"]), number(check["limit"]), mark(check["ok"]), plain(check["why"] or ""))
    table.columns[-1].justify = "left"
    return table


def windows(summary: dict) -> Table:
    table = grid("error by second", "s", "joint rms", "peak", "tangential", "tip rms", "tangential", "force rms", "peak")
    table.add_row("", "mrad", "mrad", "mrad", "mm", "mm", "N", "N", style="dim")
    for window in summary["windows"]:
        figures = ("joint_rms_mrad", "joint_peak_mrad", "tangential_joint_rms_mrad", "tip_rms_mm",
                   "tangential_tip_rms_mm", "force_rms_N", "force_peak_N")
        table.add_row(f"{window['from_s']:g}-{window['to_s']:g}", *(number(window[name], 3) for name in figures))
    return table


def timing(summary: dict) -> Table:
    lockstep = summary["clock"] == "lockstep"
    table = grid(f"time per cycle, µs{': lockstep keeps no period' if lockstep else ''}", "phase", "p50", "p99", "p99.9", "max")
    for phase, figures in summary["timing_us"].items():
        row = [figures[key] for key in ("p50", "p99", "p999", "max")] if figures else [None] * 4
        table.add_row(phase, *(number(value, 4) for value in row))
    return table


def wire_time(wire: dict | None) -> list[str]:
    if wire is None:
        return []
    parts = [f"{what} after {number(wire[name]['max'], 4)} µs at most, median {number(wire[name]['p50'], 4)} (worst case computed "
             f"{number(wire[name]['computed'], 4)})" for name, what in (("answers_us", "last answer"), ("command_us", "command"))]
    dropped = f"; {wire['dropped']} frames given up, the wire's queue was full" if wire["dropped"] else ""
    return [f"wire   {'; '.join(parts)}; others' frames {number(wire['foreign_percent'], 3)} %"
            f"{dropped}"]


LOCKED = {True: "locked", False: "not locked", None: "unknown"}  # the firmware reports it at its end


def lines(summary: dict) -> list[str]:
    """What does not fit a table."""
    bus, loop, pause = summary["bus"], summary["loop"], summary["host_pause"]
    wire = number(bus["wire_load_percent"], 3)
    speed = f", {summary['sim_s'] / summary['wall_s']:.1f}× real time" if summary["wall_s"] else ""
    return [
        f"bus    {bus['kind']} {bus['interface']}: {number(bus['frames_rx'])} frames in, {number(bus['frames_tx'])} out, "
        f"{number(bus['lost'])} lost, {number(bus['crc_errors'])} CRC errors, {number(bus['repeated'])} repeated; "
        f"{wire} % of a 1/5 Mbit/s wire",
        *wire_time(summary["wire_time"]),
        f"clock  {summary['clock']}, {summary['rate_hz']:g} Hz, {summary['cycles']} cycles, {number(summary['missed_cycles'])} missed, "
        f"{number(summary['overruns'])} overruns{speed}",
        *([f"host   {pause['count']} host pauses, {1e3 * pause['host_pause_s']:.0f} ms in all, {pause['missed_cycles']} of the missed cycles "
           "in them; the arm's clock was held"] if pause["count"] else []),
        f"loop   {number(loop['heap_allocations'])} heap allocations, {number(loop['page_faults'])} page faults, "
        f"{number(loop['telemetry_dropped'])} snapshots dropped; "
        f"scheduler {loop['scheduler'] or 'unknown'}, memory {LOCKED[loop['memory_locked']]}",
        f"modes  " + " → ".join(f"{mode['mode']}/{mode['force_source']} {mode['t_s']:+.3f} s" for mode in summary["modes"]),
    ]


def show(summary: dict) -> None:
    out = console()
    out.print(windows(summary))
    out.print(timing(summary))
    for line in lines(summary):
        out.print(line, soft_wrap=True, highlight=False, markup=False)
    out.print()
    out.print(checks(summary))
    passed = summary["verdict"] == "pass"
    cause = f"   {summary['cause']}" if summary["cause"] else ""
    out.print(plain(f"{summary['scenario']} on {summary['arm']}: "), Text(summary["verdict"].upper(), f"bold {'green' if passed else 'red'}"),
              plain(f"{cause}   digest {summary['digest'][:16]}"), sep="", highlight=False, soft_wrap=True)
