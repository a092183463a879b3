"""Several workers may share these tests (`pytest -n`). What flies in wall time stays together on one of them, so that no
other flight takes its core; what else there is goes file by file, each with a bus of its own."""

import os
import signal

for number in (signal.SIGINT, signal.SIGHUP, signal.SIGTERM):
    if signal.getsignal(number) == signal.SIG_IGN:  # `nohup … &`: it stays so here, and what the tests start gets the usual
        signal.signal(number, lambda *_: None)

REALTIME = ("bus/", "endurance/test_kill.py", "firmware/", "plant_sim/", "runs/", "strategy/", "telemetry/", "timing/test_bad_timing.py",
         "timing/test_loop_calls.py", "tools/test_hil.py", "tools/test_killed.py", "tools/test_live.py",
         "tools/test_report_page.py")


def pytest_configure(config):
    """`tools/reed test --long` runs those marked long too (pytest.ini leaves them out)."""
    if os.environ.get("REED_LONG") == "1" and config.option.markexpr == "not long":
        config.option.markexpr = ""


def pytest_xdist_make_scheduler(config, log):
    from xdist.scheduler import LoadScopeScheduling

    class OneWorkerInRealtime(LoadScopeScheduling):
        def _split_scope(self, nodeid):
            return "realtime" if nodeid.startswith(REALTIME) else nodeid.split("::")[0]

    return OneWorkerInRealtime(config, log)
