import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hil.cell.errors import FaultError
from hil.cli.main import call
from hil.falsify.errors import FalsifyError
from hil.falsify.faults import Described
from hil.falsify.regression import Regression, load
from hil_fixtures import strategies as hs


@settings(deadline=None)
@given(hs.fault_schedules(max_faults=3), st.integers(0, 99))
def test_a_kept_schedule_is_read_as_it_was_written(tmp_path_factory, schedule, seed):
    path = tmp_path_factory.mktemp("kept") / "found.regression.yaml"
    kept = Regression("ffc_ur5", seed, "pose", schedule, "failed: F1", ("C1.share",), "force <= 1")
    path.write_text(kept.as_yaml())
    assert load(path) == kept


@settings(deadline=None)
@given(hs.fault_schedules(max_faults=3))
def test_a_schedule_as_a_case_is_the_same_schedule(schedule):
    described = Described(schedule)
    assert described.schedule(described.case) == schedule
    assert described.schedule(described.case[1:]).faults == schedule.faults[1:]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("rig: ffc_ur5\nseed: -1\nfaults: [C1]", "seed: -1 is not a whole number from 0"),
        ("rig: ffc_ur5\nseed: 1\nfaults: [C77]", "no fault 'C77'"),
        ("rig: ffc_ur5\nseed: 1\nfaults: []", "a list of at least one fault"),
        ("rig: 7\nseed: 1\nfaults: [C1]", "rig and policy are names"),
        ("rig: ffc_ur5\nseeds: 1\nfaults: [C1]", "no such key 'seeds'"),
        ("rig: ffc_ur5\nseed: 1\nformula: froce <= 1\nfaults: [C1]", "did you mean 'force'"),
        ("[1, 2", "not YAML"),
    ],
)
def test_what_is_wrong_with_a_kept_schedule_is_one_line(tmp_path, text, said):
    path = tmp_path / "x.regression.yaml"
    path.write_text(text)
    with pytest.raises((FalsifyError, FaultError)) as raised:
        load(path)
    assert said in str(raised.value)
    assert "\n" not in str(raised.value)
    assert str(path) in str(raised.value)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("falsify", "ffc_ur6"), "no rig 'ffc_ur6'"),
        (("falsify", "ffc_ur5", "--faults", "can.dorp"), "did you mean 'can.drop'"),
        (("falsify", "ffc_ur5", "--formula", "froce <= 1"), "did you mean 'force'"),
        (("falsify", "ffc_ur5", "--budget", "0"), "--budget"),
        (("falsify", "ffc_ur5", "--out", "/nowhere/x.yaml"), "does not exist"),
        (("shrink", "/nowhere/x.yaml"), "cannot be read"),
        (("replay", "/nowhere/x.yaml"), "cannot be read"),
    ],
)
def test_bad_input_is_one_line_and_status_2(capsys, arguments, said):
    assert call(arguments) == 2
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1
