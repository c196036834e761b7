import pytest


@pytest.mark.parametrize("seed", [1, 2])
def test_one_seed_gives_one_recording_whether_the_cell_shares_the_process_or_not(perform, seed):
    inline = perform(seed)
    assert perform(seed).digest == inline.digest
    assert perform(seed, layout="process").digest == inline.digest


def test_another_seed_gives_another_recording(perform):
    assert perform(1).digest != perform(2).digest
