"""The plugin as a user meets it: child runs in a repository of somebody else's."""

import shlex
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

import hil_fixtures.plugin.provide  # noqa: F401  numpy cannot be loaded by two child runs in turn
from hil.cell.faults.parse import load

BENCH = "--rig=bench.yaml"


def properties(path, test):
    """What JUnit says of a test: values by name."""
    cases = ET.parse(path).getroot().iter("testcase")
    case = next(case for case in cases if case.get("name") == test)
    found = {}
    for entry in case.iter("property"):
        found.setdefault(entry.get("name"), []).append(entry.get("value"))
    return found


def test_a_users_own_drivers_and_fixtures_live_beside_ours(child):
    result = child(
        BENCH.replace("--rig", "-ohil_rig"),
        test_names="""
        from drivers import my_arm
        from fixtures import parts

        def test_mine_alone():
            import sys
            assert my_arm.NAME == "mine" and parts.PARTS == 3
            assert not {"hil", "numpy", "hypothesis"} & set(sys.modules)

        def test_mine_and_the_cell(rig):
            from drivers.ur.arm import UrArm
            from drivers import my_arm as still_mine
            assert rig.file.name == "bench"
            assert isinstance(rig.bed.near.arm, UrArm)
            assert rig.bed.near.arm.connect().program_running
            assert still_mine is my_arm
        """,
    )
    result.assert_outcomes(passed=2)


@pytest.mark.parametrize("name", ["strategies", "testbed", "visits", "law_contract"])
def test_what_a_user_imports_first_finds_its_rooms_beside_theirs(child, name):
    text = f"from drivers import my_arm\nfrom hil_fixtures import {name}\n"
    result = child(test_first=text + "def test_it(): from drivers.ur.arm import UrArm\n")
    result.assert_outcomes(passed=1)


def test_a_module_that_both_have_is_named_in_one_line(child, repository):
    repository.makepyfile(**{"drivers/errors": ""})
    result = child(BENCH, test_it="def test_it(rig): rig.bed")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["ERROR: drivers.errors in */drivers and in hil-testbed*rename*"])


SUITE = """
import socket
import threading
import pytest
from hypothesis import given, strategies as st

ports = set()
lost = []

@pytest.mark.requirement("SR-1")
@pytest.mark.parametrize("again", [1, 2])
def test_fresh(rig, again):
    assert rig.bed.near.arm.connect().program_running
    ports.add(rig.bed.cell.doors.ports["rtde"])
    assert len(ports) == again

@pytest.mark.requirement("SR-1", "SR-2")
def test_broken(rig, hil_seed):
    assert rig.seed != hil_seed

@pytest.mark.requirement("SR-3")
@pytest.mark.needs("camera", "gyroscope")
def test_gyroscope(rig):
    raise AssertionError

@pytest.mark.needs("camera", "emulated", "cb3")
def test_camera(rig): pass

def test_leaves_a_socket(rig):
    lost.append(socket.socket())

def test_comes_after_a_leak(rig):
    lost.pop().close()

@pytest.mark.requirement("SR-4")
@given(st.integers(0, 3))
def test_examples(rig, n):
    assert n < 4

@pytest.mark.requirement("SR-5")
def test_without_a_rig(): pass

@pytest.mark.parametrize("again", [1, 2])
def test_shares_one_cell(rig_session, again):
    ports.add(rig_session.bed.cell.doors.ports["rtde"])
    assert len(ports) == 3
"""


def test_a_suite_reports_requirements_leaks_and_how_to_run_a_failure_again(child, repository):
    result = child(
        BENCH, "--hil-seed=7", "--junitxml=j.xml", "--hil-report=out",
        "--hypothesis-profile=hil-smoke", test_suite=SUITE,
    )  # fmt: skip
    result.assert_outcomes(passed=9, failed=1, skipped=1, errors=1)
    result.stdout.fnmatch_lines(
        [
            "*the test left something behind: socket:*",
            "rig bench, seed 7, lockstep",
            "*= HIL requirements =*",
            "SR-1  FAIL  3 of 3 tests ran",
            "SR-2  FAIL  1 of 1 tests ran",
            "SR-3  OPEN  0 of 1 tests ran",
            "SR-4  PASS  1 of 1 tests ran",
            "SR-5  PASS  1 of 1 tests ran",
        ]
    )
    found = properties(repository.path / "j.xml", "test_broken")
    assert found["requirement"] == ["SR-1", "SR-2"]
    assert found["hil.rig"] == ["bench"]
    assert found["hil.seed"] == ["7"]
    assert found["hil.verdict"] == ["failed"]
    page = (repository.path / "out" / "report.md").read_text()
    assert "| SR-3 | OPEN | 0 of 1 |" in page
    assert "test_suite.py::test_broken" in page

    rerun = next(
        line for line in result.outlines if line.startswith("rerun: ") and "broken" in line
    )
    again = repository.runpytest_subprocess(
        "-p", "hil_fixtures.plugin", *shlex.split(rerun)[2:], timeout=60
    )
    again.assert_outcomes(failed=1)
    again.stdout.fnmatch_lines(["rig bench, seed 7, lockstep"])


