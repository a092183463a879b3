"""One cell of the matrix, in a worker: a fault in a phase of a scenario with a seed; the same run without the fault, and without the
controller's monitors."""

import functools
import shlex
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path

from reed_tools.errors import UsageError
from reed_tools.faults import observed, phases
from reed_tools.faults.catalogue import as_override
from reed_tools.run import hil, in_memory, scenario

LOST = 3  # status of a program whose bus was lost: for some faults the right end
START_S = 5.0  # an arm that a fault has not let start by then does not start; with its monitors it says so after 2 s
NEVER_DONE = "the scenario was not done"  # without its monitors an arm that a fault keeps from starting waits, with its brakes closed


@dataclass(frozen=True)
class Cell:
    scenario: str
    fault: int           # its number in the catalogue
    phase: str
    seed: int


@dataclass
class Row:
    fault: str
    kind: str
    scenario: str
    phase: str
    seed: int
    detected_by: str | None = None
    fdti_ms: float | None = None   # fault to detection
    frti_ms: float | None = None   # detection to the safe state: brakes closed, motors at rest
    fhti_ms: float | None = None   # their sum
    ftti_ms: float | None = None   # fault to hazard with the monitors off, on this bench
    margin_ms: float | None = None  # ftti - fhti
    hazard: str | None = None      # that is reached although the monitors are on
    hazard_unmonitored: str | None = None
    force_peak_N: float | None = None
    speed_peak_radps: float | None = None
    torque_step_Nm: float | None = None
    expected: str | None = None    # what was expected and did not happen
    digest: str = ""
    command: str = ""
    verdict: str = "not executed"

    @property
    def executed(self) -> bool:
        return self.verdict not in ("not executed", "died", "refused")

    def as_dict(self) -> dict:
        return {"class" if key == "verdict" else key: value for key, value in asdict(self).items()}


def seeded(seed: int) -> list[str]:
    return [f"scenario.seed={seed}"]


@functools.lru_cache(maxsize=4)
def effective_of(name: str) -> dict:
    with tempfile.TemporaryDirectory(prefix="reed-fault-") as scratch:
        return scenario.write_effective(name, None, [], Path(scratch, "effective.toml"))


def ended(name: str, entries: list[str], interrupted: list) -> tuple[in_memory.Ended, observed.Run] | None:
    """None: interrupted."""
    effective = effective_of(name)
    with tempfile.TemporaryDirectory(prefix="reed-fault-") as scratch:
        done = in_memory.run(effective, name, Path(scratch), interrupted, entries, START_S)
        if done.outcome.interrupted:
            return None
        if done.status == hil.REFUSED:
            raise UsageError(done.said)
        if done.died and done.status != LOST and NEVER_DONE not in done.died:
            raise RuntimeError(done.died)
        return done, observed.Run(done.recording(), effective["timing"]["rate_hz"])


@functools.lru_cache(maxsize=2)
def twin_of(name: str, seed: int) -> observed.Run:
    """Without a fault."""
    _, run = ended(name, seeded(seed), [])
    return run


def loses_sensor(effective: dict) -> bool:
    return effective["sensors"]["wrench"] and effective["sensors"]["wrench_lost_from_s"] >= 0.0


def triggers_of(name: str, seed: int) -> dict[str, dict]:
    return phases.triggers(twin_of(name, seed).course(loses_sensor(effective_of(name))))


def run(entries: list[dict], unmonitored: tuple[str, ...], cell: Cell, interrupted: list) -> Row | None:
    """`entries`: the catalogue. `unmonitored`: overrides that take the controller's monitors away; none: no time to hazard."""
    fault = entries[cell.fault]
    row = Row(fault["id"], fault["kind"], cell.scenario, cell.phase, cell.seed)
    trigger = triggers_of(cell.scenario, cell.seed).get(cell.phase)
    if trigger is None:
        return row
    overrides = [as_override([{**fault, **trigger}]), *seeded(cell.seed)]
    row.command = command(cell.scenario, cell.seed, overrides[0])
    try:
        done = ended(cell.scenario, overrides, interrupted)
        bare = ended(cell.scenario, [*overrides, *unmonitored], interrupted) if unmonitored else done
    except (RuntimeError, UsageError) as error:
        row.verdict, row.expected = "refused" if isinstance(error, UsageError) else "died", str(error)
        return row
    if done is None or bare is None:
        return None
    judge(row, fault, done[1], bare[1] if unmonitored else None, twin_of(cell.scenario, cell.seed), observed.Bounds.of(effective_of(cell.scenario)))
    row.digest = done[1].recording.digest("lockstep")
    return row


def judge(row: Row, fault: dict, done: observed.Run, bare: observed.Run | None, twin: observed.Run, bounds: observed.Bounds) -> None:
    onset = done.fault_begins(0)
    if onset is None:
        return
    in_ms = lambda cycles: round(1e3 * cycles / done.rate_hz, 3)  # noqa: E731
    found = observed.findings(done, twin, onset)
    first = found[0] if found else None
    stop = next((finding for finding in found if finding.stops), None)
    danger = observed.hazard(done, twin, bounds, onset)
    bare_danger = observed.hazard(bare, twin, bounds, onset) if bare else danger
    row.__dict__.update(observed.largest(done, onset))
    row.hazard = danger[1] if danger else None
    row.hazard_unmonitored = bare_danger[1] if bare_danger else None
    if first:
        row.detected_by = first.name
        row.fdti_ms = in_ms(first.cycle - onset) if first.cycle is not None else None
    if stop and (safe := observed.safe_from(done, stop.cycle)) is not None:
        row.frti_ms, row.fhti_ms = in_ms(safe - first.cycle), in_ms(safe - onset)
    if bare and bare_danger:
        row.ftti_ms = in_ms(bare_danger[0] - onset)
        row.margin_ms = round(row.ftti_ms - row.fhti_ms, 3) if row.fhti_ms is not None else None
    dangerous = danger is not None or bare_danger is not None
    row.verdict = f"{'dangerous' if dangerous else 'safe'} {'detected' if in_time(first, danger, onset) else 'undetected'}"
    row.expected = disappointed(fault, row)


def in_time(first: observed.Finding | None, danger: tuple[int, str] | None, onset: int) -> bool:
    """Noticed, and not after the danger was there. What is only counted was refused at once."""
    if first is None:
        return False
    return danger is None or (onset if first.cycle is None else first.cycle) <= danger[0]


def disappointed(fault: dict, row: Row) -> str | None:
    """What the catalogue expects and the run does not show."""
    names = [name.strip() for name in fault.get("detected_by", "").split(",") if name.strip()]
    if row.detected_by and names and row.detected_by not in names:
        return f"detected by {row.detected_by}, expected {' or '.join(names)}"
    for key, value in (("within_ms", row.fdti_ms), ("safe_within_ms", row.fhti_ms)):
        if row.detected_by and fault.get(key) and value is not None and value > fault[key]:
            return f"{key} {value:g}, expected at most {fault[key]:g}"
    return None


def command(name: str, seed: int, override: str) -> str:
    return shlex.join(["tools/reed", "run", name, "--bus", "memory", "--seed", str(seed), "--set", override])
