import numpy as np
import pytest

from hil.experiments.envelope.cost import costs
from hil.experiments.envelope.experiment import FAMILIES, envelope, select
from hil.experiments.envelope.table import as_text
from hil.experiments.envelope.verdict import SPAN, judged


def test_a_campaign_repeats_itself_from_its_seed():
    family = select(["kink, 125 Hz"])
    first, second = (list(envelope(3, 7, family)) for _ in range(2))
    assert first == second
    assert list(envelope(3, 8, family)) != first


def test_a_push_that_oscillates_is_unstable_and_one_that_is_calm_is_not():
    t = np.arange(SPAN.still + SPAN.moving)
    assert judged(10.0 + 3.0 * np.sin(t / 20.0), 10.0, 12.0).unstable
    calm = judged(np.full(len(t), 10.0), 10.0, 12.0)
    assert not calm.unstable
    assert calm.peak_over_bound == pytest.approx(10.0 / 12.0)


def test_a_tool_that_bounces_off_has_lost_contact():
    push = np.full(SPAN.still + SPAN.moving, 10.0)
    push[1500:1700] = 0.0
    found = judged(push, 10.0, 12.0)
    assert found.unstable
    assert found.lost == 200


def test_the_table_has_a_line_a_family():
    results = list(envelope(2, 1, FAMILIES[:1]))
    lines = as_text(results).splitlines()
    assert len(lines) == 3
    assert {line.count("|") for line in lines} == {11}


def test_a_family_there_is_not_is_refused():
    with pytest.raises(ValueError, match="no family is called 'springs'; there are: push as"):
        select(["springs"])


@pytest.mark.campaign
@pytest.mark.timeout(3600)
def test_two_thousand_loops_a_family_are_stable_below_the_peak_bound():
    for result in envelope(2000, 5, FAMILIES):
        assert result.unstable == 0, result
        assert result.lost == 0, result
        assert result.peak_over_bound <= 1.02, result


def test_cost_is_told_of_each_law_at_both_rates():
    found = list(costs(["soft"]))
    assert [(cost.law, cost.rate_hz) for cost in found] == [("soft", 125), ("soft", 500)]
    assert all(0.0 < cost.median_us <= cost.p95_us for cost in found)
    assert found[1].updates > 3 * found[0].updates