def test_workers_share_nothing_and_the_table_is_whole(child):
    result = child(
        BENCH, "-n2", "-p", "xdist", "-p", "hil_fixtures.plugin", "-rs",
        test_workers="""
        import pytest

        @pytest.mark.requirement("SR-1")
        @pytest.mark.parametrize("n", range(4))
        def test_up(rig, n):
            assert rig.bed.near.arm.connect().program_running

        @pytest.mark.wall_clock
        def test_keeps_real_time(rig): pass
        """,
    )  # fmt: skip
    result.assert_outcomes(passed=4, skipped=1)
    result.stdout.fnmatch_lines(["SR-1  PASS  4 of 4 tests ran", "*use -n 0*"], consecutive=False)


def test_a_real_rig_runs_what_says_so_and_nothing_else(child):
    result = child(
        "--rig=lab.yaml", "-rs",
        test_lab="""
        import pytest

        @pytest.mark.real_ok
        def test_on_the_arm(rig, tmp_path):
            import fcntl, os
            from hil_fixtures.plugin.lock import lock_file
            assert rig.bed.cell.doors.ports["rtde"] == 40004
            path = lock_file("127.0.0.1", 40004)
            assert "test_on_the_arm" in path.read_text()
            with path.open() as file, pytest.raises(BlockingIOError):
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)

        def test_of_the_emulation(rig): raise AssertionError

        @pytest.mark.needs("truth")
        @pytest.mark.real_ok
        def test_truth(rig): raise AssertionError
        """,
    )  # fmt: skip
    result.assert_outcomes(passed=1, skipped=2)
    result.stdout.fnmatch_lines(["*lab is real; only tests marked real_ok*"])
    result.stdout.fnmatch_lines(["*lab has no truth; it has*"])


@pytest.mark.parametrize(
    ("option", "said"),
    [
        ("--rig=ffc_ur4", "*no rig 'ffc_ur4'; did you mean 'ffc_ur5'*"),
        ("--hil-seed=-1", "*--hil-seed: '-1' is not a whole number from 0*"),
        ("--hil-clock=walls", "*--hil-clock: 'walls' is none of lockstep, wall*"),
        ("--hil-keep=some", "*--hil-keep: 'some' is none of failed, all, none*"),
    ],
)
def test_an_option_that_makes_no_sense_is_one_line_and_nothing_runs(repository, option, said):
    result = repository.runpytest_inprocess("-p", "hil_fixtures.plugin", option)
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines([said])
    assert len(result.errlines) <= 2


def test_a_fault_that_never_happens_fails_the_test_and_is_named(child, repository):
    result = child(
        "--rig=ffc_short", "--junitxml=j.xml", "--hil-report=out", "--hil-keep=all",
        test_faults="""
        import pytest
        from hil_fixtures.strategies import Actions

        @pytest.mark.requirement("SR-9")
        @pytest.mark.fault("can.drop", trigger="phase: insert", cycles=8)
        def test_never_inserts(rig, faults, monitors, run_log):
            monitors.add("pressed at most", "fz <= 9")
            assert [fault.kind for fault in faults.faults] == ["C1"]
            rig.run(policy=Actions([]))
            assert len(run_log) == 1
        """,
    )  # fmt: skip
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(
        ["vacuous: C1 armed but never active*", "run 1: *sha256 *", "kept in *", "SR-9  FAIL*"]
    )
    found = properties(repository.path / "j.xml", "test_never_inserts")
    assert found["hil.verdict"] == ["vacuous"]
    (folder,) = found["hil.recording"]
    assert {path.name for path in Path(folder).iterdir()} == {
        "rig.yaml", "faults.yaml", "trial.json", "trace.csv",
    }  # fmt: skip
    assert load(Path(folder) / "faults.yaml").faults[0].kind == "C1"


@pytest.mark.parametrize(
    ("marker", "said"),
    [
        ('"can.dorp"', "*no fault 'can.dorp'; did you mean 'can.drop'*"),
        ('"C1", trigger="contakt"', "*no event 'contakt'; did you mean 'contact'*"),
        ('"C2", mean="3 N"', "*3 N*"),
        ('"C1", share=float("nan")', "*share*"),
    ],
)
def test_a_fault_that_makes_no_sense_is_said_at_collection_and_nothing_runs(
    repository, marker, said
):
    repository.makepyfile(
        f"import pytest\n\n@pytest.mark.fault({marker})\ndef test_it(rig): pass\n"
    )
    result = repository.runpytest_inprocess("-p", "hil_fixtures.plugin")
    assert result.ret == pytest.ExitCode.INTERRUPTED
    result.stdout.fnmatch_lines([said])
