import json
import os
import socket
import subprocess
import sys

import pytest

from hil.cell.errors import DoorError, RigError
from hil.cell.rig import parse
from hil.cli import errors, rig_text, shipped
from hil.cli.main import call
from hil.doctor.finding import Verdict
from hil.doctor.machine import folder, packages, ports
from hil.recording.channel import Channel
from hil.recording.channels import deadline
from hil.recording.errors import RecordingError
from hil.recording.identity import Identity
from hil.recording.recorder import Recorder


@pytest.fixture
def hil(capsys):
    """Run a command line; (exit status, stdout, stderr)."""

    def run(*arguments):
        status = call([str(argument) for argument in arguments])
        captured = capsys.readouterr()
        return status, captured.out, captured.err

    return run


@pytest.fixture
def recorded(tmp_path):
    """Record three periods with some count of misses into a named folder; the folder."""

    def write(name, misses=0):
        with Recorder(tmp_path / name, Identity(1, "r", b"name: r\n")) as recorder:
            for k in range(3):
                recorder.put(Channel.DEADLINE, 8_000_000 * k, deadline.encode(k, misses))
            recorder.close()
        return tmp_path / name

    return write


def test_help_imports_none_of_the_testbed():
    look = (
        "import sys; from hil.cli.main import call; call(['--help']); "
        "print({'mujoco', 'numpy', 'pydantic', 'can', 'matplotlib', 'rich'} & set(sys.modules))"
    )
    env = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    out = subprocess.run([sys.executable, "-c", look], env=env, capture_output=True, check=True)
    assert out.stdout.decode().splitlines()[-1] == "set()"


@pytest.mark.parametrize(
    "command",
    ["demo", "run", "up", "replay", "diff", "bench", "doctor", "rig check", "rig show",
     "experiment plant", "experiment noise", "experiment insertion"],
)  # fmt: skip
def test_every_command_explains_itself(hil, command):
    status, out, _ = hil(*command.split(), "--help")
    assert status == 0
    assert out.startswith(f"Usage: hil {command}")


@pytest.mark.parametrize(
    "line", ["nope", "run", "run ffc_ur5 --seed -1", "run ffc_ur5 --clock sundial", "rig paint x"]
)
def test_wrong_usage_is_one_line_and_status_2(hil, line):
    status, out, err = hil(*line.split())
    assert (status, out) == (2, "")
    assert err.startswith("hil: ")
    assert err.count("\n") == 1


def test_a_shipped_rig_is_sound(hil):
    status, out, _ = hil("rig", "check", "ffc_ur5")
    assert status == 0
    assert out.startswith("ok: ffc_ur5, robot ur5 (cb3, 125 Hz")


def test_a_shown_rig_is_a_rig_file_that_means_the_same(hil):
    _, out, _ = hil("rig", "show", "ffc_ur5")
    rig, _ = shipped.read("ffc_ur5")
    assert parse(out) == rig
    assert rig_text.as_yaml(parse(out)) == out


def test_a_rig_is_shown_as_json_for_programs(hil):
    _, out, _ = hil("rig", "show", "ffc_ur5", "--json")
    assert json.loads(out)["connector"]["depth"] == "0.0025 m"


def test_an_unknown_rig_lists_what_there_is(hil):
    status, _, err = hil("rig", "check", "ffc_ur6")
    assert status == 2
    assert err.startswith("hil: no rig 'ffc_ur6'; did you mean 'ffc_ur5'? shipped are: ")
    assert err.count("\n") == 1


def test_a_wrong_rig_file_is_one_line_with_its_key(hil, tmp_path):
    path = tmp_path / "bad.yaml"
    path.write_text("name: bad\ncable: {widht: 3 mm}\n")
    status, _, err = hil("rig", "check", path)
    assert status == 2
    assert err == f"hil: {path}: cable.widht: no such key; did you mean 'width'?\n"


