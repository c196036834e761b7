import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from drivers.protocol.nrs_can import COUNT_LIMIT, TARED, VALID, Identifiers
from drivers.protocol.nrs_sample import encode_pair
from hil.cell.rig.sensor import Sensor
from hil.cell.sensor.framing import TORQUE_DELAY, Batch, Framing

IDS = Identifiers.of(1)
COUNT = st.integers(1 - COUNT_LIMIT, COUNT_LIMIT - 1)


@given(
    rows=st.lists(st.lists(COUNT, min_size=6, max_size=6), max_size=9),
    first=st.integers(0, 2**32),
    data=st.data(),
)
def test_a_batch_is_packed_as_the_codec_packs_each_sample(rows, first, data):
    times = [1_000_000 * (i + 1) for i in range(len(rows))]
    values = np.array(rows, np.int64).reshape(-1, 6)
    old = data.draw(st.integers(0, len(rows)))
    batch = Batch(times, values, np.zeros(len(rows), np.int64), first, old)
    expected = []
    for i, (t, row) in enumerate(zip(times, rows, strict=True)):
        flags = VALID if i < old else VALID | TARED
        force, torque = encode_pair(IDS, row, flags, first + i)
        expected += [(t, force), (t + TORQUE_DELAY, torque)]
    assert Framing(Sensor(), IDS).frames(batch, (False, True)) == expected
