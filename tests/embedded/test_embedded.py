"""The control core on a Cortex-M7 under qemu: the host's numbers, the reference's numbers, and nothing but arithmetic inside."""

import json
import math
import tomllib

import pytest

from reed_tools.bench import embedded
from reed_tools.paths import ROOT

if embedded.missing():
    pytest.skip(f"missing: {'; '.join(embedded.missing())}", allow_module_level=True)

BUDGET = tomllib.loads((ROOT / "bench" / "budget.toml").read_text())["cortex_m7"]
MARGIN = 1.05
N, P = 5, 6
# Where a result's fields start; embedded/core.h.
J, V, S, Y, U_KNOWN, U_UNKNOWN, P_RATE, ETA_RATE = 0, 30, 35, 40, 70, 75, 80, 86
TORQUE = 114


@pytest.fixture(scope="module")
def proof(tmp_path_factory):
    return embedded.prove(tmp_path_factory.mktemp("embedded"))


@pytest.fixture(scope="module")
def cases():
    return json.loads(embedded.CASES.read_text())["cases"]


def test_the_target_has_no_heap_no_exceptions_no_rtti_and_no_locks(proof):
    assert proof.symbols == []


def test_the_target_computes_what_the_host_computes(proof, cases):
    """Not bit-equal: the Cortex-M7 fuses multiply-add and has its own sin and cos; measured 1e-12 relative to the largest number."""
    assert len(proof.target) == len(proof.host) == len(cases)
    for target, host in zip(proof.target, proof.host):
        scale = max(map(abs, host))
        assert max(abs(a - b) for a, b in zip(target, host)) < 1e-12 * scale


def test_the_target_agrees_with_the_reference(proof, cases):
    for row, case in zip(proof.target, cases):
        close(row[J:J + 6 * N], [case["J_world"][i][j] for j in range(N) for i in range(6)])
        close(row[V:V + N], case["v"])
        close(row[S:S + N], case["s"])
        close(row[Y:Y + P * N], [case["Y"][i][k] for k in range(P) for i in range(N)])
        close(row[U_KNOWN:U_KNOWN + N], case["U_known"])
        close(row[U_UNKNOWN:U_UNKNOWN + N], case["U_unknown"])
        close(row[P_RATE:P_RATE + P], case["pdot_known_Gamma1"])
        close(row[ETA_RATE:ETA_RATE + P], case["etadot_Gamma1"])


def test_the_command_frame_carries_the_laws_torque(proof, cases):
    for row, case in zip(proof.target, cases):
        for sent, wanted in zip(row[TORQUE:TORQUE + N], case["U_known"]):
            assert math.isclose(sent, wanted, rel_tol=1e-6, abs_tol=1e-6)


@pytest.mark.parametrize("figure", ["instructions", "stack_bytes", "flash_bytes", "ram_bytes"])
def test_the_target_stays_within_its_budget(proof, figure):
    assert 0 < getattr(proof, figure) <= BUDGET[figure] * MARGIN


def close(got, wanted):
    assert max(abs(a - b) for a, b in zip(got, wanted, strict=True)) < 1e-9
