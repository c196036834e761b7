"""Which channel is described and decoded by which module."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import TypeAlias

from hil.recording.channel import Channel
from hil.recording.channels import can, control, deadline, event, plant, rtde, truth, wrench
from hil.recording.channels.rtde import RecipeNames
from hil.recording.channels.schema import Fields, Schema

Decode: TypeAlias = Callable[[bytes], Fields]

SCHEMAS: Mapping[Channel, Schema] = {
    Channel.RTDE_IN: rtde.schema("rtde/in"),
    Channel.RTDE_OUT: rtde.schema("rtde/out"),
    Channel.CAN: can.SCHEMA,
    Channel.WRENCH: wrench.SCHEMA,
    Channel.WRENCH_TRUE: truth.SCHEMA,
    Channel.PLANT: plant.SCHEMA,
    Channel.CTRL: control.SCHEMA,
    Channel.DEADLINE: deadline.SCHEMA,
    Channel.EVENT: event.SCHEMA,
}


def decoders(
    recipes_in: Mapping[int, RecipeNames], recipes_out: Mapping[int, RecipeNames]
) -> dict[Channel, Decode]:
    """One decoder a channel; ValueError for a recipe that RTDE does not allow."""
    return {
        Channel.RTDE_IN: partial(rtde.fields, recipes=rtde.compile_recipes(recipes_in)),
        Channel.RTDE_OUT: partial(rtde.fields, recipes=rtde.compile_recipes(recipes_out)),
        Channel.CAN: can.fields,
        Channel.WRENCH: wrench.fields,
        Channel.WRENCH_TRUE: truth.fields,
        Channel.PLANT: plant.fields,
        Channel.CTRL: control.fields,
        Channel.DEADLINE: deadline.fields,
        Channel.EVENT: event.fields,
    }
