"""URScript programs out of bytes: grammatical text that calls every builtin with odd values."""

from collections.abc import Iterator
from typing import Final

from hil.cell.arm.urscript.builtins import builtins

NUMBERS: Final = (
    "0", "1", "-1", "2", "3", "6", "47", "127", "2147483647", "0.0", "0.5", "3.14159", "-0.01",
    "1e-320", "1e9", "1e308", "-1e308",
    'to_num("nan")', 'to_num("1e999")', 'to_num("' + "9" * 400 + '")',
)  # fmt: skip
STRINGS: Final = (
    '""', '"x"', '"-"', '"%"', '"input_int_register_0"', '"pause"', '"²"', '"99999999999"', "'\"'",
)  # fmt: skip
LISTS: Final = (
    "[]", "[0]", "[0,-1.5,1.5,-1.5,-1.5,0]", "[True,False]", "[[1,2],[3,4]]", '["a","b"]',
)  # fmt: skip
ADDRESSES: Final = ('""', '".."', '"127.0.0.1"', f'"{"a" * 70}"')
"""None that a name server would be asked for."""
PORTS: Final = ("0", "1", "-1", "65536", "2147483647")
OPERATORS: Final = ("+", "-", "*", "/", "%", "==", "<", "and", "or", "xor")
DEPTH: Final = 3

_POSE, _SIX, _THREE, _TEXT, _TRUTH = range(5)
_WANTED: Final = {
    _POSE: "pose pose_to pose_via task_frame tcp feature p_1 p_2 p_from p_from_to p_to",
    _SIX: "q qd qnear xd position limits wrench selection_vector freeAxes inertia torque "
    "coulomb_scale viscous_scale direction",
    _THREE: "rpy rotation_vector cog d sensor_cog sensor_measuring_offset",
    _TEXT: "action name op1 op2 prefix s s1 socket_name src str suffix target title variable_name",
    _TRUTH: "blocking enable error warning interpret_escape friction_comp",
}
_KINDS: Final = {name: kind for kind, names in _WANTED.items() for name in names.split()}
"""What a builtin most likely wants in a parameter of this name; a number otherwise."""


class Writer:
    """Writes a program; each choice takes one byte, and the text ends when they run out."""

    def __init__(self, octets: bytes) -> None:
        self._octets = iter(octets)
        self._signatures = {name: made.signature for name, made in builtins().items()}
        self._names = sorted(self._signatures)
        self.over = False

    def program(self) -> str:
        """A whole `def`."""
        lines = ["def p():", " global a = 1", " global b = [0,0,0,0,0,0]"]
        lines += [" thread t():", "  while True:", "   sync()", "  end", " end"]
        while not self.over:
            lines += self._statement(1)
        return "\n".join([*lines, "end", ""])

    def _pick(self, count: int) -> int:
        octet = next(self._octets, None)
        self.over |= octet is None
        return 0 if octet is None else octet * count // 256

    def _one(self, words: tuple[str, ...]) -> str:
        return words[self._pick(len(words))]

    def _statement(self, depth: int) -> Iterator[str]:
        pad, kind = " " * depth, self._pick(16)
        if kind == 0 and depth <= DEPTH:
            yield f"{pad}if {self._truth()}:"
            yield from self._statement(depth + 1)
            yield f"{pad}else:"
            yield from self._statement(depth + 1)
            yield f"{pad}end"
        elif kind == 1 and depth <= DEPTH:
            yield f"{pad}while {self._truth()}:"
            yield from self._statement(depth + 1)
            yield f"{pad} sync()"
            yield f"{pad}end"
        elif kind == 2:
            yield f"{pad}a = {self._any(0)}"
        elif kind == 3:
            yield f"{pad}b[{self._pick(7)}] = {self._number(1)}"
        elif kind == 4:
            yield f"{pad}h = run t()\n{pad}kill h"
        elif kind == 5:
            yield f"{pad}sync()"
        else:
            yield pad + self._call(0)

    def _any(self, depth: int) -> str:
        kind = self._pick(8)
        if kind < 4 or depth >= DEPTH:
            return self._number(depth)
        written = (self._one(STRINGS), self._one(LISTS), self._list("p", 6, depth), self._truth())
        return written[kind - 4]

    def _number(self, depth: int) -> str:
        kind = self._pick(10)
        if kind < 6 or depth >= DEPTH:
            return self._one(NUMBERS)
        if kind == 6:
            return f"b[{self._pick(7)}]"
        if kind == 7:
            return self._call(depth + 1)
        return f"({self._number(depth + 1)} {self._one(OPERATORS)} {self._number(depth + 1)})"

    def _truth(self) -> str:
        return ("True", "False", "a == 1", f"b[0] < {self._one(NUMBERS)}")[self._pick(4)]

    def _list(self, mark: str, size: int, depth: int) -> str:
        """Mostly what an arm near its home would be told, with an odd number or two."""
        near = ["0.1", "-0.3", "0.2", "0.0", "3.1", "0.1"][:size]
        for _ in range(self._pick(3)):
            near[self._pick(size)] = self._number(depth + 1)
        return f"{mark}[{', '.join(near)}]"

    def _argument(self, name: str, depth: int) -> str:
        if self._pick(16) == 0:
            return self._any(depth)
        kind = _KINDS.get(name)
        if kind == _POSE:
            return self._list("p", 6, depth)
        if kind in (_SIX, _THREE):
            return self._list("", 6 if kind == _SIX else 3, depth)
        if kind == _TEXT:
            return self._one(STRINGS)
        return self._truth() if kind == _TRUTH else self._number(depth)

    def _call(self, depth: int) -> str:
        name = self._names[self._pick(len(self._names))]
        if name == "socket_open":
            return f"socket_open({self._one(ADDRESSES)}, {self._one(PORTS)})"
        parameters = self._signatures[name].parameters.values()
        wanted = [p for p in parameters if p.default is p.empty or self._pick(2)]
        values = ", ".join(f"{p.name}={self._argument(p.name, depth + 1)}" for p in wanted)
        return f"{name}({values})"
