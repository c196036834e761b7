import pytest

from hil.cell.arm.urscript import RuntimeStatus, ScriptError, compile_program


def test_variables_of_the_first_level_are_global(said):
    program = """
    def main():
      n = 1
      def bump():
        n = n + 1
      end
      bump()
      textmsg(n)
    end
    """
    assert said(program) == ["2"]


def test_local_hides_the_global_of_its_name(said):
    program = """
    n = 1
    def hide():
      local n = 5
      n = n + 1
      return n
    end
    textmsg(hide())
    textmsg(n)
    """
    assert said(program) == ["6", "1"]


def test_parameter_hides_the_global_of_its_name(said):
    program = """
    n = 1
    def change(n):
      n = 7
    end
    change(2)
    textmsg(n)
    """
    assert said(program) == ["1"]


def test_global_declared_in_a_function_is_seen_outside(said):
    assert said("def set():\nglobal n = 4\nend\nset()\ntextmsg(n)") == ["4"]


def test_name_assigned_in_a_function_only_is_its_local(said):
    program = """
    def count(n):
      own = n
      if n > 0:
        count(n - 1)
      end
      return own
    end
    textmsg(count(3))
    """
    assert said(program) == ["3"]


def test_inner_function_hides_an_outer_one_of_its_name(said):
    program = """
    def f():
      return "outer"
    end
    def g():
      def f():
        return "inner"
      end
      return f()
    end
    textmsg(g())
    textmsg(f())
    """
    assert said(program) == ["inner", "outer"]


def test_functions_may_be_called_before_their_definition(said):
    program = """
    def even(n):
      if n == 0:
        return True
      end
      return odd(n - 1)
    end
    textmsg(even(4))
    def odd(n):
      if n == 0:
        return False
      end
      return even(n - 1)
    end
    """
    assert said(program) == ["True"]


def test_global_without_a_value_yet_fails_where_it_is_read(run):
    runtime = run("def f():\n  return late\nend\nf()\nlate = 1")
    assert runtime.status is RuntimeStatus.FAILED
    assert (runtime.error.message, runtime.error.line) == ("late has no value yet", 2)


def test_local_without_a_value_yet_fails_where_it_is_read(run):
    runtime = run("def f():\n  if False:\n    x = 1\n  end\n  return x\nend\nf()")
    assert runtime.status is RuntimeStatus.FAILED
    assert (runtime.error.message, runtime.error.line) == ("x has no value yet", 5)


@pytest.mark.parametrize(
    ("program", "message"),
    [
        ("def f():\nend\ndef f():\nend\npass", "f is defined twice"),
        ("def f():\nlocal x = 1\nglobal x = 2\nend\npass", "x is local here"),
        ("def f():\nx = 1\nend\ntextmsg(x)", "name not found: x"),
        ("def g():\ndef f():\nend\nend\nf()", "name not found: f"),
        ("unknown_builtin(1)", "name not found: unknown_builtin"),
    ],
)
def test_wrong_names_are_refused_when_compiled(program, message):
    with pytest.raises(ScriptError, match=message):
        compile_program(program)
