import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.interfaces import Freshness, WrenchReading
from drivers.protocol.frame import CanFrame
from drivers.protocol.rtde import FieldType, PackageType, Recipe
from drivers.protocol.rtde import encode as package
from hil.cell.plant.interface import Contact, PartTruth, PlantStep
from hil.recording.channel import TOPICS, Channel
from hil.recording.channels import can, control, deadline, event, plant, rtde, truth, wrench
from hil.recording.channels.event import EventKind
from hil.recording.codec import SCHEMAS, decoders

real = st.floats(allow_nan=False, allow_infinity=False)
vector6 = st.tuples(*[real] * 6)
frames = st.builds(CanFrame, st.integers(0, 0x7FF), st.binary(max_size=64), st.booleans())


@given(st.lists(st.tuples(st.integers(0, 2**62), frames), max_size=20))
def test_can_frames_come_back_as_they_were_on_the_bus(sent):
    back = can.fields(can.encode(sent))["frames"]
    assert [
        (t, CanFrame(int(id, 16), bytes.fromhex(payload), bool(fd))) for t, id, fd, payload in back
    ] == sent


@given(vector6, st.lists(vector6, max_size=12), st.integers(0, 2**40), st.booleans(), st.booleans())
def test_a_reading_comes_back_whole(newest, samples, counter, fresh, tared):
    freshness = Freshness.OK if fresh else Freshness.HELD
    reading = WrenchReading(newest, tuple(samples), counter, 2_000_000, freshness, tared)
    fields = wrench.fields(wrench.encode(reading))
    assert tuple(fields["wrench"].values()) == newest
    assert fields["samples"] == samples
    assert (fields["counter"], fields["age"]) == (counter, 2_000_000)
    assert (fields["freshness"], fields["tared"]) == (freshness.value, tared)


@given(st.text(st.characters(exclude_characters="\0"), max_size=9), st.integers(-1, 500), vector6)
def test_a_control_period_comes_back_whole(phase, k, setpoint):
    fields = control.fields(
        control.encode(phase, k, setpoint, setpoint[::-1], (1.0, 2.0, 3.0, 4.0))
    )
    assert (fields["phase"], fields["k"]) == (phase, k)
    assert tuple(fields["setpoint"].values()) == setpoint
    assert fields["wrench"]["fx"] == setpoint[5]
    assert fields["stage"] == {"x": 1.0, "y": 2.0, "z": 3.0, "theta": 4.0}


@pytest.mark.parametrize("name", [None, "FFC1"])
@pytest.mark.parametrize("contact", list(Contact))
def test_a_plant_step_comes_back_whole(name, contact):
    part = PartTruth(name, (1.0, 2.0, 3.0), 0.1, 0.002, (4.0, 5.0, 0.2), contact)
    step = PlantStep(np.zeros((8, 6)), (6.0, 7.0, 8.0, 0.3), (9.0, 10.0, 11.0, 0.4), part)
    assert plant.fields(plant.encode(step)) == {
        "stage": {"x": 6.0, "y": 7.0, "z": 8.0, "theta": 0.3},
        "velocity": {"x": 9.0, "y": 10.0, "z": 11.0, "theta": 0.4},
        "part": name,
        "tip": {"x": 1.0, "y": 2.0, "z": 3.0},
        "theta": 0.1,
        "depth": 0.002,
        "grip": {"x": 4.0, "y": 5.0, "theta": 0.2},
        "contact": contact.value,
    }


def test_true_wrenches_keep_their_rows():
    wrenches = np.arange(48.0).reshape(8, 6)
    rows = truth.fields(truth.encode(wrenches))["wrenches"]
    assert np.array_equal(np.array(rows), wrenches)


def test_true_wrenches_of_a_strided_view_keep_their_rows():
    view = np.arange(96.0).reshape(8, 12)[:, ::2]
    assert np.array_equal(np.array(truth.fields(truth.encode(view))["wrenches"]), view)


def test_a_data_package_is_decoded_by_its_recipe():
    recipe = Recipe(["timestamp", "actual_q"], [FieldType.DOUBLE, FieldType.VECTOR6D])
    body = recipe.pack([1.5, (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)])
    raw = package(PackageType.DATA, b"\x01" + body)
    names = {1: (("timestamp", "DOUBLE"), ("actual_q", "VECTOR6D"))}
    fields = decoders({}, names)[Channel.RTDE_OUT](raw)
    assert fields["raw"] == raw.hex()
    assert fields["values"] == {"timestamp": 1.5, "actual_q": (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)}


@given(st.binary(max_size=40))
def test_any_bytes_on_the_wire_are_kept_even_where_nothing_can_be_decoded(raw):
    recipes = rtde.compile_recipes({1: (("timestamp", "DOUBLE"),)})
    assert bytes.fromhex(rtde.fields(raw, recipes)["raw"]) == raw


def test_deadlines_and_events_come_back():
    assert deadline.fields(deadline.encode(3, 1)) == {"period": 3, "misses": 1}
    note = event.fields(event.encode(EventKind.OUTCOME, "inserted\n2.0 mm"))
    assert note == {"kind": "outcome", "text": "inserted\n2.0 mm"}


def test_every_channel_has_a_topic_a_schema_and_a_decoder():
    assert len(TOPICS) == len(Channel)
    assert set(SCHEMAS) == set(decoders({}, {})) == set(Channel)


def test_an_event_names_an_address_without_the_port_that_another_run_has_not():
    """Two runs of one seed whose link was cut had recordings that differed by it."""
    lines = [f"LinkError: RTDE at 127.0.0.1:{port} cut the connection" for port in (34805, 44351)]
    first, again = (event.encode(EventKind.NOTE, line) for line in lines)
    assert first == again
    assert event.fields(first)["text"] == "LinkError: RTDE at 127.0.0.1 cut the connection"
    assert event.fields(event.encode(EventKind.NOTE, "at 12:30 h"))["text"] == "at 12:30 h"
