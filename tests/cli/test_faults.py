"""`hil faults` and `hil run --faults`."""

import json

import pytest

from hil.cli.main import call


def test_the_list_has_every_fault(capsys):
    assert call(["faults", "list", "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)["faults"]) == 52


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("faults: [can.drip]", "faults[0].kind: no fault 'can.drip'; did you mean 'can.drop'?"),
        ("faults: [{kind: C2, params: {mean: 3 N}}]", "'3 N' is not a quantity in s"),
        ("faults: [L3]", "this run has no parallel learner"),
        ("faults: [{kind: C1, trigger: episode >= 9}]", "the run has 1 episode"),
        ("faults: [{kind: C1, trigger: 'cleared: R1'}]", "waits for cleared: R1; faults beside it"),
        ("faults: [{kind: C1, trigger: 'active: C1'}]", "on this side of the wire: none"),
        ("faults: [H1, {kind: C1, trigger: 'active: H1'}]", "waits for active: H1"),
        ("faults: [{kind: S1, params: {force: .nan}}]", "nan is not finite"),
    ],
)
def test_bad_faults_are_one_line_and_nothing_runs(tmp_path, capsys, text, complaint):
    file = tmp_path / "faults.yaml"
    file.write_text(text)
    out = tmp_path / "out"
    assert call(["run", "ffc_ur5", "--faults", str(file), "--out", str(out)]) == 2
    said = capsys.readouterr().err
    assert complaint in said
    assert said.count("\n") == 1
    assert not out.exists()


@pytest.mark.parametrize(
    ("option", "value", "complaint"),
    [
        ("--formula", "sped <= 1", "no signal 'sped'; did you mean 'speed'?"),
        ("--formula", "force <= 1 N", "cannot go on at 'N' at column 12"),
        ("--formula", "force <= nan", "no signal 'nan'"),
        ("--faults", "can.dorp", "did you mean 'can.drop'?"),
    ],
)
def test_a_search_for_what_is_not_there_names_the_option(
    tmp_path, capsys, monkeypatch, option, value, complaint
):
    monkeypatch.chdir(tmp_path)
    assert call(["falsify", "ffc_short", "--budget", "1", option, value]) == 2
    said = capsys.readouterr().err
    assert option in said
    assert complaint in said
    assert said.count("\n") == 1
    assert not list(tmp_path.iterdir())
