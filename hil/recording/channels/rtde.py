"""/rtde/in and /rtde/out: one RTDE package as it crossed the wire, and its values if known."""

from collections.abc import Mapping
from typing import TypeAlias

from drivers.protocol.rtde import FieldType, PackageType, Recipe
from hil.recording.channels.schema import Fields, Schema, integer, message, text

RecipeNames: TypeAlias = tuple[tuple[str, str], ...]
"""A recipe as (variable, RTDE type) pairs, such as ("timestamp", "DOUBLE")."""

_HEADER = 3  # uint16 size, uint8 type


def schema(title: str) -> Schema:
    return message(
        title,
        raw=text("the whole package, hex"),
        type=integer("package type, the ASCII code of the RTDE guide's letter"),
        values={"type": "object", "description": "a data package's variables, SI, if known"},
    )


def encode(package: bytes) -> bytes:
    """The package itself: what was on the wire needs no other form."""
    return package


def compile_recipes(recipes: Mapping[int, RecipeNames]) -> dict[int, Recipe]:
    """Recipes by id, ready to unpack; ValueError for a type that RTDE has not."""
    return {number: _recipe(names) for number, names in recipes.items()}


def _recipe(names: RecipeNames) -> Recipe:
    try:
        return Recipe([name for name, _ in names], [FieldType[kind] for _, kind in names])
    except KeyError as error:
        raise ValueError(
            f"RTDE has no type {error}, types are {list(FieldType.__members__)}"
        ) from None


def fields(package: bytes, recipes: Mapping[int, Recipe]) -> Fields:
    """Raw bytes always; values when the package is a data package of a known recipe (v2)."""
    kind = package[2] if len(package) >= _HEADER else -1
    message: Fields = {"raw": package.hex(), "type": kind}
    if kind == PackageType.DATA and len(package) > _HEADER:
        recipe = recipes.get(package[_HEADER])
        body = package[_HEADER + 1 :]
        if recipe is not None and len(body) == recipe.size:
            message["values"] = dict(zip(recipe.names, recipe.unpack(body), strict=True))
    return message
