"""URScript expressions as Python expression nodes that keep their line and column.

The nodes go to CPython's own compiler, never through source text, and can name only what
`symbols` hands out: URScript names get a prefix, so no Python name can be reached.
"""

import ast
from collections.abc import Mapping
from inspect import Signature
from math import isfinite
from typing import Final, TypeVar

from lark import Token, Tree
from lark.visitors import Interpreter

from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.scope import Node, Routine, nodes, place
from hil.cell.arm.urscript.symbols import READ, Builtin, builtin, variable
from hil.cell.arm.urscript.values import INT_MAX

P = TypeVar("P", bound=ast.expr | ast.stmt)
_COMPARISONS: Final = {
    "==": "equal", "!=": "unequal", "<": "less", "<=": "less_equal",
    ">": "greater", ">=": "greater_equal",
}  # fmt: skip
_BOOLEAN: Final = frozenset({"compare", "not_", "and_", "or_", "xor", "true", "false"})


def placed(node: P, tree: Node) -> P:
    """`node` at the place of `tree`; children without a place get it when the program is built."""
    if not tree.meta.empty:
        meta = tree.meta
        node.lineno, node.col_offset = meta.line, meta.column - 1
        node.end_lineno, node.end_col_offset = meta.end_line, meta.end_column - 1
    return node


def invoke(symbol: str, *arguments: ast.expr) -> ast.Call:
    return ast.Call(ast.Name(symbol, ast.Load()), list(arguments), [])


