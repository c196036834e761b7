from hypothesis import given, settings

from hil.cell.faults.catalogue import CATALOGUE
from hil.cell.faults.parse import schedule as parsed
from hil.cell.rig import parse
from hil.cli.rig_text import as_yaml
from hil.falsify.faults import space
from hil_fixtures import strategies as hs
from hil_fixtures.testbed import shipped

BASE = shipped("ffc_ur5")


@given(hs.fault_schedules(max_faults=3))
def test_every_schedule_drawn_is_one_that_a_file_can_hold(found):
    assert parsed(found.written()) == found


def test_every_row_of_the_catalogue_can_be_drawn():
    assert list(space(hs.SINGLE)) == [row.id for row in CATALOGUE]


@settings(max_examples=10)
@given(hs.rigs(BASE))
def test_every_rig_drawn_is_one_that_a_file_can_hold(rig):
    assert rig.rig == BASE.rig
    for key, (low, high) in hs.SPREAD.items():
        section = rig
        for name in key.split("."):
            section = getattr(section, name)
        assert low <= section <= high
    assert parse(as_yaml(rig)).connector.friction == rig.connector.friction


@given(hs.learner_actions(max_size=25))
def test_actions_come_in_turn_and_end(actions):
    taken = [actions.choose(None) for _ in range(len(actions.actions) + 2)]
    assert len(actions.actions) <= 25
    assert taken == [*actions.actions, None, None]


@given(hs.command_streams(3e-3))
def test_commands_stay_within_their_step(moves):
    assert all(abs(way) <= 3e-3 + 1e-15 for move in moves for way in move.step)
