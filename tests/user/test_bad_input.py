import pytest

RIG = "name: r\nfixture: {parts: [{name: P, position: [0 m, 0 m, 0 m]}]}\n"

FILES = {
    "key.yaml": RIG + "cable: {free_lenght: 6 mm}\n",
    "unit.yaml": RIG + "cable: {width: 18.5 kg}\n",
    "bare.yaml": RIG + "cable: {width: 18.5}\n",
    "seed.yaml": RIG + "seed: .nan\n",
    "partless.yaml": "name: r\n",
    "list.yaml": "- name: r\n",
    "file": "",
}

CASES = (
    ("run fcc_ur5", "did you mean 'ffc_ur5'?"),
    ("run none.yaml", "cannot be read"),
    ("run folder", "is a folder, not a rig"),
    ("run key.yaml", "did you mean 'free_length'?"),
    ("run unit.yaml", "'18.5 kg' is not a quantity in m"),
    ("run bare.yaml", "18.5 has no unit"),
    ("run seed.yaml", "seed: "),
    ("run list.yaml", "a rig file is a mapping of sections"),
    ("run partless.yaml", "nothing to assemble"),
    ("run ffc_ur5 --part FFC9", "it has: FFC1, FFC2"),
    ("run ffc_ur5 --seed nan", "--seed"),
    ("run ffc_ur5 --sed 1", "--seed"),
    ("run ffc_ur5 --policy oracle --cell process", "only --cell inline"),
    ("run ffc_ur5 --out file", "choose another folder"),
    ("demo --out /proc/none", "choose another folder"),
    ("run ffc_ur5 --out full", "holds a run; choose another folder or --overwrite"),
    ("replay file", "is empty"),
    ("replay folder", "holds neither run.mcap nor run.mcap.part"),
    ("diff file none", "is empty"),
    ("bench --case contact", "did you mean"),
    ("up ffc_ur5 --clock sundial", "'lockstep', 'wall'"),
    ("up ffc_ur5 --host 10.0.0.1", "no loopback address"),
    ("experiment insertion --seeds 0", "--seeds"),
)


@pytest.fixture
def shelf(tmp_path):
    """The files that the cases name."""
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    (tmp_path / "folder").mkdir()
    (tmp_path / "full").mkdir()
    (tmp_path / "full/run.mcap").touch()


@pytest.mark.parametrize(("line", "expected"), CASES)
def test_bad_input_is_one_line_that_says_what_is_allowed(hil, shelf, tmp_path, line, expected):
    before = sorted(tmp_path.rglob("*"))
    ended = hil(*line.split())
    assert (ended.returncode, ended.stdout) == (2, "")
    assert ended.stderr.startswith("hil: ")
    assert ended.stderr.count("\n") == 1
    assert expected in ended.stderr
    assert sorted(tmp_path.rglob("*")) == before


def test_no_command_at_all_shows_the_commands(hil):
    ended = hil()
    assert ended.returncode == 2
    assert ended.stderr.startswith("Usage: hil")
    assert "doctor" in ended.stderr