def test_a_missing_rig_file_is_one_line(hil, tmp_path):
    status, _, err = hil("rig", "check", tmp_path / "none.yaml")
    assert status == 2
    assert err == f"hil: {tmp_path / 'none.yaml'}: cannot be read: No such file or directory\n"


def test_a_replay_prints_json_for_programs(hil, recorded):
    status, out, _ = hil("replay", recorded("a"), "--json")
    assert status == 0
    assert json.loads(out)["counts"] == {"/deadline": 3}


def test_a_replay_writes_table_figure_and_page(hil, recorded, tmp_path):
    files = [tmp_path / name for name in ("t.csv", "f.png", "p.html")]
    flags = ("--csv", files[0], "--figure", files[1], "--page", files[2])
    assert hil("replay", recorded("a"), *flags)[0] == 0
    assert all(file.stat().st_size for file in files)


@pytest.mark.parametrize("flag", ["--csv", "--figure", "--page"])
def test_a_replay_that_cannot_write_says_where(hil, recorded, flag):
    status, _, err = hil("replay", recorded("a"), flag, "/dev/null/x")
    assert (status, err) == (2, "hil: /dev/null/x: Not a directory\n")


def test_a_cut_off_recording_is_replayed_and_said_to_be_cut_off(hil, recorded):
    file = recorded("a") / "run.mcap"
    file.write_bytes(file.read_bytes()[:-40])
    status, out, _ = hil("replay", file)
    assert status == 0
    assert "cut off or damaged; this is what can be read" in out


def test_diff_of_equal_runs_is_0_of_different_ones_1_of_none_2(hil, recorded, tmp_path):
    a, b, c = recorded("a"), recorded("b"), recorded("c", misses=1)
    assert hil("diff", a, b) == (0, "same\n", "")
    status, out, _ = hil("diff", a, c)
    assert status == 1
    assert out == "first difference: /deadline at 0.000000000 s, misses\n  0\n  1\n"
    status, _, err = hil("diff", a, tmp_path / "none")
    assert (status, err.count("\n")) == (2, 1)


def test_doctor_reports_every_check_as_json(hil, tmp_path):
    status, out, _ = hil("doctor", "--json", "--out", tmp_path)
    found = {entry["name"]: entry for entry in json.loads(out)}
    assert set(found) == {
        "python", "packages", "cpus", "timer", "ports", "multicast", "can", "rendering", "folder",
    }  # fmt: skip
    assert status == any(entry["verdict"] == "fail" for entry in found.values())


def test_doctor_finds_a_folder_that_cannot_be_written(tmp_path):
    (tmp_path / "file").touch()
    assert folder(tmp_path / "file" / "out").verdict is Verdict.FAIL
    assert folder(tmp_path / "new" / "out").verdict is Verdict.OK


def test_doctor_finds_every_required_package_here():
    assert packages().verdict is Verdict.OK


def test_doctor_names_a_port_that_is_taken():
    with socket.socket() as other:
        other.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        assert ports(range(port, port + 1)).found == f"in use: {port}"


@pytest.mark.parametrize(
    ("error", "status"),
    [(RigError("x"), 2), (RecordingError("x"), 2), (DoorError("x"), 1), (KeyError("x"), None)],
)
def test_known_errors_have_a_status_and_others_are_bugs(error, status):
    assert errors.status(error) == status


def test_an_errors_text_becomes_one_line():
    assert errors.line(RigError("two\n  lines")) == "two lines"


INTERRUPTED = """
import os, signal
from pathlib import Path
from hil.recording import read
from hil.cli.main import main
def load(path):
    os.kill(os.getpid(), signal.SIGINT)
read.load = load
main()
"""


def test_an_interrupt_is_one_line_and_status_130(tmp_path):
    env = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, "-c", INTERRUPTED, "replay", str(tmp_path)]
    child = subprocess.run(command, env=env, capture_output=True, check=False)
    assert (child.returncode, child.stderr) == (130, b"hil: interrupted\n")
