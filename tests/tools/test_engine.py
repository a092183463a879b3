"""The engine of many runs: results are those of the items alone, whatever becomes of the workers; nothing is left behind."""

import json
import os
import signal
import socket
import subprocess
import sys
import time

import distributed
import pytest
from engine_items import DRAWS
from process_tree import children, command_line

from reed_tools.paths import BUILD, PYTHON, ROOT

REED = [*PYTHON, str(ROOT / "tools" / "reed_tools" / "__main__.py")]
SCHEDULER = "tcp://127.0.0.1:43028"


def start(folder, *argv, **variables):
    """A campaign of real draws, in a session of its own as on a terminal, with its scratch in a folder with a blank."""
    scratch = folder / "tmp folder"
    scratch.mkdir(exist_ok=True)
    command = [*REED, "campaign", "press_known", "--draws", str(DRAWS), "--repeat", "0", "--set", "scenario.duration_s=1.5", *map(str, argv)]
    return subprocess.Popen(command, env={**os.environ, "REED_BUILD_DIR": str(BUILD), "TMPDIR": str(scratch), **variables},
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)


def records(folder):
    return sorted((json.loads(line) for line in (folder / "draws.jsonl").read_text().splitlines()), key=lambda one: one["index"])


def await_records(folder, process, count=1):
    end = time.monotonic() + 90
    while not (folder / "draws.jsonl").exists() or (folder / "draws.jsonl").read_text().count("\n") < count:
        assert process.poll() is None and time.monotonic() < end, process.communicate()
        time.sleep(0.02)


def descendants(pid):
    found = set()
    for child in children(pid):
        found |= {child} | descendants(child)
    return found


def workers(pid):
    return [child for child in children(pid) if "spawn_main" in command_line(child)]


def alive(pid):
    try:
        with open(f"/proc/{pid}/stat") as file:
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def await_end(pids, seconds=20):
    end = time.monotonic() + seconds
    while left := [pid for pid in pids if alive(pid)]:
        assert time.monotonic() < end, left
        time.sleep(0.05)


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """The records with one worker that nothing happens to."""
    folder = tmp_path_factory.mktemp("alone")
    process = start(folder, "--jobs", 1, "--out", folder / "out")
    out, err = process.communicate(timeout=180)
    assert process.returncode in (0, 1) and err == "", out + err
    return records(folder / "out")


def test_two_workers_of_which_one_is_killed_give_the_records_of_one(alone, tmp_path):
    process = start(tmp_path, "--jobs", 2, "--out", tmp_path / "out")
    await_records(tmp_path / "out", process)
    everything = descendants(process.pid)
    os.kill(workers(process.pid)[0], signal.SIGKILL)
    everything |= descendants(process.pid)
    out, err = process.communicate(timeout=180)
    assert err == "" and records(tmp_path / "out") == alone, out + err
    await_end(everything)
    assert os.listdir(tmp_path / "tmp folder") == []


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_to_all_of_them_keeps_what_is_done_and_leaves_nothing(alone, tmp_path, number):
    """As Ctrl-C does on a terminal: every process of the session gets it."""
    process = start(tmp_path, "--jobs", 2, "--out", tmp_path / "out")
    await_records(tmp_path / "out", process)
    everything = descendants(process.pid)
    os.killpg(process.pid, number)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 1 and err == "" and "interrupted after" in out, out + err
    await_end(everything)
    assert os.listdir(tmp_path / "tmp folder") == []
    kept = records(tmp_path / "out")
    assert 1 <= len(kept) < DRAWS and all(one == alone[one["index"]] for one in kept)


def test_no_process_outlives_a_tool_that_was_killed(tmp_path):
    process = start(tmp_path, "--jobs", 2, "--out", tmp_path / "out")
    await_records(tmp_path / "out", process)
    everything = descendants(process.pid)
    assert len(everything) >= 3
    process.kill()
    process.communicate(timeout=60)
    await_end(everything)


