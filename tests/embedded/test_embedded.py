"""The controller on a Cortex-M7 under qemu: over recorded closed loops the firmware's torques, and nothing but arithmetic inside."""

import tomllib

import numpy as np
import pytest

from reed_tools.bench import embedded
from reed_tools.paths import ROOT

if embedded.missing():
    pytest.skip(f"missing: {'; '.join(embedded.missing())}", allow_module_level=True)

BUDGET = tomllib.loads((ROOT / "bench" / "budget.toml").read_text())["cortex_m7"]
MARGIN = 1.05
N = embedded.JOINTS
ACTIVE, KNOWN, OBSERVER = 2, 1, 3
LOOPS = list(embedded.RUNS)


@pytest.fixture(scope="module")
def proof(tmp_path_factory):
    return embedded.prove(tmp_path_factory.mktemp("embedded"))


def test_the_target_has_no_heap_no_exceptions_no_rtti_and_no_locks(proof):
    assert proof.symbols == []


@pytest.mark.parametrize("scenario", LOOPS)
def test_the_recorded_loop_is_one_worth_replaying(proof, scenario):
    loop = proof.loops[scenario]
    assert len(loop.recorded) == embedded.RUNS[scenario] and np.sum(loop.modes == ACTIVE) >= 500
    assert KNOWN in loop.sources and (scenario != "press_sensor_loss" or OBSERVER in loop.sources)


@pytest.mark.parametrize("scenario", LOOPS)
def test_the_host_commands_what_the_firmware_commanded(proof, scenario):
    loop = proof.loops[scenario]
    assert loop.host.shape == (len(loop.recorded), 2 * N)
    assert np.array_equal(loop.host[:, :N], loop.recorded)


@pytest.mark.parametrize("scenario", LOOPS)
def test_the_target_commands_what_the_host_commands(proof, scenario):
    """To the bit, over two seconds of force control and estimation."""
    loop = proof.loops[scenario]
    assert np.array_equal(loop.target, loop.host)


@pytest.mark.parametrize("scenario", LOOPS)
def test_the_command_frame_carries_the_torque(proof, scenario):
    loop = proof.loops[scenario]
    assert np.abs(loop.target[:, N:] - loop.target[:, :N]).max() < 1e-4


@pytest.mark.parametrize("figure", ["instructions", "instructions_median", "stack_bytes", "flash_bytes", "ram_bytes"])
def test_the_target_stays_within_its_budget(proof, figure):
    assert 0 < getattr(proof, figure) <= BUDGET[figure] * MARGIN
