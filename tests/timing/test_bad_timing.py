"""A [timing] that cannot be kept is one clear line at start: budgets, rates, cores, rights."""

import os
import subprocess
import sys

import own_address
import pytest

from reed_tools.paths import BUILD, ROOT

FIRMWARE, PLANT = (str(BUILD / "bin" / name) for name in ("reed_firmware", "reed_plant_sim"))
BUS = own_address.bus()
# What is set, and words of the line.
REFUSED = {
    "budgets longer than the period": (["timing.rx_budget_us=600", "timing.compute_budget_us=300", "timing.tx_budget_us=200"],
                                       ["timing.rx_budget_us", "1100 µs", "period is 1000 µs"]),
    "a receive phase shorter than its frames": (["timing.rx_budget_us=400"],
                                                ["timing.rx_budget_us: 400 µs", "1/5 Mbit/s wire", "525", "allow_wire_overload"]),
    "a transmit phase shorter than its frame": (["timing.tx_budget_us=100"], ["timing.tx_budget_us: 100 µs", "137", "the command"]),
    "a receive phase that leaves nothing": (["timing.rx_budget_us=1000"], ["timing.rx_budget_us", "leave nothing", "compute_budget_us"]),
    "a rate that the wire cannot serve": (["timing.rate_hz=2000"], ["timing.rate_hz", "2000 Hz", "132 %", "up to 1508 Hz"]),
    "a rate that the arm's gains cannot serve": (["timing.rate_hz=100"], ["control.K_d", "rule", "rate"]),
    "a rate that no arm has": (["timing.rate_hz=1e6"], ["timing.rate_hz", "50 ... 8000 Hz"]),
    "a negative budget": (["timing.tx_budget_us=-1"], ["timing.tx_budget_us", "0 ... 20000 µs"]),
    "a core that does not exist": (["timing.cpu=1000"], ["timing.cpu = 1000", "0 to "]),
    "a priority that does not exist": (["timing.priority=99"], ["timing.priority", "1 ... 98"]),
    "an unknown policy": (["timing.overrun=pray"], ["timing.overrun", "keep_grid"]),
    "an unknown action": (["timing.phase_action=pray"], ["timing.phase_action", "degrade"]),
}


@pytest.mark.parametrize("setting", ["timing.plant_cpu=1000", "timing.cpu=1000"])
def test_a_core_that_does_not_exist_is_refused_by_the_plant_too(setting):
    done = subprocess.run([PLANT, "--config", "press_known", "--bus", BUS, "--no-lcm", "--clock", "wall", "--set", setting],
                          capture_output=True, text=True, timeout=30)
    assert done.returncode == 2, done.stderr
    assert len(done.stderr.splitlines()) == 1 and setting.replace("=", " = ") in done.stderr and "0 to " in done.stderr


def test_what_the_programs_refuse_leaves_no_run_folder(tmp_path):
    done = subprocess.run([sys.executable, "-m", "reed_tools", "run", "--bus", BUS, "--out", str(tmp_path / "run"), "--set", "timing.cpu=1000"],
                          env={**os.environ, "PYTHONPATH": str(ROOT / "tools")}, capture_output=True, text=True, timeout=60)
    assert done.returncode == 2 and "timing.cpu = 1000" in done.stderr and len(done.stderr.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("what", REFUSED)
def test_is_refused_in_one_line(what):
    settings, words = REFUSED[what]
    options = [word for setting in settings for word in ("--set", setting)]
    done = subprocess.run([FIRMWARE, "--config", "press_known", "--bus", BUS, "--no-lcm", *options], capture_output=True, text=True,
                          timeout=30)
    assert done.returncode == 2, done.stderr
    assert len(done.stderr.splitlines()) == 1, done.stderr
    for word in words:
        assert word in done.stderr, done.stderr


def test_a_rate_alone_needs_no_new_budgets(tmp_path):
    """Budgets that nobody set follow the period; the run gets as far as a bus on which nobody answers."""
    done = subprocess.run([FIRMWARE, "--config", "press_known", "--bus", BUS, "--no-lcm", "--set", "timing.rate_hz=1500"],
                          capture_output=True, text=True, timeout=30)
    assert done.returncode == 3 and "nothing heard" in done.stderr, done.stderr


def test_the_keys_default_is_by_itself():
    keys = subprocess.run([str(BUILD / "bin" / "reed_config"), "--keys"], capture_output=True, text=True, check=True).stdout
    assert "| timing.rx_budget_us | 0 ... 20000 µs | 0 |" in keys
