"""URScript statements and routines as Python statement nodes; every routine becomes a generator.

A generator's `yield` is the end of the thread's slice of this control cycle.
"""

import ast
from collections.abc import Iterator, Mapping

from lark import Token, Tree
from lark.visitors import Interpreter

from hil.cell.arm.urscript.expressions import Expressions, invoke, placed
from hil.cell.arm.urscript.scope import ROUTINES, Node, Routine, nodes
from hil.cell.arm.urscript.symbols import WRITTEN, Builtin, builtin, variable


def module(main: Routine, builtins: Mapping[str, Builtin]) -> ast.Module:
    """All routines side by side: their symbols are unique, so nesting need not be kept."""
    body: list[ast.stmt] = [_definition(routine, builtins) for routine in _family(main)]
    return ast.fix_missing_locations(ast.Module(body, []))


def _family(routine: Routine) -> Iterator[Routine]:
    yield routine
    for inner in routine.inner:
        yield from _family(inner)


def _definition(routine: Routine, builtins: Mapping[str, Builtin]) -> ast.FunctionDef:
    body: list[ast.stmt] = []
    if routine.globals:
        body.append(ast.Global([variable(name) for name in sorted(routine.globals)]))
    body.append(ast.Expr(invoke("spend")))
    body += Statements(routine, builtins).block(routine.block)
    # The `yield` that is never reached makes a generator of a routine without any.
    body += [ast.Return(ast.Constant(None)), ast.Expr(ast.Yield(None))]
    parameters = [ast.arg(variable(name)) for name in routine.signature.parameters]
    arguments = ast.arguments([], parameters, None, [], [], None, [])
    return placed(ast.FunctionDef(routine.symbol, arguments, body, []), routine.block)


class Statements(Interpreter[Token, ast.stmt]):
    """Lowers the statements of one routine."""

    def __init__(self, routine: Routine, builtins: Mapping[str, Builtin]) -> None:
        self._expressions = Expressions(routine, builtins)

    def block(self, block: Node) -> list[ast.stmt]:
        lowered = [
            placed(self.visit(tree), tree) for tree in nodes(block) if tree.data not in ROUTINES
        ]
        return lowered or [ast.Pass()]

    def _block(self, tree: object) -> list[ast.stmt]:
        assert isinstance(tree, Tree)
        return self.block(tree)

    def assign(self, tree: Node) -> ast.stmt:
        _, name, value = tree.children
        assert isinstance(name, Token)
        target = ast.Name(self._expressions.name(name), ast.Store())
        return ast.Assign([target], self._expressions.lower(value))

    def assign_element(self, tree: Node) -> ast.stmt:
        _, name, indices, value = tree.children
        assert isinstance(name, Token)
        assert isinstance(indices, Tree)
        if name in WRITTEN and not self._expressions.knows(name):
            index = self._expressions.only(indices)
            return ast.Expr(invoke(builtin(WRITTEN[name]), index, self._expressions.lower(value)))
        symbol = self._expressions.name(name)
        new = invoke(
            "replaced",
            ast.Name(symbol, ast.Load()),
            self._expressions.lower(value),
            *self._expressions.elements(indices),
        )
        return ast.Assign([ast.Name(symbol, ast.Store())], placed(new, tree))

    def evaluate(self, tree: Node) -> ast.stmt:
        return ast.Expr(self._expressions.lower(tree.children[0]))

    def return_(self, tree: Node) -> ast.stmt:
        value = tree.children[0]
        return ast.Return(self._expressions.lower(value) if value is not None else None)

    def break_(self, tree: Node) -> ast.stmt:
        return ast.Break()

    def continue_(self, tree: Node) -> ast.stmt:
        return ast.Continue()

    def pass_(self, tree: Node) -> ast.stmt:
        return ast.Pass()

    def halt(self, tree: Node) -> ast.stmt:
        return ast.Raise(ast.Name("Halt", ast.Load()), None)

    def enter_critical(self, tree: Node) -> ast.stmt:
        return ast.Pass()  # a slice is critical anyway: see scheduler.py

    def exit_critical(self, tree: Node) -> ast.stmt:
        return ast.Pass()

    def kill(self, tree: Node) -> ast.stmt:
        return ast.Expr(invoke("kill", self._expressions.lower(tree.children[0])))

    def join(self, tree: Node) -> ast.stmt:
        handle = self._expressions.lower(tree.children[0])
        return ast.Expr(ast.YieldFrom(invoke("join", handle)))

    def while_(self, tree: Node) -> ast.stmt:
        condition, block = tree.children
        body = [ast.Expr(invoke("spend")), *self._block(block)]
        return ast.While(self._expressions.condition(condition), body, [])

    def if_(self, tree: Node) -> ast.stmt:
        condition, block, *others = nodes(tree)
        orelse: list[ast.stmt] = []
        for other in reversed(others):
            orelse = self._alternative(other, orelse)
        return ast.If(self._expressions.condition(condition), self._block(block), orelse)

    def _alternative(self, tree: Node, orelse: list[ast.stmt]) -> list[ast.stmt]:
        if tree.data == "else_":
            return self._block(tree.children[0])
        condition, block = tree.children
        test = self._expressions.condition(condition)
        return [placed(ast.If(test, self._block(block), orelse), tree)]
