"""UR's line rules: where a newline ends nothing, because the statement goes on."""

from collections.abc import Iterator
from typing import Final

from lark import Token
from lark.lark import PostLex

_OPENING: Final = frozenset({"LPAR", "LSQB"})
_CLOSING: Final = frozenset({"RPAR", "RSQB"})
_UNFINISHED: Final = frozenset(
    {"PLUS", "MINUS", "STAR", "SLASH", "PERCENT", "COMPARISON", "EQUAL", "COMMA"}
    | {"AND", "OR", "XOR", "NOT"}
)


class Continuation(PostLex):
    """Drops newlines inside brackets and after an operator, comma or assignment sign."""

    always_accept = ("NL",)

    def process(self, stream: Iterator[Token]) -> Iterator[Token]:
        depth = 0
        unfinished = False
        for token in stream:
            kind = token.type
            if kind == "NL" and (depth > 0 or unfinished):
                continue
            depth += (kind in _OPENING) - (kind in _CLOSING)
            unfinished = kind in _UNFINISHED
            yield token