class Expressions(Interpreter[Token, ast.expr]):
    """Lowers the expressions of one routine."""

    def __init__(self, routine: Routine, builtins: Mapping[str, Builtin]) -> None:
        self._routine = routine
        self._builtins = builtins

    def lower(self, node: Node | Token | None) -> ast.expr:
        assert isinstance(node, Tree)
        return placed(self.visit(node), node)

    def condition(self, node: Node | Token | None) -> ast.expr:
        """An expression that `if` and `while` may branch on."""
        lowered = self.lower(node)
        assert isinstance(node, Tree)
        return lowered if node.data in _BOOLEAN else placed(invoke("condition", lowered), node)

    def knows(self, token: Token) -> bool:
        """Whether the program has a variable of that name."""
        return token in self._routine.locals or token in self._routine.globals

    def name(self, token: Token) -> str:
        """The symbol of a variable; an error if the program never assigns it."""
        if self.knows(token):
            return variable(token)
        raise ScriptError(f"name not found: {token}", *place(token))

    def elements(self, tree: Node) -> list[ast.expr]:
        return [self.lower(child) for child in tree.children if child is not None]

    def only(self, indices: Node) -> ast.expr:
        """The index, where there is to be one."""
        if len(indices.children) != 1:
            raise ScriptError("one index was expected", *place(indices))
        return self.lower(indices.children[0])

    def number(self, tree: Node) -> ast.expr:
        text = str(tree.children[0])
        value = float(text)
        if value > INT_MAX if text.isdigit() else not isfinite(value):
            raise ScriptError(f"number out of range: {text[:40]}", *place(tree))
        return ast.Constant(int(value) if text.isdigit() else value)

    def string(self, tree: Node) -> ast.expr:
        return ast.Constant(str(tree.children[0])[1:-1])

    def true(self, tree: Node) -> ast.expr:
        return ast.Constant(True)

    def false(self, tree: Node) -> ast.expr:
        return ast.Constant(False)

    def variable(self, tree: Node) -> ast.expr:
        token = tree.children[0]
        assert isinstance(token, Token)
        return ast.Name(self.name(token), ast.Load())

    def list_(self, tree: Node) -> ast.expr:
        return invoke("make_list", *self.elements(tree))

    def element(self, tree: Node) -> ast.expr:
        value, indices = tree.children
        assert isinstance(value, Tree)
        assert isinstance(indices, Tree)
        # `p` is a legal variable name too (client scripts use it): six elements make a pose.
        if value.data == "variable" and value.children == ["p"] and len(indices.children) == 6:
            return invoke("make_pose", *self.elements(indices))
        name = value.children[0] if value.data == "variable" else None
        if isinstance(name, Token) and name in READ and not self.knows(name):
            return invoke(builtin(READ[name]), self.only(indices))
        return invoke("element", self.lower(value), *self.elements(indices))

    def _operator(self, tree: Node) -> ast.expr:
        return invoke(str(tree.data), *self.elements(tree))

    add = subtract = multiply = divide = remainder = _operator

    def negate(self, tree: Node) -> ast.expr:
        operand = self.lower(tree.children[0])
        if isinstance(operand, ast.Constant) and isinstance(operand.value, int | float):
            return ast.Constant(-operand.value)
        return invoke("negate", operand)

    def compare(self, tree: Node) -> ast.expr:
        left, sign, right = tree.children
        return invoke(_COMPARISONS[str(sign)], self.lower(left), self.lower(right))

    def not_(self, tree: Node) -> ast.expr:
        return ast.UnaryOp(ast.Not(), self.condition(tree.children[0]))

    def and_(self, tree: Node) -> ast.expr:
        return ast.BoolOp(ast.And(), [self.condition(child) for child in tree.children])

    def or_(self, tree: Node) -> ast.expr:
        return ast.BoolOp(ast.Or(), [self.condition(child) for child in tree.children])

    def xor(self, tree: Node) -> ast.expr:
        left, right = (self.condition(child) for child in tree.children)
        return ast.Compare(left, [ast.NotEq()], [right])

    def call(self, tree: Node) -> ast.expr:
        name = tree.children[0]
        assert isinstance(name, Token)
        if routine := self._routine.visible.get(name):
            if routine.kind == "thread":
                raise ScriptError(f"{name} is a thread: use run", *place(tree))
            return ast.YieldFrom(self._routine_call(routine, tree))
        if builtin := self._builtins.get(name):
            made = self._bound(builtin.symbol, tree, builtin.signature, {})
            return ast.YieldFrom(made) if builtin.blocking else made
        raise ScriptError(f"name not found: {name}", *place(tree))

    def run(self, tree: Node) -> ast.expr:
        name = tree.children[0]
        assert isinstance(name, Token)
        routine = self._routine.visible.get(name)
        if routine is None or routine.kind != "thread":
            raise ScriptError(f"{name} is not a thread", *place(tree))
        return invoke("run", self._routine_call(routine, tree))

    def _routine_call(self, routine: Routine, tree: Node) -> ast.expr:
        made = self._bound(routine.symbol, tree, routine.signature, routine.defaults)
        for keyword in made.keywords:
            keyword.arg = variable(str(keyword.arg))
        return made

    def _bound(
        self, symbol: str, tree: Node, signature: Signature, defaults: Mapping[str, Node]
    ) -> ast.Call:
        """The call with its arguments; a default of the program's own is evaluated at the call."""
        positional, keywords = self._arguments(tree)
        name = tree.children[0]
        try:
            given = signature.bind(*positional, **keywords).arguments
        except TypeError as error:
            raise ScriptError(f"{name}: {error}", *place(tree)) from None
        for parameter, default in defaults.items():
            if parameter not in given:
                keywords[parameter] = self.lower(default)
        bound = [ast.keyword(keyword, value) for keyword, value in keywords.items()]
        return placed(ast.Call(ast.Name(symbol, ast.Load()), positional, bound), tree)

    def _arguments(self, tree: Node) -> tuple[list[ast.expr], dict[str, ast.expr]]:
        positional: list[ast.expr] = []
        keywords: dict[str, ast.expr] = {}
        for argument in nodes(tree.children[1]):
            keyword, expression = argument.children
            if not isinstance(keyword, Token) and not keywords:
                positional.append(self.lower(expression))
            elif isinstance(keyword, Token) and str(keyword) not in keywords:
                keywords[str(keyword)] = self.lower(expression)
            else:
                raise ScriptError("argument out of order or given twice", *place(argument))
        return positional, keywords
