"""Which names a program defines and what each routine sees: routines, globals, locals.

Variables of the program's first level are global, as are those declared `global`. Elsewhere a
name assigned without a keyword means the global of that name if the program has one, and a local
otherwise (Script Manual, Scoping rules). Routines see the routines of every level around them.
"""

from collections import ChainMap
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from inspect import Parameter, Signature
from typing import Final, NamedTuple, TypeAlias

from lark import Token, Tree

from hil.cell.arm.urscript.errors import ScriptError

Node: TypeAlias = Tree[Token]
ROUTINES: Final = frozenset({"function", "thread", "secondary"})
_BODIES: Final = frozenset({"block", "if_", "elif_", "else_", "while_"})


@dataclass(frozen=True, slots=True)
class Routine:
    """A function or thread; `symbol` is its name in the compiled code."""

    symbol: str
    kind: str
    signature: Signature
    defaults: Mapping[str, Node]
    block: Node
    locals: frozenset[str]
    globals: frozenset[str]
    visible: ChainMap[str, "Routine"]

    @property
    def inner(self) -> Iterator["Routine"]:
        """The routines defined in this one."""
        return iter(self.visible.maps[0].values())


def nodes(tree: Node | Token) -> Iterator[Node]:
    """The children that are rules, in order; words and absent parts are left out."""
    assert isinstance(tree, Tree)
    return (child for child in tree.children if isinstance(child, Tree))


def statements(block: Node) -> Iterator[Node]:
    """Every statement of a block and of the blocks inside it, but not those of inner routines."""
    for tree in nodes(block):
        if tree.data in _BODIES:
            yield from statements(tree)
        else:
            yield tree


def main_routine(block: Node) -> Routine:
    """The program's outermost routine, with all others inside it."""
    first_level = {n for keyword, n in _assigned(statements(block)) if keyword != "local"}
    declared = {n for keyword, n in _assigned(block.find_data("assign")) if keyword == "global"}
    known = frozenset(map(str, first_level | declared))
    return _routine(_Head("f", "function", None, block), known, ChainMap())


def _assigned(trees: Iterator[Node]) -> Iterator[tuple[str, Token]]:
    """("global" | "local" | "", name) of each assignment to a whole variable."""
    for tree in trees:
        if tree.data == "assign":
            keyword, name, _ = tree.children
            assert isinstance(name, Token)
            yield (str(keyword.children[0]) if isinstance(keyword, Tree) else ""), name


class _Head(NamedTuple):
    symbol: str
    kind: str
    parameters: Node | None
    block: Node


def _routine(head: _Head, known: frozenset[str], outer: ChainMap[str, Routine]) -> Routine:
    signature, defaults = _signature(head.parameters)
    own = _locals(head.block, known) | set(signature.parameters)
    visible = outer.new_child()
    routine = Routine(
        head.symbol, head.kind, signature, defaults, head.block, own, known - own, visible
    )  # fmt: skip
    for tree in statements(head.block):
        if tree.data in ROUTINES:
            _define(tree, known, routine)
    return routine


def _define(tree: Node, known: frozenset[str], outer: Routine) -> None:
    name, parameters, block = tree.children
    assert isinstance(name, Token)
    assert isinstance(parameters, Tree)
    assert isinstance(block, Tree)
    siblings = outer.visible.maps[0]
    if name in siblings:
        raise ScriptError(f"{name} is defined twice", *place(name))
    head = _Head(f"{outer.symbol}_{len(siblings)}", str(tree.data), parameters, block)
    siblings[str(name)] = _routine(head, known, outer.visible)


def _locals(block: Node, known: frozenset[str]) -> frozenset[str]:
    pairs = list(_assigned(statements(block)))
    local = {str(n) for keyword, n in pairs if keyword == "local"}
    for keyword, name in pairs:
        if keyword == "global" and name in local:
            raise ScriptError(f"{name} is local here and cannot be global", *place(name))
    return frozenset(local | {str(n) for keyword, n in pairs if not keyword and n not in known})


def _signature(parameters: Node | None) -> tuple[Signature, dict[str, Node]]:
    found: list[Parameter] = []
    defaults: dict[str, Node] = {}
    for parameter in nodes(parameters) if parameters else ():
        name, default = parameter.children
        assert isinstance(name, Token)
        if isinstance(default, Tree):
            defaults[str(name)] = default
        given = None if default is not None else Parameter.empty
        found.append(Parameter(str(name), Parameter.POSITIONAL_OR_KEYWORD, default=given))
    try:
        return Signature(found), defaults
    except ValueError as error:
        raise ScriptError(str(error), *place(parameters)) from None


def place(node: Node | Token | None) -> tuple[int, int]:
    """Line and column, from 1; (0, 0) of a node without text."""
    if isinstance(node, Token):
        return node.line or 0, node.column or 0
    if node is None or node.meta.empty:
        return 0, 0
    return node.meta.line, node.meta.column
