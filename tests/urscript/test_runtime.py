import pytest

from hil.cell.arm.urscript import Runtime, RuntimeStatus, compile_program

SERVO = """
def follow():
  while True:
    q = [read_input_float_register(0), 0, 0, 0, 0, 0]
    servoj(q, 0, 0, 0.008, 0.03, 300)
  end
end
"""


def test_servoj_loop_gives_the_setpoints_of_the_registers(robot, start):
    runtime = start(SERVO)
    for i in range(5):
        robot.float_inputs[0] = 0.01 * i
        runtime.step()
        robot.end_cycle()
    assert robot.setpoints == [(0.01 * i, 0.0, 0.0, 0.0, 0.0, 0.0) for i in range(5)]


def test_line_is_where_the_main_thread_waits(start):
    runtime = start("def f():\n  sync()\n  sync()\nend\nsync()\nf()")
    lines = []
    while runtime.step() is RuntimeStatus.RUNNING:
        lines.append(runtime.line)
    assert lines == [5, 2, 3]


def test_stopped_program_does_nothing_more(robot, start):
    runtime = start(SERVO)
    runtime.step()
    robot.end_cycle()
    runtime.stop()
    assert runtime.step() is RuntimeStatus.STOPPED
    robot.end_cycle()
    assert robot.setpoints[-1] is None


def test_failed_program_stays_failed_and_keeps_its_error(start):
    runtime = start("sync()\nx = [1][1]")
    assert runtime.step() is RuntimeStatus.RUNNING
    assert runtime.step() is runtime.step() is RuntimeStatus.FAILED
    assert (runtime.error.line, runtime.error.column) == (2, 5)


def test_error_is_placed_at_the_innermost_call(run):
    runtime = run("def f(x):\n  return 1 / x\nend\ny = f(0)")
    assert (runtime.error.message, runtime.error.line) == ("division by zero", 2)


def test_same_program_does_the_same_twice(robots):
    text = """
    thread t():
      movej([0.3, 0, 0.1, 0, 0, 0])
      speedl([0.1, 0, 0, 0, 0, 0.1], 0.4, 0.2)
      stopl(3)
    end
    h = run t()
    join h
    """
    first, second = robots(), robots()
    for robot in (first, second):
        runtime = Runtime(compile_program(text), robot)
        while runtime.step() is RuntimeStatus.RUNNING:
            robot.end_cycle()
        assert runtime.status is RuntimeStatus.FINISHED
    assert first.setpoints == second.setpoints


@pytest.mark.parametrize(
    "expression",
    ['"a" + 1', "True + 1", "[1] + [1, 2]", "p[0,0,0,0,0,0] + 1", "1 < True", 'not "x"', "[1][-1]",
     "[1][0.5]", "1[0]", "sqrt(-1)", "log(2, 0)", "2147483647 + 1", "[[[1]]]", "p[1,2,3,4,5,True]",
     "5 % 0", "acos(2)", "pow(0, -1)"],
)  # fmt: skip
def test_meaningless_expression_ends_the_program(run, expression):
    assert run(f"x = {expression}").status is RuntimeStatus.FAILED