def test_workers_listen_on_the_loopback_interface_alone_and_only_on_the_processors_given(tmp_path):
    process = start(tmp_path, "--out", tmp_path / "out")
    await_records(tmp_path / "out", process)
    inodes = set()
    for pid in (process.pid, *workers(process.pid)):
        for name in os.listdir(f"/proc/{pid}/fd"):
            target = os.readlink(f"/proc/{pid}/fd/{name}")
            inodes |= {target[8:-1]} if target.startswith("socket:[") else set()
    listening = [line.split() for name in ("tcp", "tcp6") for line in open(f"/proc/{process.pid}/net/{name}") if " 0A " in line]
    ours = [entry[1] for entry in listening if entry[9] in inodes]
    assert ours and all(address.startswith("0100007F:") for address in ours), ours
    assert len(workers(process.pid)) == min(len(os.sched_getaffinity(0)), DRAWS)
    os.killpg(process.pid, signal.SIGINT)
    process.communicate(timeout=60)


def await_port(port, seconds=120):
    end = time.monotonic() + seconds
    while True:
        try:
            return socket.create_connection(("127.0.0.1", port)).close()
        except OSError:
            assert time.monotonic() < end
            time.sleep(0.1)


ENGINE = """
import sys
sys.path[:0] = [{tools!r}, {here!r}]
if __name__ == "__main__":
    import engine_items
    engine_items.main(sys.argv[1])
"""


def engine(what, tmp_path):
    """engine_items.main(what), in a process of its own as a tool is."""
    script = tmp_path / "engine.py"
    script.write_text(ENGINE.format(tools=str(ROOT / "tools"), here=os.path.dirname(__file__)))
    done = subprocess.run([*PYTHON, str(script), what], env={**os.environ, "REED_BUILD_DIR": str(BUILD)}, capture_output=True, text=True,
                          timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.splitlines()


def test_a_run_costs_less_than_ten_milliseconds_of_the_processor_beside_itself(tmp_path):
    """Of tool, scheduler and worker together; what the clock shows depends on who else computes here."""
    (line,) = engine("overhead", tmp_path)
    assert float(line) < 10.0


def test_what_a_function_raises_is_raised_and_a_run_that_kills_its_workers_is_named(tmp_path):
    assert engine("raise", tmp_path) == ["UsageError: item 3: no"]
    (line,) = engine("kill", tmp_path)
    assert line in [f"RunError: {item}, or the run before it: 4 workers died that had it" for item in (2, 3)]


def test_a_worker_that_computes_something_else_is_named_and_left_out(tmp_path):
    named, refused = engine("another", tmp_path)
    assert "is left out, on " in named and "its canary's digest is " in named and named.endswith(", here 0123")
    assert refused == "UsageError: " + named.partition("left out, ")[2]


def test_runs_on_a_scheduler_have_the_same_records_and_the_workers_stay(alone, tmp_path):
    """One that does not have Reed, with two workers; one of them has another build."""
    other = tmp_path / "build"
    (other / "bin").mkdir(parents=True)
    for name in ("lcmtypes", "bin/reed_config"):
        (other / name).symlink_to(BUILD / name)
    (other / "bin" / "reed_one_process").write_bytes((BUILD / "bin" / "reed_one_process").read_bytes() + b"\0")
    (other / "bin" / "reed_one_process").chmod(0o755)
    dask = [os.path.join(sys.prefix, "bin", "dask")]
    environment = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    started = [subprocess.Popen([*dask, "scheduler", "--host", "127.0.0.1", "--port", SCHEDULER.rpartition(":")[2], "--dashboard-address",
                                 "127.0.0.1:0"], env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)]
    try:
        for build in (BUILD, other):
            started.append(subprocess.Popen([*dask, "worker", SCHEDULER, "--nthreads", "1", "--no-dashboard", "--local-directory", tmp_path / "w"],
                                            env={**environment, "PYTHONPATH": str(ROOT / "tools"), "REED_BUILD_DIR": str(build)},
                                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
        await_port(int(SCHEDULER.rpartition(":")[2]))
        with distributed.Client(SCHEDULER, timeout=60, set_as_default=False) as client:
            client.wait_for_workers(2, timeout=120)
        for folder in ("one", "two"):  # the workers stay for the next one
            process = start(tmp_path, "--scheduler", SCHEDULER, "--out", tmp_path / folder)
            out, err = process.communicate(timeout=180)
            assert err == "" and records(tmp_path / folder) == alone, out + err
            assert out.count("is left out") == 1 and "its programs are build" in out, out
    finally:
        for process in reversed(started):
            process.terminate()
            process.wait(30)
