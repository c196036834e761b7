import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.cell.arm.urscript import Runtime, RuntimeStatus, compile_program


def test_lists_are_copied_when_assigned(said):
    assert said("a = [1, 2]\nb = a\nb[0] = 9\ntextmsg(a)\ntextmsg(b)") == ["[1, 2]", "[9, 2]"]


def test_lists_are_copied_when_passed(said):
    program = """
    def clear(list):
      list[0] = 0
    end
    a = [1, 2]
    clear(a)
    textmsg(a)
    """
    assert said(program) == ["[1, 2]"]


def test_matrix_element_is_assigned_by_two_indices(said):
    assert said("m = [[1, 2], [3, 4]]\nm[1, 0] = 9\ntextmsg(m)\ntextmsg(m[1, 1])") == [
        "[[1, 2], [9, 4]]",
        "4",
    ]


def test_pose_stays_a_pose_when_an_element_is_assigned(said):
    assert said("q = p[0, 0, 0, 0, 0, 0]\nq[2] = 0.5\ntextmsg(q)") == ["p[0, 0, 0.5, 0, 0, 0]"]


def test_lists_add_and_scale_element_by_element(said):
    assert said("textmsg(2 * [1, 2] - [3, 0] / 2 + (-[1, 1]))") == ["[-0.5, 3]"]


def test_p_can_be_the_name_of_a_list(said):
    assert said("p = [7, 8]\ntextmsg(p[1])") == ["8"]


@pytest.mark.parametrize(("x", "branch"), [(1, "if"), (2, "first"), (3, "second"), (4, "else")])
def test_branch_taken_is_the_first_whose_condition_holds(said, x, branch):
    program = f"""
    x = {x}
    if x == 1: textmsg("if")
    elif x == 2: textmsg("first")
    elif x <= 3: textmsg("second")
    else: textmsg("else") end
    """
    assert said(program) == [branch]


def test_while_obeys_break_and_continue(said):
    program = """
    i = 0
    while True:
      i = i + 1
      if i == 2:
        continue
      end
      if i > 3:
        break
      end
      textmsg(i)
    end
    """
    assert said(program) == ["1", "3"]


def test_arguments_go_by_place_by_name_and_by_default(said):
    program = """
    def f(a, b = 2, c = 3):
      return a * 100 + b * 10 + c
    end
    textmsg(f(1))
    textmsg(f(1, c = 9))
    textmsg(f(c = 4, a = 5, b = 6))
    """
    assert said(program) == ["123", "129", "564"]


def test_default_is_evaluated_at_each_call(said):
    program = """
    global n = 1
    def f(a = n):
      return a
    end
    textmsg(f())
    n = 2
    textmsg(f())
    """
    assert said(program) == ["1", "2"]


def test_functions_recurse(said):
    program = """
    def factorial(n):
      if n < 2:
        return 1
      end
      return n * factorial(n - 1)
    end
    textmsg(factorial(10))
    """
    assert said(program) == ["3628800"]


def test_empty_blocks_are_allowed(said):
    assert said("def f():\nend\nif True:\nelse:\nend\nf()\ntextmsg(1)") == ["1"]


def test_newlines_continue_inside_brackets_and_after_operators(said):
    program = """
    global a = # comment after an equal sign
    1    global b = [2,
      3]
    if a == 5 or
       b[1] ==
       3:
      textmsg(a +
        b[0])
    end
    """
    assert said(program) == ["3"]


def test_two_statements_may_share_a_line(said):
    assert said("a = 1 b = -a textmsg(b) textmsg(a)") == ["-1", "1"]


def test_labels_and_comments_do_nothing(said):
    assert said('$ 1 "Robot Program"\ntextmsg(1) # twice\n$ 2 "end"\ntextmsg("#")') == ["1", "#"]


def test_and_and_or_skip_the_operand_they_do_not_need(said):
    program = """
    def loud(x):
      textmsg(x)
      return True
    end
    if False and loud("and") or True or loud("or"):
      textmsg("done")
    end
    """
    assert said(program) == ["done"]


def test_xor_holds_when_one_side_holds(said):
    assert said("textmsg(True xor False)\ntextmsg(True xor True)") == ["True", "False"]


def test_halt_ends_the_program_at_its_line(run, robot):
    runtime = run("textmsg(1)\nhalt\ntextmsg(2)")
    assert (runtime.status, runtime.line, robot.messages) == (RuntimeStatus.HALTED, 2, ["1"])


_LEAVES = st.integers(0, 99).map(str) | st.floats(0.01, 99.0).map(lambda x: f"{x:.3f}")
_ARITHMETIC = st.recursive(
    _LEAVES,
    lambda inner: (
        st.tuples(inner, st.sampled_from("+-*/%"), inner).map("({0[0]} {0[1]} {0[2]})".format)
        | st.tuples(inner, st.sampled_from("+-*"), inner).map("{0[0]} {0[1]} {0[2]}".format)
        | inner.map("(-{})".format)
    ),
    max_leaves=8,
)


@given(_ARITHMETIC)
def test_arithmetic_agrees_with_python(robots, expression):
    robot = robots()
    runtime = Runtime(compile_program(f"write_output_float_register(0, {expression})"), robot)
    status = runtime.step()
    try:
        expected = eval(expression)
    except ZeroDivisionError:
        assert status is RuntimeStatus.FAILED
        return
    if status is RuntimeStatus.FAILED:
        assert "integer overflow" in str(runtime.error)
    else:
        assert robot.outputs[0] == expected
