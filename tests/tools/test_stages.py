"""What a later stage needs is made while an earlier one waits for clocks, in the time that it leaves."""

import re
from types import SimpleNamespace

from reed_tools.testing import command
from reed_tools.testing.stages import Stage

NOTHING = SimpleNamespace(filters=[], long=False, ci=False)
ALL = re.compile(".")


def run(monkeypatch, *stages):
    monkeypatch.setattr(command, "all_stages", lambda filters, long: list(stages))
    status = command.run(NOTHING)
    return status, [stage.closing_lines for stage in stages]


def shell(name, script, **more):
    return Stage(name, ["bash", "-c", script], ALL, **more)


def test_it_begins_beside_the_stage_that_leaves_time_and_disturbs_nothing(monkeypatch, tmp_path):
    made = tmp_path / "made"
    waits = shell("waits", f"timeout 30 bash -c 'until [ -e {made} ]; do sleep 0.05; done' && echo seen", leaves_time=True)
    needs = shell("needs", f"cat {made}", before=f"chrt -p $$ >{made}.new && mv {made}.new {made}")
    status, (seen, policy) = run(monkeypatch, waits, needs)
    assert status == 0 and seen == ["seen"] and "SCHED_IDLE" in policy[0]


def test_a_stage_begins_when_what_it_needs_is_whole(monkeypatch, tmp_path):
    made = tmp_path / "made"
    slow = f"sleep 0.5; echo whole >{made}"
    for others in ([], [shell("waits", "echo done", leaves_time=True)]):
        made.unlink(missing_ok=True)
        status, lines = run(monkeypatch, *others, shell("needs", f"cat {made}", before=slow))
        assert status == 0 and lines[-1] == ["whole"]


def test_it_ends_with_a_run_that_is_interrupted(monkeypatch, tmp_path):
    made, waits = tmp_path / "made", shell("waits", "true", leaves_time=True)

    def interrupted(*_, prepared, **__):
        monkeypatch.setattr(command, "prepared_here", prepared, raising=False)
        raise KeyboardInterrupt

    monkeypatch.setattr(command, "execute", interrupted)
    try:
        run(monkeypatch, waits, shell("needs", "true", before=f"sleep 60; touch {made}"))
    except KeyboardInterrupt:
        pass
    assert command.prepared_here.wait(timeout=10) != 0 and not made.exists()
