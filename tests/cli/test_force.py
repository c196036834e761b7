"""`hil experiment force-tracking`, `stability-map` and `hil tune force`: bad input, small runs."""

import json

import pytest

from hil.cli.main import call


@pytest.fixture
def hil(capsys):
    """Run a command line; (exit status, stdout, stderr)."""

    def run(*arguments):
        status = call([str(argument) for argument in arguments])
        captured = capsys.readouterr()
        return status, captured.out, captured.err

    return run


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--law", "sofft"), "soft"),
        (("--law", "no.such:Law"), "cannot be imported"),
        (("--stiffness", "0"), "positive"),
        (("--stiffness", "-1"), "positive"),
        (("--stiffness", "nan"), "positive"),
        (("--stiffness", "stiff"), "takes numbers"),
        (("--latency", "70"), "50 ms"),
        (("--rate", "250"), "125 (UR5) and 500 (UR5e)"),
        (("--force", "0"), "positive"),
        (("--bottoming", "3"), "a force and a stiffness"),
        (("--preset", "tund"), "did you mean 'tuned'"),
        (("--seeds", "0"), "seeds"),
    ],
)
def test_what_cannot_be_run_is_one_line_and_status_two(hil, arguments, said):
    status, out, err = hil("experiment", "force-tracking", *arguments)
    assert (status, out) == (2, "")
    assert said in err
    assert len(err.splitlines()) == 1


def test_rows_of_a_small_grid(hil, tmp_path):
    status, out, _ = hil(
        "experiment", "force-tracking", "--law", "soft", "--stiffness", 3, "--latency", 6,
        "--seeds", 1, "--jobs", 1, "--ledger", tmp_path / "l.db", "--json",
    )  # fmt: skip
    (row,) = json.loads(out)["rows"]
    assert status == 0
    assert (row["law"], row["k_e"], row["latency_ms"], row["rate_hz"]) == ("soft", 3.0, 6.0, 125)
    assert (row["runs"], row["unstable"], row["failed"]) == (1, 0, 0)
    assert row["rms_tracking"] < 0.2


def test_a_map_needs_a_picture_in_a_folder_that_exists(hil, tmp_path):
    status, _, err = hil("experiment", "stability-map", "--figure", tmp_path / "no" / "m.png")
    assert status == 2
    assert "folder that exists" in err


@pytest.mark.parametrize(
    ("study", "said"),
    [("papr", "shipped are constant, duan, paper"), ("no.yaml", "cannot be read")],
)
def test_a_study_that_is_not_there_is_one_line(hil, tmp_path, study, said):
    status, _, err = hil("tune", "force", study, "--preset", tmp_path / "p.yaml")
    assert status == 2
    assert said in err


def test_a_search_ends_in_a_preset(hil, tmp_path):
    study = tmp_path / "mine.yaml"
    study.write_text(
        "law: constant\nstiffnesses: [3]\nobjective: {settling: 1}\n"
        "parameters: {damping: {low: 500, high: 2000}}\n"
    )
    preset = tmp_path / "p.yaml"
    status, out, _ = hil(
        "tune", "force", study, "--trials", 2, "--journal", tmp_path / "j", "--preset", preset
    )
    assert status == 0
    assert "trial" in out
    assert "# constant: hil tune force" in preset.read_text()
