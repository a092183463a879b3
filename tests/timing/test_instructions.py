"""Instructions of each stage for the worst of its recorded inputs, counted by callgrind, against bench/budget.toml."""

import tomllib

import pytest

from reed_tools.bench import callgrind
from reed_tools.paths import BUILD, ROOT

BUDGET = tomllib.loads((ROOT / "bench" / "budget.toml").read_text())["x86_64"]
MARGIN = 1.05

pytestmark = pytest.mark.skipif(not callgrind.available(), reason=callgrind.HOW_TO_GET)


@pytest.fixture(scope="module")
def counts():
    return callgrind.count(BUILD / "bin" / "reed_bench_stages")


def test_every_stage_has_a_budget_and_every_budget_a_stage(counts):
    assert counts.keys() == BUDGET.keys()


@pytest.mark.parametrize("stage", BUDGET)
def test_a_stage_stays_within_its_budget(counts, stage):
    assert 0 < counts[stage].worst <= BUDGET[stage] * MARGIN, f"{stage}: {counts[stage].worst} instructions, budget {BUDGET[stage]}"


@pytest.mark.parametrize("stage", BUDGET)
def test_a_budget_is_not_much_more_than_the_stage_needs(counts, stage):
    """A budget that nobody comes near would let a stage grow unseen."""
    assert counts[stage].worst >= 0.9 * BUDGET[stage]


def test_only_the_parts_that_a_marked_call_ended_are_counted():
    text = ("desc: Trigger: --dump-after=reed_bench_one\nsummary: 7\ntotals: 7\npart: 2\ndesc: Trigger: --dump-after=reed_bench_one\n"
            "totals: 9\ndesc: Trigger: Program termination\ntotals: 3\n")
    assert callgrind.totals_after_calls(text) == [7, 9]
