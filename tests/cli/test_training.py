"""`hil train` survives its own death, refuses what is not its own, and shows what it learnt."""

import os
import re
import signal
import subprocess
import sys

import pytest

from hil.app.sessions import Training, train
from hil.app.train import Schedule
from hil.cell.faults.parse import parse
from hil.cli.main import call
from hil_fixtures.testbed import shipped
from learner import checkpoint

SMALL = ("--learner", "belief", "--episodes", "3", "--verify", "1", "--every", "1", "--seed", "4")
COMMAND = "import sys; from hil.cli.main import main; sys.argv[0] = 'hil'; main()"


def ignore(*_):
    """Watches nothing."""


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The checkpoint of a training that nobody disturbed."""
    path = tmp_path_factory.mktemp("whole") / "learner.hil"
    assert call(["train", "ffc_learning", *SMALL, "--out", str(path)]) == 0
    return path


def killed_after_a_checkpoint(path):
    """Start a training and kill -9 it as soon as there is something to go on from."""
    child = subprocess.Popen(
        [sys.executable, "-c", COMMAND, "train", "ffc_learning", *SMALL, "--out", str(path)],
        stdout=subprocess.PIPE,
        env={**os.environ, "PYTHONUNBUFFERED": "1", "MUJOCO_GL": "off"},
        text=True,
    )
    with child:
        assert child.stdout is not None
        for _ in range(2):  # the second episode's line follows the first one's checkpoint
            assert child.stdout.readline()
        child.send_signal(signal.SIGKILL)
    return child.returncode


def test_a_training_killed_in_the_middle_goes_on_to_the_same_bits(whole, tmp_path):
    path = tmp_path / "learner.hil"
    assert killed_after_a_checkpoint(path) == -signal.SIGKILL
    assert 1 <= checkpoint.read(path).episodes < 4
    assert call(["train", "ffc_learning", *SMALL, "--out", str(path), "--resume"]) == 0
    assert path.read_bytes() == whole.read_bytes()


BROKEN = """
faults:
  - {kind: L1, trigger: {event: "phase: search"}}
  - {kind: L3, trigger: {event: "phase: search"}, params: {agent: 2}}
  - {kind: L4, trigger: {event: "phase: search"}, params: {what: wrong_model}}
"""


@pytest.fixture
def broken(tmp_path):
    """Trains one episode under the faults of learners, or of a text; the exit status."""

    def train(learner, text=BROKEN):
        file, out = tmp_path / "broken.yaml", tmp_path / "learner.hil"
        file.write_text(text, encoding="utf-8")
        episodes = ("--episodes", "1", "--verify", "0", "--seed", "4")
        command = ["train", "ffc_learning", "--learner", learner, *episodes]
        return call([*command, "--out", str(out), "--faults", str(file)]), out

    return train


def test_a_training_under_faults_says_what_became_of_them_and_which_episodes_they_touched(
    broken, capsys
):
    status, _ = broken("wdql")
    said = capsys.readouterr().out
    assert status == 0
    assert "L1 [0] active: chosen by an old observation" in said
    assert "L3 [1] active: agent 2 of 6 is gone" in said
    assert "L4 [2] active: the server judges by linear, the learner by last-label" in said
    assert re.search(r"^ +1  FFC1 .* refused evaluations: [1-9]", said, re.MULTILINE)


def test_a_training_that_lost_an_agent_goes_on_to_the_same_bits(tmp_path):
    rig = shipped("ffc_learning")
    rig = rig.model_copy(update={"task": rig.task.model_copy(update={"max_steps": 5})})
    faults = parse("faults: [{kind: L3, trigger: {event: 'phase: search'}}]")
    one = Training(rig, b"", "wdql", 4, Schedule((("FFC1", 2),)), 1, faults)
    whole, broken = tmp_path / "whole.hil", tmp_path / "broken.hil"
    list(train(one, whole, ignore, resume=False))
    session = train(one, broken, ignore, resume=False)
    next(session)
    next(session)  # the first session's checkpoint is written, the second one's is not
    session.close()
    kept = checkpoint.read(broken)
    assert kept.episodes == 1
    assert len(kept.state["learner"]["agents"]["steps"]) == 5
    list(train(one, broken, ignore, resume=True))
    assert whole.read_bytes() == broken.read_bytes()


def test_a_learner_without_agents_has_none_to_lose_and_nothing_is_begun(broken, capsys):
    status, out = broken("belief")
    said = capsys.readouterr().err
    assert status == 2
    assert "faults[1]: L3 learner.agent: this run has no parallel learner" in said
    assert not out.exists()


def test_a_training_whose_fault_never_became_active_is_vacuous(broken, capsys):
    fault = '{kind: L1, trigger: {event: "phase: search", offset: +1000 s}}'
    status, _ = broken("belief", f"faults: [{fault}]")
    assert status == 1
    assert "vacuous: L1" in capsys.readouterr().err


def test_a_checkpoint_is_not_overwritten_unasked(whole, capsys):
    before = whole.read_bytes()
    assert call(["train", "ffc_learning", *SMALL, "--out", str(whole)]) == 2
    assert "--resume goes on from it" in capsys.readouterr().err
    assert whole.read_bytes() == before


def test_another_trainings_checkpoint_is_refused_with_what_differs(whole, capsys):
    other = [*SMALL[:-1], "3"]
    assert call(["train", "ffc_learning", *other, "--out", str(whole), "--resume"]) == 2
    assert "its seed is 4, this one's 3" in capsys.readouterr().err


def test_a_policy_is_drawn_and_described(whole, tmp_path, capsys):
    picture = tmp_path / "policy.png"
    assert call(["policy", "show", str(whole), "--out", str(picture)]) == 0
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert "belief" in capsys.readouterr().out


@pytest.mark.parametrize("content", [b"", b"something else", None])
def test_a_damaged_or_foreign_file_is_one_clear_line(whole, tmp_path, capsys, content):
    path = tmp_path / "bad.hil"
    path.write_bytes(whole.read_bytes()[:-7] if content is None else content)
    assert call(["policy", "show", str(path)]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert str(path) in error


def test_a_dry_run_on_a_real_rig_says_what_would_move_and_connects_to_nothing(capsys):
    assert call(["train", "real_ur5_example", "--dry-run"]) == 0
    shown = capsys.readouterr().out
    assert "the real arm" in shown
    assert "48 episodes with" in shown
