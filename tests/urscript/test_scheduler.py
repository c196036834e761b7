from hil.cell.arm.urscript import RuntimeStatus


def test_threads_take_turns_in_the_order_they_started(robot, run):
    program = """
    thread a():
      while True:
        textmsg("a")
        sync()
      end
    end
    thread b():
      while True:
        textmsg("b")
        sync()
      end
    end
    run b()
    run a()
    while True:
      textmsg("main")
      sync()
    end
    """
    run(program, cycles=3)
    assert robot.messages == ["main", "main", "b", "a", "main", "b", "a"]


def test_join_waits_for_the_thread_to_end(said):
    program = """
    thread slow():
      sleep(0.1)
      textmsg("thread")
    end
    join run slow()
    textmsg("main")
    """
    assert said(program) == ["thread", "main"]


def test_killed_thread_does_nothing_more(said):
    program = """
    thread t():
      while True:
        textmsg("t")
        sync()
      end
    end
    h = run t()
    sync()
    sync()
    kill h
    sleep(0.1)
    """
    assert said(program) == ["t"]


def test_killing_a_handle_of_zero_or_an_ended_thread_is_no_error(said):
    assert said("thread t():\nend\nh = run t()\njoin h\nkill h\nkill 0\njoin h\ntextmsg(1)") == [
        "1"
    ]


def test_thread_may_kill_itself(said):
    program = """
    h = 0
    thread t():
      kill h
      textmsg("never")
    end
    h = run t()
    join h
    textmsg("main")
    """
    assert said(program) == ["main"]


def test_thread_gets_its_arguments_when_it_is_started(said):
    program = """
    n = 1
    thread t(x):
      textmsg(x)
    end
    h = run t(n)
    n = 2
    join h
    """
    assert said(program) == ["1"]


def test_a_critical_section_lets_other_threads_run_while_it_waits(robot, run):
    program = """
    thread t():
      while True:
        textmsg("t")
        sync()
      end
    end
    run t()
    sync()
    enter_critical
    textmsg("in")
    sleep(0.024)
    exit_critical
    textmsg("out")
    sync()
    """
    run(program)
    assert robot.messages == ["in", "t", "t", "t", "out", "t"]


def test_critical_section_ends_with_its_thread(said):
    program = """
    thread t():
      enter_critical
    end
    h = run t()
    join h
    textmsg("free")
    """
    assert said(program) == ["free"]


def test_program_ends_with_its_main_thread(run):
    runtime = run("thread t():\nwhile True:\nsync()\nend\nend\nrun t()\nsync()\n")
    assert runtime.status is RuntimeStatus.FINISHED


def test_two_threads_cannot_move_the_robot_in_one_cycle(run):
    program = """
    thread t():
      while True:
        servoj([0, 0, 0, 0, 0, 0])
      end
    end
    run t()
    while True:
      servoj([0, 0, 0, 0, 0, 0])
    end
    """
    assert "another thread is already controlling" in run(program).error.message


def test_robot_can_be_taken_over_from_a_killed_thread(run):
    program = """
    thread t():
      while True:
        servoj([0, 0, 0, 0, 0, 0])
      end
    end
    h = run t()
    sleep(0.024)
    kill h
    servoj([0, 0, 0, 0, 0, 0])
    """
    assert run(program).status is RuntimeStatus.FINISHED


def test_loop_that_takes_no_robot_time_is_an_error(run):
    runtime = run("x = 0\nwhile True:\n  x = 1 - x\nend")
    assert (runtime.error.message, runtime.error.line) == ("infinite loop", 2)


def test_recursion_without_end_is_an_error(run):
    runtime = run("def f():\n  f()\nend\nf()")
    assert runtime.error.message == "calls nest too deeply"
    assert runtime.error.line in (1, 2)


def test_budget_is_for_one_cycle_and_not_for_the_program(run):
    runtime = run("i = 0\nwhile i < 900:\n  i = i + 1\n  if i % 90 == 0:\n    sync()\n  end\nend")
    assert runtime.status is RuntimeStatus.FINISHED


def test_threads_started_without_end_are_an_error(run):
    program = "thread t():\nsleep(9)\nend\nwhile True:\nrun t()\nend"
    assert "threads" in run(program).error.message
