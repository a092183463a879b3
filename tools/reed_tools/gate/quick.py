"""tools/reed gate --quick: the checkout's own programs on the corpus, against the digests that the base keeps."""

import json
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from reed_tools.errors import RunError, UsageError
from reed_tools.gate import commits, corpus, kept, trial
from reed_tools.paths import BUILD, build
from reed_tools.record.tape import Tape
from reed_tools.run import joints

SIGNALS = "signal by signal: tools/reed gate {base}"


def record_all(entries: list[tuple[str, corpus.Entry]], jobs: int) -> dict[tuple[str, str], Tape]:
    """By kind and name, in this order."""
    build("reed_one_process", "reed_config_tool")
    if lacking := {entry.joints for _, entry in entries if entry.joints} - joints.built():
        raise RunError(f"{BUILD} is not built for {min(lacking)} joints; tools/reed builds what is missing: start this as tools/reed gate --quick")

    def one(job: tuple[str, corpus.Entry]) -> Tape:
        with tempfile.TemporaryDirectory(prefix="reed-gate-") as scratch:
            try:
                return trial.record(BUILD / "bin", job[1], Path(scratch) / "tape.reed")
            except trial.Refused as refused:
                raise RunError(f"{job[0]} {job[1].name}: {refused}") from None

    with ThreadPoolExecutor(jobs) as pool:
        return dict(zip([(kind, entry.name) for kind, entry in entries], pool.map(one, entries)))


def of_kind(tapes: dict[tuple[str, str], Tape], wanted: str) -> list[Tape]:
    return [tape for (kind, _), tape in tapes.items() if kind == wanted]


def write(known: corpus.Corpus, jobs: int) -> int:
    tapes = record_all(known.entries(), jobs)
    if lacking := corpus.lacks(of_kind(tapes, "tape"), known.coverage):
        raise UsageError(f"the tapes do not cover what config/gate/corpus.toml promises: {', '.join(lacking)}")
    kept.write(kept.of_tapes(tapes))
    print(f"written: {kept.PATH}, {len(tapes)} digests")
    return 0


def run(known: corpus.Corpus, base_name: str | None, jobs: int, as_json: bool) -> int:
    base = commits.resolve(base_name) if base_name else commits.last_of_main()
    own = kept.of_checkout()
    if own is None:
        raise UsageError(f"there is no {kept.PATH}; `tools/reed gate --write` makes it")
    before = kept.of_commit(base) if base else None
    tapes = record_all(known.entries(), jobs)
    lacking = corpus.lacks(of_kind(tapes, "tape"), known.coverage)
    try:
        stale, new = kept.differences(own, tapes)
        changed = kept.differences(before, tapes)[0] if before else []
    except kept.Gone as gone:
        raise UsageError(f"the signal {gone} is gone, so that the kept digests cannot be compared: `tools/reed gate BASE` compares the others") from None
    declared = commits.declared(base, "HEAD") if base else []
    if as_json:
        print(json.dumps({"base": base, "head": commits.resolve("HEAD"), "tapes": len(known.tapes), "scenarios": len(tapes) - len(known.tapes),
                          "changed": [{"tape": name, "kind": kind, "signal": None, "first_cycle": None, "largest": None} for kind, name in changed],
                          "declared": declared, "not_covered": lacking, "not_kept": [name for _, name in stale + new]}))
    else:
        print("\n".join(lines(base, before, len(tapes), changed, declared, stale, new, lacking)))
    return 1 if lacking or stale or (changed and not declared) else 0


def lines(base, before, count, changed, declared, stale, new, lacking) -> list[str]:
    """What was found, in words."""
    found = []
    if before:
        found.append(f"changed since {base[:12]}: {in_words(changed)}" if changed else f"same as {base[:12]}: {count - len(new)} digests")
        if changed:
            found.append("declared: " + "; ".join(declared) if declared else
                         f"no commit since then says `changes-control: why`: say it in the message, or find the cause ({SIGNALS.format(base=base[:12])})")
    else:
        found.append(f"not compared with a base: {f'{base[:12]} keeps no digests' if base else commits.NO_BASE}")
    if stale:
        found.append(f"{kept.PATH} is not of this checkout: {in_words(stale)}; if that is meant: tools/reed gate --write, and commit the file")
    if new:
        found.append(f"no digest is kept yet of {in_words(new)}: tools/reed gate --write")
    if lacking:
        found.append(f"the tapes do not cover what config/gate/corpus.toml promises: {', '.join(lacking)}")
    return found


def in_words(names: list[tuple[str, str]]) -> str:
    return ", ".join(f"{kind} {name}" for kind, name in names)
