import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.cell.arm.urscript import Runtime, ScriptError, compile_program


def test_program_is_named_by_its_def():
    assert compile_program("def main():\n  sync()\nend\n").name == "main"


def test_plain_statements_have_no_name():
    assert compile_program("sync()").name == "unnamed"


def test_sec_makes_a_secondary_program():
    assert compile_program("sec lamp():\n  set_digital_out(1, True)\nend\n").secondary


def test_same_text_is_compiled_once():
    text = "def again():\n  sync()\nend\n"
    assert compile_program(text) is compile_program(text)


def test_runs_of_one_program_share_no_variables(robots):
    program = compile_program("def p():\n  n = n_of()\n  textmsg(n)\nend\n".replace("n_of()", "1"))
    first, second = robots(), robots()
    Runtime(program, first).step()
    Runtime(program, second).step()
    assert first.messages == second.messages == ["1"]


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("def f(:\nend", 1, 7),
        ("x = 1\ny = )", 2, 5),
        ("def f():\n  x = 1 +\nend", 3, 1),
        ("x = 1\n  missing()", 2, 3),
        ("x = 99999999999", 1, 5),
        ("if True:\n  break\nend", 2, 3),
        ("servoj()", 1, 1),
        ("servoj([0], speed = 1)", 1, 1),
        ("textmsg(s2 = 1, 2)", 1, 17),
        ("def f():\nend\nrun f()", 3, 1),
        ("thread t():\nend\nt()", 3, 1),
        ("def a():\nend\ndef b():\nend", 3, 1),
        ("def a(x):\nend", 1, 5),
    ],
)
def test_error_tells_line_and_column(text, line, column):
    with pytest.raises(ScriptError) as caught:
        compile_program(text)
    assert (caught.value.line, caught.value.column) == (line, column)


def test_text_that_ends_too_early_says_so():
    with pytest.raises(ScriptError, match="ends too early"):
        compile_program("def f():\n  sync()\n")


@pytest.mark.parametrize(
    "text", ["x = " + "not " * 5000 + "True", "while True:\n" * 30 + "end\n" * 30]
)
def test_nesting_without_end_is_refused(text):
    with pytest.raises(ScriptError, match="nest"):
        compile_program(text)


_WORDS = """def thread sec end if elif else while return break continue pass halt run kill
    join local global and or xor not True False enter_critical exit_critical f x p 1 2.5 "s" ( ) [ ]
    : , = == < + - * / % $ # sync textmsg"""
_WORD = st.sampled_from([*re.split(r"\s+", _WORDS), "\n"])


@given(st.text(max_size=60) | st.lists(_WORD, max_size=30).map(" ".join))
def test_garbage_raises_script_error_or_compiles(robots, text):
    try:
        runtime = Runtime(compile_program(text), robots())
    except ScriptError:
        return
    runtime.step()


_CLAUSES = st.sampled_from([
    "x = x + 1", "x = [x, x]", "x = x * x", "x = str_cat(x, x)", "x = x[0]", "x = -x", "x = not x",
    "x[0] = x", "x = p[x, 1, 2, 3, 4, 5]", "x = f(x)", "h = run t()", "kill h", "join h", "sync()",
    "if x == x: x = 1 end", "servoj(x)", "movej(x)", "enter_critical", "exit_critical", "halt",
    "x = to_str(x)", "x = norm(x)", "x = floor(x)", "sleep(x)", "x = pose_inv(x)", "speedj(x)",
    "x = pow(x, x)", "x = get_inverse_kin(x)", "x = x % x", "x = x / 3", "x = 2.5", "x = x < x",
])  # fmt: skip


@given(st.lists(_CLAUSES, max_size=20))
def test_nothing_but_script_errors_ends_a_program(robots, clauses):
    text = "\n".join(
        ["x = 1", "h = 0", "def f(y):", "return y", "end", "thread t():", *clauses, "end", *clauses]
    )
    robot = robots()
    runtime = Runtime(compile_program(text), robot)
    for _ in range(20):
        runtime.step()
        robot.end_cycle()
